"""The recorded motion as a scene that a person turns by hand; where `worldwright export` or `report` has made one."""

import base64
from typing import Any

from ..material import Material

CODE = "RS025"
TEMPLATE = "replay.html"
MOST_BYTES = 12 * 2**20
"""A larger scene is not put into the page."""


def context(material: Material) -> dict[str, Any]:
    """The scene, base64; None where there is none that may be shown, or it is too large."""
    data = material.scene
    return {"replay": base64.b64encode(data).decode() if data and len(data) <= MOST_BYTES else None}
