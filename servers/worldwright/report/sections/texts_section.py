"""The plan and the program as they are."""

from typing import Any

from .. import text
from ..material import Material

CODE = "RS050"
TEMPLATE = "sources.html"


def context(material: Material) -> dict[str, Any]:
    """What its template shows besides the material and the pictures."""
    return {
        "plan_html": text.markdown(material.plan_text) if material.plan_text else None,
        "program_html": text.code(material.program) if material.program else None,
        "program_lines": len(material.program.splitlines()),
    }
