"""The four side faces of a box: axis, sign, and the words of the templates and of a person."""

from typing import NamedTuple


class Side(NamedTuple):
    """One side face of a world box."""

    name: str
    """The face as the templates' names have it: `minus_x`."""
    axis: str
    sign: int
    """1 for the face at the larger coordinate, -1 for the other."""
    called: str
    """The words of a person, e.g. `-X, back`."""

    @property
    def across(self) -> str:
        """The horizontal axis along the face."""
        return "y" if self.axis == "x" else "x"

    @property
    def words(self) -> str:
        """The name in words: `minus x`."""
        return self.name.replace("_", " ")

    @property
    def bound(self) -> str:
        """`max` or `min`: the end of the axis at which it lies."""
        return "max" if self.sign > 0 else "min"

    def signs(self) -> tuple[str, str]:
        """The signs in a formula that go outwards and inwards from the face: `+`, `-` on the positive side."""
        return ("+", "-") if self.sign > 0 else ("-", "+")


MINUS_X = Side("minus_x", "x", -1, "-X, back")
PLUS_X = Side("plus_x", "x", 1, "+X, front")
MINUS_Y = Side("minus_y", "y", -1, "-Y, right")
PLUS_Y = Side("plus_y", "y", 1, "+Y, left")
