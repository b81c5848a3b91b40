"""How everything moved: heights, speeds, paths and contacts over time."""

from typing import Any

from ..material import Material

CODE = "RS020"
TEMPLATE = "motion.html"


def context(material: Material) -> dict[str, Any]:
    """What its template shows besides the material and the pictures."""
    return {}
