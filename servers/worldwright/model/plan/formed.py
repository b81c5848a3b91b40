"""Scene objects beyond the primitives: the numbers that a plan gives of a `worldkit.forms` shape, and the shape of them.

A cone, torus, wedge and rounded box have the `size` that the plan gives; the size of a lathe, a tube and a hill follows from
their points, and may be left out.
"""

from collections.abc import Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from worldkit.forms import Form

NUMBERS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "cone": ((), ("top_diameter",)),
    "torus": ((), ()),
    "wedge": ((), ()),
    "rounded_box": (("radius",), ()),
    "lathe": (("profile",), ("wall_thickness", "smooth")),
    "tube": (("path", "diameter"), ("wall_thickness", "smooth")),
    "hill": (("profile", "width"), ("smooth",)),
}
"""What each form needs besides its name, and what it may have."""
BY_POINTS = ("lathe", "tube", "hill")
"""Forms whose size follows from their points."""
ROUND = {"cone": "[d, d, height]", "torus": "[d, d, thickness]"}


def arguments(primitive: str, row: Mapping[str, Any]) -> dict[str, Any]:
    """The keyword arguments of the function of `worldkit.forms` that has the primitive's name, as plain numbers."""
    size: Any = row.get("size") or ()
    if primitive in ROUND and (len(size) != 3 or size[0] != size[1]):
        raise ValueError(f"a {primitive} is round: write {ROUND[primitive]}, got {list(size)}")
    if primitive == "cone":
        found = {"diameter": size[0], "height": size[2]}
    elif primitive == "torus":
        found = {"diameter": size[0], "thickness": size[2]}
    else:
        found = {} if primitive in BY_POINTS else {"size": tuple(size)}
    names = {"wall_thickness": "wall"}
    needed, may = NUMBERS[primitive]
    return found | {names.get(key, key): _tupled(row[key]) for key in (*needed, *may) if row.get(key)}


def form(primitive: str, row: Mapping[str, Any], deg_x: float = 0.0) -> "Form":
    """The shape of a scene object, after its tilt.

    Raises:
        ValueError: its numbers make no such shape.
    """
    missing = [key for key in NUMBERS[primitive][0] if not row.get(key)]
    if missing:
        raise ValueError(f"a {primitive} needs {' and '.join(f'`{key}`' for key in missing)}")
    return _form(primitive, tuple(sorted(arguments(primitive, row).items())), deg_x)


def foreign(primitive: str, given: Mapping[str, Any]) -> list[str]:
    """The numbers of forms that are given and belong to another kind of object."""
    needed, may = NUMBERS.get(primitive, ((), ()))
    known = {key for pair in NUMBERS.values() for keys in pair for key in keys} - {"wall_thickness"}
    return sorted(key for key in known if given.get(key) and key not in (*needed, *may))


def _tupled(value: Any) -> Any:
    return tuple(_tupled(item) for item in value) if isinstance(value, list | tuple) else value


@lru_cache(maxsize=256)
def _form(primitive: str, numbers: tuple[tuple[str, Any], ...], deg_x: float) -> "Form":
    from worldkit import forms  # it computes with numpy, which no server loads before it must

    made: Form = getattr(forms, primitive)(**dict(numbers))
    return made.tilted(deg_x)
