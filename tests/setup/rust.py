#!/usr/bin/env python3
"""rust.py [WORD...]: runs the test programs of the workspace, or those that a word names, side by side: three, or more that mostly wait.

Prints what `cargo test --workspace --no-fail-fast` prints: each program's output as a whole, once it has ended, and for each
that fails the command that repeats it. programs.toml says which may run beside which. Ends with 1 if one failed.
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

root = Path(__file__).resolve().parents[2]
cargo = ["cargo", "test", "--release", "--workspace"]
# Three programs side by side on two CPUs, because each waits at times, and one more that mostly waits, which takes half of a place.
PLACES = 3.5
# So many at a time measure.
MOST_MEASURE = 2
# Each has a measuring lock of its own, where it may.
APART = root / "tests/setup/apart.sh"


@dataclass
class Program:
    """A test program: how to start and to repeat it, and what programs.toml says of it."""

    name: str
    title: str
    command: list[str]
    folder: str
    repeat: str
    kind: str = "short"
    seconds: int = 0
    threads: int | None = None
    started: float = 0.0
    process: subprocess.Popen | None = None
    output: IO[bytes] | None = None

    def start(self) -> None:
        """Its output goes to a file of its own, which no process that it leaves behind holds open for us."""
        environment = os.environ | {"CARGO_MANIFEST_DIR": self.folder}
        if self.threads:
            environment.setdefault("RUST_TEST_THREADS", str(self.threads))
        self.output, self.started = tempfile.TemporaryFile(), time.monotonic()
        same = {"stdin": subprocess.DEVNULL, "stdout": self.output, "stderr": subprocess.STDOUT}
        self.process = subprocess.Popen([APART, *self.command], cwd=self.folder, env=environment, **same)


def programs() -> list[Program]:
    """All of them, built; the doc tests are one."""
    built = [*cargo, "--no-run", "--quiet", "--message-format=json-render-diagnostics"]
    told = subprocess.run(built, cwd=root, stdout=subprocess.PIPE, text=True)
    if told.returncode != 0:
        sys.exit(told.returncode)
    found = []
    for message in map(json.loads, told.stdout.splitlines()):
        if not message.get("executable") or not message["profile"]["test"]:
            continue
        target, folder = message["target"], Path(message["manifest_path"]).parent
        package = tomllib.loads(Path(message["manifest_path"]).read_text())["package"]["name"]
        source = Path(target["src_path"]).relative_to(folder)
        kind = target["kind"][0] if target["kind"][0] in ("test", "bin") else "lib"
        name = target["name"] if kind == "test" else kind
        title = f"{'' if kind == 'test' else 'unittests '}{source} ({package})"
        which = "--lib" if kind == "lib" else f"--{kind} {target['name']}"
        found.append(Program(f"{package} {name}", title, [message["executable"]], str(folder), f"-p {package} {which}"))
    return [*found, Program("doc", "doc tests", [*cargo, "--doc", "--no-fail-fast"], str(root), "--doc")]


def described(found: list[Program]) -> list[Program]:
    """Longest first, as programs.toml says; a line about none of them is a mistake."""
    by_name = {program.name: program for program in found}
    for kind, lines in tomllib.loads((Path(__file__).parent / "programs.toml").read_text()).items():
        for name, about in lines.items():
            if name not in by_name:
                sys.exit(f"rust: programs.toml names {name!r}, which is no test program.")
            program = by_name[name]
            program.kind, program.seconds, program.threads = kind, about["seconds"], about.get("threads")
            if word := about.get("alone"):
                found.append(apart(program, word, about["alone_seconds"]))
    return sorted(found, key=lambda program: -program.seconds)


def apart(program: Program, word: str, seconds: int) -> Program:
    """Takes the tests with this word out of a program, to be run alone."""
    command, title, repeat = program.command, program.title, program.repeat
    program.command, program.title = [*command, "--skip", word], f"{title} without {word}"
    alone = replace(program, command=[*command, word], title=f"{title} {word}", repeat=f"{repeat} -- {word}")
    alone.kind, alone.seconds = "alone", seconds
    return alone


def beside(kind: str, others: list[str]) -> bool:
    """May a program of this kind run at the same time as these?"""
    if "alone" in others or kind == "alone":
        return not others
    if kind == "computes":
        return "measures" not in others
    return kind != "measures" or ("computes" not in others and others.count("measures") < MOST_MEASURE)


def place(program: Program) -> float:
    """How much of the places it takes."""
    return 0.5 if program.kind == "waits" else 1


def run(waiting: list[Program]) -> list[Program]:
    """Those that failed. The longest starts first that may run beside what runs."""
    running: dict[int, Program] = {}
    ended: list[tuple[Program, float, float]] = []
    failed, begun = [], time.monotonic()
    try:
        while waiting or running:
            free = PLACES - sum(map(place, running.values()))
            kinds = [other.kind for other in running.values()]
            fitting = (p for p in waiting if place(p) <= free and beside(p.kind, kinds))
            if program := next(fitting, None):
                waiting.remove(program)
                program.start()
                running[program.process.pid] = program
                print(f"     Started {program.title} after {time.monotonic() - begun:.0f} s", flush=True)
                continue
            pid, status, used = os.wait4(-1, 0)
            if not (program := running.pop(pid, None)):
                continue
            seconds, code = time.monotonic() - program.started, os.waitstatus_to_exitcode(status)
            program.process.returncode = code
            ended.append((program, seconds, used.ru_utime + used.ru_stime))
            show(program, code)
            if code != 0:
                failed.append(program)
    finally:
        for program in running.values():
            program.process.terminate()
    print("\nThe longest, in seconds, and the seconds of CPU that they and what they started took:")
    for program, seconds, cpu in sorted(ended, key=lambda of: -of[1])[:25]:
        print(f"{seconds:7.1f} {cpu:7.1f}  {program.kind:8} {program.title}")
    print(f"{sum(cpu for *_, cpu in ended):15.1f}  all")
    return failed


def show(program: Program, code: int) -> None:
    """All that it said."""
    print(f"     Running {program.title}", flush=True)
    program.output.seek(0)
    said = program.output.read()
    program.output.close()
    sys.stdout.buffer.write(said)
    # Cargo says it itself of the doc tests.
    if code != 0 and b"error: doctest failed, to rerun pass" not in said:
        end = f"exit status {code}" if code > 0 else f"signal {-code} ({signal.strsignal(-code)})"
        # As cargo says it; test.sh looks for this line.
        print(f"error: test failed, to rerun pass `{program.repeat}`\n  {end}: {' '.join(program.command)}")
    sys.stdout.flush()


def main() -> None:
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    words = sys.argv[1:]
    chosen = [p for p in described(programs()) if not words or any(word in p.name for word in words)]
    if not chosen:
        sys.exit(f"rust: no test program is named like {' or '.join(words)}.")
    started = time.monotonic()
    if failed := run(list(chosen)):
        print(f"error: {len(failed)} of {len(chosen)} programs failed. To repeat them:")
        for program in failed:
            # With all crates: for one alone, cargo chooses other features and builds much again.
            print(f"    tests/setup/rust.py '{program.name}'")
    print(f"rust: {len(chosen)} programs in {time.monotonic() - started:.0f} s")
    sys.exit(bool(failed))


main()
