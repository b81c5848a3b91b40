"""Hunyuan3D's own `api_server.py` (2 and 2.1): POST `/generate` with a picture in base64, answered by the bytes of a GLB.

Written after its source; no real server was reached from here, only stand-ins on the loopback that speak as it does.
"""

import base64
import http.client
import json
import urllib.error
import urllib.request
from urllib.parse import urlsplit

from . import MintError

MOST_ANSWER = 256 << 20
SILENT_S = 600.0
"""A server that says nothing for so long makes nothing."""
FACES, SEED, STEPS = 40_000, 1234, 5


def variable() -> str:
    """The name of the environment variable that holds its address."""
    return "WORLDWRIGHT_HUNYUAN3D"


def starting() -> str:
    """How a user comes by one, in a few words."""
    return "start Hunyuan3D's api_server.py (port 8081), then name it: --address http://127.0.0.1:8081"


def mint(picture: bytes, address: str) -> bytes:
    """The GLB that it makes of a picture (PNG or JPEG), without texture.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """
    try:
        named = urlsplit(address)
        known = named.scheme in ("http", "https") and bool(named.hostname) and named.port != 0
    except ValueError:  # brackets without an end, a port that is none
        known = False
    if not known:
        raise MintError("that is no address of a server", code="unreachable", place=address, next_move=starting())
    asked = {
        "image": base64.b64encode(picture).decode(), "seed": SEED, "num_inference_steps": STEPS, "face_count": FACES,
        "texture": False, "type": "glb",
    }  # fmt: skip
    call = urllib.request.Request(
        f"{address.rstrip('/')}/generate", json.dumps(asked).encode(), {"Content-Type": "application/json"}
    )
    try:
        with urllib.request.urlopen(call, timeout=SILENT_S) as answer:
            made: bytes = answer.read(MOST_ANSWER + 1)
            if answer.length and len(made) <= MOST_ANSWER:
                raise ConnectionError("its answer broke off")
    except urllib.error.HTTPError as error:
        raise _refused(error, address) from error
    except (OSError, ValueError, http.client.HTTPException) as error:
        cause = getattr(error, "reason", error)
        raise MintError(
            f"it cannot be reached: {cause}", code="unreachable", place=address, next_move=starting()
        ) from error
    if len(made) > MOST_ANSWER or made[:4] != b"glTF":
        said = f"more than {MOST_ANSWER >> 20} MB" if len(made) > MOST_ANSWER else repr(made[:40])
        raise MintError(
            f"it answered no GLB: {said}", code="garbage", place=address,
            next_move="look at the server's own output, then ask again; or sculpt the thing (skill sculpting)",
        )  # fmt: skip
    return made


def _refused(error: urllib.error.HTTPError, address: str) -> MintError:
    if error.code == 429:
        wait = str(error.headers.get("Retry-After") or "")[:20]
        later = f"ask again in {wait} s" if wait.isdecimal() else "ask again later"
        return MintError("it has too much to do", code="rate_limited", place=address, next_move=later)
    try:
        told = json.loads(error.read(1 << 16))
        said = str(told.get("text") or told.get("message") or "")[:200]
    except (OSError, ValueError, AttributeError, http.client.HTTPException):
        said = ""
    return MintError(
        f"it refused (status {error.code}){f': {said}' if said else ''}", code="refused", place=address,
        next_move="give a picture of the one thing on a plain ground; or sculpt it (skill sculpting)",
    )  # fmt: skip
