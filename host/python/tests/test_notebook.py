"""The notebooks of examples/notebook run from the first cell to the last."""

from __future__ import annotations

import os
import unittest

import nbclient
import nbformat
import support


def setUpModule() -> None:
    support.use_built()
    os.environ["PYTHONPATH"] = str(support.ROOT / "host" / "python")


class Notebooks(unittest.TestCase):
    def test_every_cell_runs_and_charts_come_out(self) -> None:
        paths = sorted((support.ROOT / "examples" / "notebook").glob("*.ipynb"))
        self.assertTrue(paths)
        for path in paths:
            notebook = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
            self.assertFalse(any(cell.get("outputs") for cell in notebook.cells), f"{path.name} is stored with outputs")
            nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(support.FOLDER)}}).execute()
            outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
            self.assertTrue(any("image/png" in output.get("data", {}) for output in outputs), path.name)


if __name__ == "__main__":
    unittest.main()
