"""Meshy, a service that is paid in credits: POST `/openapi/v1/image-to-3d`, asked after until it has succeeded, then downloaded.

Written after docs.meshy.ai; no real server was reached from here, only stand-ins on the loopback that speak as it does.
"""

import base64
from typing import Any

from ..orders import Order, Price, Terms
from ..web_calls import MintError, Server, awaited, forgotten

CREDITS = 30.0
TERMS = Terms(
    "WORLDWRIGHT_MESHY",
    "make a key at meshy.ai/settings/api and export it as MESHY_API_KEY",
    "https://api.meshy.ai",
    "MESHY_API_KEY",
    price=Price(CREDITS, "credits of Meshy", "2026, Meshy 6 with texture"),
)
WORK = "/openapi/v1/image-to-3d"
FACES = 40_000


def mint(picture: bytes, server: Server, order: Order) -> bytes:
    """The textured GLB that it makes of a picture.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """
    kind = "png" if picture[:4] == b"\x89PNG" else "jpeg"

    def begin() -> str:
        asked = {
            "image_url": f"data:image/{kind};base64,{base64.b64encode(picture).decode()}", "ai_model": "meshy-6",
            "topology": "triangle", "target_polycount": FACES, "should_remesh": True, "should_texture": True,
        }  # fmt: skip
        name = server.post(WORK, asked).get("result")
        if not isinstance(name, str) or not name.replace("-", "").isalnum():
            raise server.garbage(name, "name of its work")
        return name

    name = order.begun(begin)

    def ask() -> tuple[dict[str, Any] | None, Any]:
        try:
            told = server.get(f"{WORK}/{name}")
        except MintError as error:
            if forgotten(error):
                order.done()
            raise
        state = told.get("status")
        if state in ("FAILED", "CANCELED", "EXPIRED"):
            order.done()
            why = told.get("task_error")
            raise server.refused((why.get("message") if isinstance(why, dict) else why) or str(state).lower())
        if state not in ("PENDING", "IN_PROGRESS", "SUCCEEDED"):
            raise server.garbage(f"the state {state}")
        return (told if state == "SUCCEEDED" else None), (state, told.get("progress"), told.get("preceding_tasks"))

    told = awaited(ask, server, lambda far: order.hears(f"{far[1] or 0} %"))
    if told.get("consumed_credits") not in (None, CREDITS):
        order.said.append(f"it took {server.clean(told['consumed_credits'])} credits, not {CREDITS:g}")
    urls = told.get("model_urls")
    url = urls.get("glb") if isinstance(urls, dict) else None
    if not isinstance(url, str):
        raise server.garbage(f"of its files {list(urls) if isinstance(urls, dict) else urls}")
    return server.download(url)
