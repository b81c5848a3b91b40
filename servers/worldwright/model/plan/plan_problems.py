"""What is wrong with a plan's values, in the plan's own words.

Pydantic validates; this module finds where in the plan each problem stands, what was expected there and what to do.
"""

import types
import typing
from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from enum import Enum
from typing import Any, Literal

from pydantic import BaseModel, ValidationError

from .committed import TO_CLARIFY, Plan
from .plan_yaml import Node

Path = tuple[str | int, ...]

# Where the number of a commonly misplaced key lives instead: every number has one owner.
_POSE = "poses are resolved: place the object by rows of topology.scene_predicates"
_SURFACE = "surface constants live in simulation_parameters.materials; refer to one by `material`"
_MOTION = "initial velocities live in simulation_parameters.initial_motion, by object name"
_OWNERS = dict.fromkeys(("position", "pos", "orientation", "yaw", "rotation", "deg_z"), _POSE)
_OWNERS |= dict.fromkeys(("friction", "restitution", "density", "rolling_friction"), _SURFACE)
_OWNERS |= dict.fromkeys(("velocity", "linear", "angular", "initial_velocity"), _MOTION)
_PART = "its place in the object is its `offset` [x, y, z] in metres, its turn `deg_x`, `deg_y`, `deg_z`"
_OF_PARTS = dict.fromkeys(("position", "pos", "orientation", "yaw", "rotation"), _PART)
_OF_PARTS |= dict.fromkeys(("count", "step", "copies"), "write `repeat: {count: …, step: [x, y, z]}`")
_OWNERS |= {
    "mass": "masses live in simulation_parameters.masses, by object name",
    "color": "write `look`: the name of a worldkit look, or `#rrggbb`",
    "colour": "write `look`: the name of a worldkit look, or `#rrggbb`",
    "texture": "write `look`: the name of a worldkit look, or `#rrggbb`",
    "radius": "write `size: [x, y, z]`, the full extents: a sphere of radius r has [2r, 2r, 2r]",
    "height": "sizes live in `size` (scene objects) and in asset_dimensions (assets)",
    "scale": "the scale of an asset follows from its height in asset_dimensions",
}


@dataclass(frozen=True)
class Problem:
    """One wrong value: the path to it, the cause and the fix."""

    code: str
    name: str
    path: Path
    message: str
    fix: str


def value_problems(error: ValidationError, nodes: dict[str, Node]) -> list[Problem]:
    """A validation error of `Plan` as problems, one per place in the document, in the order of the plan."""
    by_path: dict[Path, list[dict[str, Any]]] = {}
    for detail in error.errors(include_url=False, include_context=True):
        path = _path(detail["loc"], nodes, detail["type"])
        by_path.setdefault(path, []).append(typing.cast(dict[str, Any], detail))
    problems = []
    for path, details in by_path.items():
        inner = any(len(other) > len(path) and other[: len(path)] == path for other in by_path)
        if inner and all(_wrong_type(d) or d["type"] in ("too_short", "too_long") for d in details):
            continue  # an item that is wrong is not counted; a union complains once per branch: the branch that got furthest says what is wrong
        problems.append(_problem(path, details))
    return problems


def _path(loc: tuple[Any, ...], nodes: dict[str, Node], kind: str) -> Path:
    """The part of a pydantic location that names places in the document (it also names branches of unions)."""
    path: list[str | int] = [loc[0]] if loc else []
    node = nodes.get(str(loc[0])) if loc else None
    for index, part in enumerate(loc[1:], 1):
        try:
            node = node[part] if node is not None else None
        except KeyError:
            missing = index == len(loc) - 1 and kind == "missing" and isinstance(part, str)
            if missing or (node is not None and node.form == "bare"):
                path.append(part)
            continue
        if node is not None:
            path.append(part)
    return tuple(path)


def _wrong_type(detail: dict[str, Any]) -> bool:
    return detail["type"].endswith(("_type", "_parsing", "_error")) and detail["type"] != "value_error"


def _problem(path: Path, details: list[dict[str, Any]]) -> Problem:
    detail = next((d for d in details if not _wrong_type(d)), details[0])
    where = dotted(path)
    if detail["type"] == "extra_forbidden":
        return _unknown_key(path)
    if detail["type"] == "missing" and isinstance(detail["loc"][-1], str):
        return Problem(
            "WP011",
            "missing_key",
            path,
            f"`{where}` is missing",
            f"add `{path[-1]}: …`, {expected(path)}",
        )
    if detail["type"] == "value_error":
        message = str(detail["msg"]).removeprefix("Value error, ")
        return Problem("WP010", "wrong_value", path, f"`{where}`: {message}", f"`{where}` is {expected(path)}")
    if detail["type"] == "missing":  # of a list: the list is too short
        return _wrong_length(path, len(detail["input"]))
    if detail["type"] in ("too_long", "too_short"):
        return _wrong_length(path, detail["ctx"]["actual_length"], detail["ctx"].get("min_length"))
    shown = _shown(detail["input"])
    if not _wrong_type(detail):
        rule = str(detail["msg"]).removeprefix("Input should be ")
        return Problem(
            "WP010",
            "wrong_value",
            path,
            f"`{where}` must be {rule[0].lower() + rule[1:]}, got {shown}",
            f"`{where}` is {expected(path)}{allowed(path)}",
        )
    return Problem(
        "WP010", "wrong_value", path, f"`{where}` must be {expected(path)}, got {shown}", _remedy(path, detail["input"])
    )


def _wrong_length(path: Path, length: int, least: int | None = None) -> Problem:
    where, kind = dotted(path), expected(path)
    wanted = f"have at least {least} item" if least else f"be {kind}"
    return Problem(
        "WP010", "wrong_value", path, f"`{where}` must {wanted}, got a list of {length}", f"`{where}` is {kind}"
    )


def _unknown_key(path: Path) -> Problem:
    key, owner = str(path[-1]), annotation_at(path[:-1])
    mappings = [b for b in _branches(owner) if isinstance(b, type) and issubclass(b, BaseModel)]
    known = [name for mapping in mappings for name in mapping.model_fields]
    near = get_close_matches(key, known, n=1, cutoff=0.6)
    owners = _OF_PARTS | {k: v for k, v in _OWNERS.items() if k not in _OF_PARTS} if "parts" in path else _OWNERS
    if key in owners and path[0] in ("scene_objects", "assets"):
        fix = owners[key] + "; "
    elif near:
        fix = f"did you mean `{near[0]}`? "
    else:
        fix = "remove it; "
    return Problem(
        "WP009",
        "unknown_key",
        path,
        f"`{dotted(path[:-1])}` has no key `{key}`",
        f"{fix}known keys: {', '.join(known)}",
    )


def _remedy(path: Path, value: Any) -> str:
    kind = str(expected(path))
    if isinstance(value, str):
        if "number" in kind:
            return "write a bare number: no quotes and no unit (units are fixed: m, kg, s, degrees, SI)"
        if kind.startswith("true or false"):
            return "write true or false"
        choices = _choices(annotation_at(path))
        if path == ("visualization", "setting") and (told := _of_a_film(value, choices)):
            return told
        near = get_close_matches(value, choices, n=1, cutoff=0.5)
        if near:
            return f"did you mean `{near[0]}`?"
        if choices:
            return f"write one of {', '.join(choices)}"
    if kind.startswith("text") and isinstance(value, bool):
        return "write the reason in words"  # `visual_only: true` asks for more than yes
    if kind.startswith("text") and isinstance(value, int | float):
        return f'put it in quotes: "{value}"'
    if value is None:
        return "give it a value, or remove the line"
    return f"write {kind}"


def _of_a_film(name: str, settings: list[str]) -> str:
    """What to do with a set of a film that stands where the plan's setting belongs; empty for any other word."""
    from worldkit.filming import sets

    if name not in sets.names():
        return ""
    setting = "room" if name in (*sets.ROOMS, *sets.ON_TOPS) else "outdoor"
    film = f'`{name}` is a set of film.py: write `film.set("{name}")` there, and `setting: {setting}` here'
    return f"settings are {', '.join(settings)}; {film}"


def dotted(path: Path) -> str:
    """A path as people write it: `topology.scene_predicates[3].params`."""
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f".{part}" if text else str(part)
    return text


def expected(path: Path) -> str:
    """What belongs at a path of the plan, in words."""
    return describe(annotation_at(path))


def allowed(path: Path) -> str:
    """The numbers that are allowed at a path of the plan, both ends, in words; empty where nothing bounds them."""
    if len(path) < 2:
        return ""
    above = next(
        (b for b in _branches(annotation_at(path[:-1])) if isinstance(b, type) and issubclass(b, BaseModel)), None
    )
    field = above.model_fields.get(str(path[-1])) if above is not None else None
    words = {"ge": "at least", "gt": "more than", "le": "at most", "lt": "less than"}
    rules = field.metadata if field is not None else []
    said = [f"{word} {getattr(rule, end):g}" for end, word in words.items() for rule in rules if hasattr(rule, end)]
    return f", {' and '.join(said)}" if said else ""


def annotation_at(path: Path) -> Any:
    """The type annotation at a path of the plan; `Any` where the plan is open."""
    annotation: Any = Plan
    for part in path:
        annotation = next((found for branch in _branches(annotation) if (found := _child(branch, part))), Any)
    return annotation


def keys_of(section: str) -> tuple[str, ...]:
    """The keys that a section's mapping, or the mappings it lists, may have; none when the section is open."""
    annotation = annotation_at((section,))
    for branch in (annotation, *typing.get_args(annotation)):
        if isinstance(branch, type) and issubclass(branch, BaseModel):
            return tuple(branch.model_fields)
    return ()


def _branches(annotation: Any) -> tuple[Any, ...]:
    if typing.get_origin(annotation) in (typing.Union, types.UnionType):
        return tuple(branch for branch in typing.get_args(annotation) if branch is not type(None))
    return (annotation,)


def _child(annotation: Any, part: str | int) -> Any:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        field = annotation.model_fields.get(str(part))
        return field.annotation if field else None
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is dict:
        return arguments[1]
    if origin is tuple and isinstance(part, int):
        if len(arguments) == 2 and arguments[1] is Ellipsis:
            return arguments[0]
        return arguments[part] if part < len(arguments) else None
    return None


def _choices(annotation: Any) -> list[str]:
    found: list[str] = []
    for branch in _branches(annotation):
        if typing.get_origin(branch) is Literal:
            found += [str(value) for value in typing.get_args(branch) if value != TO_CLARIFY]
        elif isinstance(branch, type) and issubclass(branch, Enum):
            found += [str(member.value) for member in branch]
    return found


def describe(annotation: Any) -> str:
    """A type in the words of the plan format."""
    return " or ".join(dict.fromkeys(_words(branch) for branch in _branches(annotation)))


def _words(annotation: Any) -> str:
    simple = {
        float: "a number",
        int: "a whole number",
        str: "text",
        bool: "true or false",
        Any: "anything",
        Plan: "a plan",
    }
    if annotation in simple:
        return simple[annotation]
    if choices := _choices(annotation):
        return f"one of {', '.join(choices)}"
    origin, arguments = typing.get_origin(annotation), typing.get_args(annotation)
    if origin is Literal:
        return " or ".join(str(value) for value in arguments)
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        needed = [name for name, field in annotation.model_fields.items() if field.is_required()]
        return "a mapping" + (f" with {', '.join(needed)}" if needed else f" of {', '.join(annotation.model_fields)}")
    if origin is dict:
        return f"a mapping from names to {_plural(describe(arguments[1]))}"
    if origin is tuple and len(arguments) == 2 and arguments[1] is Ellipsis:
        return f"a list of {_plural(describe(arguments[0]))}"
    if origin is tuple:
        return f"a list of {len(arguments)} {_plural(describe(arguments[0]))}"
    return str(annotation)


def _plural(words: str) -> str:
    plural = {"a number": "numbers", "text": "texts", "a whole number": "whole numbers", "anything": "values"}
    if words in plural:
        return plural[words]
    return words.replace("a mapping", "mappings", 1)


def _shown(value: Any) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, dict):
        return "a mapping" if value else "an empty mapping"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}" if value else "an empty list"
    if isinstance(value, bool):
        return str(value).lower()
    text = repr(value) if isinstance(value, str) else str(value)
    return text if len(text) <= 60 else text[:57] + "…"


def unsafe_numbers(path: Path, value: Any) -> Iterator[Path]:
    """Paths of whole numbers too large for a float."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from unsafe_numbers((*path, key), item)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from unsafe_numbers((*path, index), item)
    elif isinstance(value, int) and abs(value) > 2**63:
        yield path
