"""A benchmark run: its summary, its records, its configurations."""

from __future__ import annotations

from typing import Any, List, Mapping, Optional, Protocol, Sequence

from .configurations import Configurations
from .errors import Error
from .tables import Parquet, Row, Rows, joined, picked


class Source(Protocol):
    """Where the files of a run are."""

    def records(self, algorithm: str) -> bytes:
        """The records of an algorithm as Parquet."""

    def triangles(self, algorithm: str) -> Optional[bytes]:
        """The primitive tests per triangle as Parquet, where the algorithm counts them."""

    def configurations(self) -> bytes:
        """The configuration set as Parquet."""


class Run:
    """A run that has ended, well or not.

    Attributes:
        info: everything about the run as `ocb --json` and the API give it (`RunInfo` in `web/server/openapi.json`): `spec`,
            `set`, `environment`, `results` and so on.
    """

    def __init__(self, info: Mapping[str, Any], source: Source) -> None:
        self.info = dict(info)
        self._source = source

    @property
    def id(self) -> str:
        """Its id."""
        return str(self.info["id"])

    @property
    def state(self) -> str:
        """`done`, `failed` or `cancelled`."""
        return str(self.info["state"])

    @property
    def message(self) -> Optional[str]:
        """Why it failed, one sentence."""
        return self.info.get("message")

    @property
    def algorithms(self) -> List[str]:
        """The algorithms that were measured, with their settings."""
        return [result["algorithm"] for result in self._results() if result.get("n")]

    @property
    def ok(self) -> bool:
        """Whether every algorithm completed and gave no wrong answer, also to the control questions."""
        return self.state == "done" and all(well(result) for result in self._results())

    def summary(self) -> Rows:
        """One row per algorithm, in the order in which they were asked for.

        Times are in nanoseconds per query, `_lo` and `_hi` the ends of their 95 % intervals; `ratio` is the time over that of the
        reference algorithm; `rank` is absent for an algorithm that failed or was wrong, and `unranked` says why. `missed`
        collisions are part of `wrong`.
        """
        return Rows([row(result) for result in self._results()])

    def records(self, algorithm: Optional[str] = None) -> Parquet:
        """The records: one row per configuration that was measured, with the columns of "Records" in `host/README.md`.

        Args:
            algorithm: one of `algorithms`; by default all below each other, with a column `algorithm` in front.

        Raises:
            Error: it was not measured.
        """
        if algorithm is not None:
            return self._records(algorithm, {})
        if not self.algorithms:
            raise Error("The run has no records, because no algorithm was measured.")
        return joined([self._records(each, {"algorithm": each}) for each in self.algorithms])

    def triangles(self, algorithm: str) -> Optional[Parquet]:
        """In how many primitive tests each triangle took part, or nothing where the algorithm does not count them."""
        found = self._source.triangles(self._measured(algorithm))
        if found is None:
            return None
        content: bytes = found
        return Parquet([({}, lambda: content)])

    def configurations(self) -> Configurations:
        """The configurations with their certified answers."""
        return Configurations(self.info.get("set") or {}, self._source.configurations)

    def _records(self, algorithm: str, constants: Mapping[str, Any]) -> Parquet:
        measured = self._measured(algorithm)
        return Parquet([(constants, lambda: self._source.records(measured))])

    def _measured(self, algorithm: str) -> str:
        if algorithm not in self.algorithms:
            measured = ", ".join(self.algorithms) or "none"
            raise Error(f"{algorithm!r} was not measured in this run; measured were: {measured}.")
        return algorithm

    def _results(self) -> Sequence[Mapping[str, Any]]:
        results: Sequence[Mapping[str, Any]] = self.info.get("results") or []
        return results

    def __repr__(self) -> str:
        return f"<Run {self.id}: {self.state}, {', '.join(self.algorithms) or 'nothing measured'}>"

    def __str__(self) -> str:
        names = "algorithm", "rank", "median_ns", "p95_ns", "n", "of", "wrong", "missed", "outcome"
        return str(Rows([{name: row[name] for name in names} for row in self.summary()]))


def well(result: Mapping[str, Any]) -> bool:
    """Whether an algorithm answered everything, and nothing wrongly. A repro archive has no outcomes."""
    completed = picked(result, "outcome", "name") == "Completed" if "outcome" in result else result["n"] == result["of"]
    return completed and not result.get("wrong") and not picked(result, "controls", "wrong")


def row(result: Mapping[str, Any]) -> Row:
    """The row of a result in the summary."""
    cells: Row = {"algorithm": result["algorithm"], "name": result.get("name"), "rank": result.get("rank")}
    for name in ("value", "lo", "hi"):
        cells["ratio" if name == "value" else f"ratio_{name}"] = picked(result, "ratio", name)
    for statistic in ("median", "mean", "p95", "max"):
        for name in ("value", "lo", "hi"):
            end = "ns" if name == "value" else name
            cells[f"{statistic}_{end}"] = picked(result, "time", f"{statistic}_ns", name)
    verdicts = {each["verdict"]: each["count"] for each in result.get("verdicts") or []}
    cells["n"], cells["of"] = result.get("n"), result.get("of")
    cells["wrong"], cells["missed"] = result.get("wrong"), verdicts.get("false_negative", 0)
    for name in ("build_ms", "memory_bytes", "bv_tests_mean", "primitive_tests_mean"):
        cells[name] = result.get(name)
    cells["outcome"] = picked(result, "outcome", "name")
    cells["message"] = picked(result, "outcome", "message")
    cells["unranked"] = picked(result, "unranked", "message")
    return cells
