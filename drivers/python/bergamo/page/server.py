"""Serves the page of a run by Python's http.server, to this machine alone."""

from __future__ import annotations

import json
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

from ..errors import BadArgument, Error
from .look import Looks

HOST = "127.0.0.1"  # never another one: whoever reaches the page sees the run
PAGE = Path(__file__).with_name("page.html")
PLOTS = "/plots/"


class PageServer(ThreadingHTTPServer):
    """Waits for a browser; `serve_forever()` until `shutdown()` or an exception. A browser that holds a connection open
    does not keep others out.
    """

    daemon_threads = True

    def __init__(self, looks: Looks, port: int = 0, interval: float = 2.) -> None:
        """@param port 0: any that is free; @param interval between two looks of the browser [s]. BadArgument for a port
        that cannot be had.
        """
        self.looks, self.interval = looks, interval
        try:
            super().__init__((HOST, port), Handler)
        except (OSError, OverflowError) as error:
            raise BadArgument(f"--port {port}: {getattr(error, 'strerror', None) or error}; leave --port out for any that "
                              "is free") from None

    @property
    def address(self) -> str:
        return f"http://{HOST}:{self.server_port}/"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A browser that goes away in the middle is no news."""


class Handler(BaseHTTPRequestHandler):
    """Answers a few addresses, none of which is made into a path: what is not among them is not there."""

    server: PageServer

    def do_GET(self) -> None:
        if self.headers.get("Host", "") not in (f"{HOST}:{self.server.server_port}", f"localhost:{self.server.server_port}"):
            self.refuse(HTTPStatus.FORBIDDEN, "this page is for the browser of its own machine")  # a name that leads here
            return
        path = unquote(urlsplit(self.path).path)
        try:
            if path == "/":
                text = PAGE.read_text().replace("{{interval}}", str(self.server.interval))
                self.answer("text/html; charset=utf-8", text.encode())
            elif path == "/look.json":
                self.answer("application/json", json.dumps(self.server.looks.look(), allow_nan=False).encode())
            elif path == "/picture.png":
                self.answer("image/png", self.server.looks.draw())
            elif path.startswith(PLOTS) and path[len(PLOTS):] in (plots := self.server.looks.plots()):
                self.answer("image/png", plots[path[len(PLOTS):]].read_bytes())
            else:
                self.refuse(HTTPStatus.NOT_FOUND, "there is no such page")
        except (Error, OSError, ImportError) as error:
            self.refuse(HTTPStatus.NOT_FOUND, str(error))

    def answer(self, kind: str, content: bytes, status: HTTPStatus = HTTPStatus.OK) -> None:
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(content)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        self.send_header("Content-Security-Policy", "default-src 'self'; style-src 'unsafe-inline'; script-src "
                                                    "'unsafe-inline'; base-uri 'none'; frame-ancestors 'none'")
        self.end_headers()
        self.wfile.write(content)

    def refuse(self, status: HTTPStatus, why: str) -> None:
        self.answer("text/plain; charset=utf-8", (why + "\n").encode(), status)

    def log_message(self, format: str, *arguments: Any) -> None:
        """A line for each look would fill the terminal."""
