"""Records `mujoco.mj_geomDistance`: the distance of two geoms, up to a largest one.

It is recorded as a tolerance, whose length is that largest distance. MuJoCo takes the convex hull for a mesh, so the hull is
recorded. Not recorded, and counted: planes, height fields, ellipsoids and signed distance fields. Not seen: the collisions that
`mj_step` and `mj_forward` find.
"""

import itertools
import weakref

import numpy as np

from .patching import replace
from .shapes import Shapes, recording
from .spool import ANSWERED, HIT, TOLERANCE, Unusable


def patch(mujoco):
    """Puts a recording function in the place of the library's; a list of what to put back."""
    asked = _Mujoco(mujoco)
    return replace([mujoco], "mj_geomDistance", recording(mujoco.mj_geomDistance, asked.measured))


class _Mujoco:
    """The recorded functions of MuJoCo."""

    def __init__(self, mujoco):
        self.types = mujoco.mjtGeom
        self.shapes = Shapes(("mujoco", mujoco.__version__))
        # Models by number, as the address of one that is gone may be that of another.
        self.models, self.numbers = weakref.WeakKeyDictionary(), itertools.count()

    def measured(self, args, kwargs):
        names = ("m", "d", "geom1", "geom2", "distmax")
        model, data, one, other, most = (args[i] if i < len(args) else kwargs.get(name) for i, name in enumerate(names))

        def describe(spool, distance):
            pair = [int(one), int(other)]
            objects = [self.number(spool, model, geom) for geom in pair]
            poses = [(data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]) for geom in pair]
            mesh = any(model.geom_type[geom] == self.types.mjGEOM_MESH for geom in pair)
            # A body may be inside a hull, whose surface alone is recorded.
            bits = 0 if mesh and distance <= 0 else ANSWERED | (HIT if distance < most else 0)
            return objects, poses, TOLERANCE, bits, float(most), distance

        return describe

    def number(self, spool, model, geom):
        """The number of a geom in the spool."""
        types, kind, size = self.types, model.geom_type[geom], model.geom_size[geom].tolist()
        if kind == types.mjGEOM_MESH:
            mesh = int(model.geom_dataid[geom])
            if model not in self.models:
                self.models[model] = next(self.numbers)
            return self.shapes.convex(spool, (self.models[model], mesh), lambda: _hull(model, mesh), model.mesh(mesh).name)
        if kind == types.mjGEOM_BOX:
            return self.shapes.primitive(spool, "box", *(2 * x for x in size))
        if kind == types.mjGEOM_SPHERE:
            return self.shapes.primitive(spool, "sphere", size[0])
        for name, of in [("cylinder", types.mjGEOM_CYLINDER), ("capsule", types.mjGEOM_CAPSULE)]:
            if kind == of:
                return self.shapes.primitive(spool, name, size[0], 2 * size[1])
        raise Unusable(f"{types(int(kind)).name} is not a recorded kind of object")


def _hull(model, mesh):
    """Vertices and triangles of the convex hull of a mesh, as the model holds it."""
    at = int(model.mesh_graphadr[mesh])
    if at < 0:
        raise Unusable("a mesh without a convex hull")
    begin, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    vertices, faces = (int(x) for x in model.mesh_graph[at:at + 2])
    # Behind them: for each vertex its edges and its number in the mesh, the edges, and the corners of the faces as such numbers.
    end = at + 2 + 2 * vertices + (vertices + 3 * faces)
    corners = model.mesh_graph[end:end + 3 * faces].reshape(-1, 3)
    return np.array(model.mesh_vert[begin:begin + count], float), corners.copy()
