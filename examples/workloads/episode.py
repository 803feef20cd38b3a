"""A heap falls together in MuJoCo, and every step asks how close its bodies come.

    ocb record --out episode.ocbrec -- python episode.py

Bottles, bowls (MuJoCo takes the convex hull of a mesh), boxes, balls, cans and capsules fall into a bin. Each step is one group:
`mj_geomDistance` of each pair that may be closer than a margin, as a program does that watches clearances.
"""

import argparse

import mujoco
import numpy as np
import shapes

try:
    from opencollbench.recorders import group
except ImportError:  # Then a recording has a group for each call.
    def group():
        """No groups of our own."""

#: What falls, in turn.
KINDS = [
    'type="mesh" mesh="bottle"', 'type="box" size=".05 .04 .1"', 'type="sphere" size=".05"', 'type="mesh" mesh="bowl"',
    'type="cylinder" size=".04 .06"', 'type="capsule" size=".03 .06"',
]
#: Half the edge of the bin.
BIN = 0.25


def mesh(name, vertices, triangles):
    """A mesh of MuJoCo."""
    words = [" ".join(f"{x:.9g}" for x in np.ravel(numbers)) for numbers in (vertices, triangles)]
    return f'<mesh name="{name}" vertex="{words[0]}" face="{words[1]}"/>'


def bodies(number, rng):
    """Bodies above the bin, each turned at random."""
    for i in range(number):
        turn = rng.normal(size=4)
        x, y = rng.uniform(-0.6 * BIN, 0.6 * BIN, 2)
        yield (f'<body pos="{x} {y} {0.2 + 0.12 * i}" quat="{" ".join(map(str, turn / np.linalg.norm(turn)))}">'
               f'<freejoint/><geom {KINDS[i % len(KINDS)]} density="500"/></body>')


def world(number, rng):
    """The model: a bin of boxes, as planes are not recorded, and what falls into it."""
    assets = mesh("bottle", *shapes.bottle()) + mesh("bowl", *shapes.bowl())
    walls = "".join(f'<geom type="box" pos="{x} {y} .2" size="{dx} {dy} .25"/>' for x, y, dx, dy in [
        (BIN, 0, 0.01, BIN), (-BIN, 0, 0.01, BIN), (0, BIN, BIN, 0.01), (0, -BIN, BIN, 0.01)])
    floor = f'<geom type="box" pos="0 0 -.05" size="{BIN} {BIN} .05"/>'
    text = f"<mujoco><asset>{assets}</asset><worldbody>{floor}{walls}{''.join(bodies(number, rng))}</worldbody></mujoco>"
    return mujoco.MjModel.from_xml_string(text)


def near(model, data, margin):
    """Pairs of geoms whose bounding spheres are closer than the margin, and of which one moves; boxes of the bin: always."""
    centres, radii = data.geom_xpos, model.geom_rbound
    gaps = np.linalg.norm(centres[:, None] - centres, axis=2) - radii[:, None] - radii
    moves = model.body_weldid[model.geom_bodyid] > 0
    return [(one, other) for one, other in zip(*np.nonzero(np.triu(gaps < margin, 1))) if moves[one] or moves[other]]


def main():
    """Lets it fall, and prints how close it was."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, default=1, help="of the places from which it falls")
    parser.add_argument("--bodies", type=int, default=30, help="that fall")
    parser.add_argument("--steps", type=int, default=1000, help="of 2 ms; distances are asked in every tenth")
    parser.add_argument("--margin", type=float, default=0.02, help="largest distance of interest in metres")
    given = parser.parse_args()
    model = world(given.bodies, np.random.default_rng(given.seed))
    data = mujoco.MjData(model)
    asked = close = touching = 0
    for step in range(given.steps):
        mujoco.mj_step(model, data)
        if step % 10:
            continue
        # The step has moved the bodies; only now the geoms are where they are.
        mujoco.mj_kinematics(model, data)
        group()
        for one, other in near(model, data, given.margin):
            distance = mujoco.mj_geomDistance(model, data, one, other, given.margin, None)
            asked, close, touching = asked + 1, close + (distance < given.margin), touching + (distance <= 0)
    print(f"{model.ngeom} geoms, {asked} distances asked, {close} below {given.margin} m, {touching} of them touch")


if __name__ == "__main__":
    main()
