"""Records queries to Coal from Python: `coal.collide` and `coal.distance`, of objects and of geometries.

Not seen: what `ComputeCollision` and `ComputeDistance` ask, and, where the recorder for C++ is not loaded, managers with callbacks in
C++. Not recorded, and counted: bodies with a swept sphere, negative security margins, and objects that are not a mesh, convex body,
box, sphere, cylinder or capsule.
"""

import sys

import numpy as np

from .patching import leave, replace
from .shapes import Shapes, named, recording
from .spool import ANSWERED, COLLIDE, CONTACTS, DISTANCE, HIT, MEASURED, TOLERANCE, Unusable

#: What a result has as distance before anything was asked.
_NO_ANSWER = sys.float_info.max


def patch(coal):
    """Puts recording functions in the place of the library's; a list of what to put back."""
    asked = _Coal(coal)
    modules = [coal, coal.coal_pywrap]
    leave("coal", coal.coal_pywrap)
    undo = replace(modules, "collide", recording(coal.collide, asked.collided))
    return undo + replace(modules, "distance", recording(coal.distance, asked.measured))


class _Coal:
    """The recorded functions of Coal."""

    def __init__(self, coal):
        self.coal, self.shapes = coal, Shapes(("coal", coal.__version__))

    def collided(self, args, _kwargs):
        *_, request, result = args
        before = result.numContacts()

        def describe(spool, _contacts):
            objects, poses, solid = self.pair(spool, args)
            margin, most, more = request.security_margin, request.num_max_contacts, result.numContacts() > before
            if margin < 0:
                raise Unusable("a negative security margin is not recorded")
            kind, limit = (TOLERANCE, margin) if margin > 0 else (CONTACTS if most > 1 else COLLIDE, most)
            # A result that already had contacts tells nothing of this pair, and neither does a convex body where it collides.
            told = (more or before == 0) and not (solid and more)
            return objects, poses, kind, (ANSWERED | (HIT if more else 0)) if told else 0, float(limit), 0.0

        return describe

    def measured(self, args, _kwargs):
        before = args[-1].min_distance

        def describe(spool, distance):
            objects, poses, solid = self.pair(spool, args)
            told = distance < _NO_ANSWER and (before == _NO_ANSWER or distance < before)
            bits = MEASURED if told and not (solid and distance <= 0) else 0
            return objects, poses, DISTANCE, bits, 0.0, distance

        return describe

    def pair(self, spool, args):
        """The numbers of two objects, their poses, and whether one is a convex body."""
        if len(args) == 4:
            pairs = [(each.collisionGeometry(), each.getTransform()) for each in args[:2]]
        else:
            pairs = [args[0:2], args[2:4]]
        objects = [self.number(spool, geometry) for geometry, _ in pairs]
        solid = any(isinstance(geometry, self.coal.ConvexBase) for geometry, _ in pairs)
        return objects, [(pose.getRotation(), pose.getTranslation()) for _, pose in pairs], solid

    def number(self, spool, geometry):
        """The number of a geometry in the spool."""
        coal, shapes, name = self.coal, self.shapes, named(geometry)
        if isinstance(geometry, coal.BVHModelBase):
            vertices = geometry.vertices()
            mark = geometry.id(), geometry.num_tris, len(vertices), vertices[[0, len(vertices) // 2]].tobytes(), _bounds(geometry)
            return shapes.mesh(spool, mark, lambda: (vertices.copy(), _corners(geometry.tri_indices, geometry.num_tris)), name)
        if isinstance(geometry, coal.ShapeBase) and geometry.getSweptSphereRadius() > 0:
            raise Unusable("a body with a swept sphere is not recorded")
        if isinstance(geometry, coal.Convex):
            points = geometry.points()
            mark = geometry.id(), geometry.num_polygons, len(points), points[[0, len(points) // 2]].tobytes(), _bounds(geometry)
            return shapes.convex(spool, mark, lambda: (points.copy(), _corners(geometry.polygons, geometry.num_polygons)), name)
        if isinstance(geometry, coal.Box):
            return shapes.primitive(spool, "box", *(2 * geometry.halfSide).tolist(), name=name)
        if isinstance(geometry, coal.Sphere):
            return shapes.primitive(spool, "sphere", geometry.radius, name=name)
        for kind, of in [("cylinder", coal.Cylinder), ("capsule", coal.Capsule)]:
            if isinstance(geometry, of):
                return shapes.primitive(spool, kind, geometry.radius, 2 * geometry.halfLength, name=name)
        raise Unusable(f"{type(geometry).__name__} is not a recorded kind of object")


def _bounds(geometry):
    return geometry.aabb_radius, geometry.aabb_center.tobytes()


def _corners(triangle, count):
    """The corners of all triangles; `triangle` gives one."""
    return np.array([[triangle(i)[k] for k in range(3)] for i in range(count)])
