"""load_robot.py URDF SHARE: how many collision geometries Pinocchio and MuJoCo find in a robot, as JSON."""

import json
import re
import sys
from pathlib import Path

import mujoco  # type: ignore[import-not-found]
import pinocchio  # type: ignore[import-not-found]


def main() -> None:
    robot, share = Path(sys.argv[1]), sys.argv[2]
    model = pinocchio.buildModelFromUrdf(str(robot))
    folders = [share, str(robot.parent)]
    geometry = pinocchio.buildGeomFromUrdf(model, str(robot), pinocchio.COLLISION, package_dirs=folders)
    # MuJoCo takes the folders of files away, and checks inertias, unless a URDF says otherwise.
    settings = '<mujoco><compiler strippath="false" balanceinertia="true"/></mujoco>'
    text = re.sub(r"(<robot[^>]*>)", rf"\1{settings}", robot.read_text(), count=1)
    text = text.replace("package://", f"{share}/")
    beside = robot.with_name("mujoco.urdf")
    beside.write_text(text)
    compiled = mujoco.MjModel.from_xml_path(str(beside))
    print(json.dumps({"pinocchio": len(geometry.geometryObjects), "mujoco": compiled.ngeom}))


main()
