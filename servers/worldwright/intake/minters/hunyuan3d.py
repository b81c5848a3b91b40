"""Hunyuan3D's own `api_server.py` (2 and 2.1): POST `/generate` with a picture in base64, answered by the bytes of a GLB.

Written after its source; no real server was reached from here, only stand-ins on the loopback that speak as it does.
"""

import base64

from ..orders import Order, Terms
from ..web_calls import Server

TERMS = Terms(
    "WORLDWRIGHT_HUNYUAN3D",
    "start Hunyuan3D's api_server.py (port 8081), then name it: --address http://127.0.0.1:8081",
)
FACES, SEED, STEPS = 40_000, 1234, 5


def mint(picture: bytes, server: Server, _order: Order) -> bytes:
    """The GLB that it makes of a picture (PNG or JPEG), without texture.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """
    asked = {
        "image": base64.b64encode(picture).decode(), "seed": SEED, "num_inference_steps": STEPS, "face_count": FACES,
        "texture": False, "type": "glb",
    }  # fmt: skip
    return server.posted("/generate", asked)
