"""Requests to services that behave badly, played by a server of the test."""

from __future__ import annotations

import json
import threading
import unittest
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any, ClassVar, Dict, List
from unittest import mock

import support
from opencollbench import Error, Service
from opencollbench import service as services

RUN = {"id": "r1", "state": "running", "results": []}


class Server(BaseHTTPRequestHandler):
    """Breaks the stream of events off once, and notes what it is asked."""

    asked: ClassVar[List[Any]] = []

    def do_GET(self) -> None:
        self.note()
        after = self.headers.get("Last-Event-ID")
        if self.path == "/moved/api/v1/runs/r1":
            self.answer(302, b"", Location="http://127.0.0.1:1/elsewhere")
        elif self.path == "/broken/api/v1/runs/r1":
            self.answer(500, b"<html>")
        elif not self.path.endswith("/events"):
            asked = len(self.events_asked())
            # Once while it starts anew.
            self.answer(503 if asked == 1 else 200, json.dumps({**RUN, "state": "done"}).encode())
        elif after == "0":
            stage = {"kind": "measuring", "algorithm": "x", "state": "running", "done": 3, "total": 9, "rate": 1}
            event = json.dumps({"seq": 1, "state": "running", "stage": stage})
            self.answer(200, f"id: 1\ndata: {event}\n\n".encode())
        else:
            self.answer(200, b": heartbeat\n\ndata: " + json.dumps({"seq": 2, "state": "done"}).encode() + b"\n\n")

    def do_POST(self) -> None:
        self.note(json.loads(self.rfile.read(int(self.headers["Content-Length"])) or "null"))
        self.answer(201, json.dumps(RUN).encode())

    def note(self, body: Any = None) -> None:
        self.asked.append((self.command, self.path, {name.lower(): value for name, value in self.headers.items()}, body))

    def events_asked(self) -> List[Any]:
        return [headers["last-event-id"] for _, path, headers, _ in self.asked if path.endswith("/events")]

    def answer(self, status: int, body: bytes, **headers: str) -> None:
        self.send_response(status)
        for name, value in {"Content-Length": str(len(body)), **headers}.items():
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_: Any) -> None:
        """Says nothing."""


class Clients(unittest.TestCase):
    def setUp(self) -> None:
        Server.asked = []
        pause = mock.patch.object(services, "PAUSE", 0.01)
        pause.start()
        self.addCleanup(pause.stop)
        server = ThreadingHTTPServer(("127.0.0.1", 0), Server)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.url = f"http://127.0.0.1:{server.server_port}"

    def paths(self, method: str) -> List[str]:
        return [path for each, path, _, _ in Server.asked if each == method]

    def test_a_stream_that_breaks_off_goes_on_behind_the_last_event(self) -> None:
        run = Service(self.url, token="t").bench(support.KNOT, **support.SMALL)
        self.assertEqual(run.state, "done")
        headers: List[Dict[str, str]] = [headers for _, path, headers, _ in Server.asked if path.endswith("/events")]
        self.assertEqual([each["last-event-id"] for each in headers], ["0", "1"])
        self.assertEqual({each["authorization"] for each in headers}, {"Bearer t"})

    def test_a_run_is_asked_for_under_a_key(self) -> None:
        Service(self.url).bench(support.KNOT, algorithms="x", quick=True, **support.SMALL)
        [(_, path, headers, body)] = [each for each in Server.asked if each[0] == "POST"]
        self.assertEqual(path, "/api/v1/runs")
        self.assertEqual(len(headers["idempotency-key"]), 32)
        self.assertEqual((body["algorithms"], body["at_most"], body["query"]), (["x"], 5000, "proximity"))

    def test_an_interrupt_cancels_the_run(self) -> None:
        with mock.patch.object(services, "show", side_effect=KeyboardInterrupt), self.assertRaises(KeyboardInterrupt):
            Service(self.url).bench(support.KNOT, **support.SMALL)
        self.assertEqual(self.paths("POST"), ["/api/v1/runs", "/api/v1/runs/r1/cancel"])

    def test_a_redirection_does_not_take_the_token_away(self) -> None:
        with self.assertRaisesRegex(Error, "redirects to http://127.0.0.1:1/elsewhere; use its address there"):
            Service(f"{self.url}/moved", token="t").load_run("r1")

    def test_an_answer_without_a_sentence_is_an_error_all_the_same(self) -> None:
        with self.assertRaisesRegex(Error, "answered 500 to /api/v1/runs/r1"):
            Service(f"{self.url}/broken").load_run("r1")


if __name__ == "__main__":
    unittest.main()
