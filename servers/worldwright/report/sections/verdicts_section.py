"""What the checks and the review found."""

from typing import Any

from ..material import Material, acting

CODE = "RS030"
TEMPLATE = "findings.html"


def context(material: Material) -> dict[str, Any]:
    """What its template shows besides the material and the pictures."""
    return {"acting": acting(material)}
