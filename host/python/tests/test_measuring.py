"""Benchmarks, answers, advice and replays by the program that was built."""

from __future__ import annotations

import shutil
import unittest
import zipfile
from typing import Any, Dict, List

import numpy
import recording
import support
import trimesh
from opencollbench import Command, Error, Positions, advise, bench, generate, load_run, reduce_scene, replay, truth
from opencollbench.command import command
from opencollbench.progress import Silent

QUIET: Dict[str, Any] = {"progress": False}


def setUpModule() -> None:
    support.use_built()


class Benchmarks(unittest.TestCase):
    def test_a_run_has_a_summary_and_records_that_agree(self) -> None:
        run = bench(support.KNOT, algorithms=["box-tree", "box-tree:leaf_size=8"], run_seed=7, **support.SMALL)
        self.assertTrue(run.ok, run.info)
        self.assertEqual(run.algorithms, ["box-tree", "box-tree:leaf_size=8"])
        summary = run.summary()
        records = run.records().to_pandas()
        for row in summary:
            mine = records[records["algorithm"] == row["algorithm"]]
            self.assertEqual(len(mine), row["n"])
            self.assertAlmostEqual(mine["time_ns"].median(), row["median_ns"], delta=1e-6 * row["median_ns"])
            self.assertTrue(row["median_lo"] <= row["median_ns"] <= row["median_hi"])
        found = run.configurations()
        self.assertEqual((len(found), found.poses.shape), (40, (40, 4, 4)))
        triangles = run.triangles("box-tree")
        assert triangles is not None
        self.assertEqual(triangles.to_polars().columns, ["object", "triangle", "tests"])
        with self.assertRaisesRegex(Error, "'parry' was not measured in this run; measured were: box-tree"):
            run.records("parry")

    def test_meshes_in_memory_keep_their_coordinates(self) -> None:
        box = trimesh.creation.box((1.0, 2.0, 1 / 3))
        poses = numpy.tile(numpy.eye(4), (3, 1, 1))
        poses[:, 0, 3] = 1 + 1 / 7, 1.5, 2.0
        arrays = (box.vertices, box.faces)
        answers = truth(box, arrays, poses, **QUIET)
        numpy.testing.assert_allclose(answers.distance, numpy.array([[1 / 7] * 2, [0.5] * 2, [1.0] * 2]), rtol=1e-12)
        self.assertFalse(answers.hit.any())
        run = bench(box, arrays, configurations=poses, algorithms="brute-force", passes=1, **QUIET)
        self.assertTrue(run.ok, run.info)
        numpy.testing.assert_allclose(sorted(run.records().to_pandas()["distance"]), [1 / 7, 0.5, 1.0], rtol=1e-9)
        numpy.testing.assert_array_equal(run.configurations().poses, poses)

    def test_other_queries_and_all_settings_of_positions(self) -> None:
        where = Positions("random", count=60, hit_share=0.5, seed=3)
        run = bench(support.KNOT, query="contacts", positions=where, algorithms="brute-force", passes=1, **QUIET)
        self.assertEqual(run.info["spec"]["query"], "collision_all")
        self.assertEqual(run.info["spec"]["method"]["seed"], 3)
        lists = truth(support.KNOT, None, run.configurations(), query="contacts", **QUIET)
        records = run.records("brute-force").to_polars().sort("configuration")
        self.assertEqual(records["hit"].to_list(), lists.hit.tolist())
        self.assertTrue(20 <= lists.hit.sum() <= 40)
        meeting = lists[int(numpy.flatnonzero(lists.hit)[0])]
        self.assertTrue({"triangle_a", "triangle_b", "margin"} <= set(meeting["contacts"][0]))

    def test_bad_input_gets_the_sentence_of_the_command(self) -> None:
        bent = numpy.eye(4)
        bent[0, 1] = 0.5
        with self.assertRaisesRegex(Error, "row 1: the 3x3 part R of a matrix must be a rotation") as raised:
            bench(support.KNOT, configurations=bent, **QUIET)
        self.assertEqual(raised.exception.code, 2)
        with self.assertRaisesRegex(Error, "nowhere.obj"):
            bench("nowhere.obj", **QUIET)
        with self.assertRaisesRegex(Error, "no-such"):
            bench(support.KNOT, algorithms="no-such", **support.SMALL)

    def test_the_same_request_finds_the_same_configurations(self) -> None:
        path = support.FOLDER / "set.parquet"
        found = generate(support.KNOT, separation="ladder", count=30, seed=4, out=path, **QUIET)
        again = generate(support.KNOT, positions=Positions(separation="ladder", count=30, seed=4), **QUIET)
        numpy.testing.assert_array_equal(found.poses, again.poses)
        run = bench(support.KNOT, configurations=path, algorithms="box-tree", passes=1, **QUIET)
        self.assertEqual(run.summary()[0]["n"], 30)


class Loading(unittest.TestCase):
    def test_a_run_comes_back_from_a_folder_a_zip_and_a_repro_archive(self) -> None:
        out = support.FOLDER / "results"
        run = bench(support.KNOT, algorithms="box-tree", out=out, **support.SMALL)
        zipped = shutil.make_archive(str(support.FOLDER / "zipped"), "zip", out)
        repro = support.FOLDER / "repro.zip"
        command(None).ask(["run", "repro", run.id, "--output", str(repro)], Silent())
        expected = run.records().to_polars()
        sources: List[Any] = [out, zipped, repro]
        for source in sources:
            loaded = load_run(source)
            self.assertEqual((loaded.id, loaded.ok, loaded.algorithms), (run.id, True, ["box-tree"]))
            self.assertTrue(loaded.records().to_polars().equals(expected), source)
            self.assertEqual(len(loaded.configurations()), 40)
            row, original = loaded.summary()[0], run.summary()[0]
            self.assertEqual((row["n"], row["of"], row["wrong"]), (40, 40, 0))
            self.assertAlmostEqual(row["median_ns"], original["median_ns"], delta=1e-6 * original["median_ns"])

    def test_what_is_no_run_is_refused_in_a_sentence(self) -> None:
        other = support.FOLDER / "other.zip"
        with zipfile.ZipFile(other, "w") as archive:
            archive.writestr("x", "y")
        sources: List[Any] = [
            (other, "neither a recipe.json nor one run.json"),
            (support.FOLDER, "run.json is missing"),
            (support.FOLDER / "nothing", "neither a folder of results, nor a zip archive"),
            ("http://127.0.0.1:1/board", "is not the address of a run"),
        ]
        for source, told in sources:
            with self.assertRaisesRegex(Error, told):
                load_run(source)


class Others(unittest.TestCase):
    def test_advice_comes_with_reduced_objects_and_certificates(self) -> None:
        advice = advise("stock:sphere@2000", tolerance="5%", configurations=64, held_out=64, **QUIET)
        self.assertLess(advice.triangles_after, advice.triangles_before)
        self.assertTrue(advice.speedup > 0 and advice.guaranteed_error is not None)
        for path in advice.reduced():
            self.assertTrue(path.with_name(path.stem + ".certificate.json").is_file())
        self.assertTrue(advice.reduced() and any(point["advised"] for point in advice.points()))

    def test_a_recording_is_replayed_in_all_orders(self) -> None:
        path = support.FOLDER / "robot.ocbrec"
        recording.write(path)
        workload = replay(path, ["box-tree", "brute-force"], passes=2, **QUIET)
        self.assertTrue(workload.ok, workload.data)
        summary = workload.summary().to_pandas()
        self.assertEqual(set(summary["order"]), {"shuffled", "recorded", "scene"})
        # Of the two, box-tree alone offers scenes.
        self.assertEqual(list(summary["n"]), [20] * 5)
        self.assertTrue((summary["total_lowest_ns"] <= summary["total_ns"]).any())
        self.assertEqual(workload.queries().to_polars().shape[0], 5 * 20)
        self.assertEqual([each["claim"] for each in workload.false_answers()], ["distance_over"])
        one = replay(path, "box-tree", order="recorded", passes=1, **QUIET)
        self.assertEqual([row["order"] for row in one.summary()], ["recorded"])

    def test_a_scene_is_reduced_and_replayed(self) -> None:
        path = support.FOLDER / "robot.ocbrec"
        recording.write(path)
        reduction = reduce_scene(path, 0.01, algorithms="box-tree", **QUIET)
        # A box is exact, and a ball or a capsule is not.
        self.assertEqual([(row["body"], row["before"], row["after"]) for row in reduction.objects()], [("box", 12, 6)] * 2)
        self.assertEqual((reduction.data["queries"], reduction.data["held_out"]["queries"]), (20, 4))
        self.assertLess(reduction.data["largest_change"], 1e-6)
        self.assertEqual([(row["algorithm"], row["wrong"]) for row in reduction.speed()], [("box-tree", 0)])
        again = support.FOLDER / "reduced.ocbrec"
        again.write_bytes(reduction.recording())
        workload = replay(again, "box-tree", order="recorded", passes=1, **QUIET)
        self.assertTrue(workload.ok, workload.data)
        balls = reduce_scene(path, "1m", outside_only=True, **QUIET)
        self.assertEqual([row["body"] for row in balls.objects()], ["sphere"] * 2)
        with self.assertRaisesRegex(Error, "half of the tolerance"):
            reduce_scene(path, 0.01, near=0.005, **QUIET)

    def test_a_data_folder_of_its_own(self) -> None:
        mine = Command(data=support.FOLDER / "mine")
        bench(support.KNOT, algorithms="box-tree", ocb=mine, **support.SMALL)
        self.assertEqual(len(mine.ask(["run", "list"], Silent())), 1)


if __name__ == "__main__":
    unittest.main()
