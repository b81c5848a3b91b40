"""The journal: who did what, on which hashes. Append-only; each line is bound to the one before it.

A line is a JSON object whose last field, `chain`, is the SHA-256 of the previous line's `chain`, a newline, and the line
itself without that field. So a line that was edited, taken out or slipped in breaks the chain at the next one, and the
stamp holds the chain's head at acceptance, which binds the last line too. The field before it is its `seal`, where one was
given (`seals`). What stood in the file before its first
chained line (journals of older versions) is bound as a whole: its hash takes the place of the previous `chain`.

A crash can tear the last line. A torn line is skipped, the next writer starts a new line after it, and the chain goes on
from the last whole one: tearing loses that line and nothing else.
"""

import fcntl
import hashlib
import json
import os
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

CHAIN, SEAL = "chain", "seal"
_MARK, _SEAL_MARK = f', "{CHAIN}": "', f', "{SEAL}": "'
Sealing = Callable[[str, str], str]
"""The seal of a line, from the chain before it and its text; empty for none."""


@dataclass(frozen=True)
class Line:
    """One whole line of the file, or a fragment that is none."""

    number: int
    """1-based."""
    start: int
    """First byte, counted from the start of the file."""
    text: str
    entry: dict[str, Any] | None
    """None for a fragment."""

    @property
    def chain(self) -> str:
        """The hash that binds it to the line before; empty in journals of older versions."""
        return str((self.entry or {}).get(CHAIN, ""))

    @property
    def body(self) -> str:
        """The line without its chain."""
        return _without(self.text, _MARK)

    @property
    def seal(self) -> str:
        """The signature on it; empty where there is none."""
        return str((self.entry or {}).get(SEAL, ""))

    @property
    def unsealed(self) -> str:
        """The line without its chain and its seal: what was sealed."""
        return _without(self.body, _SEAL_MARK) if self.seal else self.body


class Journal:
    """A journal file; it need not exist yet. With `held`, bytes that were read of it before, it tells those alone."""

    def __init__(self, path: Path, held: bytes | None = None) -> None:
        self.path = path
        self.held = held

    def append(self, entry: dict[str, Any], sealing: Sealing | None = None) -> str:
        """Write one entry, of at least one field, and flush it to the disk; returns the new head of the chain.

        Writers in other processes wait for each other. A write that the disk does not take whole is taken back, and
        its `OSError` is raised.
        """
        body = json.dumps({k: v for k, v in entry.items() if k not in (CHAIN, SEAL)}, ensure_ascii=False, default=str)
        handle = os.open(self.path, os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC, 0o644)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX)
            size = os.fstat(handle).st_size
            before = _read(handle, size)
            previous = _head(before)
            if sealing is not None and (seal := sealing(previous, body)):
                body = f'{body[:-1]}{_SEAL_MARK}{seal}"}}'
            chain = _next(previous, body)
            torn = b"" if not before or before.endswith(b"\n") else b"\n"
            line = torn + f'{body[:-1]}{_MARK}{chain}"}}\n'.encode()
            try:
                while line:  # a disk that is nearly full takes a part, and says so at the next
                    line = line[os.write(handle, line) :]
                os.fsync(handle)
            except OSError:
                os.ftruncate(handle, size)
                raise
        finally:
            os.close(handle)
        return chain

    def entries(self) -> Iterator[dict[str, Any]]:
        """What was written, oldest first; fragments are skipped."""
        yield from (line.entry for line in _lines(self._bytes()) if line.entry is not None)

    def head(self) -> str:
        """The chain of the last whole line; empty for a journal without any."""
        return _head(self._bytes()) if self.path.is_file() else ""

    def goes_on(self) -> bool:
        """Whether the chain holds in what is held, and the file still begins with it: lines may have been added since."""
        return not self.breaks() and Journal(self.path)._bytes().startswith(self._bytes())

    def heads(self) -> Iterator[str]:
        """Every head the journal ever had, as far as its chain holds."""
        yield from (line.chain for line in _lines(self._bytes()) if line.chain)

    def vouched(self, key: str) -> dict[str, str]:
        """The hashes of the reports of an evidence key, by name, as the last line about each says."""
        return reports(self.entries(), key)

    def bound(self) -> Iterator[tuple[Line, str]]:
        """Each chained line, and the chain that it is bound to."""
        content, previous = self._bytes(), ""
        for line in _lines(content):
            if line.chain:
                yield line, previous or _before(content, line.start)
                previous = line.chain

    def breaks(self) -> list[str]:
        """Where lines were edited, taken out or slipped in; empty when the chain holds."""
        if self.path.is_dir():
            return ["the journal is a folder, not a file"]
        content = self._bytes()
        found: list[str] = []
        previous = ""
        for line in _lines(content):
            if line.entry is None:
                continue
            if not line.chain:
                if previous:
                    found.append(f"line {line.number} was not written by worldwright")
                continue
            previous = previous or _before(content, line.start)
            if line.chain != _next(previous, line.body):
                found.append(f"line {line.number}, or the one before it, is not as it was written")
            previous = line.chain
        return found

    def _bytes(self) -> bytes:
        if self.held is not None:
            return self.held
        try:
            return self.path.read_bytes()
        except (FileNotFoundError, IsADirectoryError):  # `breaks` names a folder in its place
            return b""


def reports(entries: Iterable[dict[str, Any]], key: str) -> dict[str, str]:
    """See `Journal.vouched`, of entries that were read already."""
    found: dict[str, str] = {}
    for entry in entries:
        said = entry.get("reports")
        if entry.get("key") == key and isinstance(said, dict):
            found |= said
    return found


def results(entries: Iterable[dict[str, Any]], key: str) -> dict[str, str]:
    """The hashes of the results of an evidence key's passes, by stage, as the last line about each says."""
    told = (e for e in entries if e.get("key") == key and e.get("action") == "stage" and e.get("result_sha256"))
    return {str(entry.get("stage")): str(entry["result_sha256"]) for entry in told}


def _without(text: str, mark: str) -> str:
    """A line without its last field, which begins with this mark."""
    head, found, _ = text.rpartition(mark)
    return f"{head}}}" if found else text


def _next(previous: str, body: str) -> str:
    return hashlib.sha256(f"{previous}\n{body}".encode()).hexdigest()


def _before(content: bytes, start: int) -> str:
    """What the first chained line is bound to: everything before it."""
    return hashlib.sha256(content[:start]).hexdigest()


def _head(content: bytes) -> str:
    chained = [line.chain for line in _lines(content) if line.chain]
    if chained:
        return chained[-1]
    start = len(content) + (not content.endswith(b"\n") and bool(content))  # where the next line will start
    return _before(content + b"\n" * (start - len(content)), start)


def _lines(content: bytes) -> Iterator[Line]:
    start = 0
    for number, raw in enumerate(content.split(b"\n"), 1):
        if raw.strip():
            text = raw.decode("utf-8", errors="replace")
            try:
                entry = json.loads(text)
            except (ValueError, RecursionError):
                entry = None
            yield Line(number, start, text, entry if isinstance(entry, dict) else None)
        start += len(raw) + 1


def _read(handle: int, size: int) -> bytes:
    parts, at = [], 0
    while at < size and (part := os.pread(handle, size - at, at)):
        parts.append(part)
        at += len(part)
    return b"".join(parts)
