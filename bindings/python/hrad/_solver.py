"""The solver as programs see it: all sections of hrad.h together."""

from ._files import Files
from ._parameters import Parameters
from ._partition import Partition
from ._queries import Queries
from ._solving import Solving


class Solver(Parameters, Partition, Solving, Queries, Files):
    """A solver, empty at first, for this process alone (hrad_create), or over the processes of a
    communicator of mpi4py (hrad_create_mpi): Solver(MPI.COMM_WORLD), which takes the library
    libhrad_mpi beside libhrad. All ranks then call the methods marked [C] in the same order, and
    destroy the solver together, before MPI ends. A method that fails by its arguments' types or
    shapes has not called the library: then all ranks must fail alike.

        with hrad.Solver() as solver:
            solver.make_scene("cornell")
            solver.solve()

    Errors: MEMORY, MPI; ImportError without libhrad_mpi."""
