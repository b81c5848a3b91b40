"""An ONNX file as bytes: what it uses and where its weights lie, and its graph with rows freed, without a package for the format.

Source: ONNX 1.19, `onnx.proto` (field numbers); Protocol Buffers, "Encoding".
"""

from collections import deque
from collections.abc import Callable, Iterator

KNOWN_DOMAINS = ("", "ai.onnx", "ai.onnx.ml")
"""Whose operators every runtime has; another domain's are custom."""
VARINT, EIGHT, LENGTH, FOUR = 0, 1, 2, 5
GRAPH, NODE, INPUT, OUTPUT, VALUE = 7, 1, 11, 12, 13
OP_TYPE, DOMAIN = 4, 7
EXTERNAL_DATA, DATA_LOCATION = 13, 14
OF_TENSOR = (*range(1, 15), 16)
"""Every field that a tensor has; what is another may be one to a runtime that reads otherwise."""
KEYS, NUMBERS = 1 << 32, 1 << 64
"""A field's key is below the first, any other number below the second: a runtime drops the bits beyond, and reads another field."""
INSIDE = {
    "model": {7: "graph", 25: "function"},
    "graph": {1: "node", 5: "tensor", 15: "sparse"},
    "function": {7: "node", 11: "attribute"},
    "node": {5: "attribute"},
    "attribute": {5: "tensor", 6: "graph", 10: "tensor", 11: "graph", 22: "sparse", 23: "sparse"},
    "sparse": {1: "tensor", 2: "tensor"},
    "tensor": {},
}
"""What holds a node or a tensor: of each kind of message, the fields that may and what they are; attributes hold graphs (If, Loop)."""
TO_SHAPE = (2, 1, 2)
"""From a value to its shape: its type, of a tensor, the shape."""
FREE = b"\x12\x04rows"
"""A dimension that has a name (field 2) in place of a number."""


def operators(data: bytes) -> tuple[tuple[str, str], ...]:
    """(domain, name) of every node: of the graph in its order, then of the graphs within it.

    Raises:
        ValueError: it is no ONNX file.
    """
    found = []
    for node in _all(data, "node"):
        said = {
            key: part.decode() for key, wire, part, _ in _fields(node) if wire == LENGTH and key in (OP_TYPE, DOMAIN)
        }
        found.append((said.get(DOMAIN, ""), said.get(OP_TYPE, "")))
    return tuple(found)


def weighs_elsewhere(data: bytes) -> bool:
    """Whether a tensor's numbers lie in another file, which no hash of this one covers.

    Raises:
        ValueError: it is no ONNX file, or a tensor has a field that is none of a tensor's.
    """
    elsewhere = False
    for tensor in _all(data, "tensor"):
        for number, kind, body, _ in _fields(tensor):
            if number not in OF_TENSOR:
                raise ValueError(f"a tensor has a field {number}, which is none of a tensor's")
            located = number == DATA_LOCATION and kind == VARINT and _number(body, 0)[0] != 0
            elsewhere |= located or number == EXTERNAL_DATA
    return elsewhere


def freed(data: bytes) -> bytes:
    """The same graph, the first dimension of whose inputs, outputs and inner values is free: it takes any number of rows.

    Raises:
        ValueError: it is no ONNX file.
    """
    _graph(data)
    return _rewritten(data, (GRAPH,), _free_graph)


def _graph(data: bytes) -> bytes:
    for number, kind, body, _ in _fields(data):
        if number == GRAPH and kind == LENGTH:
            return body
    raise ValueError("it holds no graph")


def _all(data: bytes, wanted: str) -> Iterator[bytes]:
    """Every node or tensor, however deep; a queue, since a file may nest deeper than calls may."""
    _graph(data)
    left = deque([("model", data)])
    while left:
        kind, message = left.popleft()
        if kind == wanted:
            yield message
        held = INSIDE[kind]
        left.extend(
            (held[number], body) for number, wire, body, _ in _fields(message) if number in held and wire == LENGTH
        )


def _free_graph(graph: bytes) -> bytes:
    return _rewritten(graph, (INPUT, OUTPUT, VALUE), lambda value: _down(value, TO_SHAPE))


def _down(message: bytes, path: tuple[int, ...]) -> bytes:
    if not path:
        return _first_free(message)
    return _rewritten(message, path[:1], lambda part: _down(part, path[1:]))


def _first_free(shape: bytes) -> bytes:
    for number, kind, _, (start, end) in _fields(shape):
        if number == 1 and kind == LENGTH:
            return shape[:start] + _packed(1, FREE) + shape[end:]
    return shape


def _rewritten(message: bytes, numbers: tuple[int, ...], change: Callable[[bytes], bytes]) -> bytes:
    parts = []
    for number, kind, body, (start, end) in _fields(message):
        parts.append(_packed(number, change(body)) if number in numbers and kind == LENGTH else message[start:end])
    return b"".join(parts)


def _packed(number: int, body: bytes) -> bytes:
    return _varint(number << 3 | LENGTH) + _varint(len(body)) + body


def _varint(value: int) -> bytes:
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    out.append(value)
    return bytes(out)


def _fields(message: bytes) -> Iterator[tuple[int, int, bytes, tuple[int, int]]]:
    """Number, kind and content of each field, and where it lies, its key included."""
    at = 0
    while at < len(message):
        start = at
        key, at = _number(message, at)
        if not 8 <= key < KEYS:
            raise ValueError(f"byte {start} begins a field with no number of a field's")
        kind = key & 7
        if kind == VARINT:
            before = at
            _, at = _number(message, at)
            body = message[before:at]
        elif kind in (EIGHT, FOUR, LENGTH):
            size = 8 if kind == EIGHT else 4
            if kind == LENGTH:
                size, at = _number(message, at)
            body = message[at : at + size]
            at += size
        else:
            raise ValueError(f"byte {start} begins no field")
        if at > len(message):
            raise ValueError("it is cut off")
        yield key >> 3, kind, body, (start, at)


def _number(message: bytes, at: int) -> tuple[int, int]:
    value = shift = 0
    while at < len(message) and shift < 70:
        byte = message[at]
        value |= (byte & 0x7F) << shift
        at += 1
        if byte < 0x80:
            if value >= NUMBERS or (byte == 0 and shift):
                raise ValueError(f"byte {at - 1} ends a number that is written longer than it is")
            return value, at
        shift += 7
    raise ValueError("it is cut off")
