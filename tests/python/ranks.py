"""One rank of test_ranks.py: prints the hash of a solve over all ranks when everything was as it should
be."""

import sys
import warnings

from mpi4py import MPI

import hrad


def require(what, fact):
    if not fact:
        sys.stderr.write("rank %d: %s\n" % (MPI.COMM_WORLD.rank, what))
        MPI.COMM_WORLD.Abort(1)


def fail(progress):
    raise LookupError("of rank 0")


rank, size = MPI.COMM_WORLD.rank, MPI.COMM_WORLD.size
with hrad.Solver(MPI.COMM_WORLD) as solver:
    solver.make_scene("cornell")
    solver["accuracy"] = 0.2
    solver["threads"] = 1
    solver.set_progress(fail)
    try:
        require("the others stop", solver.solve() == hrad.STOPPED and rank > 0)
    except LookupError:
        require("rank 0 has the callback", rank == 0)
    solver.set_progress(None)
    require("the solve goes on", solver.solve() == hrad.OK)
    require("all are one solver", solver.get_stats().ranks == size)

    # Each asks for what it likes.
    mine = solver.query_patches(hrad.RADIOSITY, first=rank, count=3)
    require("answers are complete", (mine == solver.query_patches(hrad.RADIOSITY)[rank:rank + 3]).all())

    # All must destroy it together, which a garbage collector can't.
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        solver.__del__()
    require("dropping it is warned about", [w.category for w in caught] == [ResourceWarning])
    sys.stdout.write("hash %016x\n" % solver.state_hash())

try:
    hrad.Solver(MPI.COMM_NULL)
    require("no communicator is refused", False)
except hrad.ArgumentError:
    pass
