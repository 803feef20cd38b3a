"""Found by every Python that `ocb record` starts: records it, and then does what another `sitecustomize` would have done.

Nothing is imported before the program imports a library that is recorded.
"""

import importlib.machinery
import importlib.util
import os
import sys

_FOLDER = os.path.dirname(os.path.abspath(__file__))


def _record():
    if folder := os.environ.get("OCB_RECORD"):
        import opencollbench_recorders

        limit = int(os.environ.get("OCB_RECORD_LIMIT", "250000"))
        opencollbench_recorders.follow(folder, limit=limit, program=os.environ.get("OCB_RECORD_PROGRAM"))


def _next():
    """The `sitecustomize` that this one hides."""
    others = [path for path in sys.path if os.path.abspath(path or ".") != _FOLDER]
    spec = importlib.machinery.PathFinder.find_spec("sitecustomize", others)
    if spec and spec.loader:
        module = sys.modules["sitecustomize"] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)


try:
    _record()
except Exception as error:  # A recorder must not end the program that it records.
    print(f"ocb record: Python is not recorded: {error!r}", file=sys.stderr)
_next()
