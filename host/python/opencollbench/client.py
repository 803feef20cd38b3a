"""Requests to a service, by the standard library alone."""

from __future__ import annotations

import http.client
import http.cookiejar
import json
import secrets
import urllib.error
import urllib.parse
import urllib.request
from typing import Any, Dict, Iterator, Mapping, Optional

from .errors import Error

#: Seconds without a byte after which a request fails; a stream of events says something every 15 seconds.
TIMEOUT = 60.0
REDIRECTIONS = (301, 302, 303, 307, 308)


class NoRedirect(urllib.request.HTTPRedirectHandler):
    """Follows no redirection, which would take the token to another host."""

    def redirect_request(self, *arguments: Any) -> None:
        """Makes the redirection an error."""


class Client:
    """A visitor of a service: a guest, whom a cookie identifies, or the account of a token.

    Args:
        url: address of the service, such as `http://127.0.0.1:8080`.
        token: token of an account, from its account page.
    """

    def __init__(self, url: str, token: Optional[str] = None) -> None:
        parts = urllib.parse.urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.netloc:
            raise Error(f"{url!r} is not the address of a service, such as http://127.0.0.1:8080.")
        self.url = url.rstrip("/")
        self._headers = {"Accept": "application/json"}
        if token is not None:
            self._headers["Authorization"] = f"Bearer {token}"
        cookies = urllib.request.HTTPCookieProcessor(http.cookiejar.CookieJar())
        self._opener = urllib.request.build_opener(cookies, NoRedirect)

    def json(self, path: str) -> Any:
        """What the service answers to a GET."""
        return json.loads(self.content(path))

    def content(self, path: str) -> bytes:
        """A file of the service."""
        with self.open(path) as answer:
            content: bytes = answer.read()
        return content

    def post(self, path: str, body: Any = None, key: Optional[str] = None) -> Any:
        """Sends JSON; `key` makes a repeated request harmless."""
        headers = {"Content-Type": "application/json"}
        if key is not None:
            headers["Idempotency-Key"] = key
        with self.open(path, json.dumps(body).encode() if body is not None else b"", headers) as answer:
            return json.loads(answer.read())

    def upload(self, path: str, name: str, content: bytes) -> Any:
        """Sends a file as a form."""
        boundary = secrets.token_hex(16)
        quoted = name.replace("\\", "_").replace('"', "_").replace("\r", "_").replace("\n", "_")
        head = (
            f'--{boundary}\r\nContent-Disposition: form-data; name="file"; filename="{quoted}"\r\n'
            "Content-Type: application/octet-stream\r\n\r\n"
        )
        body = head.encode() + content + f"\r\n--{boundary}--\r\n".encode()
        with self.open(path, body, {"Content-Type": f"multipart/form-data; boundary={boundary}"}) as answer:
            return json.loads(answer.read())

    def events(self, path: str, after: int) -> Iterator[Dict[str, Any]]:
        """The events of a stream behind number `after`, until it ends or breaks off."""
        with self.open(path, headers={"Accept": "text/event-stream", "Last-Event-ID": str(after)}) as answer:
            if answer.status == 204:
                return
            for raw in answer:
                name, _, value = raw.decode("utf-8").rstrip("\r\n").partition(": ")
                if name == "data":
                    yield json.loads(value)

    def open(self, path: str, body: Optional[bytes] = None, headers: Optional[Mapping[str, str]] = None) -> Any:
        """Begins a request.

        Raises:
            Error: the service refused it, or cannot be reached.
        """
        request = urllib.request.Request(f"{self.url}{path}", body, {**self._headers, **(headers or {})})
        try:
            return self._opener.open(request, timeout=TIMEOUT)
        except urllib.error.HTTPError as error:
            with error:
                otherwise = f"The service {self.url} answered {error.code} to {path}."
                if error.code in REDIRECTIONS:
                    otherwise = f"The service {self.url} redirects to {error.headers.get('Location')}; use its address there."
                raise Error(sentence(error.read(), otherwise), error.code) from None
        except (OSError, http.client.HTTPException) as error:
            reason = getattr(error, "reason", error)
            raise Error(f"The service {self.url} cannot be reached: {reason}.") from error


def sentence(content: bytes, otherwise: str) -> str:
    """What the service says in its answer to a request that it refuses."""
    try:
        return str(json.loads(content)["detail"])
    except (ValueError, KeyError, TypeError):
        return otherwise


def segment(text: str) -> str:
    """A text as part of a path or a query."""
    return urllib.parse.quote(text, safe="")
