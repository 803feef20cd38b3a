"""What becomes of the endings of a command, with stand-ins for it."""

from __future__ import annotations

import contextlib
import io
import os
import signal
import threading
import time
import unittest
import warnings
from pathlib import Path
from unittest import mock

import support
from opencollbench import Command, Error, Notice, bench, generate, truth
from opencollbench.command import run
from opencollbench.progress import Silent

#: What a stand-in prints for a run with a wrong answer.
WRONG = """
print(json.dumps({"id": "r", "state": "done", "results": [{"algorithm": "x", "n": 3, "of": 3, "wrong": 1,
      "outcome": {"name": "Completed", "message": "m"}}]}))
"""


class Endings(unittest.TestCase):
    def test_a_refusal_is_an_error_with_its_sentence(self) -> None:
        ocb = support.stand_in("print('ocb: No such file.', file=sys.stderr); sys.exit(2)")
        with self.assertRaises(Error) as raised:
            bench("a.obj", ocb=ocb, progress=False)
        self.assertEqual((str(raised.exception), raised.exception.code), ("No such file.", 2))

    def test_wrong_answers_do_not_hide_the_result(self) -> None:
        ocb = support.stand_in(WRONG + "sys.exit(3)")
        run = bench("a.obj", ocb=ocb, progress=False)
        self.assertEqual((run.ok, run.state, run.summary()[0]["wrong"]), (False, "done", 1))

    def test_a_fault_after_a_result_of_other_commands_is_an_error(self) -> None:
        ocb = support.stand_in("print('[]'); print('ocb: Internal error: broken.', file=sys.stderr); sys.exit(1)")
        with self.assertRaisesRegex(Error, "Internal error: broken."):
            truth("a.obj", None, "poses.csv", ocb=ocb, progress=False)

    def test_silence_is_an_error(self) -> None:
        ocb = support.stand_in("os.kill(os.getpid(), signal.SIGKILL)")
        with self.assertRaisesRegex(Error, "exit code -9"):
            bench("a.obj", ocb=ocb, progress=False)

    def test_what_is_said_beside_a_result_is_a_warning(self) -> None:
        ocb = support.stand_in("print('ocb: a.obj: 2 triangles without area.', file=sys.stderr)\n" + WRONG)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            bench("a.obj", ocb=ocb, progress=False)
        self.assertEqual([str(each.message) for each in caught], ["a.obj: 2 triangles without area."])
        self.assertIs(caught[0].category, Notice)
        self.assertEqual(Path(caught[0].filename).name, Path(__file__).name)

    def test_progress_goes_to_stderr_as_lines_where_tqdm_is_missing(self) -> None:
        body = "print('x: 10/40 5/s, 6 s left', file=sys.stderr); print('waiting', file=sys.stderr)"
        ocb = support.stand_in(body + WRONG)
        shown = io.StringIO()
        with mock.patch.dict("sys.modules", {"tqdm": None}), contextlib.redirect_stderr(shown):
            bench("a.obj", ocb=ocb)
        self.assertEqual(shown.getvalue(), "x: 10/40 5/s, 6 s left\nwaiting\n")

    def test_large_output_beside_large_progress_does_not_block(self) -> None:
        ocb = support.stand_in("for i in range(20000): print('x' * 50, file=sys.stderr)\nprint(json.dumps(['y' * 500000]))")
        self.assertEqual(len(Command(ocb).ask([], Silent())[0]), 500000)

    def test_an_interrupt_reaches_the_command_and_waits_for_it(self) -> None:
        ended = support.FOLDER / "ended"
        body = f"""
def end(*_):
    time.sleep(0.2); open({str(ended)!r}, "w").close(); sys.exit(130)
signal.signal(signal.SIGINT, end)
print('ready', file=sys.stderr, flush=True)
time.sleep(60)
"""
        ocb = support.stand_in(body)
        # A shell that starts this program in the background has it ignore interrupts.
        before = signal.signal(signal.SIGINT, signal.default_int_handler)
        self.addCleanup(signal.signal, signal.SIGINT, before)

        class Interrupting(Silent):
            def say(self, text: str) -> None:
                threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()

        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            run([str(ocb)], Interrupting())
        self.assertTrue(ended.exists())
        self.assertLess(time.monotonic() - began, 20)


class Finding(unittest.TestCase):
    def test_the_argument_comes_before_the_environment_and_this_before_the_path(self) -> None:
        one, two = support.stand_in(""), support.stand_in("")
        in_path = support.FOLDER / "bin" / "ocb"
        in_path.parent.mkdir(exist_ok=True)
        in_path.write_text("#!/bin/sh\n")
        in_path.chmod(0o755)
        with mock.patch.dict(os.environ, {"OCB": str(two), "PATH": str(in_path.parent)}):
            self.assertEqual(Command(one).find(), one)
            self.assertEqual(Command().find(), two)
            del os.environ["OCB"]
            self.assertEqual(Command().find(), in_path)
            os.environ["PATH"] = "/nowhere"
            with self.assertRaisesRegex(Error, "There is no program `ocb`"):
                Command().find()
            os.environ["OCB"] = "/nowhere/ocb"
            with self.assertRaisesRegex(Error, "the environment variable OCB"):
                Command().find()

    def test_settings_of_the_command_are_passed_on(self) -> None:
        ocb = support.stand_in("print(json.dumps(sys.argv[1:]))")
        told = Command(ocb, data="d", plugins=["p.so", "q.so"], profile="dev").ask(["x"], Silent())
        self.assertEqual(told, ["--json", "x", "--data", "d", "--plugins", "p.so", "--plugins", "q.so", "--profile", "dev"])


class Arguments(unittest.TestCase):
    def test_what_has_no_effect_is_refused(self) -> None:
        with self.assertRaisesRegex(Error, "not both"):
            bench("a.obj", configurations="poses.csv", count=5)
        with self.assertRaisesRegex(Error, "The query must be distance, collision or contacts, not 'pq'."):
            bench("a.obj", query="pq")

    def test_a_missing_package_is_named_with_its_extra(self) -> None:
        with mock.patch.dict("sys.modules", {"numpy": None}):
            with self.assertRaisesRegex(ImportError, r"needs numpy; install it with: pip install 'opencollbench\[numpy\]'"):
                generate(([[0, 0, 0]], [[0, 0, 0]]))


if __name__ == "__main__":
    unittest.main()
