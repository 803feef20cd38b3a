"""`advise`: how few triangles a query needs."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any, List, Mapping, Optional, Sequence, Union

from .benchmark import objects
from .command import Ocb, PathLike, command
from .kept import Kept
from .objects import Object
from .progress import shown
from .tables import Rows, picked


class Advice:
    """How far the objects can be reduced for a query, with certificates.

    Attributes:
        data: everything that `ocb advise --json` prints (`Advice` in `web/server/openapi.json`).
        folder: the folder with the reduced objects, their certificates, and maps of the detail that is needed.
    """

    def __init__(self, data: Mapping[str, Any], kept: Kept) -> None:
        self.data = dict(data)
        self.folder = kept.path
        self._kept = kept

    @property
    def triangles_before(self) -> int:
        """Triangles of both objects."""
        return int(self.data["triangles_before"])

    @property
    def triangles_after(self) -> int:
        """Triangles of the coarsest levels that are asked first."""
        return int(self.data["triangles_after"])

    @property
    def speedup(self) -> float:
        """Time of the whole objects, asked for their distance, over that of the advice."""
        return float(self.data["faster"]["value"])

    @property
    def guaranteed_error(self) -> Optional[float]:
        """No distance was or could have been further off on the configurations, in the unit of the objects."""
        return self.data.get("guaranteed_error")

    def reduced(self) -> List[Path]:
        """The reduced objects as OBJ files, each with `NAME.certificate.json` beside it."""
        return sorted(self.folder.glob("[ab]-*.obj"))

    def points(self) -> Rows:
        """The ways to answer that were measured: levels of detail and other methods, with time, error and certificate."""
        return Rows([point_row(point) for point in self.data["points"]])

    def __repr__(self) -> str:
        return f"<Advice: {self.triangles_after:,} of {self.triangles_before:,} triangles, {self.speedup:.3g} times as fast>"


def point_row(point: Mapping[str, Any]) -> Any:
    cells = {name: point.get(name) for name in ("kind", "algorithm", "elements", "unit", "certified", "advised")}
    cells["micros"], cells["faster"] = picked(point, "micros", "value"), picked(point, "faster", "value")
    cells["guaranteed_error"], cells["observed_error"] = point.get("guaranteed_error"), point.get("observed_error")
    return cells


def advise(
    a: Object,
    b: Optional[Object] = None,
    *,
    tolerance: Union[None, float, str] = None,
    clearance: Union[None, float, str] = None,
    unit: Optional[str] = None,
    configurations: Optional[int] = None,
    held_out: Optional[int] = None,
    distances: Sequence[float] = (),
    seed: int = 0,
    out: Optional[PathLike] = None,
    progress: bool = True,
    ocb: Ocb = None,
) -> Advice:
    """Finds out how far two objects can be reduced for a query.

    Args:
        a: object A, which stands still.
        b: object B, which moves; by default the same as A.
        tolerance: largest error of a distance: a number in the unit of the objects, `"1%"` of A's longest side (the default),
            or `"0.5mm"`.
        clearance: ask instead whether the distance is greater than this length, written in the same way.
        unit: unit of the files (`mm`, `cm` or `m`), for lengths with a unit.
        configurations: number of configurations to choose the advice by.
        held_out: number of other configurations to check it by.
        distances: relative distances of the configurations.
        seed: seed of the low-discrepancy sequences.
        out: folder for the reduced objects; by default they are deleted with the `Advice`.
        progress: show how far it is.
        ocb: the program, or a `Command`.

    Raises:
        Error: in one sentence, what is wrong.

    >>> advice = advise("stock:sphere@2000", tolerance="5%", configurations=64, held_out=64, progress=False)
    >>> advice.triangles_after < advice.triangles_before
    True
    """
    kept = Kept(out)
    with tempfile.TemporaryDirectory(prefix="opencollbench-") as inputs:
        arguments = ["advise", *objects(a, b, Path(inputs)), "--seed", str(seed), "--out", str(kept.path)]
        question = None if clearance is None else f"clearance={clearance}"
        distance = ",".join(map(str, distances)) or None
        for option, value in [
            ("--question", question),
            ("--tolerance", tolerance),
            ("--unit", unit),
            ("--configurations", configurations),
            ("--held-out", held_out),
            ("--distance", distance),
        ]:
            if value is not None:
                arguments += [option, str(value)]
        data = command(ocb).ask(arguments, shown(progress))
    return Advice(data, kept)
