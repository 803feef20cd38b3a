"""The examples in docstrings and in the README do what they say."""

from __future__ import annotations

import contextlib
import doctest
import importlib
import io
import os
import pkgutil
import re
import tempfile
import unittest
from pathlib import Path

import opencollbench
import support

README = Path(__file__).parents[1] / "README.md"


def setUpModule() -> None:
    support.use_built()


class Examples(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory()
        before = os.getcwd()
        os.chdir(folder.name)
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, before)

    def test_docstrings(self) -> None:
        names = [module.name for module in pkgutil.iter_modules(opencollbench.__path__) if module.name != "__main__"]
        tried = 0
        for name in ["", *(f".{name}" for name in names)]:
            module = importlib.import_module(f"opencollbench{name}")
            result = doctest.testmod(module, extraglobs=vars(opencollbench))
            self.assertEqual(result.failed, 0, module.__name__)
            tried += result.attempted
        self.assertGreater(tried, 10)

    def test_readme(self) -> None:
        blocks = re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL)
        self.assertGreater(len(blocks), 3)
        names: "dict[str, object]" = {}
        with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.redirect_stderr(io.StringIO()):
            for block in blocks:
                exec(compile(block, str(README), "exec"), names)
        self.assertIn("ocb-fast", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
