"""Calls to servers that make meshes and pictures: bounded, never led elsewhere, and a key that no message repeats.

Neither a clock nor a count of tries ends a call, but silence: nothing said for `SILENT_S`, or nothing new in `MOST_SAME` answers.
"""

import http.client
import json
import time
import urllib.error
import urllib.request
import uuid
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import urlsplit

from ..model.errors import WorldwrightError

MOST_ANSWER, MOST_JSON = 256 << 20, 96 << 20
SILENT_S = 600.0
"""A server that says nothing for so long makes nothing."""
PAUSE_S, MOST_PAUSE_S = 3.0, 60.0
"""Between two questions after the same work, and the most that a server may ask one to wait with the next."""
MOST_SAME = 400
"""Answers that tell of no progress, after which the work is taken for lost."""
OR_SCULPT = "or sculpt the thing (skill sculpting)"


class MintError(WorldwrightError):
    """A server made nothing; `code` says why.

    It is `unreachable`, `refused`, `rate_limited`, `garbage`, `redirected`, `too_large`, `expired`, `stalled`, `no_key` or `price`.
    """

    def __init__(self, cause: str, *, code: str, place: str, next_move: str) -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code = code


@dataclass(frozen=True)
class Server:
    """One server, as it is called."""

    address: str
    starting: str
    """What to do where it is not there."""
    key: str = field(default="", repr=False)
    key_header: str = "Authorization"

    def get(self, path: str) -> dict[str, Any]:
        """The JSON object that lies at a path."""
        return self._object(self._call("GET", path, None, {}, MOST_JSON))

    def post(self, path: str, asked: dict[str, Any]) -> dict[str, Any]:
        """The JSON object that answers one."""
        return self._object(
            self._call("POST", path, json.dumps(asked).encode(), {"Content-Type": "application/json"}, MOST_JSON)
        )

    def posted(self, path: str, asked: dict[str, Any]) -> bytes:
        """The file that answers a JSON object."""
        return self._call("POST", path, json.dumps(asked).encode(), {"Content-Type": "application/json"}, MOST_ANSWER)

    def upload(self, path: str, word: str, name: str, data: bytes) -> Any:
        """The JSON that answers a file, sent as a form's field `word` (RFC 7578)."""
        edge = uuid.uuid4().hex
        kind = "image/png" if data[:4] == b"\x89PNG" else "image/jpeg"
        head = f'--{edge}\r\nContent-Disposition: form-data; name="{word}"; filename="{name}"\r\nContent-Type: {kind}\r\n\r\n'
        body = head.encode() + data + f"\r\n--{edge}--\r\n".encode()
        headers = {"Content-Type": f"multipart/form-data; boundary={edge}"}
        return self._parsed(self._call("POST", path, body, headers, MOST_JSON))

    def download(self, url: str) -> bytes:
        """A file where the server said that it lies; one that lies elsewhere is asked for without the key.

        Raises:
            MintError: besides what any call raises, `expired`: it is no longer there.
        """
        own = _origin(url) == _origin(self.address)
        if not own and _origin(url)[0] != "https" and _origin(self.address)[0] == "https":
            raise MintError(
                "it says that its file lies where nothing is encrypted", code="garbage", place=named(url), next_move=OR_SCULPT,
            )  # fmt: skip
        there = self if own else Server(url, self.starting)
        try:
            return there._call("GET", url, None, {}, MOST_ANSWER)
        except MintError as error:
            if isinstance(error.__cause__, urllib.error.HTTPError) and error.__cause__.code in (401, 403, 404, 410):
                raise MintError(
                    "what it made is no longer where it said: the address has expired", code="expired", place=named(url),
                    next_move="ask again: it is fetched anew, and made anew only where the server has forgotten it",
                ) from error  # fmt: skip
            raise

    def events(self, path: str) -> Iterator[dict[str, Any]]:
        """What a stream of events tells, one JSON object each (server-sent events, HTML standard 9.2)."""
        with self._opened("GET", path, None, {"Accept": "text/event-stream"}) as answer:
            said = 0
            while line := answer.readline(MOST_JSON + 1):
                said += len(line)
                if said > MOST_JSON:
                    raise self._too_large(MOST_JSON)
                if line.startswith(b"data:"):
                    yield self._object(line[5:].strip())

    def _call(self, method: str, path: str, body: bytes | None, headers: dict[str, str], most: int) -> bytes:
        with self._opened(method, path, body, headers) as answer:
            made: bytes = answer.read(most + 1)
            if answer.length and len(made) <= most:
                raise ConnectionError("its answer broke off")
        if len(made) > most:
            raise self._too_large(most)
        return made

    @contextmanager
    def _opened(self, method: str, path: str, body: bytes | None, headers: dict[str, str]) -> Iterator[Any]:
        url = path if "://" in path else f"{self.address.rstrip('/')}{path}"
        if not _is_address(url):
            raise MintError(
                "that is no address of a server", code="unreachable", place=named(url), next_move=self.starting
            )
        own = {self.key_header: f"Bearer {self.key}" if self.key_header == "Authorization" else self.key}
        call = urllib.request.Request(url, body, headers | (own if self.key else {}), method=method)
        try:
            with urllib.request.build_opener(_Stays).open(call, timeout=SILENT_S) as answer:
                yield answer
        except urllib.error.HTTPError as error:
            raise self._refused(error) from error
        except (OSError, ValueError, http.client.HTTPException) as error:
            cause = self.clean(getattr(error, "reason", error))
            raise MintError(
                f"it cannot be reached: {cause}", code="unreachable", place=named(self.address), next_move=self.starting
            ) from error

    def _refused(self, error: urllib.error.HTTPError) -> MintError:
        place = named(self.address)
        if error.code == 429:
            wait = self.clean(error.headers.get("Retry-After") or "")[:40]
            later = (
                f"ask again in {wait} s" if wait.isdecimal() else f"ask again {f'after {wait}' if wait else 'later'}"
            )
            return MintError("it has too much to do", code="rate_limited", place=place, next_move=later)
        if 300 <= error.code < 400:
            return MintError(
                f"it sends elsewhere, to {named(str(error.headers.get('Location') or 'nowhere'))}", code="redirected",
                place=place, next_move="name the address to which it sends, if you trust it: a key is not carried there",
            )  # fmt: skip
        said = self.clean(_told(error))
        next_move = f"give a picture of the one thing on a plain ground; {OR_SCULPT}"
        if error.code in (401, 403):
            next_move = f"see that its key is right and may do this; {OR_SCULPT}"
        elif error.code == 402:
            next_move = f"buy credits where the key is from; {OR_SCULPT}"
        elif error.code >= 500:
            next_move = f"look at the server's own output, or ask again later; {OR_SCULPT}"
        return MintError(
            f"it refused (status {error.code}){f': {said}' if said else ''}",
            code="refused",
            place=place,
            next_move=next_move,
        )

    def refused(self, said: object, next_move: str = "") -> MintError:
        """What to raise where an answer itself says that nothing is made."""
        return MintError(
            f"it refused: {self.clean(said)}", code="refused", place=named(self.address),
            next_move=next_move or f"give a picture of the one thing on a plain ground; {OR_SCULPT}",
        )  # fmt: skip

    def garbage(self, said: object, what: str = "mesh") -> MintError:
        """What to raise where an answer is not what was asked for."""
        return MintError(
            f"it answered no {what}: {self.clean(said)}", code="garbage", place=named(self.address),
            next_move=f"look at the server's own output, then ask again; {OR_SCULPT}",
        )  # fmt: skip

    def clean(self, said: object) -> str:
        """Of what a server says so much as a message may repeat: some words, and never the key."""
        text = _shown(" ".join(str(said).split()))
        return (text.replace(self.key, "[key]") if self.key else text)[:200]

    def _too_large(self, most: int) -> MintError:
        return MintError(
            f"it answered more than {most >> 20} MB", code="too_large", place=named(self.address),
            next_move=f"have it make fewer faces or smaller pictures; {OR_SCULPT}",
        )  # fmt: skip

    def _object(self, data: bytes) -> dict[str, Any]:
        found = self._parsed(data)
        if not isinstance(found, dict):
            raise self.garbage(repr(data[:40]), "JSON object")
        return found

    def _parsed(self, data: bytes) -> Any:
        try:
            return json.loads(data)
        except (ValueError, RecursionError) as error:
            raise self.garbage(repr(data[:40]), "JSON") from error


def awaited(ask: Callable[[], tuple[Any, Any]], server: Server, hears: Callable[[Any], None]) -> Any:
    """Ask until work is done.

    Args:
        ask: gives what is made, None as long as it is not, and how far it is: anything that changes while it advances.
        server: whose work it is.
        hears: is told how far it is, whenever that changed.

    Raises:
        MintError: as `ask` does; a rate limit is waited out. `stalled`: `MOST_SAME` answers told nothing new.
    """
    last, same = None, 0
    while same < MOST_SAME:
        pause, same = PAUSE_S, same + 1
        try:
            made, far = ask()
            if made is not None:
                return made
            if far != last:
                last, same = far, 0
                hears(far)
        except MintError as error:
            if error.code != "rate_limited":
                raise
            wait = "".join(letter for letter in error.next_move if letter.isdecimal())
            pause = min(max(float(wait[:4] or 0), PAUSE_S), MOST_PAUSE_S)
        time.sleep(pause)
    raise MintError(
        f"it has told of no progress in {MOST_SAME} answers", code="stalled", place=named(server.address),
        next_move="ask again later: the same work is asked after, and not paid again",
    )  # fmt: skip


def forgotten(error: MintError) -> bool:
    """Whether a server says that it does not know, or no longer, what it was asked after."""
    return isinstance(error.__cause__, urllib.error.HTTPError) and error.__cause__.code in (400, 404, 410)


class _Stays(urllib.request.HTTPRedirectHandler):
    """Follows to the same server alone: elsewhere a key would be a stranger's."""

    def redirect_request(self, req: Any, fp: Any, code: int, msg: str, headers: Any, newurl: str) -> Any:
        if _origin(newurl) != _origin(req.full_url):
            return None
        return super().redirect_request(req, fp, code, msg, headers, newurl)


def _origin(url: str) -> tuple[str, str, int | None]:
    try:
        parts = urlsplit(url)
        return parts.scheme, parts.hostname or "", parts.port or {"http": 80, "https": 443}.get(parts.scheme)
    except ValueError:
        return "", url, None


def _is_address(url: str) -> bool:
    try:
        parts = urlsplit(url)
        return parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
    except ValueError:  # brackets without an end, a port that is none
        return False


def named(url: str) -> str:
    """A place without what signs it or may be secret in it."""
    scheme, host, port = _origin(url)
    path = url.partition("://")[2].partition("/")[2].partition("?")[0]
    if not scheme or not host:
        return _shown(url.partition("?")[0].rpartition("@")[2][:80])
    at = f":{port}" if port not in (None, 80, 443) else ""
    return _shown(f"{scheme}://{host}{at}{f'/{path[:80]}' if path else ''}")


def _shown(text: str) -> str:
    """Text without what a terminal obeys, or cannot be written at all (JSON may hold half of a pair of code units)."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)


def _told(error: urllib.error.HTTPError) -> str:
    """What a refusal says, in whichever of the usual places."""
    try:
        told = json.loads(error.read(1 << 16))
        for word in ("error", "detail", "task_error"):
            told = told[word] if isinstance(told.get(word), dict) else told
        return str(told.get("text") or told.get("message") or told.get("error") or told.get("detail") or "")
    except (OSError, ValueError, AttributeError, RecursionError, http.client.HTTPException):
        return ""
