"""A job's supervisor, forked instead of started: `worldwright.stage.supervisor` with the same words, environment and files."""

import os
import socket
import sys
from collections.abc import Callable

from .. import family
from . import kept_warm, letters, newborn


def begin(asked: socket.socket, serve: Callable[[socket.socket], object]) -> int:
    """Supervise the job that is asked for, with a nursery of its own for its engines; returns the exit status.

    That nursery is forked before the request is read: an engine's memory holds nothing of what a supervisor knows.

    Args:
        asked: where the request comes from.
        serve: be a nursery that is asked at this socket, until nobody can any more.
    """
    ours, theirs = socket.socketpair()
    if (own := os.fork()) == 0:
        os.setsid()
        newborn.dies_with_parent()
        newborn.alone(theirs.fileno())
        serve(theirs)
        os._exit(0)
    theirs.close()
    request, (errors, lock) = letters.receive(asked)
    os.setsid()
    newborn.become(request["environment"], request["folder"], request["umask"])
    for number in (1, 2):
        os.dup2(errors, number)
    asked.send(letters.TAKEN)
    if asked.recv(1) != letters.GO:
        return 0
    asked.close()
    newborn.alone(lock, ours.fileno())
    kept_warm.use(kept_warm.Nursery(ours, ready=True))
    family.UNCOUNTED.add(own)
    sys.argv = ["worldwright.stage.supervisor", request["job"], str(lock)]
    from .. import supervisor

    return supervisor.main()
