"""A Panda reaches into a shelf: RRTConnect of OMPL plans, python-fcl checks each state of the robot.

    ocb record --out planner.ocbrec -- python planner.py --states 2000

The robot comes from `example-robot-data`, Pinocchio places its links, the shelf and the 14 things in it are made here. Each state
that the planner asks about is one group: the links against the scene, then against each other, until something collides.
"""

import argparse
import sysconfig
from pathlib import Path

import coal
import fcl
import numpy as np
import ompl.base
import ompl.geometric
import ompl.util
import pinocchio
import shapes

try:
    from opencollbench.recorders import group
except ImportError:  # Then a recording has a group for each call.
    def group():
        """No groups of our own."""

#: Where Python installs `example-robot-data`, and the robot in it.
SHARE = Path(sysconfig.get_path("purelib"), "cmeel.prefix/share")
PANDA = "example-robot-data/robots/panda_description"
#: How far the fingers stay open, and states after which the planner gives up a goal.
OPEN, PATIENCE = [0.04, 0.04], 1000
#: Corners of the box where the hand shall arrive: the shelf's compartments.
INSIDE = np.array([[0.45, -0.4, 0.1], [0.75, 0.4, 0.9]])


def named(kind, name, *sizes):
    """A geometry of python-fcl that has a name, which recordings show."""
    geometry = type(kind.__name__, (kind,), {})(*sizes)
    geometry.name = name
    return geometry


def model(name, vertices, triangles):
    """A hierarchy of bounding volumes over a mesh."""
    bvh = named(fcl.BVHModel, name)
    bvh.beginModel(len(triangles), len(vertices))
    bvh.addSubModel(np.asarray(vertices, float), np.asarray(triangles))
    bvh.endModel()
    return bvh


def shelf(rng):
    """The scene: six boards, and 14 things that stand on them."""
    def place(geometry, *at, angle=0.0):
        turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
        return fcl.CollisionObject(geometry, fcl.Transform(turn, np.array(at)))

    levels = [0.1, 0.45, 0.8]
    scene = [place(named(fcl.Box, "board", 0.4, 1.0, 0.02), 0.65, 0, z) for z in [*levels, 1.15]]
    scene += [place(named(fcl.Box, "side", 0.4, 0.02, 1.1), 0.65, y, 0.6) for y in (-0.51, 0.51)]
    meshes = [model("bottle", *shapes.bottle()), model("bowl", *shapes.bowl())]
    for number in range(14):
        x, y = 0.52 + 0.26 * rng.random(), -0.4 + 0.2 * (number // 3) + 0.03 * rng.random()
        level, angle = levels[number % 3] + 0.011, 2 * np.pi * rng.random()
        if number % 4 < 2:
            scene.append(place(named(fcl.Box, "carton", 0.1, 0.08, 0.2), x, y, level + 0.1, angle=angle))
        elif number % 4 == 2:
            scene.append(place(named(fcl.Cylinder, "can", 0.04, 0.12), x, y, level + 0.06))
        else:
            scene.append(place(meshes[number // 4 % 2], x, y, level, angle=angle))
    return scene


class Robot:
    """The links of the Panda as objects of python-fcl, and the pairs of them that may collide."""

    def __init__(self, share):
        urdf, srdf = str(share / PANDA / "urdf/panda.urdf"), str(share / PANDA / "srdf/panda.srdf")
        self.model = pinocchio.buildModelFromUrdf(urdf)
        self.geometry = pinocchio.buildGeomFromUrdf(self.model, urdf, pinocchio.COLLISION, package_dirs=[str(share)])
        self.geometry.addAllCollisionPairs()
        pinocchio.removeCollisionPairs(self.model, self.geometry, srdf)
        self.data, self.placed = self.model.createData(), self.geometry.createData()
        self.links = [fcl.CollisionObject(self.link(each)) for each in self.geometry.geometryObjects]
        self.pairs = [(self.links[pair.first], self.links[pair.second]) for pair in self.geometry.collisionPairs]
        self.hand = self.model.getFrameId("panda_hand")

    def link(self, part):
        """The geometry of a part of a link. Pinocchio names it as `ocb scene import` does: the link and a number."""
        name, shape = part.name, part.geometry
        if isinstance(shape, coal.Box):
            return named(fcl.Box, name, *(2 * shape.halfSide))
        corners = [[shape.tri_indices(i)[k] for k in range(3)] for i in range(shape.num_tris)]
        return model(name, shape.vertices(), corners)

    def move(self, joints):
        """Places the links."""
        q = np.concatenate([joints, OPEN])
        pinocchio.updateGeometryPlacements(self.model, self.data, self.geometry, self.placed, q)
        for link, pose in zip(self.links, self.placed.oMg):
            link.setTransform(fcl.Transform(pose.rotation, pose.translation))

    def at(self, joints):
        """Where the hand is."""
        pinocchio.framesForwardKinematics(self.model, self.data, np.concatenate([joints, OPEN]))
        return self.data.oMf[self.hand].translation


class Checker:
    """Says whether a state is free of collisions, of at most so many."""

    def __init__(self, robot, scene, most):
        self.robot, self.most, self.states, self.free = robot, most, 0, 0
        self.scene, self.moving = fcl.DynamicAABBTreeCollisionManager(), fcl.DynamicAABBTreeCollisionManager()
        for manager, objects in [(self.scene, scene), (self.moving, robot.links)]:
            manager.registerObjects(objects)
            manager.setup()

    def done(self):
        """Were all states asked?"""
        return self.states >= self.most

    def valid(self, joints):
        """Is the robot free of collisions in this state?"""
        if self.done():
            return False
        self.states += 1
        self.robot.move(joints)
        self.moving.update()
        group()
        data = fcl.CollisionData()
        self.scene.collide(self.moving, data, touches)
        free = not data.result.is_collision and not any(fcl.collide(*pair) for pair in self.robot.pairs)
        self.free += free
        return free


def touches(one, other, data):
    """Asks about a pair whose boxes overlap; the manager stops at the first collision."""
    fcl.collide(one, other, data.request, data.result)
    return data.result.is_collision


def plan(setup, planner, checker, start, goal):
    """Plans from one state to another; the number of states of the path, or none."""
    last = min(checker.most, checker.states + PATIENCE)
    ended = ompl.base.PlannerTerminationCondition(lambda: checker.states >= last)
    problem = ompl.base.ProblemDefinition(setup)
    states = [setup.allocState() for _ in range(2)]
    for state, joints in zip(states, (start, goal)):
        state[0:7] = list(joints)
    problem.setStartAndGoalStates(*states)
    planner.clear()
    planner.setProblemDefinition(problem)
    planner.solve(ended)
    return problem.getSolutionPath().getStateCount() if problem.hasExactSolution() else None


def main():
    """Plans from compartment to compartment until all states were asked."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, default=1, help="of the scene, of the goals and of the planner")
    parser.add_argument("--states", type=int, default=2000, help="most states of the robot that are checked")
    parser.add_argument("--share", type=Path, default=SHARE, help="folder that holds example-robot-data [default: this Python's]")
    given = parser.parse_args()
    rng = np.random.default_rng(given.seed)
    ompl.util.setLogLevel(ompl.util.LogLevel.LOG_ERROR)
    ompl.util.RNG.setSeed(given.seed)

    robot, scene = Robot(given.share), shelf(rng)
    checker = Checker(robot, scene, given.states)
    low, high = robot.model.lowerPositionLimit[:7], robot.model.upperPositionLimit[:7]
    space = ompl.base.RealVectorStateSpace(7)
    bounds = ompl.base.RealVectorBounds(7)
    for joint in range(7):
        bounds.setLow(joint, low[joint])
        bounds.setHigh(joint, high[joint])
    space.setBounds(bounds)
    setup = ompl.base.SpaceInformation(space)
    setup.setStateValidityChecker(lambda state: checker.valid(np.array(state[0:7])))
    setup.setup()
    planner = ompl.geometric.RRTConnect(setup)

    here, paths = np.array([0, -0.785398, 0, -2.35619, 0, 1.5707, 0.785398]), []
    while not checker.done():
        goal = rng.uniform(low, high)
        hand = robot.at(goal)
        if (hand < INSIDE[0]).any() or (hand > INSIDE[1]).any() or not checker.valid(goal):
            continue
        if length := plan(setup, planner, checker, here, goal):
            here = goal
            paths.append(length)
    print(f"{len(robot.links)} parts of the Panda among {len(scene)} objects: {checker.states} states, {checker.free} of them free")
    print(f"{len(paths)} paths of {sum(paths)} states")


if __name__ == "__main__":
    main()
