"""Tripo, a service that is paid in credits: the picture is uploaded, a task begun, asked after, and its model downloaded.

Written after the public schema of its version 2 and docs.tripo3d.ai; no real server was reached from here, only stand-ins on the
loopback that speak as it does.
"""

from typing import Any

from ..orders import Order, Price, Terms
from ..web_calls import MintError, Server, awaited, forgotten

TERMS = Terms(
    "WORLDWRIGHT_TRIPO",
    "make a key at platform.tripo3d.ai and export it as TRIPO_API_KEY",
    "https://api.tripo3d.ai",
    "TRIPO_API_KEY",
    price=Price(30.0, "credits of Tripo (0.30 US dollars)", "2026, image to model with texture"),
)
PATH, VERSION, FACES = "/v2/openapi", "v2.5-20250123", 40_000
ENDED = ("failed", "cancelled", "banned", "expired", "unknown")


def mint(picture: bytes, server: Server, order: Order) -> bytes:
    """The textured GLB that it makes of a picture.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """

    def begin() -> str:
        kind = "png" if picture[:4] == b"\x89PNG" else "jpg"
        token = _data(server, server.upload(f"{PATH}/upload/sts", "file", f"picture.{kind}", picture)).get(
            "image_token"
        )
        asked = {
            "type": "image_to_model", "file": {"type": kind, "file_token": token}, "model_version": VERSION,
            "face_limit": FACES, "texture": True, "pbr": True,
        }  # fmt: skip
        name = _data(server, server.post(f"{PATH}/task", asked)).get("task_id")
        if not isinstance(name, str) or not name.replace("-", "").isalnum():
            raise server.garbage(name, "name of its work")
        return name

    name = order.begun(begin)

    def ask() -> tuple[dict[str, Any] | None, Any]:
        try:
            told = _data(server, server.get(f"{PATH}/task/{name}"))
        except MintError as error:
            if forgotten(error):
                order.done()
            raise
        state = told.get("status")
        if state in ENDED:
            order.done()
            raise server.refused("its rules do not allow this picture" if state == "banned" else f"the task is {state}")
        if state not in ("queued", "running", "success"):
            raise server.garbage(f"the state {state}")
        return (told if state == "success" else None), (state, told.get("progress"), told.get("queuing_num"))

    told = awaited(ask, server, lambda far: order.hears(f"{far[1] or 0} %"))
    output = told.get("output")
    found = [output.get(word) for word in ("pbr_model", "model", "base_model")] if isinstance(output, dict) else []
    url = next((word for word in found if isinstance(word, str) and word), None)
    if url is None:
        raise server.garbage(f"of its files {list(output) if isinstance(output, dict) else output}")
    return server.download(url)


def _data(server: Server, told: Any) -> dict[str, Any]:
    """What stands in the envelope that all its answers have."""
    if not isinstance(told, dict) or told.get("code") != 0:
        raise server.refused(told.get("message") if isinstance(told, dict) else "an answer without a code")
    if not isinstance(told.get("data"), dict):
        raise server.garbage(told)
    return told["data"]
