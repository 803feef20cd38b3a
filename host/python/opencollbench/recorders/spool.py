"""Writes a spool: a folder that only grows, which `ocb record` and the `pack` of the lab make a recording of.

It can be read at any moment, also after the program was killed: each query is one write of one row of 256 bytes, meshes get
their name when they are whole, and text files are read up to their last whole line.
"""

import hashlib
import json
import os
import platform
import struct
import threading
import time
from pathlib import Path

import numpy as np

FORMAT = "opencollbench-spool/1"
#: What a query asks, by its number in the spool.
COLLIDE, CONTACTS, DISTANCE, TOLERANCE = range(4)
#: Bits of an answer.
ANSWERED, HIT, MEASURED = 1, 2, 4
#: Bounds of a spool: objects, and bytes of their meshes.
MOST_OBJECTS, MOST_MESH_BYTES = 20_000, 4 << 30
#: Largest coordinate of a mesh, smallest and largest length of a primitive.
LARGEST, SMALLEST = 1e18, 1e-100
#: Seconds between two notes of how many queries were dropped for known reasons.
NOTED = 0.2

ROW = np.dtype([
    ("sequence", "<u8"), ("group", "<u8"), ("objects", "<u4", 2), ("poses", "<f8", (2, 3, 4)), ("kind", "<u4"),
    ("bits", "<u4"), ("limit", "<f8"), ("distance", "<f8"), ("seconds", "<f8"), ("library", "<u4"), ("unused", "<u4"),
])
#: What stands before the poses and behind them, for speed.
_HEAD, _TAIL = struct.Struct("<QQII"), struct.Struct("<IIdddII")


class Unusable(Exception):
    """A query that cannot be recorded; its text is the reason under which it is counted."""


class Spool:
    """The spool in one folder. At most `limit` queries are kept: of more, every second, fourth, ... whole group."""

    def __init__(self, folder, program, limit=250_000):
        """Makes the folder, which must not exist or be empty; `OSError` when that fails."""
        self.folder = Path(folder)
        (self.folder / "objects").mkdir(parents=True)
        head = {"format": FORMAT, "program": program, "recorder": f"opencollbench.recorders on Python {platform.python_version()}"}
        _whole(self.folder / "about.json", json.dumps(head).encode())
        self.limit, self.every, self.rows, self.seen = max(1, limit), 1, 0, 0
        self._objects, self._libraries, self._mesh_bytes = {}, [], 0
        self._dropped, self._noted = {}, 0.0
        self._queries = self._append("queries.bin")
        self._row = bytearray(ROW.itemsize)
        matrices = np.frombuffer(self._row, ROW)[0]["poses"]
        self._poses = [(matrix[:, :3], matrix[:, 3]) for matrix in matrices]
        self.lock = threading.RLock()

    def object(self, name, geometry, library, source=""):
        """The number of an object; equal objects of one library and name are one object.

        `geometry` is a pair of vertices (n, 3) and triangles (m, 3), or a dictionary of a primitive. Raises `Unusable`.
        """
        shape = geometry if isinstance(geometry, dict) else self._mesh(*geometry)
        key = (name, json.dumps(shape), library, source)
        if key not in self._objects:
            if len(self._objects) >= MOST_OBJECTS:
                raise Unusable(f"an object is beyond the first {MOST_OBJECTS}")
            lengths = [(field, x) for field, value in shape.items() if not isinstance(value, str) for x in np.ravel(value)]
            # A capsule may be a ball: it has a radius, and no length.
            ball = ("length", 0.0) if shape["kind"] == "capsule" else None
            if not all(SMALLEST <= x <= LARGEST or (field, x) == ball for field, x in lengths):
                raise Unusable(f"a {shape['kind']} has a length that cannot be computed with")
            line = {"id": len(self._objects), "name": name, "geometry": shape, "source": source}
            line |= dict(zip(("library", "version"), library))
            self._line("objects.jsonl", line)
            if library not in self._libraries:
                self._libraries.append(library)
            self._objects[key] = line["id"], self._libraries.index(library)
        return self._objects[key]

    def keeps(self, group):
        """Are the queries of this group recorded? Counts the query."""
        self.seen += 1
        if group % self.every == 0:
            return True
        self.drop("sampled")
        return False

    def query(self, group, objects, poses, kind, bits, limit, distance, seconds):
        """Adds the query that was counted last. `objects` are as `object` gave them, `poses` two (rotation, translation)."""
        if self.rows >= self.limit:
            self._thin()
            if group % self.every:
                return self.drop("sampled")
            if self.rows >= self.limit:
                return self.drop("a group has more queries than the limit")
        _HEAD.pack_into(self._row, 0, self.seen - 1, group, objects[0][0], objects[1][0])
        for (turned, moved), (rotation, translation) in zip(self._poses, poses):
            turned[:], moved[:] = rotation, translation
        _TAIL.pack_into(self._row, 216, kind, bits, limit, distance, seconds, objects[0][1], 0)
        os.write(self._queries, self._row)
        self.rows += 1

    def drop(self, reason):
        """Counts a query that is not recorded."""
        count = self._dropped[reason] = self._dropped.get(reason, 0) + 1
        now = time.monotonic()
        if count == 1 or now - self._noted > NOTED:
            self._noted = now
            self.note()

    def note(self):
        """Writes down how many queries were dropped until now."""
        lines = (json.dumps({"reason": reason, "count": count}) + "\n" for reason, count in self._dropped.items())
        with (self.folder / "dropped.jsonl").open("a") as file:
            file.write("".join(lines))

    def close(self):
        """The last note."""
        self.note()
        os.close(self._queries)

    def _thin(self):
        """Keeps the queries of every second group of those that are kept."""
        rows = np.fromfile(self.folder / "queries.bin", ROW)
        while len(rows) > self.limit // 2 and len(np.unique(rows["group"])) > 1:
            self.every *= 2
            rows = rows[rows["group"] % self.every == 0]
        gone, self.rows = self.rows - len(rows), len(rows)
        os.close(self._queries)
        _whole(self.folder / "queries.bin", rows.tobytes())
        self._queries = self._append("queries.bin")
        if gone:
            self._dropped["sampled"] = self._dropped.get("sampled", 0) + gone
            self.note()

    def _mesh(self, vertices, triangles):
        vertices = np.ascontiguousarray(vertices, "<f8")
        triangles = np.asarray(triangles, np.int64)
        if not len(triangles):
            raise Unusable("a mesh has no triangles")
        if triangles.min() < 0 or triangles.max() >= len(vertices):
            raise Unusable("a triangle of a mesh names a vertex that does not exist")
        if not (np.abs(vertices) <= LARGEST).all():
            raise Unusable("a mesh has a coordinate that is not a number, or too large")
        a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
        if not np.cross(b - a, c - a).any():
            raise Unusable("every triangle of a mesh has zero area")
        faces = np.empty(len(triangles), [("corners", "u1"), ("at", "<u4", 3)])
        faces["corners"], faces["at"] = 3, triangles
        header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
                  "property double x\nproperty double y\nproperty double z\n"
                  f"element face {len(faces)}\nproperty list uchar uint vertex_indices\nend_header\n")
        ply = header.encode() + vertices.tobytes() + faces.tobytes()
        sha256 = hashlib.sha256(ply).hexdigest()
        path = self.folder / f"objects/{sha256}.ply"
        if not path.exists():
            if self._mesh_bytes + len(ply) > MOST_MESH_BYTES:
                raise Unusable(f"the meshes have more than {MOST_MESH_BYTES >> 30} GiB")
            self._mesh_bytes += len(ply)
            _whole(path, ply)
        return {"kind": "mesh", "sha256": sha256}

    def _line(self, name, line):
        with (self.folder / name).open("a") as file:
            file.write(json.dumps(line) + "\n")

    def _append(self, name):
        return os.open(self.folder / name, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC, 0o644)


def _whole(path, content):
    """A file is there as a whole or not at all."""
    new = path.with_name(path.name + ".new")
    new.write_bytes(content)
    new.replace(path)
