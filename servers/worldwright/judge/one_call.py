"""One call to a judge's server through its maker's own client, and every way in which it can fail as a `JudgeError`.

The clients write requests and read answers; what goes over the line is a matter of this module, which hands them the HTTP
client that they speak through. A key is sent over TLS or to this machine itself, never on to another address that the server
names, and never stands in a message. Nothing else of the environment or about this machine goes along: the clients would
add keys, organisations and headers of variables that belong to other addresses. Nor is anything asked twice: `patience` does that.
"""

import contextlib
import json
import os
from collections.abc import Iterator
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from typing import Any
from urllib.parse import urlsplit

import httpx2

from .judges import Answer, JudgeError

MOST_ANSWER = 8 << 20
LOOPBACK = ("127.0.0.1", "::1", "localhost")
SENT = ("host", "connection", "content-type", "content-length", "accept", "accept-encoding", "user-agent", "anthropic-version")  # fmt: skip
"""Headers that a call has beside the one of its key."""
CODES = {401: "unauthorised", 403: "unauthorised", 408: "timed_out", 413: "too_large", 429: "rate_limited", 529: "rate_limited"}  # fmt: skip
NEXT = {
    "unauthorised": "set its key in the environment, or ask its owner for the right to this model",
    "timed_out": "ask again, or give it longer: --silent-s",
    "too_large": "show less of the film: --frames, or --shows sheet",
    "rate_limited": "ask again later; what was voted stays",
    "failed": "ask again later; what was voted stays",
    "refused": "look at the model's name, and whether it takes pictures",
}


def key(variable: str, place: str, needed: bool = True) -> str:
    """A key of the environment, or an empty text where none is needed.

    Raises:
        JudgeError: `unauthorised`, there is none, or it is no header's text.
    """
    found = os.environ.get(variable, "").strip()
    if (not found and needed) or not found.isascii() or not found.isprintable():
        why = "holds characters that no key has" if found else "is not set"
        raise JudgeError(f"{variable} {why}", code="unauthorised", place=place, next_move=f"export {variable}=…")
    return found


@contextlib.contextmanager
def line(address: str, secret: str, silent_s: float) -> Iterator[httpx2.Client]:
    """The HTTP client that one call is made through; what fails inside is told as a `JudgeError`.

    Args:
        address: scheme and host, and where the server's paths begin.
        secret: the key, which alone of all that could tell who asks is sent.
        silent_s: a server that says nothing for so long is given up.

    Raises:
        JudgeError: it gave no answer, or none that is an object of JSON of the form that the client reads.
    """
    place = _checked(address)

    def goes(request: httpx2.Request) -> None:
        for name, value in list(request.headers.items()):
            if name.lower() not in SENT and not (secret and value.endswith(secret)):
                del request.headers[name]

    def comes(response: httpx2.Response) -> None:
        assert isinstance(response.stream, httpx2.SyncByteStream)
        response.stream = _Bounded(response.stream)
        if response.headers.get("Content-Encoding", "identity") != "identity":
            raise garbage("it answered packed, which was not asked for", place)  # and whose length nobody knows
        try:
            response.read()
        except OverflowError:
            raise garbage(f"its answer is longer than {MOST_ANSWER >> 20} MB", place) from None
        if not response.is_success:
            raise _refused(response, place, secret)
        if not isinstance(_object(response.content), dict):
            raise garbage(f"it answered no object of JSON: {response.content[:60]!r}", place)
        response.headers["Content-Type"] = "application/json"  # by which clients decide whether they read it

    try:
        with httpx2.Client(
            timeout=silent_s,
            follow_redirects=False,
            trust_env=urlsplit(address).hostname not in LOOPBACK,  # a proxy would get key and films in the clear
            headers={"Accept-Encoding": "identity"},
            event_hooks={"request": [goes], "response": [comes]},
        ) as http:
            yield http
    except Exception as error:  # each client wraps in its own kinds what was raised below it
        raise _named(error, place, silent_s) from error


class _Bounded(httpx2.SyncByteStream):
    """An answer that may not be longer than is read."""

    def __init__(self, held: httpx2.SyncByteStream) -> None:
        self.held = held

    def __iter__(self) -> Iterator[bytes]:
        size = 0
        for chunk in self.held:
            if (size := size + len(chunk)) > MOST_ANSWER:
                raise OverflowError
            yield chunk

    def close(self) -> None:
        """Close what it stands for."""
        self.held.close()


def _named(error: BaseException, place: str, silent_s: float) -> JudgeError:
    """What lies at the bottom of an error."""
    below: BaseException | None = error
    while below is not None:
        if isinstance(below, JudgeError):
            return below
        if isinstance(below, ImportError):
            return JudgeError(
                f"its maker's client is not installed: {below}", code="not_here", place="extra `judge`",
                next_move="pip install 'worldwright[judge]'",
            )  # fmt: skip
        if isinstance(below, httpx2.TimeoutException):
            said = f"it said nothing for {silent_s:g} s"
            return JudgeError(said, code="timed_out", place=place, next_move=NEXT["timed_out"])
        if isinstance(below, httpx2.TransportError | httpx2.InvalidURL | OSError):
            said = f"it cannot be reached: {below}"
            return JudgeError(said, code="unreachable", place=place, next_move=NEXT["timed_out"])
        below = below.__cause__ or below.__context__
    return garbage(f"it answered in no form that its client reads: {type(error).__name__}", place)


def declined(why: str, place: str) -> JudgeError:
    """It will not judge this film."""
    return JudgeError(
        f"it declines to judge this film: {why[:120]}", code="declined", place=place,
        next_move="take another judge for it, and for all others",
    )  # fmt: skip


def answer(text: object, cut: bool, place: str, model: object, *counts: object) -> Answer:
    """What it said, if that is all of it and something.

    Args:
        cut: it did not come to its end.
        counts: tokens in and out, if it told them.

    Raises:
        JudgeError: `cut_off`, or `garbage`.
    """
    if cut:
        raise JudgeError("its answer was cut off", code="cut_off", place=place, next_move="take a model that says less")
    if not isinstance(text, str) or not text.strip():
        raise garbage("it answered nothing", place)
    return Answer(text, str(model or ""), *(n if isinstance(n, int) else None for n in counts))


def garbage(said: str, place: str) -> JudgeError:
    """An answer in another form than the protocol's."""
    return JudgeError(said, code="garbage", place=place, next_move="see whether that address speaks this protocol")


def place_of(address: str) -> str:
    """An address without what may be secret in it: no user, no password, no query."""
    try:
        named = urlsplit(address)
        port = f":{named.port}" if named.port else ""
    except ValueError:
        return "an address that is none"
    return f"{named.scheme}://{named.hostname or ''}{port}{named.path}"


def _checked(address: str) -> str:
    try:
        named = urlsplit(address)
        known = named.scheme in ("http", "https") and bool(named.hostname) and named.port != 0
        more = "@" in named.netloc or bool(named.query or named.fragment)
    except ValueError:  # brackets without an end, a port that is none
        known = more = False
    if not known or any(c.isspace() for c in address):
        raise JudgeError(
            "that is no address of a server", code="unreachable", place=place_of(address),
            next_move="name one: --address https://…",
        )  # fmt: skip
    if more:
        raise JudgeError(
            "an address names no user and holds no query", code="refused", place=place_of(address),
            next_move="name the bare address; a key comes from the environment",
        )  # fmt: skip
    if named.scheme == "http" and named.hostname not in LOOPBACK:
        raise JudgeError(
            "a key and films are not sent in the clear", code="refused", place=place_of(address),
            next_move="name its https address; http is for a server on this machine",
        )  # fmt: skip
    return place_of(address)


def _refused(response: httpx2.Response, place: str, secret: str) -> JudgeError:
    status = response.status_code
    code = CODES.get(status, "failed" if status >= 500 else "refused")
    said = _said(response.content)
    said = (said.replace(secret, "(key)") if secret else said)[:200]  # some servers say the key again that they refuse
    after = _after(response.headers.get("Retry-After")) if code in ("rate_limited", "failed") else None
    wait = f"; it asks to wait {after:g} s" if after is not None else ""
    return JudgeError(
        f"it refused (status {status}){f': {said}' if said else ''}{wait}", code=code, place=place,
        next_move=NEXT[code], after_s=after,
    )  # fmt: skip


def _object(content: bytes) -> Any:
    try:
        return json.loads(content)
    except (ValueError, RecursionError):
        return None


def _said(content: bytes) -> str:
    """The server's own words: `error.message` in all three protocols."""
    told = _object(content)
    told = told[0] if isinstance(told, list) and told else told
    inner = told.get("error", told) if isinstance(told, dict) else ""
    message = inner.get("message", "") if isinstance(inner, dict) else inner
    return " ".join(str(message).split())


def _after(header: Any) -> float | None:
    """Seconds to wait, of a header that gives seconds or a date (RFC 9110, 10.2.3)."""
    text = str(header or "").strip()[:40]
    if text.isascii() and text.isdecimal():
        return float(text)
    try:
        return max(0.0, (parsedate_to_datetime(text) - datetime.now(UTC)).total_seconds())
    except (ValueError, TypeError):
        return None
