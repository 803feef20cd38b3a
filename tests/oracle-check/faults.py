#!/usr/bin/env python3
"""faults.py all|quick: plants the faults of faults.toml into a copy of the core, one at a time, and runs the oracle's tests.

Every fault must make a test fail, and the copy without a fault must pass. The copy stands in target/faults, where it finds
the dependencies that the workspace has built already; nothing outside target/ is touched.
"""

import os
import re
import shutil
import subprocess
import sys
import time
import tomllib
from pathlib import Path

root = Path(__file__).resolve().parents[2]
target = Path(os.environ.get("CARGO_TARGET_DIR", root / "target")).resolve()
copy = target / "faults"
sources = "host/core/src"
# A fault may make a search endless; the sound copy needs a minute.
seconds = 900


def die(reason: str) -> None:
    sys.exit(f"faults: {reason}")


def make_copy() -> None:
    """Tracked and new files as they are now; unchanged ones are not written, so that nothing is built twice."""
    listed = ["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = [n for n in subprocess.check_output(listed, text=True).split("\0") if n and (root / n).is_file()]
    for stale in sorted(copy.rglob("*")):
        if stale.is_file() and str(stale.relative_to(copy)) not in set(names):
            stale.unlink()
    for name in names:
        content = (root / name).read_bytes()
        to = copy / name
        if not to.is_file() or to.read_bytes() != content:
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_bytes(content)


def run_tests() -> tuple[bool, str]:
    """Do they pass? And which of them failed."""
    environment = os.environ | {"CARGO_TARGET_DIR": str(target), "RUST_BACKTRACE": "0", "CARGO_TERM_COLOR": "never"}
    environment.setdefault("OCB_SHARED", str(root.parent / "shared"))
    cargo = ["cargo", "test", "--release", "--locked", "--offline", "--workspace", "--test", "oracle"]
    # CGAL is the same whatever the fault, and its program takes a while to build. The quick tests find most faults.
    first, skip = ["pairs::", "margins::", "extremes::"], ["--skip", "cgal::"]
    rest = skip + [word for name in first for word in ("--skip", name)]
    built = subprocess.run(cargo + ["--no-run"], cwd=copy, env=environment, capture_output=True, text=True)
    if built.returncode != 0:
        die(f"the copy does not compile:\n{built.stderr}")
    for chosen in [first, rest]:
        passed, report = run_some(cargo + ["--quiet", "--", *chosen], environment)
        if not passed:
            return False, report
    return True, "no test"


def run_some(cargo: list[str], environment: dict[str, str]) -> tuple[bool, str]:
    try:
        done = subprocess.run(cargo, cwd=copy, env=environment, capture_output=True, text=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        return False, f"no end after {seconds} s"
    failed = sorted(set(re.findall(r"^---- (\S+) stdout ----", done.stdout, re.M)))
    if done.returncode != 0 and not failed:
        die(f"the tests did not run:\n{done.stdout}\n{done.stderr}")
    return done.returncode == 0, f"{len(failed)} tests, such as {', '.join(failed[:3])}"


def main() -> None:
    if sys.argv[1:] not in (["all"], ["quick"]):
        die("usage: faults.py all|quick")
    faults = tomllib.loads((Path(__file__).parent / "faults.toml").read_text())["fault"]
    chosen = [f for f in faults if sys.argv[1] == "all" or f.get("quick")]
    # All are looked up, also those that are not planted now.
    for fault in faults:
        times = (root / sources / fault["file"]).read_text().count(fault["find"])
        if times != 1:
            die(f"{fault['file']} holds {fault['find']!r} {times} times, not once; plant this fault anew: {fault['why']}")
    if shutil.which("cargo") is None:
        die("cargo is not on the path")
    make_copy()
    sound, report = run_tests()
    if not sound:
        die(f"without any fault these fail: {report}")
    survived = []
    for number, fault in enumerate(chosen, 1):
        started = time.monotonic()
        file = copy / sources / fault["file"]
        whole = file.read_text()
        file.write_text(whole.replace(fault["find"], fault["replace"]))
        try:
            passed, report = run_tests()
        finally:
            file.write_text(whole)
        if passed:
            survived.append(fault["why"])
            report = "NOTHING"
        took = time.monotonic() - started
        print(f"faults: {number} of {len(chosen)}, {fault['why']}: found by {report} ({took:.0f} s)", flush=True)
    print(f"faults: {len(chosen) - len(survived)} of {len(chosen)} found")
    if survived:
        die("these faults passed all tests: " + "; ".join(survived))


main()
