"""The benchmark of issue #1427 of MoveIt: a Panda that stands still among 100 meshes of its own link 5, python-fcl checks it.

    python moveit_1427.py free.npy                                  # finds places, once
    ocb record --out free.ocbrec -- python moveit_1427.py free.npy  # checks the robot among them

The issue gives the robot, the number of meshes, what they are, and how many of them touch the robot: none, or two (`--touching 2`).
Sizes and places are drawn here, anew for each scene. A scene is one group: pairs whose boxes overlap, until something collides.
"""

import argparse
from pathlib import Path

import fcl
import numpy as np
from planner import SHARE, Checker, Robot, model

#: The state of the robot, as MoveIt calls it home.
HOME = np.array([0, -0.785398, 0, -2.35619, 0, 1.5707, 0.785398])
MESHES, SIZES = 100, (0.3, 1.0)
#: Corners of the box in which the meshes are.
AROUND = np.array([[-1, -1, 0], [1, 1, 1.2]])


class Scene:
    """The robot at home, and meshes that are put somewhere else for each check."""

    def __init__(self, share, seed):
        self.robot, self.rng = Robot(share), np.random.default_rng(seed)
        self.robot.move(HOME)
        link = next(part for part in self.robot.geometry.geometryObjects if part.name == "panda_link5_0").geometry
        corners = [[link.tri_indices(i)[k] for k in range(3)] for i in range(link.num_tris)]
        sizes = self.rng.uniform(*SIZES, MESHES)
        self.meshes = [fcl.CollisionObject(model(f"mesh {i}", link.vertices() * size, corners)) for i, size in enumerate(sizes)]

    def draw(self):
        """A place anywhere: a quaternion and a translation."""
        turn = self.rng.normal(size=4)
        return np.concatenate([turn / np.linalg.norm(turn), self.rng.uniform(*AROUND)])

    def places(self, touching):
        """Places of all meshes, of which so many touch the robot."""
        found = []
        for number, mesh in enumerate(self.meshes):
            while True:
                place = self.draw()
                mesh.setTransform(fcl.Transform(place[:4], place[4:]))
                if any(fcl.collide(mesh, link) for link in self.robot.links) == (number < touching):
                    break
            found.append(place)
        return found

    def check(self, places):
        """Does the robot touch something, as MoveIt asks it: meshes first, then itself, and no further than to the first?"""
        for mesh, place in zip(self.meshes, places):
            mesh.setTransform(fcl.Transform(place[:4], place[4:]))
        return not Checker(self.robot, self.meshes, 1).valid(HOME)


def main():
    """Finds places if there are none, otherwise checks the robot among them."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("places", type=Path, help="file with the places; it is made if it does not exist")
    parser.add_argument("--touching", type=int, default=0, help="meshes that touch the robot, in a new file")
    parser.add_argument("--scenes", type=int, default=200, help="in a new file")
    parser.add_argument("--seed", type=int, default=1, help="of sizes and places")
    parser.add_argument("--share", type=Path, default=SHARE, help="folder that holds example-robot-data [default: this Python's]")
    given = parser.parse_args()
    scene = Scene(given.share, given.seed)
    if not given.places.exists():
        np.save(given.places, [scene.places(given.touching) for _ in range(given.scenes)])
        print(f"places of {MESHES} meshes in {given.scenes} scenes, {given.touching} of them touching the robot")
        return
    places = np.load(given.places)
    touched = sum(scene.check(each) for each in places)
    print(f"the Panda among {MESHES} meshes: {len(places)} scenes, it touches something in {touched} of them")


if __name__ == "__main__":
    main()
