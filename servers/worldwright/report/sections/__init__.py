"""The shelf of the report's sections: each is one part of the page, in the order of their codes.

A section that fails is named on the page, and the others are shown.
"""

from ...shelf import Attribute, Function, Shelf

SECTIONS = Shelf(
    "worldwright.report.sections",
    {
        "TEMPLATE": Attribute(str, "the name of its template, in `templates` beside this folder"),
        "context": Attribute(Function, "(Material) -> what its template shows besides the material and the pictures"),
    },
)
