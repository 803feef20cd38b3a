"""What python-fcl does not tell: which geometry a collision object has, and the vertices and triangles of a model.

Read from the memory of the process, at the places where FCL 0.7 has them on x86-64; `known()` tries these places on objects whose
content it knows, and nothing is read where that fails.
"""

import ctypes

import numpy as np

#: In the Python objects: the C++ object, and the geometry of a collision object.
_THIS = object.__basicsize__
_GEOMETRY = object.__basicsize__ + 8
#: In `fcl::CollisionGeometry`: centre, radius and box of its own frame.
_BOUNDS, _BOUNDS_BYTES = 8, 80
#: In `fcl::BVHModel`: pointers to vertices and triangles, then their numbers.
_VERTICES, _TRIANGLES, _NUM_TRIANGLES, _NUM_VERTICES = 120, 128, 144, 148
#: In `fcl::Convex`: pointers to vectors of vertices and of faces, and the number of faces.
_POINTS, _NUM_FACES, _FACES = 120, 136, 144


def _pointer(at):
    return ctypes.c_void_p.from_address(at).value


def _number(at):
    return ctypes.c_int.from_address(at).value


def _array(at, kind, shape):
    kind = np.dtype(kind)
    return np.frombuffer(ctypes.string_at(at, kind.itemsize * int(np.prod(shape))), kind).reshape(shape)


def _vector(at, kind):
    """A copy of a `std::vector`, to which a shared pointer at this place points."""
    vector = _pointer(at)
    begin, end = _pointer(vector), _pointer(vector + 8)
    return np.frombuffer(ctypes.string_at(begin, end - begin) if begin else b"", kind)


def geometry(collision_object):
    """The Python geometry of a collision object, which lives at least as long as that."""
    return ctypes.py_object.from_address(id(collision_object) + _GEOMETRY).value


def fingerprint(geometry):
    """Changes when a model of the same address is another one: place, size, bounds, first and last numbers of its memory."""
    this = _pointer(id(geometry) + _THIS)
    triangles, vertices = _number(this + _NUM_TRIANGLES), _number(this + _NUM_VERTICES)
    at, bounds = _pointer(this + _VERTICES), ctypes.string_at(this + _BOUNDS, _BOUNDS_BYTES)
    if not at or vertices < 1:
        return this, bounds
    sample = ctypes.string_at(at, 24) + ctypes.string_at(at + vertices // 2 * 24, 24)
    return this, at, triangles, vertices, bounds, sample


def model(geometry):
    """Vertices and triangles of a `BVHModel`."""
    this = _pointer(id(geometry) + _THIS)
    vertices = _array(_pointer(this + _VERTICES), "f8", (_number(this + _NUM_VERTICES), 3))
    return vertices, _array(_pointer(this + _TRIANGLES), "u8", (_number(this + _NUM_TRIANGLES), 3))


def convex_fingerprint(geometry):
    """The same of a `Convex`."""
    this = _pointer(id(geometry) + _THIS)
    vector = _pointer(this + _POINTS)
    at = _pointer(vector)
    bounds = ctypes.string_at(this + _BOUNDS, _BOUNDS_BYTES)
    return this, at, _pointer(vector + 8), _number(this + _NUM_FACES), bounds, ctypes.string_at(at, 24) if at else b""


def convex(geometry):
    """Vertices of a `Convex`, and triangles that make up its faces."""
    this = _pointer(id(geometry) + _THIS)
    faces, at, triangles = _vector(this + _FACES, "i4"), 0, []
    for _ in range(_number(this + _NUM_FACES)):
        corners = faces[at + 1:at + 1 + faces[at]]
        triangles += [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]
        at += 1 + len(corners)
    return _vector(this + _POINTS, "f8").reshape(-1, 3), triangles


def known(fcl):
    """Are the places right for this build of python-fcl?"""
    vertices = np.array([[0.0, 0.5, 1], [1, 0, 0.25], [0, 1, 0.75], [0.125, 0.25, 2], [3, 3, 3]])
    triangles = np.array([[0, 1, 2], [0, 1, 3], [2, 3, 4]])
    bvh = fcl.BVHModel()
    bvh.beginModel(len(triangles), len(vertices))
    bvh.addSubModel(vertices, triangles)
    bvh.endModel()
    this = _pointer(id(bvh) + _THIS)
    # The numbers come first: only where these are right, the pointers are followed.
    if (_number(this + _NUM_TRIANGLES), _number(this + _NUM_VERTICES)) != (3, 5):
        return False
    if not all(map(np.array_equal, model(bvh), (vertices, triangles))):
        return False
    faces = np.array([3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3])
    body = fcl.Convex(vertices[:4], 4, faces)
    if _number(_pointer(id(body) + _THIS) + _NUM_FACES) != 4:
        return False
    if not all(map(np.array_equal, convex(body), (vertices[:4], faces.reshape(4, 4)[:, 1:]))):
        return False
    placed = fcl.CollisionObject(body)
    return _pointer(id(placed) + _GEOMETRY) == id(body)
