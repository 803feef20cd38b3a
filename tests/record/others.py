"""An ordinary program on Coal and MuJoCo, which knows nothing of recorders: prints each of its answers, one a line.

    others.py coal|mujoco ROUNDS
"""

import sys

import numpy as np

rng = np.random.default_rng(7)


def turned():
    rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return rotation * np.sign(np.linalg.det(rotation)), rng.uniform(-2, 2, 3)


def on_coal(rounds):
    import coal

    def model():
        vertices, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        for corner in [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]:
            vertices.append(np.array(corner, float))
        for corners in [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]:
            triangles.append(coal.Triangle(*corners))
        bvh = coal.BVHModelOBBRSS()
        bvh.beginModel(4, 4)
        bvh.addSubModel(vertices, triangles)
        bvh.endModel()
        return bvh

    mesh, shapes = model(), [coal.Box(0.5, 0.75, 1), coal.Sphere(0.5), coal.Capsule(0.25, 1), coal.Cylinder(0.25, 1)]
    here = coal.Transform3s.Identity()
    for i in range(rounds):
        for shape in shapes:
            there = coal.Transform3s(*turned())
            request, result = coal.CollisionRequest(), coal.CollisionResult()
            request.security_margin = 0.25 if i % 2 else 0.0
            if i % 3:
                coal.collide(mesh, here, shape, there, request, result)
            else:
                coal.collide(coal.CollisionObject(mesh, here), coal.CollisionObject(shape, there), request, result)
            print("collide", int(result.isCollision()))
            print("distance", repr(coal.distance(mesh, here, shape, there, coal.DistanceRequest(), coal.DistanceResult())))
    coal.collide(mesh, here, coal.Cone(1, 1), here, coal.CollisionRequest(), coal.CollisionResult())


def on_mujoco(rounds):
    import mujoco

    geoms = ['type="box" size=".25 .375 .5"', 'type="sphere" size=".5"', 'type="capsule" size=".25 .5"',
             'type="mesh" mesh="part"', 'type="ellipsoid" size=".1 .2 .3"']
    bodies = "".join(f'<body><freejoint/><geom {geom} mass="1"/></body>' for geom in geoms)
    part = '<mesh name="part" vertex="0 0 0 1 0 0 0 1 0 0 0 1 .1 .1 .1"/>'
    model = mujoco.MjModel.from_xml_string(f"<mujoco><asset>{part}</asset><worldbody>{bodies}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    for _ in range(rounds):
        data.qpos[:] = rng.normal(size=model.nq)
        mujoco.mj_forward(model, data)
        for other in range(1, 5):
            print("tolerance", repr(mujoco.mj_geomDistance(model, data, 0, other, 0.5, None)))


{"coal": on_coal, "mujoco": on_mujoco}[sys.argv[1]](int(sys.argv[2]))
sys.exit(3)
