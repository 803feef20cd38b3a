#!/usr/bin/env python3
"""faults.py all|quick|WORD: plants the faults of faults.toml into a copy of the core, one at a time, and runs its tests.

Every fault must make a test fail, and the copy without a fault must pass; quick leaves the latter to `make test`, which runs
the same tests beside it. WORD: those that name it. The copy stands in target/faults, where it finds the dependencies that
the workspace has built already; nothing outside target/ is touched.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import threading
import time
import tomllib
from pathlib import Path

root = Path(__file__).resolve().parents[2]
target = Path(os.environ.get("CARGO_TARGET_DIR", root / "target")).resolve()
copy = target / "faults"
sources = "host/core/src"
# A fault may make a search endless: so many times as long as without a fault, and this much more, is waited for an end.
patience, spare = 10, 30
# So long where that is not known.
longest = 600
# Of each test program those that need objects which are not there; found while no fault is planted.
absent: dict[str, list[str]] = {}


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


def run_tests(test: str, sound: dict[str, float], setting: str, finder: str | None = None) -> str | None:
    """What failed, if anything did. `sound`: seconds that the parts of a test program take without a fault, where known.
    `finder`: a test of the oracle that is run before all others."""
    environment = os.environ | {"CARGO_TARGET_DIR": str(target), "RUST_BACKTRACE": "0", "CARGO_TERM_COLOR": "never"}
    environment.setdefault("OCB_SHARED", str(root.parent / "shared"))
    # Another profile than that of the workspace: else the core with a fault would lie where the next build looks for its own,
    # and all that depends on it would be built again.
    profile = f"profile.release.package.ocb-core.{setting}"
    cargo = ["cargo", "test", "--release", "--locked", "--offline", "--workspace", "--test", test, "--no-run"]
    cargo += ["--config", profile, "--message-format=json-render-diagnostics"]
    built = subprocess.run(cargo, cwd=copy, env=environment, capture_output=True, text=True)
    if built.returncode != 0:
        die(f"the copy does not compile:\n{built.stderr}")
    said = [json.loads(line) for line in built.stdout.splitlines()]
    [program] = [m["executable"] for m in said if m.get("executable") and m["target"]["name"] == test]
    parts = {test: []}
    if test == "oracle":
        # CGAL is the same whatever the fault, and its program takes a while to build. The quick tests find most faults.
        first, skip = ["pairs::", "rounding::", "margins::", "extremes::"], ["--skip", "cgal::"]
        parts = {"quick ones": first, "others": skip + [word for name in first for word in ("--skip", name)]}
    if finder:
        parts = {finder: ["--exact", finder], test: ["--skip", finder, "--skip", "cgal::"]}
    for name in without_objects(test, program, environment):
        parts = {part: [*chosen, "--skip", name] for part, chosen in parts.items()}
    for name, chosen in parts.items():
        started = time.monotonic()
        limit = patience * sound[name] + spare if name in sound else longest
        failed = first_failure([program, *chosen], environment, limit)
        if failed:
            return failed
        sound.setdefault(name, time.monotonic() - started)
    return None


def without_objects(test: str, program: str, environment: dict[str, str]) -> list[str]:
    """The tests that are not run because the real objects are not there; whatever they say tells nothing of a fault."""
    if (Path(environment["OCB_SHARED"]) / "meshes").is_dir():
        return []
    if test not in absent:
        said = subprocess.run([program], cwd=copy / "host/core", env=environment, capture_output=True, text=True).stdout
        blocks = re.findall(r"^---- (\S+) stdout ----$(.*?)(?=^---- |^failures:$)", said, re.MULTILINE | re.DOTALL)
        absent[test] = [name for name, told in blocks if "not run: objects missing" in told]
        print(f"faults: {len(absent[test])} tests not run: objects missing, set OCB_SHARED", flush=True)
    return absent[test]


def first_failure(program: list[str], environment: dict[str, str], limit: float) -> str | None:
    """The first test that fails, after which none of the others is waited for."""
    tests = subprocess.Popen(program, cwd=copy / "host/core", env=environment, stdout=subprocess.PIPE, text=True)
    late = threading.Event()
    watch = threading.Timer(limit, lambda: (late.set(), tests.kill()))
    watch.start()
    try:
        for line in tests.stdout:
            if failed := re.match(r"test (\S+) \.\.\. FAILED", line):
                return failed[1]
    finally:
        watch.cancel()
        tests.kill()
        tests.wait()
    if late.is_set():
        return f"no end after {limit:.0f} s"
    if tests.returncode != 0:
        die(f"{' '.join(program)} ended with {tests.returncode}")
    return None


def main() -> None:
    if len(sys.argv) != 2:
        die("usage: faults.py all|quick|WORD")
    which = sys.argv[1]
    faults = tomllib.loads((Path(__file__).parent / "faults.toml").read_text())["fault"]
    chosen = [f for f in faults if which == "all" or (f.get("quick") if which == "quick" else which in f["why"])]
    if not chosen:
        die(f"no fault names {which!r}")
    # All are looked up, also those that are not planted now.
    for fault in faults:
        times = (root / sources / fault["file"]).read_text().count(fault["find"])
        if times != 1:
            die(f"{fault['file']} holds {fault['find']!r} {times} times, not once; plant this fault anew: {fault['why']}")
    if shutil.which("cargo") is None:
        die("cargo is not on the path")
    make_copy()
    sound: dict[str, float] = {}
    # The quick ones are found in seconds: a core that is compiled sooner is worth more than one that computes faster.
    setting = "opt-level=0" if which == "quick" else "codegen-units=15"
    if which != "quick":
        for test in dict.fromkeys(f.get("test", "oracle") for f in chosen):
            if failed := run_tests(test, sound, setting):
                die(f"without any fault there fails {failed}")
        print(f"faults: none planted, none found ({sum(sound.values()):.0f} s)", flush=True)
    survived = []
    for number, fault in enumerate(chosen, 1):
        started = time.monotonic()
        file = copy / sources / fault["file"]
        whole = file.read_text()
        finder = fault["quick"] if which == "quick" else None
        file.write_text(whole.replace(fault["find"], fault["replace"]))
        try:
            failed = run_tests(fault.get("test", "oracle"), sound, setting, finder)
        finally:
            file.write_text(whole)
        if not failed:
            survived.append(fault["why"])
        seconds = time.monotonic() - started
        print(f"faults: {number} of {len(chosen)}, {fault['why']}: found by {failed or 'NOTHING'} ({seconds:.0f} s)", flush=True)
    print(f"faults: {len(chosen) - len(survived)} of {len(chosen)} found")
    if survived:
        die("these faults passed all tests: " + "; ".join(survived))


main()
