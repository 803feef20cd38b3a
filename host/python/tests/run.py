"""run.py [NAME...]: runs the tests of this folder, or those of these modules, and says the counts that `make test` adds up."""

from __future__ import annotations

import sys
import unittest
from pathlib import Path

HERE = Path(__file__).parent


def main() -> int:
    sys.path[:0] = [str(HERE), str(HERE.parent)]
    loader = unittest.defaultTestLoader
    names = sys.argv[1:]
    suite = loader.loadTestsFromNames(names) if names else loader.discover(str(HERE))
    result = unittest.TextTestRunner(verbosity=2).run(suite)
    failed = len(result.failures) + len(result.errors) + len(result.unexpectedSuccesses)
    passed = max(0, result.testsRun - failed - len(result.skipped))
    for _, reason in result.skipped:
        print(f"not run: {reason}")
    word = "ok" if result.wasSuccessful() and passed else "FAILED"
    print(f"test result: {word}. {passed} passed; {failed} failed")
    return 0 if word == "ok" else 1


if __name__ == "__main__":
    sys.exit(main())
