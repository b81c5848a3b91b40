"""What the cameras saw, where everything was placed, and how a witness described it."""

from typing import Any

from ..material import Material

CODE = "RS040"
TEMPLATE = "pictures.html"


def context(material: Material) -> dict[str, Any]:
    """What its template shows besides the material and the pictures."""
    return {}
