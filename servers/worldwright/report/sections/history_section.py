"""The journal, and where everything came from."""

from typing import Any

from ..facts import provenance, story
from ..material import Material

CODE = "RS060"
TEMPLATE = "record.html"


def context(material: Material) -> dict[str, Any]:
    """What its template shows besides the material and the pictures."""
    return {"story": story(material), "provenance": provenance(material)}
