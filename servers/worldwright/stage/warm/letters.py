"""How a request to a nursery looks on its socket: a length, the descriptors that go with it, and one JSON object."""

import json
import os
import socket
import struct
from collections.abc import Sequence
from typing import Any

LENGTH = struct.Struct("!Q")
READY, TAKEN, GO = b"r", b"y", b"g"
"""The nursery has loaded what it had to; a process is ready to begin; it may."""
SUPERVISOR, ENGINE = b"s", b"e"
MOST_DESCRIPTORS = 32


def send(to: socket.socket, request: dict[str, Any], descriptors: Sequence[int]) -> None:
    """Send a request with at least one descriptor."""
    data = json.dumps(request).encode()
    socket.send_fds(to, [LENGTH.pack(len(data))], list(descriptors))
    to.sendall(data)


def receive(asked: socket.socket) -> tuple[dict[str, Any], list[int]]:
    """The request and its descriptors, which programs started from here do not inherit.

    Raises:
        EOFError: who asked has gone.
    """
    head, descriptors, _, _ = socket.recv_fds(asked, LENGTH.size, MOST_DESCRIPTORS)
    for number in descriptors:
        os.set_inheritable(number, False)  # as they come they are handed on
    data = bytearray()
    while len(head) == LENGTH.size and len(data) < LENGTH.unpack(head)[0]:
        part = asked.recv(LENGTH.unpack(head)[0] - len(data))
        if not part:
            break
        data += part
    if len(head) < LENGTH.size or len(data) < LENGTH.unpack(head)[0]:
        raise EOFError("who asked has gone")
    return json.loads(data), descriptors
