"""What a file sculpts, as one thing of a world: `sculpt.from_file(spec, "sculpt/vase.py", name="vase", pos=…)`.

The file lies beside the program and is part of what a plan's approval and a world's evidence are about. It is run once a
process, and so is a function in it, however many bodies are made of it.
"""

import runpy
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import ProgramError
from ..joints import Joint
from ..parts import WATER
from .crisp import Solid
from .figure import Part, assemble, box_around
from .signed import Shape, Vec3

if TYPE_CHECKING:
    import mujoco

KINDS = "a Shape, a crisp.Solid, a Part, a row of Parts, or a function without arguments that gives one of them"


def from_file(
    spec: "mujoco.MjSpec",
    file: str,
    *,
    name: str,
    pos: Vec3,
    of: str = "",
    yaw_deg: float = 0.0,
    mass: float | None = None,
    surface: dict[str, Any] | None = None,
    look: str | None = None,
    fixed: bool = False,
    parent: str | None = None,
    joint: Joint | Sequence[Joint] | None = None,
) -> "mujoco.MjsBody":
    """Add what a file sculpts as the body `name`, the centre of the box around it at `pos`, m; returns the body.

    Of several parts, one has no parent and becomes that body; the others are called `name_` and their own name, and so are
    their joints.

    Args:
        spec: the world under construction.
        file: path of the file, relative to the program's folder.
        name: body name.
        pos: world position of the centre of the box around all of it, m.
        of: name in the file of `KINDS`; the last one in it, if not given.
        yaw_deg: rotation about world z, degrees counter-clockwise from +X.
        mass: of all parts together, kg, shared out as their own masses or densities say; else the surface's density is that of
            all, else each has its own, or that of water.
        surface: contact properties from `worldkit.contacts.surface`, of all parts, in place of their own.
        look: of parts without paint, in place of their own.
        fixed: part of the scenery; its joints move all the same.
        parent: name of the body it belongs to, which must be there already.
        joint: how it moves against its parent; None for a loose thing means a free joint.

    Raises:
        ProgramError: there is no such file, or nothing of that name in it.
        ValueError: not exactly one part has no parent, or what `add` refuses.
    """
    with sculpted(file, of) as held:
        parts = as_planned(named_parts(name, held), mass, surface, look)
        root = next(number for number, part in enumerate(parts) if part.parent is None)
        parts[root] = replace(parts[root], parent=parent)
        low, high = box_around(parts)
        middle = (low + high) / 2
        return assemble(
            spec, parts, pos=pos, yaw_deg=yaw_deg, origin=(float(middle[0]), float(middle[1]), float(middle[2])), fixed=fixed,
            placed_joints={name: joint} if joint is not None else {},
        )[name]  # fmt: skip


def as_planned(
    parts: Sequence[Part], mass: float | None, surface: dict[str, Any] | None, look: str | None
) -> list[Part]:
    """Parts with the mass of all together, the contact properties and the look that a plan gives, as of `from_file`."""
    parts = list(parts)
    if mass is not None:
        own = [_weight(part, surface) for part in parts]
        parts = [replace(part, mass=mass * share / sum(own)) for part, share in zip(parts, own, strict=True)]
    elif surface is not None and "density" in surface:
        parts = [replace(part, mass=None, density=surface["density"]) for part in parts]
    given: dict[str, Any] = {key: value for key, value in (("surface", surface), ("look", look)) if value is not None}
    return [replace(part, **given) for part in parts]


def named_parts(name: str, parts: Sequence[Part]) -> list[Part]:
    """A figure's parts under the names that they get as the thing `name` of a world, with what they hang on and their joints."""
    roots = [part.name for part in parts if part.parent is None]
    if len(roots) != 1:
        raise ValueError(
            f"{name}: one part stands by itself and the others hang on it by `parent`; here it is {', '.join(roots)}"
        )
    called = {part.name: name if part.parent is None else f"{name}_{part.name}" for part in parts}

    def renamed(joint: Joint) -> Joint:
        return replace(joint, name=f"{name}_{joint.name}")

    def joints(part: Part) -> Any:
        if part.joint is None or part.parent is None:
            return None  # how a thing stands in the world is the world's
        return [renamed(one) for one in (part.joint if isinstance(part.joint, list | tuple) else (part.joint,))]

    return [
        replace(
            part,
            name=called[part.name],
            parent=None if part.parent is None else called.get(part.parent, part.parent),
            joint=joints(part),
        )
        for part in parts
    ]


@contextmanager
def sculpted(file: str, of: str = "") -> Iterator[tuple[Part, ...]]:
    """The parts of a thing in a file beside the program; of a bare shape one, painted by the file's `paint`.

    While they are made, what their functions import is found beside the file, too.
    """
    path = found(file)
    with beside(path):
        yield _parts(str(path), file, of)


@contextmanager
def beside(path: Path) -> Iterator[None]:
    """Let modules in the folder of a file be imported."""
    folder = str(path.absolute().parent)
    sys.path.insert(0, folder)
    try:
        yield
    finally:
        with suppress(ValueError):  # an author may have changed the path, too
            sys.path.remove(folder)


def found(file: str) -> Path:
    """A file beside the program: where modules of its own are looked for."""
    if Path(file).is_absolute() or ".." in Path(file).parts or not file.endswith(".py"):
        raise ProgramError("what sculpts is a file of Python beside the program", file, "name it by its relative path")
    for folder in sys.path:
        if folder and (Path(folder) / file).is_file():
            return (Path(folder) / file).absolute()
    raise ProgramError("there is no such file beside the program", file, "put it there, or correct the path")


@cache
def _held(path: str) -> dict[str, Any]:
    return runpy.run_path(path)


@cache
def _parts(path: str, file: str, of: str) -> tuple[Part, ...]:
    held = _held(path)
    chosen = of or last(held)
    if chosen not in held:
        known = ", ".join(names(held)) or "nothing that is sculpted"
        raise ProgramError(f"there is no {chosen!r} in it", file, f"it has: {known}")
    return parts_of(chosen, held[chosen], held.get("paint"))


def parts_of(name: str, value: Any, paint: Any = None) -> tuple[Part, ...]:
    """Any of `KINDS` as parts."""
    if callable(value) and not isinstance(value, Shape):
        value = value()
    if isinstance(value, Shape | Solid):
        value = Part(name, value, paint=paint)
    if isinstance(value, Part):
        value = (value,)
    if not is_row(value):
        raise ProgramError(f"{name} is {type(value).__name__}, which is nothing sculpted", name, f"name {KINDS}")
    return tuple(value)


def names(held: dict[str, Any]) -> list[str]:
    """What a file has that is sculpted, in the order of the file."""
    return [name for name, value in held.items() if not name.startswith("_") and drawable(value)]


def last(held: dict[str, Any]) -> str:
    """The last thing in the file that is sculpted: rows of parts first, then parts, then shapes."""
    for kind in (is_row, lambda value: isinstance(value, Part), lambda value: isinstance(value, Shape | Solid)):
        several = [name for name in names(held) if kind(held[name])]
        if several:
            return several[-1]
    raise ProgramError("there is nothing sculpted in it", "", f"name {KINDS}: FILE.py:NAME")


def is_row(value: Any) -> bool:
    """Whether it is a row of parts."""
    return isinstance(value, list | tuple) and len(value) > 0 and all(isinstance(one, Part) for one in value)


def drawable(value: Any) -> bool:
    """Whether it is a shape, a solid, a part, or a row of parts."""
    return isinstance(value, Shape | Solid | Part) or is_row(value)


def _weight(part: Part, surface: dict[str, Any] | None) -> float:
    """What a part would weigh by itself, kg."""
    if part.mass is not None:
        return part.mass
    density = part.density or (part.surface or surface or {}).get("density", WATER)
    return float(density) * part.made().volume
