"""A size is off by exactly a factor of two from the plan.

What it does: compares the size of every named box, sphere, cylinder, capsule and ellipsoid with the plan's full
extents. MuJoCo's `geom size` holds half sizes and radii; `worldkit.bodies` takes full extents and diameters.

Why is this bad: an object twice as large in each direction has eight times the volume and mass, and still looks
plausible. It is the most common silent mistake with geoms.

Use instead: half of the plan's `size` in `add_geom(size=…)` and MJCF; the whole of it in `worldkit.bodies`.
"""

import ast
from collections.abc import Iterator
from math import isclose
from typing import Any

from ...case import Case
from ...harm import Measured, model_of
from ...problem import Problem
from ...program_view import Program

CODE = "WL125"
SEVERITY = "error"
SCOPE = "plan"
GEOM = "import mujoco\nspec = mujoco.MjSpec()\nb = spec.worldbody.add_body(name='crate')\n"
BALL = {"scene_objects": [{"name": "crate", "primitive": "sphere", "size": [0.2, 0.2, 0.2]}]}
GOOD = (
    GEOM + "b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.15, 0.1))\n",
    "from worldkit import bodies\nbodies.box(None, 'crate', size=(0.4, 0.3, 0.2))\n",
    Case("from worldkit import bodies\nbodies.sphere(None, 'crate', diameter=0.2)\n", BALL),
    GEOM + "b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.15, 0.05))\nb.add_geom(size=(0.4, 0.3, 0.2))\n",
)
BAD = (
    GEOM + "b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.4, 0.3, 0.2))\n",
    "from worldkit import bodies\nbodies.box(None, 'crate', size=(0.2, 0.15, 0.1))\n",
    Case("from worldkit import bodies\nbodies.sphere(None, 'crate', diameter=0.1)\n", BALL),
    'XML = \'<mujoco><worldbody><body name="crate"><geom type="box" size=".4 .3 .2"/></body></worldbody></mujoco>\'\n',
)
HALF = (
    "import mujoco\nspec = mujoco.MjSpec()\nb = spec.worldbody.add_body(name='crate')\n"
    "b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.15, 0.1))\n"
)
EVIDENCE = Measured(
    "the crate is eight times as heavy", lambda s: float(model_of(s).body_mass[1]), 50.0, "kg", good=HALF
)
HALF_SIZES = {"box": 3, "ellipsoid": 3, "sphere": 1, "cylinder": 2}
"""How many leading entries of a geom's `size` are half extents of the shape."""


def check(program: Program) -> Iterator[Problem]:
    """Check worldkit's shapes, then geoms of named bodies, then MJCF."""
    if program.plan is None:
        return
    extents = {row.name: row for row in program.plan.scene_objects if row.primitive in (*HALF_SIZES, "capsule")}
    for name, full, line, what in (*_shapes(program), *_geoms(program), *_mjcf(program)):
        row = extents.get(name)
        if row is None:
            continue
        planned = {"sphere": row.size[:1], "cylinder": (row.size[0], row.size[2])}.get(row.primitive, row.size)
        if len(planned) != len(full):
            continue
        for factor, fix in (
            (2.0, "geom sizes are half sizes: halve it"),
            (0.5, "worldkit takes full extents: double it"),
        ):
            if all(isclose(value, factor * p, rel_tol=1e-6) for value, p in zip(full, planned, strict=True)):
                text = " x ".join(f"{value:g}" for value in full)
                wanted = " x ".join(f"{value:g}" for value in planned)
                message = f"`{name}` is {text} m in full, the plan says {wanted} m: a factor of two"
                yield Problem(message, fix if factor == 2.0 or what == "worldkit" else "double it", line)


def _shapes(program: Program) -> Iterator[tuple[str, tuple[float, ...], int, str]]:
    for full, call in program.calls("worldkit.bodies."):
        name = program.value(program.argument(call, "name", 1))
        shape = full.rsplit(".", 1)[1]
        keywords = {
            "box": ("size",),
            "ellipsoid": ("size",),
            "sphere": ("diameter",),
            "cylinder": ("diameter", "height"),
        }
        values = [program.value(program.argument(call, key)) for key in keywords.get(shape, ())]
        numbers = values[0] if len(values) == 1 and isinstance(values[0], tuple) else tuple(values)
        if isinstance(name, str) and numbers and _all_numbers(numbers):
            yield name, numbers, call.lineno, "worldkit"


def _geoms(program: Program) -> Iterator[tuple[str, tuple[float, ...], int, str]]:
    """Bodies with exactly one geom: of several, none need have the size of the whole."""
    by_body: dict[ast.Call, list[ast.Call]] = {}
    for call in program.method_calls("add_geom"):
        made = _body(program, call.func.value)  # type: ignore[attr-defined]
        if made is not None:
            by_body.setdefault(made, []).append(call)
    for maker, calls in by_body.items():
        name = program.value(program.argument(maker, "name"))
        if not isinstance(name, str) or len(calls) != 1:
            continue
        kind = program.dotted(program.argument(calls[0], "type")) or ""
        shape = kind.rsplit("mjGEOM_", 1)[-1].lower()
        half = program.value(program.argument(calls[0], "size"))
        if shape in HALF_SIZES and isinstance(half, tuple) and _all_numbers(half):
            yield name, tuple(2 * v for v in half[: HALF_SIZES[shape]]), calls[0].lineno, "geom"


def _body(program: Program, node: ast.AST) -> ast.Call | None:
    """The `add_body(…)` call a variable stands for."""
    if isinstance(node, ast.Name):
        bound = program.scopes.bound(node)
        node = bound[0] if len(bound) == 1 and bound[0] is not None else node
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "add_body":
        return node
    return None


def _mjcf(program: Program) -> Iterator[tuple[str, tuple[float, ...], int, str]]:
    for tag in program.tags():
        geoms = [child for child in tag.children if child.name == "geom"]
        if tag.name != "body" or len(geoms) != 1 or "name" not in tag.attributes:
            continue
        shape = geoms[0].attributes.get("type", "sphere")
        try:
            half = tuple(float(v) for v in geoms[0].attributes.get("size", "").split())
        except ValueError:
            continue
        if shape in HALF_SIZES and len(half) >= HALF_SIZES[shape]:
            yield tag.attributes["name"], tuple(2 * v for v in half[: HALF_SIZES[shape]]), geoms[0].line, "geom"


def _all_numbers(values: Any) -> bool:
    return all(isinstance(v, int | float) and not isinstance(v, bool) for v in values)
