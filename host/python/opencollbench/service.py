"""A service that measures for others, over its HTTP API (`web/server/openapi.json`)."""

from __future__ import annotations

import secrets
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, Mapping, Optional, Union

from .benchmark import Algorithms, listed, queried, refuse_both
from .errors import Error
from .client import Client, segment
from .objects import Object, named
from .poses import filed, matrices
from .positions import Where, positions_of
from .progress import Progress, shown
from .run import Run

if TYPE_CHECKING:
    from .poses import Poses

#: Configurations of a quick look, as the command has it.
QUICK_LOOK = 5000
#: States in which a run stays.
ENDED = ("done", "failed", "cancelled")
#: How often a stream of events is opened again while the service fails, and the seconds between.
TRIES = 30
PAUSE = 1.0


class Service:
    """A service, such as one that `ocb serve` started.

    Args:
        url: its address.
        token: a token of an account there; a guest's runs have shorter limits and are deleted after some time.

    Raises:
        Error: the address is none.
    """

    def __init__(self, url: str, token: Optional[str] = None) -> None:
        self._client = Client(url, token)

    def bench(
        self,
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
        progress: bool = True,
    ) -> Run:
        """Like `opencollbench.bench`, but the service measures. Objects that are files or in memory are uploaded.

        Anyone who knows the id of an uploaded object or of the run can see it, unless the account decides otherwise. An interrupt
        cancels the run.

        Raises:
            Error: in one sentence, what is wrong, or why the run did not begin.
        """
        where = positions_of(positions, separation, count, seed)
        spec: Dict[str, Any] = {"query": queried(query)[1], "semantics": "solid" if solid else "surface", **where.spec()}
        with tempfile.TemporaryDirectory(prefix="opencollbench-") as kept:
            folder = Path(kept)
            if configurations is not None:
                refuse_both(positions, separation, count, seed)
                saved = self._client.upload("/api/v1/configurations", "poses", pose_bytes(configurations, folder))
                spec["method"] = {"kind": "file", "sha256": saved["sha256"]}
            spec["object_a"] = self._object(a, folder, "a")
            if b is not None and b is not a:
                spec["object_b"] = self._object(b, folder, "b")
        spec.update(algorithms=listed(algorithms), passes=passes, budget_seconds=budget, seed=run_seed, precision=precision)
        spec["at_most"] = QUICK_LOOK if quick else None
        run = self._client.post("/api/v1/runs", spec, secrets.token_hex(16))
        try:
            self._follow(run["id"], shown(progress))
        except KeyboardInterrupt:
            self._client.post(f"/api/v1/runs/{run['id']}/cancel")
            raise
        return self.load_run(run["id"])

    def load_run(self, id: str) -> Run:
        """A run of the service by its id; one that has not ended yet has the results that it has so far.

        Raises:
            Error: there is no such run, or it is private.
        """
        info = self._client.json(f"/api/v1/runs/{segment(id)}")
        return Run(info, Remote(self._client, id))

    def _object(self, thing: Object, folder: Path, name: str) -> str:
        known = named(thing, folder, name)
        path = Path(known)
        if known.startswith("stock:") or (not path.exists() and len(known) == 36):
            return known
        try:
            content = path.read_bytes()
        except OSError as error:
            raise Error(f"{known} cannot be read: {error.strerror}.") from None
        return str(self._client.upload("/api/v1/objects", path.name, content)["id"])

    def _follow(self, id: str, progress: Progress) -> None:
        """Shows how far the run is until it has ended. A stream that breaks off, as when the service starts anew, is opened again
        behind the last event."""
        after, failures = 0, 0
        try:
            while True:
                try:
                    for event in self._client.events(f"/api/v1/runs/{id}/events", after):
                        after, failures = event["seq"], 0
                        show(progress, event)
                        if event["state"] in ENDED:
                            return
                    if self._client.json(f"/api/v1/runs/{id}")["state"] in ENDED:
                        return
                except (Error, OSError) as error:
                    code = getattr(error, "code", None) or 500
                    if failures >= TRIES or code < 500:
                        raise
                failures += 1
                time.sleep(PAUSE)
        finally:
            progress.close()


class Remote:
    """The files of a run of a service."""

    def __init__(self, client: Client, id: str) -> None:
        self._client = client
        self._below = f"/api/v1/runs/{segment(id)}"

    def records(self, algorithm: str) -> bytes:
        return self._client.content(f"{self._below}/records.parquet?algorithm={segment(algorithm)}")

    def triangles(self, algorithm: str) -> Optional[bytes]:
        try:
            return self._client.content(f"{self._below}/triangles.parquet?algorithm={segment(algorithm)}")
        except Error as error:
            if error.code == 404:
                return None
            raise

    def configurations(self) -> bytes:
        return self._client.content(f"{self._below}/configurations.parquet")


def show(progress: Progress, event: Mapping[str, Any]) -> None:
    stage = event.get("stage")
    if stage is None or stage["state"] == "queued":
        return
    note = stage.get("message") or ("" if stage["state"] == "running" else stage["state"])
    progress.stage(stage.get("algorithm") or stage["kind"], stage["done"], stage["total"], note)


def pose_bytes(poses: Any, folder: Path) -> bytes:
    """Poses as the service accepts them, which reads no Parquet."""
    from .configurations import Configurations

    if isinstance(poses, Configurations):
        poses = poses.poses
        return matrices(poses).astype("<f8").tobytes()
    return filed(poses, folder).read_bytes()
