"""Who may use the workbench: token, cookie, host, origin; headers of security; largest request.

The workbench writes files. So it listens on the loopback address alone; asks every request for the cookie
that only the address in the terminal hands out; refuses any other name of the host (a foreign page that has
its name point here) and any other origin (a foreign page that sends a form); and lets its own pages load
nothing from elsewhere, and run no script but those that come along.
"""

from __future__ import annotations

import re
import secrets
from collections.abc import Awaitable, Callable
from dataclasses import dataclass

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import Request
from starlette.responses import PlainTextResponse, RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from zlmreport.language import Language, Words, find_accepted_language

HOST = "127.0.0.1"
_NAMES = (HOST, "localhost")
_SAFE = frozenset({"GET", "HEAD"})
_LONGEST_BODY = 65_536

#: No source but this server, for nothing: no inline script or style, no frame, no form, no plug-in.
POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; font-src 'self'; img-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
    "require-trusted-types-for 'script'; trusted-types 'none'"
)
_HEADERS = {
    "Content-Security-Policy": POLICY,
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Cache-Control": "no-store",
}

_NO_TOKEN = Words("This page opens only by the address that 'zlmreport workbench' printed on the terminal.")


@dataclass(frozen=True, slots=True)
class Door:
    """Where the workbench listens, and what opens it."""

    port: int  #: On the loopback address.
    token: str  #: In the address that the terminal prints, and then in the cookie.

    @classmethod
    def at(cls, port: int) -> Door:
        """Return a door with a token of its own, which nobody guesses."""
        return cls(port, secrets.token_urlsafe(32))

    @property
    def address(self) -> str:
        """What the terminal prints."""
        return f"http://{HOST}:{self.port}/?token={self.token}"

    @property
    def cookie(self) -> str:
        """Name of the cookie: cookies do not tell ports apart."""
        return f"zlmreport-{self.port}"

    @property
    def hosts(self) -> frozenset[str]:
        """What a request may call this server."""
        return frozenset(f"{name}:{self.port}" for name in _NAMES)

    @property
    def origins(self) -> frozenset[str]:
        """Where a request that changes something may come from."""
        return frozenset(f"http://{host}" for host in self.hosts)

    def is_opened_by(self, offered: str) -> bool:
        """Return whether a token is the one, in a time that does not tell how nearly."""
        return secrets.compare_digest(offered.encode(), self.token.encode())


class DoorKeeper:
    """Stands before the application, and lets through what `Door` says.

    `door`: Where it listens, and what opens it.
    """

    def __init__(self, app: ASGIApp, door: Door) -> None:
        self.app = app
        self.door = door

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or hand it on; every answer carries the headers that keep its page in."""
        if scope["type"] != "http":
            if scope["type"] == "lifespan":
                await self.app(scope, receive, send)
            return
        answer: Callable[[Scope, Receive, Send], Awaitable[None]]
        answer = self._find_refusal(Request(scope)) or self.app
        await answer(scope, receive, _add_headers(send))

    def _find_refusal(self, request: Request) -> Response | None:
        """Return what stands in the way of a request; the cookie, where it brings the token; else nothing."""
        offered = request.query_params.get("token")
        refusal = self._refuse_foreign(request)
        if refusal is not None:
            return refusal
        if offered is not None and request.url.path == "/" and self.door.is_opened_by(offered):
            return self._admit(request)
        if not self.door.is_opened_by(request.cookies.get(self.door.cookie, "")):
            language = find_accepted_language(request.headers.get("accept-language", "")) or Language.ENGLISH
            return PlainTextResponse(_NO_TOKEN.in_language(language), 403)
        return None

    def _refuse_foreign(self, request: Request) -> Response | None:
        """Refuse what no page of this server would ask."""
        headers = request.headers
        origin = headers.get("origin")
        if headers.get("host", "") not in self.door.hosts:
            return PlainTextResponse("wrong host", 421)
        changes = request.method not in _SAFE
        if origin not in self.door.origins and (changes or origin is not None):
            return PlainTextResponse("wrong origin", 403)
        if changes and headers.get("content-type") != "application/json":
            return PlainTextResponse("wrong content", 415)
        if changes and not _is_short(headers):
            return PlainTextResponse("too long", 413)
        return None

    def _admit(self, request: Request) -> Response:
        """Hand out the cookie, and lead to the page by an address that no longer tells the token."""
        kept = request.url.remove_query_params("token").query
        response = RedirectResponse(f"/?{kept}" if kept else "/", 303)
        response.set_cookie(self.door.cookie, self.door.token, httponly=True, samesite="strict", path="/")
        return response


def _is_short(headers: Headers) -> bool:
    length = headers.get("content-length", "")
    return re.fullmatch("[0-9]{1,9}", length) is not None and int(length) <= _LONGEST_BODY


def _add_headers(send: Send) -> Send:
    async def send_with_headers(message: Message) -> None:
        if message["type"] == "http.response.start":
            headers = MutableHeaders(scope=message)
            for name, value in _HEADERS.items():
                headers[name] = value
        await send(message)

    return send_with_headers
