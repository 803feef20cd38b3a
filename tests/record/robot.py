"""An ordinary program on python-fcl and trimesh, which knows nothing of recorders: prints each of its answers, one a line.

    robot.py ROUNDS [killed]

With `killed` it ends itself by SIGKILL after the first rounds.
"""

import os
import signal
import sys

import fcl
import numpy as np
import trimesh

rng = np.random.default_rng(7)


def pose():
    turned = rng.normal(size=4)
    return fcl.Transform(turned / np.linalg.norm(turned), rng.uniform(-3, 3, 3))


def ring(n):
    """A closed ring of n pieces with a square cross-section."""
    angles = 2 * np.pi * np.arange(n) / n
    corners = [(0.75, -0.25), (1.25, -0.25), (1.25, 0.25), (0.75, 0.25)]
    vertices = [(r * np.cos(angle), r * np.sin(angle), z) for angle in angles for r, z in corners]
    at = lambda i, k: i % n * 4 + k % 4  # noqa: E731
    quads = [(at(i, k), at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)) for i in range(n) for k in range(4)]
    return np.array(vertices), np.array([t for a, b, c, d in quads for t in [(a, b, c), (b, d, c)]])


def model(n):
    vertices, triangles = ring(n)
    bvh = fcl.BVHModel()
    bvh.beginModel(len(triangles), len(vertices))
    bvh.addSubModel(vertices, triangles)
    bvh.endModel()
    return bvh


rounds, killed = int(sys.argv[1]), sys.argv[2:] == ["killed"]
mesh, other = fcl.CollisionObject(model(50)), fcl.CollisionObject(model(20))
box, ball = fcl.CollisionObject(fcl.Box(0.5, 0.75, 1)), fcl.CollisionObject(fcl.Sphere(0.5))
for i in range(rounds):
    for moving in (other, box, ball):
        moving.setTransform(pose())
        most = 1 if i % 2 else 5
        print("collide", int(fcl.collide(mesh, moving, request=fcl.CollisionRequest(num_max_contacts=most)) > 0))
        print("distance", repr(fcl.distance(mesh, moving)))
sys.stdout.flush()
if killed:
    os.kill(os.getpid(), signal.SIGKILL)

print("unsupported", fcl.collide(mesh, fcl.CollisionObject(fcl.Cone(0.5, 1))))
manager = fcl.DynamicAABBTreeCollisionManager()
for each in (mesh, other, box, ball):
    each.setTransform(fcl.Transform())
manager.registerObjects([mesh, other, box, ball])
manager.setup()
data = fcl.CollisionData()
manager.collide(data, fcl.defaultCollisionCallback)
print("manager", data.result.is_collision, len(data.result.contacts))

scene = trimesh.collision.CollisionManager()
scene.add_object("ring", trimesh.Trimesh(*ring(20)))
scene.add_object("cube", trimesh.creation.box(), trimesh.transformations.translation_matrix([0.8, 0, 0]))
print("trimesh", scene.in_collision_internal(return_names=True))
sys.exit(3)
