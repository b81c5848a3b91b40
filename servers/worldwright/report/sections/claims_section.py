"""What the plan claims, and what was measured of each claim."""

from typing import Any

from ..facts import arguments, strength
from ..material import Material

CODE = "RS010"
TEMPLATE = "objectives.html"


def context(material: Material) -> dict[str, Any]:
    """What its template shows besides the material and the pictures."""
    return {"arguments": arguments, "strength": strength}
