"""One session with an app that Gradio serves, versions 4 to 6: its functions by their names, files up and down.

Written after Gradio's own server (`queue/join`, and `queue/data` as server-sent events) and tried against a real one of version 5.
"""

import uuid
from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any
from urllib.parse import quote

from .web_calls import OR_SCULPT, MintError, Server, named

MOST_BEATS = 200
"""Heartbeats (one in 15 s) with nothing else between, after which nobody works any more."""
FILE = {"_type": "gradio.FileData"}
File = dict[str, Any]


class Session:
    """Calls that share what the app keeps for one visitor.

    Args:
        server: where the app is.
        hears: is told what the app says of its progress.
    """

    def __init__(self, server: Server, hears: Callable[[str], None]) -> None:
        self.server, self.hears, self.name = server, hears, uuid.uuid4().hex[:12]

    @cached_property
    def _config(self) -> dict[str, Any]:
        found = self.server.get("/config")
        if not isinstance(found.get("dependencies"), list) or not isinstance(found.get("components"), list):
            raise self.server.garbage(str(found), "description of a Gradio app")
        return found

    @property
    def _prefix(self) -> str:
        found = self._config.get("api_prefix") or "/"
        if not isinstance(found, str) or not found.startswith("/"):  # else it would be another port, or another host
            raise self.server.garbage(found, "place of its functions")
        return found.rstrip("/")

    def functions(self) -> dict[str, dict[str, Any]]:
        """What the app can do, by name."""
        rows = [row for row in self._config["dependencies"] if isinstance(row, dict)]
        return {str(row["api_name"]).lstrip("/"): row for row in rows if row.get("api_name")}

    def upload(self, data: bytes) -> File:
        """A picture as the app's functions are given one."""
        name = "picture.png" if data[:4] == b"\x89PNG" else "picture.jpg"
        paths = self.server.upload(f"{self._prefix}/upload", "files", name, data)
        if not isinstance(paths, list) or not paths or not isinstance(paths[0], str):
            raise self.server.garbage(paths, "place of the picture")
        return {"path": paths[0], "orig_name": name, "meta": FILE}

    def ask(self, names: tuple[str, ...], **told: Any) -> list[Any]:
        """What the first function of these names that there is gives.

        Args:
            names: of one function, as versions of the app call it.
            told: values by a component's kind (`image`); the first of that kind gets it, all else what the app itself begins with.

        Raises:
            MintError: `refused`: there is none of these, or it failed; `garbage`, `stalled` or `unreachable` as with any server.
        """
        known = self.functions()
        name = next((name for name in names if name in known), None)
        if name is None:
            raise self.server.refused(
                f"it has no {names[0]}, but {', '.join(sorted(known)[:12]) or 'nothing'}",
                f"name the --server that it is; {OR_SCULPT}",
            )
        row = known[name]
        number = row.get("id", self._config["dependencies"].index(row))
        asked = {"data": self._values(row, told), "fn_index": number, "session_hash": self.name, "event_data": None}
        joined = self.server.post(f"{self._prefix}/queue/join", {**asked, "trigger_id": None})
        return self._ended(name, joined.get("event_id"))

    def has(self, name: str) -> bool:
        """Whether the app has a function of this name."""
        return name in self.functions()

    def file(self, values: list[Any], suffixes: tuple[str, ...]) -> bytes:
        """The file of an answer whose end comes first among these."""
        there = [str(found["path"]) for found in _files(values)]
        for path in (path for end in suffixes for path in there if path.lower().endswith(end)):
            return self.server.download(
                f"{self.server.address.rstrip('/')}{self._prefix}/file={quote(path, safe='/', errors='replace')}"
            )
        raise self.server.garbage(values)

    def _values(self, row: dict[str, Any], told: dict[str, Any]) -> list[Any]:
        kinds = {str(part.get("id")): part for part in self._config["components"] if isinstance(part, dict)}
        left, values = dict(told), []
        inputs = row.get("inputs")
        for number in inputs if isinstance(inputs, list) else []:
            part = kinds.get(str(number)) or {}
            kind = str(part.get("type"))
            props = _table(part.get("props"))
            values.append(left.pop(kind) if kind in left else None if kind == "state" else props.get("value"))
        return values

    def _ended(self, name: str, event: Any) -> list[Any]:
        beats = 0
        for told in self.server.events(f"{self._prefix}/queue/data?session_hash={self.name}"):
            what, own = told.get("msg"), told.get("event_id") in (event, None)
            beats = beats + 1 if what == "heartbeat" else 0
            if beats >= MOST_BEATS:
                raise MintError(
                    f"its {name} has told of no progress in {MOST_BEATS} heartbeats", code="stalled",
                    place=named(self.server.address), next_move=f"look at the server's own output; {OR_SCULPT}",
                )  # fmt: skip
            if what == "unexpected_error":
                raise self.server.refused(f"{name}: {told.get('message') or 'an unexpected error'}")
            if what == "process_completed" and own:
                output = _table(told.get("output"))
                if not told.get("success") or not isinstance(output.get("data"), list):
                    raise self.server.refused(f"{name}: {output.get('error') or 'it failed and does not say why'}")
                return list(output["data"])
            if what in ("estimation", "process_starts", "progress", "process_generating") and own:
                self.hears(name)
        raise MintError(
            f"its answer to {name} broke off", code="unreachable", place=named(self.server.address),
            next_move=self.server.starting,
        )  # fmt: skip


def _table(value: Any) -> dict[str, Any]:
    """A JSON object; empty where something else stands."""
    return value if isinstance(value, dict) else {}


def _files(value: Any) -> Iterator[File]:
    """Every file that an answer speaks of, however deep."""
    left = [value]
    while left:
        one = left.pop()
        if isinstance(one, dict):
            if isinstance(one.get("path"), str):
                yield one
            left += reversed(one.values())
        elif isinstance(one, list):
            left += reversed(one)


def handed_on(values: list[Any]) -> File | None:
    """The first file of an answer, as the next function is given it."""
    found = next(_files(values), None)
    return None if found is None else {"path": found["path"], "orig_name": found.get("orig_name"), "meta": FILE}
