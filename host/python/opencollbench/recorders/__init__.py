"""Records what a Python program asks of collision libraries, without a change to its answers.

    from opencollbench import recorders

    with recorders.record("spool"):
        plan()                      # calls fcl, coal, trimesh.collision or mujoco.mj_geomDistance
    # then: ocb record --spool spool --out robot.ocbrec

`python -m opencollbench.recorders PROGRAM.py ARGS` records a program that knows nothing of it, and so does
`ocb record --out robot.ocbrec -- python PROGRAM.py ARGS`, which also makes the recording and needs no package installed.

Recorded are calls from Python. The times are of the library's function alone. What cannot be recorded is counted by reason.
Needs numpy.
"""

import atexit
import sys
from contextlib import contextmanager

#: The name under which `ocb record` puts this package into programs.
_FOLLOWED = "opencollbench_recorders"

__all__ = ["group", "record", "start", "stop"]


def group():
    """Begins a group; the queries of this thread belong to it until it calls this again.

    Call it for each robot state, call of a planner, or step of a simulation. A thread that never calls it has a group for each
    call of a collision manager, and for each query outside of those.
    """
    from . import session

    session.group()
    followed = sys.modules.get(_FOLLOWED)
    if followed and __name__ != _FOLLOWED:
        followed.group()


def start(folder, *, limit=250_000, program=None):
    """Begins recording into `folder`, which must not exist or be empty.

    At most `limit` queries are kept (256 bytes each): of more, every second, fourth, ... whole group. Raises `OSError` when the
    folder cannot be made, `RuntimeError` when something is being recorded already.
    """
    from . import patching, session

    if session.recording():
        raise RuntimeError("A recording is under way already; end it with stop() first.")
    session.this_process(folder, program or sys.argv[0] or "python", limit)
    patching.install()


def follow(folder, *, limit, program=None):
    """Begins recording of a whole process and of those that it forks, each into a spool of its own in `folder`."""
    from . import patching

    def each_process():
        from . import session

        session.each_process(folder, program or sys.argv[0] or "python", limit)
        atexit.register(session.end)

    patching.install(each_process)


def stop():
    """Ends recording; the libraries are as they were."""
    from . import patching, session

    session.end()
    patching.remove()


@contextmanager
def record(folder, *, limit=250_000, program=None):
    """Records the queries inside of the `with` block; see `start`."""
    start(folder, limit=limit, program=program)
    try:
        yield
    finally:
        stop()
