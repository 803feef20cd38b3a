"""`reduce_scene`: no more model than a recorded program needs."""

from __future__ import annotations

import os
from typing import Any, List, Mapping, Optional, Union

from .benchmark import Algorithms, listed
from .command import ENDED, Ocb, PathLike, command
from .kept import Kept
from .progress import shown
from .tables import Rows, picked

Length = Union[float, str]


class Reduction:
    """A recorded scene with simpler bodies.

    Attributes:
        data: everything that `ocb scene reduce --json` prints: the tolerance, the objects, what is certified, and what the choice
            is worth on the last fifth of the recording, made without it (`held_out`).
    """

    def __init__(self, data: Mapping[str, Any], kept: Kept) -> None:
        self.data = dict(data)
        self._kept = kept

    def objects(self) -> Rows:
        """One row per object: what replaces it (`body`), and its elements `before` and `after`."""
        return Rows([dict(row) for row in self.data["objects"]])

    def speed(self) -> Rows:
        """One row per algorithm that was asked for: the mean time of a query in nanoseconds, before and after, or
        nothing where a replay was not complete."""
        return Rows([dict(row) for row in self.data.get("speed", [])])

    def recording(self) -> bytes:
        """The reduced recording: the same queries about the simpler bodies, to be written to a file and replayed."""
        return (self._kept.path / "reduced.ocbrec").read_bytes()

    def __repr__(self) -> str:
        before, after = (sum(row[name] for row in self.data["objects"]) for name in ("before", "after"))
        changed = picked(self.data, "held_out", "changed", "seen")
        later = "" if changed is None else f", {changed} of {self.data['held_out']['queries']} held-out answers changed"
        return f"<Reduction: {before} elements became {after}{later}>"


def reduce_scene(
    file: PathLike,
    tolerance: Length,
    *,
    near: Length = 0.0,
    outside_only: bool = False,
    algorithms: Algorithms = None,
    passes: int = 1,
    budget: float = 60.0,
    urdf: Optional[PathLike] = None,
    packages: Optional[Mapping[str, PathLike]] = None,
    out: Optional[PathLike] = None,
    progress: bool = True,
    ocb: Ocb = None,
) -> Reduction:
    """Replaces each object of a recording by the simplest body that keeps every recorded answer within a tolerance.

    Args:
        file: a recording (`.ocbrec`).
        tolerance: the largest change of a distance, in the unit of the scene (metres for robots), or a text such as `"1mm"`.
        near: the answers are also kept where one object, with its body, is moved relative to the other by less than this length.
        outside_only: every body contains its object, so that no collision is missed.
        algorithms: ids of algorithms that replay the queries about both scenes; by default none.
        passes: number of processes per algorithm and pair of objects in each replay.
        budget: measuring time per algorithm in seconds, in each replay.
        urdf: a robot whose collision geometry is replaced as well; it is written to `out`.
        packages: folders by the names of the packages that the robot names.
        out: folder for the result files; by default they are deleted with the `Reduction`.
        progress: show how far it is.
        ocb: the program, or a `Command`.

    Raises:
        Error: in one sentence, what is wrong.
    """
    kept = Kept(out)
    arguments: List[str] = ["scene", "reduce", os.fspath(file), "--tolerance", str(tolerance), "--near", str(near)]
    arguments += ["--outside-only"] if outside_only else []
    for algorithm in listed(algorithms):
        arguments += ["--algorithm", algorithm]
    arguments += ["--passes", str(passes), "--budget", str(budget), "--out", str(kept.path)]
    arguments += [] if urdf is None else ["--urdf", os.fspath(urdf)]
    for name, folder in (packages or {}).items():
        arguments += ["--package", f"{name}={os.fspath(folder)}"]
    return Reduction(command(ocb).ask(arguments, shown(progress), ENDED), kept)
