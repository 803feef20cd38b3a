"""Objects as callers name them: files, stock objects, meshes in memory."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Tuple, Union

from .errors import Error
from .extras import need

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


class MeshLike(Protocol):
    """What has vertices and faces, such as `trimesh.Trimesh`."""

    @property
    def vertices(self) -> Any:
        """Positions, (n, 3)."""

    @property
    def faces(self) -> Any:
        """Vertices of each triangle, (m, 3), from 0."""


#: An object: the path of a file (OBJ, STL, PLY, OFF, glTF, GLB, COLLADA), the name of a stock object such as
#: `stock:castle@5000`, a `trimesh.Trimesh`, or a pair of arrays (vertices, triangles).
Object = Union[str, "os.PathLike[str]", MeshLike, Tuple["ArrayLike", "ArrayLike"]]


def named(thing: Object, folder: Path, name: str) -> str:
    """The object as the command names it. A mesh in memory is written to `folder` as `name`.ply, without loss.

    Raises:
        Error: it is no object.
    """
    if isinstance(thing, (str, os.PathLike)):
        return os.fspath(thing)
    vertices, triangles = arrays(thing, name)
    path = folder / f"{name}.ply"
    path.write_bytes(ply(vertices, triangles))
    return str(path)


def arrays(thing: Any, name: str) -> "Tuple[NDArray[np.float64], NDArray[np.int64]]":
    """Vertices and triangles of a mesh in memory."""
    numpy = need("numpy", "A mesh in memory", "numpy")
    if hasattr(thing, "vertices") and hasattr(thing, "faces"):
        thing = (thing.vertices, thing.faces)
    if not isinstance(thing, (tuple, list)) or len(thing) != 2:
        known = "a path, the name of a stock object, a mesh with vertices and faces, or a pair (vertices, triangles)"
        raise Error(f"Object {name} must be {known}, not {type(thing).__name__}.")
    vertices, triangles = (numpy.asarray(part) for part in thing)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise Error(f"The vertices of object {name} must be an array of shape (n, 3), not {vertices.shape}.")
    if triangles.ndim != 2 or triangles.shape[1] != 3:
        raise Error(f"The triangles of object {name} must be an array of shape (m, 3), not {triangles.shape}.")
    if triangles.size and triangles.dtype.kind not in "iu":
        raise Error(f"The triangles of object {name} must be whole numbers, not {triangles.dtype}.")
    if triangles.size and not (0 <= triangles.min() and triangles.max() < len(vertices)):
        raise Error(f"A triangle of object {name} names a vertex outside of 0 to {len(vertices) - 1}.")
    return vertices.astype(numpy.float64), triangles.astype(numpy.int64)


def ply(vertices: "NDArray[np.float64]", triangles: "NDArray[np.int64]") -> bytes:
    """A binary PLY file with coordinates in double precision."""
    numpy = need("numpy", "A mesh in memory", "numpy")
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\n"
        f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = numpy.empty(len(triangles), dtype=[("corners", "u1"), ("vertices", "<i4", (3,))])
    faces["corners"] = 3
    faces["vertices"] = triangles
    body: bytes = numpy.ascontiguousarray(vertices, dtype="<f8").tobytes() + faces.tobytes()
    return header.encode("ascii") + body
