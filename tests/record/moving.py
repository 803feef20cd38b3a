"""An ordinary program on Pinocchio, whose C++ asks Coal, and which knows nothing of recorders: prints each answer, one a line.

    moving.py ROUNDS
"""

import sys

import coal
import numpy as np
import pinocchio

model, bodies = pinocchio.Model(), pinocchio.GeometryModel()
joint = model.addJoint(0, pinocchio.JointModelFreeFlyer(), pinocchio.SE3.Identity(), "free")
bodies.addGeometryObject(pinocchio.GeometryObject("ball", joint, 0, pinocchio.SE3.Identity(), coal.Sphere(0.5)))
bodies.addGeometryObject(pinocchio.GeometryObject("box", 0, 0, pinocchio.SE3.Identity(), coal.Box(1, 2, 0.5)))
bodies.addCollisionPair(pinocchio.CollisionPair(0, 1))
data, answers = model.createData(), bodies.createData()
rng = np.random.default_rng(7)
for _ in range(int(sys.argv[1])):
    state = pinocchio.neutral(model)
    state[:3] = rng.uniform(-1.5, 1.5, 3)
    print("collide", int(pinocchio.computeCollisions(model, data, bodies, answers, state, False)))
    pinocchio.computeDistances(model, data, bodies, answers, state)
    print("distance", repr(answers.distanceResults[0].min_distance))
sys.exit(3)
