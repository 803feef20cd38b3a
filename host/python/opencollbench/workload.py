"""`replay`: what a program asked, put to other algorithms."""

from __future__ import annotations

import os
from typing import Any, List, Mapping, Optional

from .benchmark import Algorithms, listed
from .command import ENDED, Ocb, PathLike, command
from .kept import Kept
from .progress import shown
from .tables import Parquet, Row, Rows, picked


class Workload:
    """A recording that was replayed.

    Attributes:
        data: everything that `ocb bench --workload --json` prints: the program, its own answers (`recorded`), the objects, and
            the results of each order (`tracks`).
    """

    def __init__(self, data: Mapping[str, Any], kept: Kept) -> None:
        self.data = dict(data)
        self._kept = kept

    @property
    def ok(self) -> bool:
        """Whether every algorithm answered everything that it can be asked, and nothing wrongly."""
        return all(row["fair"] for row in self.summary())

    def summary(self) -> Rows:
        """One row per order and algorithm. Times are in nanoseconds: `total_ns` of all queries together, with the range over
        the processes.

        An algorithm that is not `fair` gave a wrong answer or none, or was not asked everything: its time must not be compared.
        """
        return Rows([row(track["track"], each) for track in self.data["tracks"] for each in track["algorithms"]])

    def false_answers(self) -> Rows:
        """The first false answers in the recording, missed collisions first."""
        return Rows(picked(self.data, "recorded", "false_answers") or [])

    def queries(self) -> Parquet:
        """One row per query, algorithm and order, with the columns of "Recordings" in `host/README.md`."""
        return Parquet([({}, (self._kept.path / "queries.parquet").read_bytes)])

    def __repr__(self) -> str:
        program = self.data.get("program") or "a program"
        return f"<Workload of {program}: {self.data['queries']} of {self.data['seen']} queries>"


def row(order: str, result: Mapping[str, Any]) -> Row:
    cells: Row = {"order": order, "algorithm": result["algorithm"], "n": result["n"], "of": result["of"]}
    for name in ("ns", "lowest_ns", "highest_ns"):
        cells[f"total_{name}"] = picked(result, "total", name)
    for name in ("median_ns", "p95_ns", "max_ns"):
        cells[f"group_{name}"] = picked(result, "groups", name)
    for name in ("build_ns", "wrong", "missed", "silent"):
        cells[name] = result[name]
    complete = 0 < result["n"] == result["of"] and not result["ended"]
    cells["fair"] = complete and not result["wrong"] and not result["silent"]
    return cells


def replay(
    file: PathLike,
    algorithms: Algorithms = None,
    *,
    order: Optional[str] = None,
    passes: int = 5,
    budget: float = 60.0,
    run_seed: Optional[int] = None,
    out: Optional[PathLike] = None,
    progress: bool = True,
    ocb: Ocb = None,
) -> Workload:
    """Puts every query of a recording to every algorithm that answers its kind, and compares the answers with the oracle.

    Args:
        file: a recording (`.ocbrec`).
        algorithms: ids, with optional settings; by default the usual ones.
        order: `recorded`, `shuffled` or `scene` (all objects in one process); by default all.
        passes: number of processes per algorithm, order and pair of objects.
        budget: measuring time per algorithm and order in seconds.
        run_seed: seed of the orders, to repeat a replay.
        out: folder for the result files; by default they are deleted with the `Workload`.
        progress: show how far it is.
        ocb: the program, or a `Command`.

    Returns:
        The result, also when an algorithm failed or gave wrong answers: `Workload.ok` and `Workload.summary` tell.

    Raises:
        Error: in one sentence, what is wrong.
    """
    kept = Kept(out)
    arguments: List[str] = ["bench", "--workload", os.fspath(file)]
    for algorithm in listed(algorithms):
        arguments += ["--algorithm", algorithm]
    arguments += ["--passes", str(passes), "--budget", str(budget), "--out", str(kept.path)]
    arguments += [] if order is None else ["--order", order]
    arguments += [] if run_seed is None else ["--run-seed", str(run_seed)]
    data = command(ocb).ask(arguments, shown(progress), ENDED)
    return Workload(data, kept)
