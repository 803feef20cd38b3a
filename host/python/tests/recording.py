"""A small recording, as a recorder would have written it."""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from pathlib import Path
from typing import Any

import numpy
import pyarrow
import pyarrow.parquet
import trimesh
from numpy.typing import NDArray
from opencollbench.objects import ply

Numbers = NDArray[Any]
#: How many queries it has; the answer to the last one is false.
QUERIES = 20


def write(path: Path) -> None:
    """Two boxes of edge 1, the second one moving away along x."""
    box = trimesh.creation.box((1.0, 1.0, 1.0))
    mesh = ply(box.vertices, box.faces)
    name = hashlib.sha256(mesh).hexdigest()
    identity = numpy.eye(4)[:3].reshape(12)
    objects = [
        {"name": part, "geometry": {"kind": "mesh", "sha256": name}, "pose": identity.tolist(), "source": "", "scale": [1, 1, 1]}
        for part in ("base", "tool")
    ]
    moved = numpy.tile(identity, (QUERIES, 1))
    gaps = 0.1 * numpy.arange(1, QUERIES + 1)
    moved[:, 3] = 1 + gaps
    answered = gaps.copy()
    answered[-1] += 0.5
    scene = {"format": "opencollbench-scene/1", "scene": {"name": "robot", "objects": objects, "disabled": []}}
    about = {"program": "robot", "recorder": "test", "libraries": ["x 1"], "seen": QUERIES, "dropped": []}
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("scene.json", json.dumps(scene))
        archive.writestr(f"objects/{name}.ply", mesh)
        archive.writestr("about.json", json.dumps(about))
        archive.writestr("queries.parquet", queries(numpy.tile(identity, (QUERIES, 1)), moved, answered))


def queries(pose_a: Numbers, pose_b: Numbers, answered: Numbers) -> bytes:
    n = len(answered)
    places = pyarrow.array(numpy.zeros(n), pyarrow.uint32())
    table = {
        "sequence": pyarrow.array(range(n), pyarrow.uint64()),
        "group": pyarrow.array(range(n), pyarrow.uint64()),
        "object_a": places,
        "object_b": pyarrow.array(numpy.ones(n), pyarrow.uint32()),
        "pose_a": lists(pose_a),
        "pose_b": lists(pose_b),
        "kind": ["distance"] * n,
        "limit": numpy.zeros(n),
        "hit": pyarrow.array([None] * n, pyarrow.bool_()),
        "distance": answered,
        "seconds": pyarrow.array([None] * n, pyarrow.float64()),
        "library": places,
    }
    out = io.BytesIO()
    pyarrow.parquet.write_table(pyarrow.table(table), out, compression="none")
    return out.getvalue()


def lists(poses: Numbers) -> pyarrow.Array:
    return pyarrow.FixedSizeListArray.from_arrays(pyarrow.array(poses.reshape(-1)), 12)
