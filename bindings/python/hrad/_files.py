"""The section "files" of hrad.h: checkpoints and exports. Paths are str or os.PathLike."""

from ._calls import call, text_of
from ._handle import Handle


def describe_checkpoint(path):
    """Checks a whole checkpoint as reading does, and describes it as text, one `name: value` a
    line. Errors: FILE; FORMAT for a file that is damaged or no checkpoint."""
    return text_of(call, "describe_checkpoint", path)


class Files(Handle):
    """Checkpoints (.hrad), which hold a whole solve, and exports for other programs."""

    def write_checkpoint(self, path):
        """[C] Writes a checkpoint at any time between other calls, and from the progress function
        of a solve, which then goes on. The file appears whole under its name or not at all; what
        was there before stays as PATH.prev (parameter checkpoint_keep). Errors: FILE (the old file
        is whole), also when another process holds PATH.lock; STATE from the progress function while
        there is nothing yet to go on from, or of several ranks: stop the solve there, write on all
        of them, and solve on."""
        self._call("write_checkpoint", path)

    def lock_checkpoint(self, path):
        """[C] Locks a checkpoint against other writers, in this and in other processes, until the
        solver locks another one or is destroyed. Errors: FILE when it is locked already or
        PATH.lock can't be made."""
        self._call("lock_checkpoint", path)

    def read_checkpoint(self, path):
        """[C] Reads a checkpoint: the solver is then as the one that wrote it was, with the same
        hash, and solve() goes on to the same bits as without a stop. The result parameters become
        those of the file, the run parameters stay. A solver that has patches must have the same
        scene. Errors: FILE; FORMAT for a file that is damaged or no checkpoint; STATE for another
        scene; MEMORY when it holds more than max_memory. The solver is then as it was."""
        self._call("read_checkpoint", path)

    def export(self, path):
        """[C] Writes the solution in the format of the path's ending: .csv, .vtu, .ply or .glb;
        .obj writes the scene itself with its .mtl beside it and needs no solve. The file appears
        whole under its name or not at all. Errors: ARGUMENT for another ending; FILE; STATE before
        a solve; UNSUPPORTED for a solution larger than the format can hold."""
        self._call("export", path)
