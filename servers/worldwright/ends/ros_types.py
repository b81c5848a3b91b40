"""Message types of ROS 2 Jazzy and ours, as bytes (CDR), as DDS types, and by the hash that ROS knows them by (extra `ros`).

A message here is a dict of its fields, as in `ros_messages`. Ours is what a car's driver says:

    worldwright_msgs/msg/Drive
        float64 steering    rad, of the front wheels in the middle, left is positive
        float64 throttle    -1 (backwards) to 1
        float64 brake       0 to 1
"""

from functools import cached_property
from typing import Any

from ..model.errors import NotFoundError

DRIVE = "worldwright_msgs/msg/Drive"
DEFINITIONS = {DRIVE: "float64 steering\nfloat64 throttle\nfloat64 brake\n"}
INSTALL = 'pip install "worldwright[ros]"'


class UnreadableError(ValueError):
    """Bytes that are no message of the type that they came as."""


class Types:
    """What is known of message types.

    Raises:
        NotFoundError: the extra `ros` is not installed.
    """

    def __init__(self) -> None:
        try:
            from rosbags.typesys import Stores, get_types_from_msg, get_typestore
        except ImportError as cause:
            raise NotFoundError("rosbags is not installed", place="extra `ros`", next_move=INSTALL) from cause
        self.store: Any = get_typestore(Stores.ROS2_JAZZY)
        for kind, text in DEFINITIONS.items():
            self.store.register(get_types_from_msg(text, kind))
        self._structs: dict[str, Any] = {}

    def hash(self, kind: str) -> str:
        """Its REP 2016 hash, `RIHS01_…`."""
        return str(self.store.hash_rihs01(kind))

    def encode(self, kind: str, message: dict[str, Any]) -> bytes:
        """A message as CDR (XCDR1, with its header), little-endian; what a message leaves out is 0 or empty.

        Raises KeyError for a field that the type has not.
        """
        return bytes(self.store.serialize_cdr(self._filled(kind, message), kind, little_endian=True))

    def decode(self, kind: str, data: bytes) -> Any:
        """The message, its fields as attributes; `UnreadableError` where the bytes are none."""
        from rosbags.serde import SerdeError

        try:
            return self.store.deserialize_cdr(data, kind)
        except (SerdeError, AssertionError, IndexError, MemoryError) as cause:
            raise UnreadableError(f"these {len(data)} bytes are no {kind}") from cause

    def _filled(self, kind: str, message: dict[str, Any]) -> Any:
        fields = self.store.fielddefs[kind][1]
        if unknown := message.keys() - {name for name, _ in fields}:
            raise KeyError(f"{kind} has no {', '.join(sorted(unknown))}")
        return self.store.types[kind](**{name: self._value(form, message.get(name)) for name, form in fields})

    def _value(self, form: Any, value: Any) -> Any:
        import numpy as np
        from rosbags.interfaces import Nodetype

        sort, what = form
        if sort == Nodetype.NAME:
            return self._filled(what, {} if value is None else value)
        if sort == Nodetype.BASE:
            base = what[0]
            return value if value is not None else "" if base == "string" else False if base == "bool" else 0
        (inner, name), length = what
        if inner == Nodetype.NAME or name[0] == "string":
            rows = [None] * length if value is None and sort == Nodetype.ARRAY else (value or ())
            return [self._value((inner, name), row) for row in rows]
        dtype = {"char": "uint8", "byte": "uint8", "octet": "uint8"}.get(name[0], name[0])
        if value is None:
            return np.zeros(length if sort == Nodetype.ARRAY else 0, dtype)
        return np.frombuffer(value, np.uint8) if isinstance(value, bytes) else np.asarray(value, dtype)

    def dds(self, kind: str) -> Any:
        """The type as `cyclonedds` has it; a sample of it holds its bytes (`cdr`), which nobody takes apart field by field."""
        struct = self._struct(kind)
        struct.serialize = lambda sample, **_: sample.cdr
        struct.deserialize = struct.deserialize_key = classmethod(lambda own, data, **_: sample(own, data))
        return struct

    def _struct(self, kind: str) -> Any:
        from cyclonedds.idl import make_idl_struct

        if kind not in self._structs:
            fields = {name: self._form(form) for name, form in self.store.fielddefs[kind][1]}
            self._structs[kind] = make_idl_struct(kind.rpartition("/")[2], mangled(kind), fields)
        return self._structs[kind]

    def _form(self, form: Any) -> Any:
        from cyclonedds.idl import types
        from rosbags.interfaces import Nodetype

        forms: Any = types
        sort, what = form
        if sort == Nodetype.NAME:
            return self._struct(what)
        if sort == Nodetype.BASE:
            return forms.bounded_str[what[1]] if what[0] == "string" and what[1] else self._bases[what[0]]
        inner, length = self._form(what[0]), what[1]
        if sort == Nodetype.ARRAY:
            return forms.array[inner, length]
        return forms.sequence[inner, length] if length else forms.sequence[inner]

    @cached_property
    def _bases(self) -> dict[str, Any]:
        from cyclonedds.idl import types

        numbers = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32", "float64")
        # A `char` of a message is an unsigned byte in ROS's mapping, as `byte` is.
        small = {"char": types.uint8, "byte": types.uint8, "octet": types.uint8}
        return {name: getattr(types, name) for name in numbers} | small | {"bool": bool, "string": str}


def sample(struct: Any, data: bytes) -> Any:
    """A sample of a type of `Types.dds` that holds these bytes."""
    made = struct.__new__(struct)
    made.cdr = data
    return made


def mangled(kind: str) -> str:
    """A type's name as ROS gives it to DDS: `std_msgs::msg::dds_::String_`."""
    package, folder, name = kind.split("/")
    return f"{package}::{folder}::dds_::{name}_"
