"""The program `ocb` on this machine: where it is, and what it answers."""

from __future__ import annotations

import json
import os
import queue
import shutil
import signal
import subprocess
import threading
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Collection, Iterator, List, Optional, Sequence, Tuple, Union

from .errors import Error, Notice
from .progress import Progress, show_line

#: A path of the file system.
PathLike = Union[str, "os.PathLike[str]"]

#: Exit codes of a benchmark that ran to its end: all well; a fault of the machine; an algorithm failed or was wrong.
ENDED = (0, 1, 3)

#: How long a stopped command may take to end its jails, seconds.
PATIENCE = 30.0
#: Between two looks for a line, seconds.
LOOK_EVERY = 0.2


@dataclass(frozen=True)
class Command:
    """How `ocb` is called on this machine.

    Args:
        program: the program; by default the one in this package, else the one that the environment variable `OCB` names, else
            the one in `PATH`.
        data: data folder, with objects and runs of earlier calls; by default that of the command line. Two processes cannot use
            one at the same time.
        plugins: plugin files, or folders of plugins; by default those beside the program.
        profile: `production`, or `dev` on machines that lack layers of the jail; then nothing is ranked.
    """

    program: Optional[PathLike] = None
    data: Optional[PathLike] = None
    plugins: Sequence[PathLike] = ()
    profile: Optional[str] = None

    def find(self) -> Path:
        """The path of the program.

        Raises:
            Error: there is none.
        """
        if self.program is not None:
            return existing(Path(self.program), "the argument `ocb`")
        ours = Path(__file__).parent / "ocb"
        if ours.is_file():
            return ours
        named = os.environ.get("OCB")
        if named:
            return existing(Path(named), "the environment variable OCB")
        found = shutil.which("ocb")
        if found is None:
            raise Error("There is no program `ocb`: this package has none, OCB is not set, and none is in PATH.")
        return Path(found)

    def ask(self, arguments: Sequence[str], progress: Progress, accepted: Collection[int] = (0,)) -> Any:
        """Runs `ocb --json` with these arguments and gives what it prints.

        Raises:
            Error: it printed nothing, or ended with a code that is not accepted.
        """
        line: List[str] = [str(self.find()), "--json", *arguments]
        if self.data is not None:
            line += ["--data", os.fspath(self.data)]
        for plugin in self.plugins:
            line += ["--plugins", os.fspath(plugin)]
        if self.profile is not None:
            line += ["--profile", self.profile]
        code, printed, said = run(line, progress)
        answer = parsed(printed)
        if answer is None or code not in accepted:
            raise Error(said[-1] if said else f"`ocb` ended with exit code {code} and said nothing.", code)
        for sentence in said:
            warnings.warn(sentence, Notice, stacklevel=3)
        return answer


#: What functions accept as `ocb`.
Ocb = Union[None, PathLike, Command]


def command(ocb: Ocb) -> Command:
    """The command that the argument `ocb` of a function means."""
    return ocb if isinstance(ocb, Command) else Command(ocb)


def existing(path: Path, named_by: str) -> Path:
    if not path.is_file():
        raise Error(f"{path}, which {named_by} names, is not a file.")
    return path.absolute()


def parsed(printed: bytes) -> Any:
    try:
        return json.loads(printed)
    except ValueError:
        return None


def run(line: Sequence[str], progress: Progress) -> Tuple[int, bytes, List[str]]:
    """Runs a command line; its exit code, its output, and the sentences that it said beside its progress."""
    try:
        process = subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    except OSError as error:
        raise Error(f"{line[0]} cannot be started: {error.strerror}.") from error
    printed: List[bytes] = []
    lines: "queue.SimpleQueue[Optional[bytes]]" = queue.SimpleQueue()
    readers = [threading.Thread(target=each, daemon=True) for each in (output(process, printed), errors(process, lines))]
    for reader in readers:
        reader.start()
    said: List[str] = []
    try:
        for raw in arriving(lines):
            text = raw.decode("utf-8", "replace").rstrip()
            if text.startswith("ocb: "):
                said.append(text[len("ocb: ") :])
            elif text:
                show_line(progress, text)
        code = process.wait()
    except BaseException:
        stop(process)
        raise
    finally:
        progress.close()
        for reader in readers:
            reader.join(PATIENCE)
    return code, b"".join(printed), said


def output(process: "subprocess.Popen[bytes]", printed: List[bytes]) -> Callable[[], None]:
    def read() -> None:
        assert process.stdout is not None
        with process.stdout:
            printed.append(process.stdout.read())

    return read


def errors(process: "subprocess.Popen[bytes]", lines: "queue.SimpleQueue[Optional[bytes]]") -> Callable[[], None]:
    def read() -> None:
        assert process.stderr is not None
        with process.stderr:
            for line in process.stderr:
                lines.put(line)
        lines.put(None)

    return read


def arriving(lines: "queue.SimpleQueue[Optional[bytes]]") -> Iterator[bytes]:
    """The lines until the end. Python notices an interrupt between two looks, whichever thread the signal reaches."""
    while True:
        try:
            line = lines.get(timeout=LOOK_EVERY)
        except queue.Empty:
            continue
        if line is None:
            return
        yield line


def stop(process: "subprocess.Popen[bytes]") -> None:
    """Lets the command end its jails, and kills it when it does not."""
    process.send_signal(signal.SIGINT)
    try:
        process.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
