"""Folders for results."""

from __future__ import annotations

import shutil
import tempfile
import weakref
from pathlib import Path
from typing import Optional

from .command import PathLike


class Kept:
    """A folder for results: the one that is named, or a temporary one that is deleted with the last reference to this.

    Attributes:
        path: the folder.
    """

    def __init__(self, out: Optional[PathLike]) -> None:
        if out is not None:
            self.path = Path(out)
            return
        self.path = Path(tempfile.mkdtemp(prefix="opencollbench-"))
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)
