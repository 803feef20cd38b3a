"""How far a call has come, shown on stderr: as bars where tqdm is installed, else as lines."""

from __future__ import annotations

import re
import sys
from typing import Any, Dict, Optional, Protocol

STAGE = re.compile(r"(?P<name>.+?): (?P<done>\d+)/(?P<total>\d+)(?: (?P<note>.*))?")
BEGUN = re.compile(r"(?P<name>.+): running")
QUERIES = re.compile(r"(?P<done>\d+) of (?P<total>\d+) (?P<name>queries)")


class Progress(Protocol):
    """Shows the progress of the command."""

    def stage(self, name: str, done: int, total: int, note: str) -> None:
        """So much of a stage is done; `total` is 0 while it is unknown."""

    def say(self, text: str) -> None:
        """Something that is no number."""

    def close(self) -> None:
        """Nothing more comes."""


class Silent:
    """Shows nothing."""

    def stage(self, name: str, done: int, total: int, note: str) -> None:
        pass

    def say(self, text: str) -> None:
        pass

    def close(self) -> None:
        pass


class Lines:
    """A line for everything that is new."""

    def __init__(self) -> None:
        self.last: Optional[str] = None

    def stage(self, name: str, done: int, total: int, note: str) -> None:
        count = f"{done}/{total} " if total else ""
        self.say(f"{name}: {count}{note}".rstrip())

    def say(self, text: str) -> None:
        if text != self.last:
            print(text, file=sys.stderr, flush=True)
            self.last = text

    def close(self) -> None:
        pass


class Bars:
    """A bar of tqdm for each stage."""

    def __init__(self, tqdm: Any) -> None:
        self.tqdm = tqdm
        self.bars: Dict[str, Any] = {}

    def stage(self, name: str, done: int, total: int, note: str) -> None:
        bar = self.bars.get(name)
        if bar is None:
            bar = self.bars[name] = self.tqdm(desc=name, file=sys.stderr)
        bar.total = total or None
        bar.set_postfix_str(note, refresh=False)
        bar.update(done - bar.n)

    def say(self, text: str) -> None:
        self.tqdm.write(text, file=sys.stderr)

    def close(self) -> None:
        for bar in self.bars.values():
            bar.close()
        self.bars.clear()


def shown(progress: bool) -> Progress:
    """What shows progress, or nothing where none is wanted."""
    if not progress:
        return Silent()
    try:
        from tqdm import tqdm
    except ImportError:
        return Lines()
    return Bars(tqdm)


def show_line(progress: Progress, line: str) -> None:
    """Shows a line of progress of `ocb`, such as `parry: 300/1000 100/s, 7 s left`, `parry: running` or `300 of 1000 queries`."""
    begun = BEGUN.fullmatch(line)
    found = STAGE.fullmatch(line) or QUERIES.fullmatch(line)
    if found is not None:
        parts = found.groupdict()
        progress.stage(parts["name"], int(parts["done"]), int(parts["total"]), parts.get("note") or "")
    elif begun is not None:
        progress.stage(begun["name"], 0, 0, "running")
    else:
        progress.say(line)
