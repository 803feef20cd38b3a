"""`truth`: the oracle's certified answers."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Optional

from .command import Ocb, command
from .errors import Error
from .extras import need
from .objects import Object
from .poses import filed
from .progress import shown
from .tables import Rows

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .poses import Poses

#: The queries as the command names them.
QUERIES = {"distance": "pq", "collision": "cd", "contacts": "all"}


class Answers(Rows):
    """Certified answers, one row per pose: `hit`, `distance_lo` and `distance_hi`, `margin`, `triangles`, `points` and so on.

    The columns are those of "Certified answers" in `host/README.md`; lengths are in the unit of the objects, points in A's
    frame. With the query `contacts` a row has all pairs of triangles that intersect in `contacts`.
    """

    @property
    def hit(self) -> "NDArray[np.bool_]":
        """Whether the surfaces meet, (n,) (extra `numpy`)."""
        numpy = need("numpy", "An array of answers", "numpy")
        answer: "NDArray[np.bool_]" = numpy.array([row["hit"] for row in self], dtype=bool)
        return answer

    @property
    def distance(self) -> "NDArray[np.float64]":
        """Lower and upper bounds of the distances, (n, 2); NaN where no distance was asked for (extra `numpy`)."""
        numpy = need("numpy", "An array of answers", "numpy")
        bounds = [(row["distance_lo"], row["distance_hi"]) for row in self]
        answer: "NDArray[np.float64]" = numpy.array(bounds, dtype=numpy.float64).reshape(-1, 2)
        return answer


def truth(
    a: Object,
    b: Optional[Object],
    poses: "Poses",
    *,
    query: str = "distance",
    rounded: bool = False,
    progress: bool = True,
    ocb: Ocb = None,
) -> Answers:
    """Answers a query for each pose, certified by exact arithmetic where that is needed; measures nothing.

    Args:
        a: object A.
        b: object B; nothing means the same as A.
        poses: poses of B in A's frame: an array (n, 4, 4) or (n, 3, 4), a file, or what `generate` gave.
        query: `distance`, `collision` or `contacts`.
        rounded: round the coordinates to single precision first, as for algorithms that compute in it.
        progress: show how far it is.
        ocb: the program, or a `Command`.

    Raises:
        Error: in one sentence, what is wrong.

    >>> import numpy
    >>> square = (numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), numpy.array([[0, 1, 2], [0, 2, 3]]))
    >>> above = numpy.eye(4)
    >>> above[2, 3] = 0.25
    >>> answers = truth(square, square, above, progress=False)
    >>> answers.hit, answers.distance
    (array([False]), array([[0.25, 0.25]]))
    """
    from .benchmark import objects

    if query not in QUERIES:
        raise Error(f"The query must be distance, collision or contacts, not {query!r}.")
    with tempfile.TemporaryDirectory(prefix="opencollbench-") as kept:
        folder = Path(kept)
        arguments = ["truth", *objects(a, b, folder), "--query", QUERIES[query]]
        arguments += ["--configurations", str(filed(poses, folder))]
        arguments += ["--rounded"] if rounded else []
        return Answers(command(ocb).ask(arguments, shown(progress)))
