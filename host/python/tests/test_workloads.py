"""The recipes of examples/workloads: a short slice of each is recorded, and replayed with box-tree."""

from __future__ import annotations

import io
import json
import os
import re
import subprocess
import unittest
import zipfile
from pathlib import Path
from typing import Any, Dict, List, Set

import pandas
import support
from opencollbench import Workload, reduce_scene, replay

TOOLS = support.ROOT / ".tools"
RECIPES = support.ROOT / "examples" / "workloads"


def setUpModule() -> None:
    support.use_built()


class Recording:
    """What a recipe printed, what was recorded of it, and what came of the replay."""

    def __init__(self, name: str, *arguments: str) -> None:
        program = [str(TOOLS / "record/bin/python"), str(RECIPES / name), *arguments]
        path = support.FOLDER / f"{name}.ocbrec"
        environment = {**os.environ, "PYTHONPATH": str(support.ROOT / "host" / "python")}
        record = [os.environ["OCB"], "record", "--out", str(path), "--", *program]
        done = subprocess.run(record, env=environment, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stderr
        self.printed, self.path = done.stdout, path
        with zipfile.ZipFile(path) as archive:
            self.queries = pandas.read_parquet(io.BytesIO(archive.read("queries.parquet")))
            self.about: Dict[str, Any] = json.loads(archive.read("about.json"))
            scene = json.loads(archive.read("scene.json"))["scene"]
        self.names: Set[str] = {each["name"] for each in scene["objects"]}
        self.replayed: Workload = replay(path, "box-tree", order="recorded", passes=1, budget=600, progress=False)

    def numbers(self, pattern: str) -> List[int]:
        """The numbers in the line that the pattern finds."""
        found = re.search(pattern, self.printed)
        assert found, f"{pattern!r} is not in {self.printed!r}"
        return [int(number) for number in found.groups()]


class Recipes(unittest.TestCase):
    def recorded(self, *arguments: str) -> Recording:
        """Records and replays a recipe; nothing is missing, box-tree is right, and so were the answers that were recorded."""
        if not (TOOLS / "record/complete").is_file():
            self.skipTest("the collision libraries of Python are not installed")
        recording = Recording(*arguments)
        [result] = recording.replayed.summary()
        self.assertEqual(recording.about["dropped"], [])
        [algorithm] = recording.replayed.data["tracks"][0]["algorithms"]
        self.assertEqual(algorithm["ended"], [])
        self.assertEqual((result["n"], result["of"]), (len(recording.queries), recording.about["seen"]))
        self.assertEqual((result["wrong"], result["missed"], result["silent"]), (0, 0, 0))
        judged = {claim["claim"]: claim["count"] for claim in recording.replayed.data["recorded"]["claims"]}
        self.assertLessEqual(set(judged), {"right", "undecided"}, recording.replayed.false_answers())
        told = recording.queries["hit"].notna() | recording.queries["distance"].notna()
        self.assertEqual(sum(judged.values()), told.sum())
        self.assertLessEqual(judged.get("undecided", 0), 0.01 * len(recording.queries))
        return recording

    def test_the_planner_has_a_group_for_each_state_of_the_robot(self) -> None:
        share = next(iter(TOOLS.glob("robots/lib/python*/site-packages/cmeel.prefix/share")), None)
        if share is None:
            self.skipTest("the robots are not installed")
        recording = self.recorded("planner.py", "--states", "25", "--share", str(share))
        states, free = recording.numbers(r"(\d+) states, (\d+) of them free")
        groups = recording.queries.groupby("group", sort=False)
        self.assertEqual((states, len(groups)), (25, 25))
        # The checker stops at the first collision, so that this is the last query of its state.
        hits = groups["hit"].agg(["sum", "last"])
        self.assertEqual(list(hits["sum"]), list(hits["last"]))
        self.assertEqual(hits["sum"].sum(), states - free)
        self.assertTrue(0 < free < states, recording.printed)
        self.assertLessEqual({"panda_link0_0", "panda_link5_0", "panda_hand_0", "carton", "board"}, recording.names)
        self.assertEqual(recording.about["libraries"], ["python-fcl 0.7.0.11"])
        self.reduced(recording, share)

    def reduced(self, recording: Recording, share: Path) -> None:
        """The Panda with the bodies that are enough for its plan is read by Pinocchio and MuJoCo."""
        folder = support.FOLDER / "panda"
        urdf = share / "example-robot-data/robots/panda_description/urdf/panda.urdf"
        packages = {"example-robot-data": share / "example-robot-data"}
        reduction = reduce_scene(recording.path, "1mm", urdf=urdf, packages=packages, out=folder, progress=False)
        objects = {row["name"]: row for row in reduction.objects()}
        self.assertEqual(reduction.data["queries"], len(recording.queries))
        self.assertLess(2 * sum(row["after"] for row in objects.values()), sum(row["before"] for row in objects.values()))
        # Link 3 comes near nothing else of the robot.
        self.assertIn(objects.get("panda_link3_0", {"body": "sphere"})["body"], {"sphere", "capsule", "box"})
        changed = [name for name, row in objects.items() if name.startswith("panda") and row["body"] != "object"]
        self.assertGreater(len(changed), 4)
        load = [str(TOOLS / "record/bin/python"), str(Path(__file__).with_name("load_robot.py")), str(folder / urdf.name), str(share)]
        loaded = subprocess.run(load, capture_output=True, text=True, timeout=120)
        self.assertEqual(loaded.returncode, 0, loaded.stderr)
        parts = json.loads(loaded.stdout)
        # A capsule is three parts, and so many hulls as many.
        bodies = [objects[name]["body"] for name in changed]
        more = 2 * bodies.count("capsule") + len(list(folder.glob("collision/*_hull_*.obj"))) - bodies.count("hulls")
        self.assertEqual(parts, {"pinocchio": 17 + more, "mujoco": 17 + more})

    def test_coal_and_fcl_are_asked_the_same(self) -> None:
        recording = self.recorded("coal_857.py", "--steps", "60")
        pairs, collide = recording.numbers(r"(\d+) pairs in 60 steps, (\d+) of them collide")
        queries = recording.queries
        self.assertEqual((len(queries), queries["hit"].sum(), queries["group"].nunique()), (3 * pairs, 3 * collide, 60))
        self.assertTrue(0 < collide < pairs, recording.printed)
        self.assertEqual(recording.about["libraries"], ["python-fcl 0.7.0.11", "coal 3.0.3"])
        self.assertEqual(list(queries["library"].value_counts().sort_index()), [pairs, 2 * pairs])
        self.assertLessEqual({"gripper", "gripper (Coal)", "product", "link 1"}, recording.names)
        self.assertEqual(recording.printed.count("times that of FCL"), 3)
        self.assertNotIn("do not agree", recording.printed)

    def test_the_panda_stands_among_meshes_of_its_own_link(self) -> None:
        share = next(iter(TOOLS.glob("robots/lib/python*/site-packages/cmeel.prefix/share")), None)
        if share is None or not (TOOLS / "record/complete").is_file():
            self.skipTest("the robots or the collision libraries of Python are not installed")
        for touching in (0, 2):
            name, places = "moveit_1427.py", support.FOLDER / f"places-{touching}.npy"
            made = [str(places), "--scenes", "4", "--touching", str(touching), "--share", str(share)]
            subprocess.run([str(TOOLS / "record/bin/python"), str(RECIPES / name), *made], check=True, timeout=120)
            recording = self.recorded(name, str(places), "--share", str(share))
            self.assertEqual(recording.numbers(r"(\d+) scenes, it touches something in (\d+) of them"), [4, 2 * touching])
            # The first collision is the last query of a scene; without one, the robot's own links are asked about, too.
            hits = recording.queries.groupby("group")["hit"].agg(["sum", "last"])
            self.assertEqual((list(hits["sum"]), list(hits["last"])), ([touching / 2] * 4, [touching > 0] * 4))
            # As in MoveIt, every object is there at once.
            for row in replay(recording.path, ["box-tree", "ocb-fast"], order="scene", passes=1, progress=False).summary():
                self.assertEqual((row["n"], row["wrong"], row["missed"]), (len(recording.queries), 0, 0), row)
            self.assertIn("panda_link1_0", recording.names)
            self.assertGreater(len([each for each in recording.names if each.startswith("mesh ")]), 4)

    def test_the_episode_has_a_group_for_each_step(self) -> None:
        recording = self.recorded("episode.py", "--bodies", "8", "--steps", "300")
        asked, close, touching = recording.numbers(r"(\d+) distances asked, (\d+) below 0.02 m, (\d+) of them touch")
        queries = recording.queries
        self.assertEqual((len(queries), queries["group"].nunique()), (asked, 30))
        self.assertEqual((set(queries["kind"]), set(queries["limit"])), ({"tolerance"}, {0.02}))
        # Where a hull touches something, the answer is left out.
        left_out = queries["hit"].isna().sum()
        self.assertEqual((queries["hit"] == True).sum() + left_out, close)  # noqa: E712
        self.assertTrue(0 < left_out < touching < close, recording.printed)
        self.assertLessEqual({"bottle", "bowl", "capsule"}, recording.names)


if __name__ == "__main__":
    unittest.main()
