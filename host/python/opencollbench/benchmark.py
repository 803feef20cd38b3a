"""`bench`: measure algorithms on a pair of objects, on this machine."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Union

from .command import ENDED, Ocb, PathLike, command
from .errors import Error
from .kept import Kept
from .objects import Object, named
from .poses import filed
from .positions import Where, positions_of
from .progress import shown
from .run import Run
from .sources import Folder

if TYPE_CHECKING:
    from .poses import Poses

#: The queries: as arguments of the command, and as the API names them.
QUERIES: Dict[str, Any] = {
    "distance": (["--query", "pq"], "proximity"),
    "collision": (["--query", "cd"], "collision_first"),
    "contacts": (["--query", "cd", "--contacts", "all"], "collision_all"),
}

#: One algorithm, several, or the usual ones.
Algorithms = Union[None, str, Sequence[str]]


def bench(
    a: Object,
    b: Optional[Object] = None,
    *,
    query: str = "distance",
    algorithms: Algorithms = None,
    positions: Where = "sphere",
    separation: Union[None, float, str] = None,
    count: Optional[int] = None,
    seed: Optional[int] = None,
    configurations: "Optional[Poses]" = None,
    passes: int = 5,
    budget: float = 60.0,
    run_seed: Optional[int] = None,
    precision: Optional[float] = None,
    quick: bool = False,
    solid: bool = False,
    out: Optional[PathLike] = None,
    progress: bool = True,
    ocb: Ocb = None,
) -> Run:
    """Measures algorithms on two objects in many relative poses, and compares every answer with the oracle.

    Args:
        a: object A, which stands still: a path, a stock object such as `stock:castle@5000`, a `trimesh.Trimesh`, or a pair of
            arrays (vertices, triangles).
        b: object B, which moves; by default the same as A.
        query: `distance`, `collision` (the first pair that intersects) or `contacts` (all pairs).
        algorithms: ids, with optional settings (`box-tree:leaf_size=4`), or `"all"`; by default the usual ones that answer the
            query.
        positions: how configurations are found; a name of a method, or `Positions` with all settings.
        separation: how far apart; see `Positions`.
        count: number of configurations.
        seed: seed of the configurations.
        configurations: poses of B in A's frame instead: an array (n, 4, 4) or (n, 3, 4), a file, or what `generate` gave.
        passes: number of fresh processes per algorithm, each with one timed pass; the median counts.
        budget: measuring time per algorithm in seconds.
        run_seed: seed of everything that is drawn while measuring, to repeat a run.
        precision: stop once the comparison is settled; differences below this share (0.05) do not matter.
        quick: measure at most 5,000 configurations.
        solid: an object inside of the other one collides, too.
        out: folder for the result files; by default they are deleted with the `Run`.
        progress: show how far it is.
        ocb: the program, or a `Command` with data folder and plugins.

    Returns:
        The run, also when an algorithm failed or gave wrong answers: `Run.ok` and `Run.summary` tell.

    Raises:
        Error: in one sentence, what is wrong; nothing was measured.

    >>> run = bench("stock:torus-knot@600", algorithms=["box-tree"], separation=0.1, count=40, passes=1, progress=False)
    >>> run.ok, run.algorithms
    (True, ['box-tree'])
    >>> [(row["algorithm"], row["n"], row["wrong"]) for row in run.summary()]
    [('box-tree', 40, 0)]
    >>> run.records("box-tree").to_polars().shape[0]
    40
    """
    where = positions_of(positions, separation, count, seed)
    kept = Kept(out)
    with tempfile.TemporaryDirectory(prefix="opencollbench-") as inputs:
        arguments = ["bench", *objects(a, b, Path(inputs)), *queried(query)[0]]
        if configurations is None:
            arguments += where.arguments()
        else:
            refuse_both(positions, separation, count, seed)
            arguments += ["--configurations", str(filed(configurations, Path(inputs)))]
        for algorithm in listed(algorithms):
            arguments += ["--algorithm", algorithm]
        arguments += ["--passes", str(passes), "--budget", str(budget), "--out", str(kept.path)]
        arguments += [] if run_seed is None else ["--run-seed", str(run_seed)]
        arguments += [] if precision is None else ["--precision", str(precision)]
        arguments += (["--quick"] if quick else []) + (["--solid"] if solid else [])
        info = command(ocb).ask(arguments, shown(progress), ENDED)
    return Run(info, Folder(kept.path, kept))


def objects(a: Object, b: Optional[Object], folder: Path) -> List[str]:
    """Both objects as the command names them; one where they are the same."""
    first = named(a, folder, "a")
    return [first] if b is None or b is a else [first, named(b, folder, "b")]


def queried(query: str) -> Any:
    if query not in QUERIES:
        raise Error(f"The query must be distance, collision or contacts, not {query!r}.")
    return QUERIES[query]


def listed(algorithms: Algorithms) -> List[str]:
    if algorithms is None:
        return []
    return [algorithms] if isinstance(algorithms, str) else list(algorithms)


def refuse_both(positions: Where, *settings: Any) -> None:
    """Configurations that are given are not searched for."""
    if positions != "sphere" or any(setting is not None for setting in settings):
        raise Error("Give either configurations, or how they are found (positions, separation, count, seed), not both.")
