"""Objects, poses, positions and tables, as they go to the program and come from it."""

from __future__ import annotations

import contextlib
import io
import unittest
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest import mock

import numpy
import polars
import pyarrow
import pyarrow.parquet
import support
import tqdm
from opencollbench import Error, MissingPackage, Parquet, Positions, Rows
from opencollbench.objects import named, ply
from opencollbench.poses import filed, matrices, relative
from opencollbench.progress import Bars, Lines, show_line
from opencollbench.tables import joined

VERTICES = numpy.array([[0.0, 0.0, 1 / 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.1]])
TRIANGLES = numpy.array([[0, 1, 2]])


class Objects(unittest.TestCase):
    def test_names_and_paths_stay_as_they_are(self) -> None:
        self.assertEqual(named("stock:box", support.FOLDER, "a"), "stock:box")
        self.assertEqual(named(support.FOLDER / "x.obj", support.FOLDER, "a"), str(support.FOLDER / "x.obj"))

    def test_a_mesh_is_written_without_loss(self) -> None:
        head, _, body = ply(VERTICES, TRIANGLES).partition(b"end_header\n")
        self.assertIn(b"property double x", head)
        self.assertTrue((numpy.frombuffer(body[:72], "<f8").reshape(3, 3) == VERTICES).all())
        self.assertEqual(body[72], 3)
        self.assertEqual(list(numpy.frombuffer(body[73:], "<i4")), [0, 1, 2])

    def test_anything_with_vertices_and_faces_is_a_mesh(self) -> None:
        mesh: Any = SimpleNamespace(vertices=VERTICES, faces=TRIANGLES)
        files = [Path(named(thing, support.FOLDER, name)) for thing, name in [(mesh, "m"), ((VERTICES, TRIANGLES), "n")]]
        self.assertEqual(files[0].read_bytes(), files[1].read_bytes())

    def test_what_is_no_mesh_is_refused_in_a_sentence(self) -> None:
        for thing, told in [
            (5, "must be a path, the name of a stock object"),
            ((VERTICES[:, :2], TRIANGLES), r"shape \(n, 3\), not \(3, 2\)"),
            ((VERTICES, TRIANGLES[0]), r"shape \(m, 3\), not \(3,\)"),
            ((VERTICES, [[0, 1, 3]]), "names a vertex outside of 0 to 2"),
            ((VERTICES, [[0.0, 1.0, 2.0]]), "must be whole numbers"),
        ]:
            with self.assertRaisesRegex(Error, told):
                named(thing, support.FOLDER, "a")  # type: ignore[arg-type]


class Poses(unittest.TestCase):
    def test_matrices_of_both_shapes_are_written_by_rows(self) -> None:
        poses = numpy.arange(24.0).reshape(2, 3, 4)
        numbers = numpy.fromfile(filed(poses, support.FOLDER), "<f8").reshape(2, 4, 4)
        self.assertTrue((numbers[:, :3] == poses).all() and (numbers[:, 3] == [0, 0, 0, 1]).all())
        self.assertEqual(matrices(numpy.eye(4, dtype=numpy.float32)).shape, (1, 4, 4))

    def test_transposed_and_misshapen_ones_are_refused(self) -> None:
        transposed = numpy.eye(4)
        transposed[3, 0] = 2.0
        for poses, told in [
            (transposed, "last row of pose 0 must be 0 0 0 1"),
            (numpy.zeros((2, 3)), r"not \(2, 3\)"),
            ([["x"]], "must be numbers"),
        ]:
            with self.assertRaisesRegex(Error, told):
                matrices(poses)

    def test_b_in_the_frame_of_a(self) -> None:
        turn = numpy.array([[0.0, -1, 0, 5], [1, 0, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        b = numpy.eye(4)
        b[:3, 3] = 1, 2, 3
        found = relative(turn[None, :3].reshape(1, 12), (turn @ b)[None, :3].reshape(1, 12))
        numpy.testing.assert_allclose(found[0], b, atol=1e-15)


class Where(unittest.TestCase):
    def test_the_same_words_on_the_command_line_and_in_the_api(self) -> None:
        grid = Positions("grid", count=50, step=-1e-4, seed=3)
        self.assertEqual(grid.arguments(), ["--method", "grid", "--count", "50", "--step", "-0.0001", "--seed", "3"])
        sampling = {"kind": "count", "count": 50}
        self.assertEqual(grid.spec()["method"], {"kind": "grid", "sampling": sampling, "seed": 3})
        self.assertEqual(grid.spec()["separation"], {"kind": "step", "of_size": -1e-4})
        self.assertEqual(Positions(separation="ladder").arguments(), ["--method", "sphere", "--ladder"])
        self.assertEqual(Positions("random").spec()["method"], {"kind": "random", "count": 10000, "hit_share": 0.5, "seed": 0})

    def test_a_setting_without_effect_is_refused(self) -> None:
        for positions, told in [
            (Positions("trajectory", rotate=5), "rotate does not belong to the method trajectory"),
            (Positions("spiral"), "not 'spiral'"),
            (Positions(separation="far"), 'a number or "ladder"'),
        ]:
            with self.assertRaisesRegex(Error, told):
                positions.spec()


class Tables(unittest.TestCase):
    def part(self, name: str, **columns: Any) -> Parquet:
        out = io.BytesIO()
        pyarrow.parquet.write_table(pyarrow.table(columns), out)
        return Parquet([({"algorithm": name}, out.getvalue)])

    def test_tables_are_joined_and_missing_columns_are_empty(self) -> None:
        whole = joined([self.part("x", n=[1, 2]), self.part("y", n=[3], rounded=[True])])
        expected = {"algorithm": ["x", "x", "y"], "n": [1, 2, 3], "rounded": [None, None, True]}
        self.assertEqual(whole.to_arrow().to_pydict(), expected)
        self.assertEqual(whole.to_polars().to_dict(as_series=False), expected)
        self.assertEqual(list(whole.to_pandas()["algorithm"]), expected["algorithm"])

    def test_a_polars_that_cannot_read_the_file_is_helped_or_named(self) -> None:
        table = self.part("x", n=[1, 2])
        refusal = polars.exceptions.ComputeError("Invalid thrift: bad data")
        with mock.patch.object(polars, "read_parquet", side_effect=refusal):
            self.assertEqual(table.to_polars().to_dict(as_series=False), {"algorithm": ["x", "x"], "n": [1, 2]})
            with mock.patch.dict("sys.modules", {"pyarrow.parquet": None}):
                with self.assertRaisesRegex(Error, "cannot read this Parquet file; install polars 1.43 or newer, or pyarrow"):
                    table.to_polars()

    def test_lists_become_an_array_by_either_library(self) -> None:
        poses = pyarrow.array([[1.0, 2.0], [3.0, 4.0]], pyarrow.list_(pyarrow.float64(), 2))
        table = self.part("x", pose=poses)
        self.assertEqual(table.matrices("pose")[0].tolist(), [[1.0, 2.0], [3.0, 4.0]])
        with mock.patch.dict("sys.modules", {"pyarrow": None}):
            self.assertEqual(table.matrices("pose")[0].tolist(), [[1.0, 2.0], [3.0, 4.0]])
            with self.assertRaisesRegex(MissingPackage, "needs pyarrow"):
                table.to_pandas()
        with self.assertRaisesRegex(Error, "There is no column 'q'; the columns are algorithm, pose."):
            table.matrices("q")

    def test_rows_are_text_without_any_package(self) -> None:
        rows = Rows([{"algorithm": "x", "ns": 1234.56}, {"algorithm": "longer", "ns": None}])
        self.assertEqual(str(rows), "algorithm  ns\nx          1235\nlonger     -")
        self.assertEqual(rows.to_polars().shape, (2, 2))
        self.assertEqual(rows.to_arrow().num_rows, 2)


class Shown(unittest.TestCase):
    def show(self, progress: Any) -> None:
        for line in [
            "parry: running",
            "parry: 30/100 50/s, 2 s left",
            "30 of 200 queries",
            "waiting: another process is measuring on this machine",
        ]:
            show_line(progress, line)

    def test_lines_of_the_command_become_bars(self) -> None:
        shown = io.StringIO()
        with contextlib.redirect_stderr(shown):
            bars = Bars(tqdm.tqdm)
            self.show(bars)
            found = {name: (bar.n, bar.total) for name, bar in bars.bars.items()}
            bars.close()
        self.assertEqual(found, {"parry": (30, 100), "queries": (30, 200)})
        self.assertIn("waiting: another process is measuring on this machine\n", shown.getvalue())
        self.assertIn("50/s, 2 s left", shown.getvalue())

    def test_or_lines(self) -> None:
        shown = io.StringIO()
        with contextlib.redirect_stderr(shown):
            self.show(Lines())
        waiting = "waiting: another process is measuring on this machine"
        lines = ["parry: running", "parry: 30/100 50/s, 2 s left", "queries: 30/200", waiting]
        self.assertEqual(shown.getvalue().splitlines(), lines)


if __name__ == "__main__":
    unittest.main()
