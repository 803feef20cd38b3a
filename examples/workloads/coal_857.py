"""The scene of issue #857 of Coal, asked of python-fcl and of Coal, with and without contacts.

    ocb record --out coal.ocbrec -- python coal_857.py

An arm of six cylinders with a gripper sweeps through twelve boxes on a pallet beside its pedestal: 21 meshes. The issue gives their
numbers and kinds; sizes, places and motion are made here. Each step is one group, and every pair whose boxes overlap is asked
three times: of FCL, of Coal as it is by default, and of Coal with `enable_contact` off.
"""

import argparse
import time

import coal
import fcl
import numpy as np
import shapes

try:
    from opencollbench.recorders import group
except ImportError:  # Then a recording has a group for each call.
    def group():
        """No groups of our own."""

#: Lengths of the arm's links; about which axis each of them turns, and how fast.
LINKS = [0.3, 0.45, 0.2, 0.4, 0.15, 0.1]
AXES, SPEEDS = [2, 1, 1, 2, 1, 2], [0.7, 1.0, 1.3, 1.9, 2.3, 3.1]


def meshes():
    """Name, mesh and resting place of each object; the arm's come last, without a place."""
    still = [("pedestal", shapes.cylinder(0.2, 0.5, 24), (0, 0, 0.25)), ("pallet", shapes.box(1.2, 1.0, 0.14), (1.0, 0, 0.07))]
    for column in range(4):
        for row in range(3):
            still.append(("product", shapes.box(0.28, 0.28, 0.28), (0.57 + 0.29 * column, 0.29 * (row - 1), 0.281)))
    arm = [(f"link {i + 1}", shapes.cylinder(0.06, length, 16), None) for i, length in enumerate(LINKS)]
    return [*still, *arm, ("gripper", shapes.box(0.2, 0.1, 0.12), None)]


def turn(axis, angle):
    """The rotation about an axis of coordinates."""
    one, other = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[[one, one, other, other], [one, other, one, other]] = np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)
    return matrix


def arm(step):
    """Poses of links and gripper in a step: each link begins where the one before it ends."""
    rotation, tip = np.eye(3), np.array([0, 0, 0.51])
    for length, axis, speed in zip(LINKS, AXES, SPEEDS):
        rotation = rotation @ turn(axis, 0.6 * (axis == 1) + 0.8 * np.sin(0.01 * speed * step))
        yield rotation, tip + rotation[:, 2] * length / 2
        tip = tip + rotation[:, 2] * (length + 0.002)
    yield rotation, tip + rotation[:, 2] * 0.06


#: Who is asked, and how.
LIBRARIES = ["FCL", "Coal", "Coal without contacts"]


class Scene:
    """The objects in both libraries."""

    def __init__(self):
        parts = meshes()
        self.names = [name for name, *_ in parts]
        self.corners = [np.array(vertices) for _, (vertices, _), _ in parts]
        self.poses = [(np.eye(3), np.array(place, float)) for *_, place in parts if place]
        self.moving = len(self.poses)
        self.fcl = [fcl.CollisionObject(fcl_model(name, *mesh)) for name, mesh, _ in parts]
        self.coal = [coal_model(name, *mesh) for name, mesh, _ in parts]

    def move(self, step):
        """Places everything as it is in a step."""
        self.poses[self.moving:] = arm(step)
        for each, pose in zip(self.fcl, self.poses):
            each.setTransform(fcl.Transform(*pose))
        self.transforms = [coal.Transform3s(*pose) for pose in self.poses]

    def near(self):
        """Pairs whose boxes overlap; a pair of which nothing moves never does."""
        placed = [corners @ rotation.T + translation for corners, (rotation, translation) in zip(self.corners, self.poses)]
        low, high = (np.array([limit(each, axis=0) for each in placed]) for limit in (np.min, np.max))
        overlap = ((low[:, None] <= high) & (low <= high[:, None])).all(axis=2)
        return [(one, other) for one, other in zip(*np.nonzero(np.triu(overlap, 1))) if other >= self.moving]


    def collide(self, library, one, other, most):
        """Does a library say that two objects collide?"""
        if library == "FCL":
            return fcl.collide(self.fcl[one], self.fcl[other], fcl.CollisionRequest(num_max_contacts=most)) > 0
        request, result = coal.CollisionRequest(), coal.CollisionResult()
        request.num_max_contacts, request.enable_contact = most, library == "Coal"
        pair = [self.coal[one], self.transforms[one], self.coal[other], self.transforms[other]]
        return coal.collide(*pair, request, result) > 0


class Named(fcl.BVHModel):
    """A mesh of python-fcl with a name, which recordings show."""


def fcl_model(name, vertices, triangles):
    """A mesh of python-fcl."""
    bvh = Named()
    bvh.name = name
    bvh.beginModel(len(triangles), len(vertices))
    bvh.addSubModel(np.array(vertices), np.array(triangles))
    bvh.endModel()
    return bvh


def coal_model(name, vertices, triangles):
    """A mesh of Coal."""
    points, corners = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
    for vertex in vertices:
        points.append(np.array(vertex, float))
    for triangle in triangles:
        corners.append(coal.Triangle(*triangle))
    bvh = coal.BVHModelOBBRSS()
    bvh.name = f"{name} (Coal)"
    bvh.beginModel(len(triangles), len(vertices))
    bvh.addSubModel(points, corners)
    bvh.endModel()
    return bvh


def main():
    """Asks all, and prints what it took."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--steps", type=int, default=2000, help="of the arm")
    parser.add_argument("--most", type=int, default=1, help="contacts that are asked for")
    given = parser.parse_args()
    scene, seconds, asked, hits = Scene(), dict.fromkeys(LIBRARIES, 0.0), 0, 0
    for step in range(given.steps):
        scene.move(step)
        group()
        for one, other in scene.near():
            answers = set()
            for name in LIBRARIES:
                begun = time.perf_counter()
                answers.add(scene.collide(name, one, other, given.most))
                seconds[name] += time.perf_counter() - begun
            if len(answers) > 1:
                print(f"step {step}: the libraries do not agree about {scene.names[one]} and {scene.names[other]}")
            asked, hits = asked + 1, hits + answers.pop()
    print(f"{asked} pairs in {given.steps} steps, {hits} of them collide")
    for name, time_of in seconds.items():
        print(f"{name}: {1e6 * time_of / asked:.2f} us a query, {time_of / seconds['FCL']:.2f} times that of FCL")


if __name__ == "__main__":
    main()
