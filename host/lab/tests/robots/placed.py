"""Prints what Pinocchio makes of robots: for each URDF file that is named on stdin, with all joints at neutral(), a line of JSON with
[{"name", "pose": 12 numbers, row-major, "kind", "sizes"}], or null if Pinocchio refuses it.

The sizes of a mesh are its number of triangles, the corners of its bounding box and its area.
"""

import json
import sys
from pathlib import Path

import numpy
import pinocchio


def shape(geometry):
    kind = type(geometry).__name__
    if kind == "Box":
        return {"kind": "box", "sizes": (2 * geometry.halfSide).tolist()}
    if kind == "Sphere":
        return {"kind": "sphere", "sizes": [geometry.radius]}
    if kind in ("Cylinder", "Capsule"):
        return {"kind": kind.lower(), "sizes": [geometry.radius, 2 * geometry.halfLength]}
    if kind == "Convex":
        return {"kind": "hull", "sizes": []}
    corners = [[it[0], it[1], it[2]] for it in map(geometry.tri_indices, range(geometry.num_tris))]
    a, b, c = geometry.vertices()[numpy.array(corners)].transpose(1, 0, 2)
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
    box = [*numpy.min([a, b, c], axis=(0, 1)), *numpy.max([a, b, c], axis=(0, 1))]
    return {"kind": "mesh", "sizes": [len(corners), *box, area]}


def robot(urdf, packages):
    model = pinocchio.buildModelFromUrdf(urdf)
    collision = pinocchio.buildGeomFromUrdf(model, urdf, pinocchio.COLLISION, packages)
    data, placed = model.createData(), collision.createData()
    pinocchio.updateGeometryPlacements(model, data, collision, placed, pinocchio.neutral(model))
    return [
        {"name": it.name, "pose": pose.homogeneous[:3].reshape(-1).tolist(), **shape(it.geometry)}
        for it, pose in zip(collision.geometryObjects, placed.oMg)
    ]


for line in sys.stdin:
    urdf = Path(line.strip())
    packages = [str(above) for above in urdf.parents if (above / "example-robot-data").is_dir()]
    try:
        print(json.dumps(robot(str(urdf), packages)), flush=True)
    except Exception as why:
        print(why, file=sys.stderr)
        print("null", flush=True)
