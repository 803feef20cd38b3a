"""How configurations are found: the same words as on the command line and in the API."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Dict, List, Optional, Union

from .errors import Error

#: What the command takes when a setting is absent; the service has no such defaults.
STEP, FRAMES, CENTERS, POSES, SHARE = 20.0, 5000, 1.0, 10_000, 0.5


@dataclass(frozen=True)
class Positions:
    """How configurations are found; settings that are absent have the defaults of `ocb bench`.

    Args:
        method: `sphere`: B approaches from outside; `grid`: from every free place, also in concavities; `trajectory`: B
            tumbles, the order is kept; `random`: B anywhere in a cube.
        count: number of configurations, instead of `rotate` and `move`.
        rotate: step of the rotations in degrees.
        move: step of the directions in degrees.
        separation: distance of the surfaces over the longest side of A's bounding box (0: touching), or `"ladder"` for ten
            steps from far to deep in turn.
        step: instead of it, a share of the size of the scene, apart (above 0) or crossing (below 0).
        center_distance: for `trajectory`, distance of the centres over the longest side of A's bounding box.
        hit_share: for `random`, share of the poses that collide.
        seed: seed of the low-discrepancy sequences.
    """

    method: str = "sphere"
    count: Optional[int] = None
    rotate: Optional[float] = None
    move: Optional[float] = None
    separation: Union[None, float, str] = None
    step: Optional[float] = None
    center_distance: Optional[float] = None
    hit_share: Optional[float] = None
    seed: Optional[int] = None

    def arguments(self) -> List[str]:
        """As arguments of the command."""
        line = ["--method", self.method]
        for option, value in [
            ("--count", self.count),
            ("--rotate", self.rotate),
            ("--move", self.move),
            ("--step", self.step),
            ("--center-distance", self.center_distance),
            ("--hit-share", self.hit_share),
            ("--seed", self.seed),
        ]:
            if value is not None:
                line += [option, str(value)]
        if self.separation == "ladder":
            line.append("--ladder")
        elif self.separation is not None:
            line += ["--distance", str(number(self.separation))]
        return line

    def spec(self) -> Dict[str, Any]:
        """As `method` and `separation` of a run of the API."""
        method: Dict[str, Any] = {"kind": self.method}
        if self.method in ("sphere", "grid"):
            self.only("count", "rotate", "move", "separation", "step", "seed")
            steps = {"kind": "steps", "rotate": given(self.rotate, STEP), "move": given(self.move, STEP)}
            method["sampling"] = steps if self.count is None else {"kind": "count", "count": self.count}
        elif self.method == "trajectory":
            self.only("count", "center_distance")
            method["center_distance"] = given(self.center_distance, CENTERS)
            method["count"] = given(self.count, FRAMES)
        elif self.method == "random":
            self.only("count", "hit_share", "seed")
            method["count"] = given(self.count, POSES)
            method["hit_share"] = given(self.hit_share, SHARE)
        else:
            raise Error(f"The method must be sphere, grid, trajectory or random, not {self.method!r}.")
        if self.method != "trajectory":
            method["seed"] = given(self.seed, 0)
        return {"method": method, "separation": self.apart()}

    def apart(self) -> Dict[str, Any]:
        if self.step is not None:
            return {"kind": "step", "of_size": self.step}
        if self.separation == "ladder":
            return {"kind": "ladder"}
        return {"kind": "relative", "distance": number(given(self.separation, 0.0))}

    def only(self, *known: str) -> None:
        """No setting is silently without effect."""
        for name, value in vars(self).items():
            if name != "method" and name not in known and value is not None:
                raise Error(f"{name} does not belong to the method {self.method}, which takes {', '.join(known)}.")


#: A method by its name, or with all settings.
Where = Union[str, Positions]


def positions_of(where: Where, separation: Any, count: Optional[int], seed: Optional[int]) -> Positions:
    """The positions that the arguments of a function mean; those that are given replace others."""
    positions = where if isinstance(where, Positions) else Positions(where)
    changes = {"separation": separation, "count": count, "seed": seed}
    return replace(positions, **{name: value for name, value in changes.items() if value is not None})


def number(value: Union[float, str]) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Error(f'The separation must be a number or "ladder", not {value!r}.') from None


def given(value: Any, otherwise: Any) -> Any:
    return otherwise if value is None else value
