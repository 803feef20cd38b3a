"""Records queries to python-fcl, directly or through trimesh: `fcl.collide`, `fcl.distance`, and what managers call.

Not recorded, and counted: continuous collision, and objects that are not a mesh, convex body, box, sphere, cylinder or capsule.
"""

import sys

from . import fcl_memory, session
from .patching import leave, replace
from .shapes import Shapes, named, recording
from .spool import ANSWERED, COLLIDE, CONTACTS, DISTANCE, HIT, MEASURED, Unusable

#: What FCL gives as distance where it has no algorithm for a pair.
_NO_ANSWER = sys.float_info.max


def patch(fcl):
    """Puts recording functions in the place of the library's; a list of what to put back."""
    library = ("python-fcl", fcl.__version__)
    asked = _Fcl(fcl, library)
    core = fcl.fcl
    leave("fcl", core)
    undo = []
    for name, describe in [("collide", asked.collided), ("distance", asked.measured)]:
        undo += replace([fcl, core], name, recording(getattr(core, name), describe))
    continuous = session.missed("continuous collision is not recorded")
    undo += replace([fcl, core], "continuousCollide", recording(core.continuousCollide, lambda *_: continuous))
    return undo + replace([fcl, core], "DynamicAABBTreeCollisionManager", _manager(core.DynamicAABBTreeCollisionManager))


def _manager(original):
    """A manager whose calls are a group each."""

    class DynamicAABBTreeCollisionManager(original):
        def collide(self, *args):
            with session.together():
                return super().collide(*args)

        def distance(self, *args):
            with session.together():
                return super().distance(*args)

    DynamicAABBTreeCollisionManager.__module__ = original.__module__
    DynamicAABBTreeCollisionManager.__qualname__ = original.__qualname__
    return DynamicAABBTreeCollisionManager


def _given(args, kwargs):
    """The two objects and the request of a call."""
    names = ("o1", "o2", "request")
    return [args[i] if i < len(args) else kwargs.get(name) for i, name in enumerate(names)]


class _Fcl:
    """The recorded functions of python-fcl."""

    def __init__(self, fcl, library):
        self.fcl, self.shapes = fcl, Shapes(library)
        self.readable = fcl_memory.known(fcl)

    def collided(self, args, kwargs):
        one, other, request = _given(args, kwargs)

        def describe(spool, contacts):
            objects, poses, solid = self.pair(spool, one, other)
            most = 1 if request is None else request.num_max_contacts
            # FCL answers nothing when no contact is asked for; a body may be inside a convex one, whose surface alone is recorded.
            bits = 0 if most == 0 or (solid and contacts) else ANSWERED | (HIT if contacts else 0)
            return objects, poses, CONTACTS if most > 1 else COLLIDE, bits, float(most), 0.0

        return describe

    def measured(self, args, kwargs):
        one, other, _ = _given(args, kwargs)

        def describe(spool, distance):
            objects, poses, solid = self.pair(spool, one, other)
            answered = distance < _NO_ANSWER and not (solid and distance <= 0)
            return objects, poses, DISTANCE, MEASURED if answered else 0, 0.0, distance

        return describe

    def pair(self, spool, one, other):
        """The numbers of two collision objects, their poses, and whether one is a convex body."""
        if not self.readable:
            raise Unusable("this version of python-fcl has its objects at unknown places of memory")
        geometries = [fcl_memory.geometry(each) for each in (one, other)]
        objects = [self.number(spool, each) for each in geometries]
        solid = any(isinstance(each, self.fcl.Convex) for each in geometries)
        return objects, [(each.getRotation(), each.getTranslation()) for each in (one, other)], solid

    def number(self, spool, geometry):
        """The number of a geometry in the spool."""
        fcl, shapes, name = self.fcl, self.shapes, named(geometry)
        if isinstance(geometry, fcl.BVHModel):
            return shapes.mesh(spool, fcl_memory.fingerprint(geometry), lambda: fcl_memory.model(geometry), name)
        if isinstance(geometry, fcl.Convex):
            mark = fcl_memory.convex_fingerprint(geometry)
            return shapes.convex(spool, mark, lambda: fcl_memory.convex(geometry), name)
        if isinstance(geometry, fcl.Box):
            return shapes.primitive(spool, "box", *geometry.side.tolist(), name=name)
        if isinstance(geometry, fcl.Sphere):
            return shapes.primitive(spool, "sphere", geometry.radius, name=name)
        for kind, of in [("cylinder", fcl.Cylinder), ("capsule", fcl.Capsule)]:
            if isinstance(geometry, of):
                return shapes.primitive(spool, kind, geometry.radius, geometry.lz, name=name)
        raise Unusable(f"{type(geometry).__name__} is not a recorded kind of object")
