"""One call to a judge's server, JSON there and back, and every way in which it can fail as a `JudgeError`.

A key is sent over TLS or to this machine itself, never on to another address that the server names, and never stands in a
message.
"""

import http.client
import json
import os
import urllib.error
import urllib.request
from datetime import UTC, datetime
from email.utils import parsedate_to_datetime
from typing import Any
from urllib.parse import urlsplit

from .judges import JudgeError

MOST_ANSWER = 8 << 20
LOOPBACK = ("127.0.0.1", "::1", "localhost")
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


def post(address: str, path: str, body: dict[str, Any], headers: dict[str, str], silent_s: float) -> dict[str, Any]:
    """Send an object and return the object that comes back.

    Args:
        address: scheme and host, and where the server's paths begin.
        headers: with the key; not sent in the clear beyond this machine.

    Raises:
        JudgeError: it gave no answer, or none that is an object of JSON.
    """
    place = _checked(address)
    data = json.dumps(body).encode()
    call = urllib.request.Request(
        address.rstrip("/") + path, data, {"Content-Type": "application/json", **headers}, method="POST"
    )
    try:
        opener = _STRAIGHT if urlsplit(address).hostname in LOOPBACK else _OPENER
        with opener.open(call, timeout=silent_s) as answer:
            content = answer.read(MOST_ANSWER + 1)
            if answer.length and len(content) <= MOST_ANSWER:
                raise ConnectionError("its answer broke off")
    except urllib.error.HTTPError as error:
        raise _refused(error, place, [value.split()[-1] for value in headers.values()]) from error
    except (OSError, ValueError, http.client.HTTPException) as error:
        cause = getattr(error, "reason", error)
        late = isinstance(cause, TimeoutError)
        said = f"it said nothing for {silent_s:g} s" if late else f"it cannot be reached: {cause}"
        code = "timed_out" if late else "unreachable"
        raise JudgeError(said, code=code, place=place, next_move=NEXT["timed_out"]) from error
    try:
        told = json.loads(content) if len(content) <= MOST_ANSWER else None
    except (ValueError, RecursionError):
        told = None
    if not isinstance(told, dict):
        raise garbage(f"it answered no object of JSON: {content[:60]!r}", place)
    return told


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


class _NoRedirect(urllib.request.HTTPRedirectHandler):
    """Whoever is sent elsewhere would send the key along."""

    def redirect_request(self, *_: Any) -> None:
        """Follow nothing: the call then fails by its status."""
        return


_OPENER = urllib.request.build_opener(_NoRedirect)
_STRAIGHT = urllib.request.build_opener(_NoRedirect, urllib.request.ProxyHandler({}))
"""To this machine: a proxy of the environment would get key and films in the clear."""


def _refused(error: urllib.error.HTTPError, place: str, secrets: list[str]) -> JudgeError:
    code = CODES.get(error.code, "failed" if error.code >= 500 else "refused")
    said = _said(error)
    for secret in secrets:  # some servers say the key again that they refuse
        said = said.replace(secret, "(key)")
    said = said[:200]
    after = _after(error.headers.get("Retry-After")) if code in ("rate_limited", "failed") else None
    wait = f"; it asks to wait {after:g} s" if after is not None else ""
    return JudgeError(
        f"it refused (status {error.code}){f': {said}' if said else ''}{wait}", code=code, place=place,
        next_move=NEXT[code], after_s=after,
    )  # fmt: skip


def _said(error: urllib.error.HTTPError) -> str:
    """The server's own words: `error.message` in all three protocols."""
    try:
        told = json.loads(error.read(1 << 16))
    except (OSError, ValueError, RecursionError, http.client.HTTPException):
        return ""
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
