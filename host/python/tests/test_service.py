"""A service that measures, over HTTP."""

from __future__ import annotations

import json
import os
import subprocess
import unittest
from typing import ClassVar

import numpy
import support
import trimesh
from opencollbench import Error, Service, bench, load_run


def setUpModule() -> None:
    support.use_built()


class Services(unittest.TestCase):
    process: ClassVar["subprocess.Popen[bytes]"]
    url: ClassVar[str]

    @classmethod
    def setUpClass(cls) -> None:
        line = [os.environ["OCB"], "--json", "serve", "--address", "127.0.0.1:0", "--idle", "off"]
        line += ["--data", str(support.FOLDER / "service")]
        cls.process = subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        assert cls.process.stdout is not None
        cls.url = json.loads(cls.process.stdout.readline())["url"]

    @classmethod
    def tearDownClass(cls) -> None:
        cls.process.terminate()
        cls.process.wait(30)
        assert cls.process.stdout is not None
        cls.process.stdout.close()

    def test_a_run_of_uploaded_meshes_on_given_poses(self) -> None:
        box = trimesh.creation.box((1.0, 2.0, 1 / 3))
        poses = numpy.tile(numpy.eye(4), (3, 1, 1))
        poses[:, 0, 3] = 1 + 1 / 7, 1.5, 2.0
        run = Service(self.url).bench(
            box, (box.vertices, box.faces), configurations=poses, algorithms="brute-force", passes=1, progress=False
        )
        self.assertTrue(run.ok, run.info)
        numpy.testing.assert_allclose(sorted(run.records().to_pandas()["distance"]), [1 / 7, 0.5, 1.0], rtol=1e-9)
        numpy.testing.assert_array_equal(run.configurations().poses, poses)
        again = load_run(f"{self.url}/r/{run.id}?tab=table")
        self.assertTrue(again.records().to_polars().equals(run.records().to_polars()))

    def test_the_same_question_here_and_there(self) -> None:
        there = Service(self.url).bench(support.KNOT, algorithms=["box-tree"], run_seed=5, **support.SMALL)
        here = bench(support.KNOT, algorithms=["box-tree"], run_seed=5, **support.SMALL)
        for name in ("query", "semantics", "method", "separation", "passes", "algorithms", "seed"):
            self.assertEqual(there.info["spec"][name], here.info["spec"][name], name)
        numpy.testing.assert_array_equal(there.configurations().poses, here.configurations().poses)
        answers = [run.records("box-tree").to_polars().sort("configuration")["distance"] for run in (there, here)]
        self.assertTrue(answers[0].equals(answers[1]))
        tests = there.triangles("box-tree")
        assert tests is not None
        self.assertGreater(tests.to_polars()["tests"].sum(), 0)

    def test_a_refusal_is_an_error_with_the_sentence_of_the_service(self) -> None:
        service = Service(self.url)
        with self.assertRaisesRegex(Error, "no-such") as raised:
            service.bench(support.KNOT, algorithms="no-such", **support.SMALL)
        self.assertEqual(raised.exception.code, 422)
        with self.assertRaises(Error) as raised:
            service.load_run("no-such")
        self.assertEqual(raised.exception.code, 404)
        with self.assertRaises(Error) as raised:
            Service(self.url, token="wrong").bench(support.KNOT, **support.SMALL)
        self.assertEqual(raised.exception.code, 401)

    def test_a_service_that_is_not_there(self) -> None:
        with self.assertRaisesRegex(Error, "http://127.0.0.1:1 cannot be reached"):
            Service("http://127.0.0.1:1").load_run("x")
        with self.assertRaisesRegex(Error, "not the address of a service"):
            Service("127.0.0.1:8080")


if __name__ == "__main__":
    unittest.main()
