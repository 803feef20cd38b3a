"""What the tests share: the program that was built, and stand-ins for it."""

from __future__ import annotations

import atexit
import os
import shutil
import stat
import sys
import tempfile
from pathlib import Path
from typing import Any, Dict

ROOT = Path(__file__).resolve().parents[3]
BUILT = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "release"
#: The plugins that are asked; to describe all of them takes longer than most tests.
PLUGINS = [BUILT / name for name in ("libocb_box_tree.so", "libocb_brute_force.so", "libocb_fast.so")]
#: A small object, so that everything is quick.
KNOT = "stock:torus-knot@600"
#: Arguments of a benchmark that takes a second.
SMALL: Dict[str, Any] = {"separation": 0.1, "count": 40, "passes": 1, "progress": False}

#: A folder of these tests alone.
FOLDER = Path(tempfile.mkdtemp(prefix="ocb-python-"))
atexit.register(shutil.rmtree, FOLDER, ignore_errors=True)


def use_built() -> None:
    """Lets the package find the program that was built, with a data folder of the tests."""
    program = BUILT / "ocb"
    for path in [program, *PLUGINS]:
        assert path.is_file(), f"{path} is missing; run `cargo build --release` first"
    for name in ("OCB_DATABASE", "OCB_BLOBS", "OCB_RUNNER", "OCB_STOCK", "OCB_LOG", "OCB_MACHINE_NOTE", "OCB_PROFILE"):
        os.environ.pop(name, None)
    os.environ["OCB"] = str(program)
    os.environ["OCB_DATA"] = str(FOLDER / "data")
    os.environ["OCB_PLUGINS"] = ":".join(map(str, PLUGINS))


def stand_in(body: str) -> Path:
    """A program that takes the place of `ocb`, written in Python."""
    path = FOLDER / f"stand-in-{len(list(FOLDER.glob('stand-in-*')))}"
    path.write_text(f"#!{sys.executable}\nimport json, os, signal, sys, time\n{body}\n")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    return path
