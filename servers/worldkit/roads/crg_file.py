"""Read an OpenCRG file: its header, the channels along its reference line, and its grid of heights.

Source: ASAM OpenCRG 1.2, "File format". A file is text up to a line of `$$$`, then one row of numbers for each step along the
reference line. `#:KRBI` and `#:KDBI` rows are big-endian floats of 4 and 8 bytes; `#:LRFI` and `#:LDFI` rows are text in columns of 10
and 20 characters, eight and four to a line, each row on lines of its own. What is no number there (`*missing*`, `**unused**`) is NaN.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

LARGEST_BYTES = 256 << 20
MOST_CELLS = 40_000_000
ENCODINGS: dict[str, str | int] = {"KRBI": ">f4", "KDBI": ">f8", "LRFI": 10, "LDFI": 20}
"""Type of a number, or the width of its column."""
_END = re.compile(rb"^\${8}[$0-9]{12,}[^\r\n]*(?:\r\n|\n|\r)", re.MULTILINE)
_KEY = re.compile(r"^\s*([A-Za-z_]\w*)\s*=\s*([^!]*)")
_AT = re.compile(r"long section at v\s*=\s*([-+.\deE]+)", re.IGNORECASE)
_NUMBERED = re.compile(r"long section\s+\d+", re.IGNORECASE)


class RoadFileError(ValueError):
    """A file that is no road: what is wrong with it, and where."""


@dataclass(frozen=True)
class CrgFile:
    """What a file says, unchanged."""

    numbers: dict[str, float]
    """Of `$ROAD_CRG`, by their names in small letters."""
    channels: "dict[str, np.ndarray]"
    """(N,) each: `phi` (rad), `banking` and `slope` (m/m), those that there are."""
    sections_m: "np.ndarray"
    """(M,) where the long sections lie to the left of the reference line, growing."""
    grid: "np.ndarray"
    """(N, M) m, NaN where nothing was measured."""


@dataclass
class _Header:
    numbers: dict[str, float] = field(default_factory=dict)
    encoding: str = ""
    channels: list[str] = field(default_factory=list)


def read_crg(path: Path) -> CrgFile:
    """Read a file.

    Raises:
        RoadFileError: it is not there, no OpenCRG file, of an encoding that is not read, or cut off; the message says which.
    """
    import numpy as np

    try:
        if path.stat().st_size > LARGEST_BYTES:
            raise RoadFileError(f"{path.name} is larger than {LARGEST_BYTES >> 20} MB: cut a shorter road of it")
        content = path.read_bytes()
    except OSError as cause:
        raise RoadFileError(f"{path.name} cannot be read: {cause.strerror}") from cause
    end = _END.search(content)
    if end is None:
        raise RoadFileError(f"{path.name} is no OpenCRG file: no line of $$$$ ends its header")
    header = _header(path.name, content[: end.start()].decode("latin-1"))
    start, stop, step = (
        header.numbers.get(f"reference_line_{key}", default)
        for key, default in (("start_u", 0.0), ("end_u", float("nan")), ("increment", float("nan")))
    )
    if not (step > 0 and stop > start and np.isfinite(stop)):
        raise RoadFileError(
            f"{path.name}: reference_line_end_u must lie beyond reference_line_start_u, and reference_line_increment be above 0; "
            f"they are {stop:g}, {start:g} and {step:g}"
        )
    if not (stop - start) / step < MOST_CELLS:
        raise RoadFileError(f"{path.name}: {stop - start:g} m in steps of {step:g} m are no road that is read here")
    rows = round((stop - start) / step) + 1
    places, own = _sections(path.name, header)
    if rows < 2 or rows * len(header.channels) > MOST_CELLS:
        raise RoadFileError(
            f"{path.name}: a grid of {rows} rows of {len(header.channels)} is no road that is read here"
        )
    table = _table(path.name, content[end.end() :], header.encoding, rows, len(header.channels))
    along = {kind: table[:, i] for i, name in enumerate(header.channels) for kind in own if own[kind] == name}
    sections = [i for i, name in enumerate(header.channels) if name.lower().startswith("long section")]
    order = np.argsort(places)
    return CrgFile(header.numbers, along, np.asarray(places)[order], table[:, np.array(sections)[order]])


def _header(name: str, text: str) -> _Header:
    """Keys, encoding and channels."""
    found, section = _Header(), ""
    for line in re.split(r"\r\n|\n|\r", text):
        bare = line.split("!")[0].strip()
        if bare.startswith("$"):
            section = bare[1:].strip().upper().split(" ")[0] or section
        elif section == "ROAD_CRG" and (match := _KEY.match(bare)):
            try:
                found.numbers[match[1].lower()] = float(match[2])
            except ValueError as cause:
                raise RoadFileError(f"{name}: {match[1]} is no number: {match[2].strip()!r}") from cause
        elif section == "KD_DEFINITION" and bare.startswith("#:"):
            found.encoding = bare[2:].strip().upper()
        elif section == "KD_DEFINITION" and bare.upper().startswith("D:"):
            found.channels.append(bare[2:].split(",")[0].strip())
    if found.encoding not in ENCODINGS:
        told = f"`#:{found.encoding}`" if found.encoding else "no encoding"
        raise RoadFileError(f"{name} has {told}; {', '.join(ENCODINGS)} are read")
    if bad := [key for key, value in found.numbers.items() if value != value or abs(value) == float("inf")]:
        raise RoadFileError(f"{name}: {bad[0]} is not a finite number")
    return found


def _sections(name: str, header: _Header) -> tuple[list[float], dict[str, str]]:
    """Where the long sections lie, m, and the channels of phi, banking and slope by kind."""
    own = {
        kind: channel
        for kind in ("phi", "banking", "slope")
        for channel in header.channels
        if channel.lower().endswith(f"reference line {kind}")
    }
    known = [channel for channel in header.channels if channel.lower().startswith("long section")]
    if unknown := [channel for channel in header.channels if channel not in known and channel not in own.values()]:
        raise RoadFileError(f"{name} has a channel `{unknown[0]}` that is not read")
    explicit = [_number(match[1]) for channel in known if (match := _AT.fullmatch(channel))]
    if bad := [channel for channel, place in zip(known, explicit, strict=False) if not abs(place) < float("inf")]:
        raise RoadFileError(f"{name}: a channel `{bad[0]}` does not say where it lies")
    if len(explicit) == len(known) >= 2:
        places = explicit
    else:
        right, left = (header.numbers.get(f"long_section_v_{side}", float("nan")) for side in ("right", "left"))
        count = len(known)
        if count < 2 or not left > right or not all(_NUMBERED.fullmatch(channel) for channel in known):
            raise RoadFileError(
                f"{name}: its {count} long sections do not say where they lie: `at v = …`, or v_right and v_left"
            )
        step = header.numbers.get("long_section_v_increment", (left - right) / (count - 1))
        if abs(right + step * (count - 1) - left) > 0.5 * step:
            raise RoadFileError(f"{name} has {count} long sections, {step:g} m apart, between {right:g} and {left:g} m")
        places = [right + (left - right) * i / (count - 1) for i in range(count)]
    if len(set(places)) < len(places):
        raise RoadFileError(f"{name} has two long sections in one place")
    return places, own


def _table(name: str, body: bytes, encoding: str, rows: int, columns: int) -> "np.ndarray":
    """(rows, columns) numbers."""
    import numpy as np

    kind = ENCODINGS[encoding]
    if isinstance(kind, str):
        size = rows * columns * np.dtype(kind).itemsize
        if len(body) < size:
            raise RoadFileError(f"{name} is cut off: {len(body)} of {size} bytes of numbers are there")
        if len(body) - size > 80 * np.dtype(kind).itemsize:
            raise RoadFileError(
                f"{name} has {len(body)} bytes of numbers where {size} belong: its line ends were converted"
            )
        found = np.frombuffer(body[:size], kind).reshape(rows, columns).astype(float)
        found[~np.isfinite(found) | (np.abs(found) > 1e6)] = np.nan
        return found
    lines = [line for line in body.decode("latin-1").splitlines() if line.strip()]
    each = -(-columns // (80 // kind))
    if len(lines) < rows * each:
        raise RoadFileError(f"{name} is cut off: {len(lines)} of {rows * each} lines of numbers are there")
    table = np.empty((rows, columns))
    for row in range(rows):
        words = [
            line[i : i + kind]
            for line in lines[row * each : (row + 1) * each]
            for i in range(0, len(line.rstrip()), kind)
        ]
        if len(words) != columns:
            raise RoadFileError(f"{name}: row {row + 1} has {len(words)} numbers, not {columns}")
        table[row] = [_number(word) for word in words]
    return table


def _number(word: str) -> float:
    try:
        return float(word)
    except ValueError:
        return float("nan")
