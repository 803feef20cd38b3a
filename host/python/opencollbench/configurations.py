"""Configuration sets: poses with certified answers, found by `ocb generate` or used by a run."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Mapping, Optional

from .command import Ocb, PathLike, command
from .objects import Object, named
from .poses import relative
from .positions import Positions, Where, positions_of
from .progress import shown
from .tables import Parquet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Configurations(Parquet):
    """A configuration set: one row per configuration, with the columns of "Configuration sets" in `host/README.md`.

    `bench` and `truth` accept it where they accept poses.

    Attributes:
        info: facts about the set as `ocb` prints them: `configurations`, `longest_side`, `classes`, `coverage_a` and so on.
    """

    def __init__(self, info: Mapping[str, Any], read: Callable[[], bytes]) -> None:
        super().__init__([({}, read)])
        self.info = dict(info)
        self._read = read

    def __len__(self) -> int:
        return int(self.info["configurations"])

    @property
    def poses(self) -> "NDArray[np.float64]":
        """Poses of B in A's frame, (n, 4, 4) (extra `numpy`, and `arrow` or `polars`)."""
        return relative(*self.matrices("pose_a", "pose_b"))

    def file(self, folder: Path) -> Path:
        """Writes the set as `configurations.parquet` into a folder, and gives the path."""
        path = folder / "configurations.parquet"
        path.write_bytes(self._read())
        return path


def generate(
    a: Object,
    b: Optional[Object] = None,
    *,
    positions: Where = "sphere",
    separation: Any = None,
    count: Optional[int] = None,
    seed: Optional[int] = None,
    out: Optional[PathLike] = None,
    progress: bool = True,
    ocb: Ocb = None,
) -> Configurations:
    """Finds configurations of two objects, each with the oracle's certified answer.

    Args:
        a: object A, which stands still.
        b: object B, which moves; by default the same as A.
        positions: how configurations are found; a name of a method, or `Positions` with all settings.
        separation: how far apart; see `Positions`.
        count: how many.
        seed: seed of the low-discrepancy sequences; the same request gives the same set.
        out: a Parquet file to keep.
        progress: show how far it is.
        ocb: the program, or a `Command`.

    Raises:
        Error: in one sentence, what is wrong.

    >>> found = generate("stock:torus-knot@600", count=50, separation=0.1, progress=False)
    >>> len(found), found.poses.shape
    (50, (50, 4, 4))
    """
    where = positions_of(positions, separation, count, seed)
    with tempfile.TemporaryDirectory(prefix="opencollbench-") as kept:
        folder = Path(kept)
        path = folder / "set.parquet" if out is None else Path(out)
        arguments = ["generate", named(a, folder, "a")]
        if b is not None:
            arguments.append(named(b, folder, "b"))
        arguments += [*where.arguments(), "--output", str(path)]
        answer = command(ocb).ask(arguments, shown(progress))
        content = path.read_bytes()
    return Configurations(answer["set"], lambda: content)
