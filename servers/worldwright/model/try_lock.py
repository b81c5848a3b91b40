"""Take a lock that belongs to an open file, or learn that somebody else holds it; the kernel lets go when the holder dies."""

import fcntl


def taken(handle: int) -> bool:
    """Whether the lock on this open file or folder (its descriptor) is the caller's now; it is kept until that is closed.

    Raises:
        OSError: the file system has no locks.
    """
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True
