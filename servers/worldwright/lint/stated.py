"""What a program states about its world, and where: time step, gravity, duration, cameras, sizes."""

import ast
from collections.abc import Iterator
from typing import Any

from .program_view import UNKNOWN, Program

Place = tuple[Any, int, ast.AST | None]
"""A value, its line, and the node it was read from (None inside MJCF)."""


def time_steps(program: Program) -> Iterator[Place]:
    """Every time step the program sets, in seconds."""
    for _, call in program.calls("worldkit.scene.new"):
        yield from _known_value(program, program.argument(call, "time_step"))
    yield from _stored(program, "timestep")
    for tag in program.tags():
        if tag.name == "option" and "timestep" in tag.attributes:
            yield from _numbers(tag.attributes["timestep"], tag.line, 1)


def gravities(program: Program) -> Iterator[Place]:
    """Every gravity vector the program sets, m/s^2 in the world frame."""
    for _, call in program.calls("worldkit.scene.new"):
        yield from _known_value(program, program.argument(call, "gravity"))
    yield from _stored(program, "gravity")
    for tag in program.tags():
        if tag.name == "option" and "gravity" in tag.attributes:
            yield from _numbers(tag.attributes["gravity"], tag.line, 3)


def durations(program: Program) -> Iterator[Place]:
    """Every duration handed to the runtime, in seconds."""
    for _, call in program.calls("worldkit.program.main"):
        yield from _known_value(program, program.argument(call, "duration"))


def named(program: Program, tag: str, *functions: str) -> set[str] | None:
    """Names given to the second argument of worldkit functions or to MJCF elements; None when some cannot be known."""
    found = {t.attributes["name"] for t in program.tags() if t.name == tag and "name" in t.attributes}
    for _, call in program.calls(*functions):
        value = program.value(program.argument(call, "name", 1))
        if not isinstance(value, str):
            return None
        found.add(value)
    return found


def _stored(program: Program, field: str) -> Iterator[Place]:
    """Values assigned to `<anything>.option.<field>` or `<anything>.opt.<field>`."""
    for target, value, _ in program.stores():
        if not (isinstance(target, ast.Attribute) and target.attr == field):
            continue
        if isinstance(target.value, ast.Attribute) and target.value.attr in ("option", "opt"):
            yield from _known_value(program, value)


def _known_value(program: Program, node: ast.AST | None) -> Iterator[Place]:
    value = program.value(node)
    if node is not None and value is not UNKNOWN:
        yield value, getattr(node, "lineno", 1), node


def _numbers(text: str, line: int, count: int) -> Iterator[Place]:
    try:
        values = tuple(float(part) for part in text.split())
    except ValueError:
        return
    if len(values) == count:
        yield values[0] if count == 1 else values, line, None
