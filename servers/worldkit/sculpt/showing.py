"""The author's process of a sheet: `python -m worldkit.sculpt.showing FILE.py --name NAME --out DIR`.

It runs an author's file, takes a shape, a solid, parts or a whole world from it, and leaves a small world to be drawn from four
sides (`world.mjz`, `program.json`) and what it measured (`sheet.json`); or `error.json` and status 1.
"""

import argparse
import runpy
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ProgramError
from . import from_files
from .figure import assemble, box_around
from .marching import CELLS
from .signed import Array, Shape

if TYPE_CHECKING:
    import mujoco

FACTS = "sheet.json"
FOV_DEG, ASPECT = 24.0, 4 / 3
SIDES = {
    "front_plus_x": (1.0, 0.0, 0.18),
    "three_quarters": (0.8, -0.65, 0.4),
    "side_minus_y": (0.0, -1.0, 0.12),
    "back_minus_x": (-1.0, 0.12, 0.25),
}
"""Where the cameras stand, seen from the middle; +x is the front."""


def main(argv: Sequence[str] | None = None) -> int:
    """Lay out a sheet; returns the exit status."""
    from ..files import write_json
    from ..reporting import report_failure

    parser = argparse.ArgumentParser(description="Lay out a sculpted thing to be drawn from four sides.")
    parser.add_argument("program", type=Path)
    parser.add_argument("--name", default="")
    parser.add_argument("--root", type=Path, help="the run folder, where the file lies deeper in it")
    parser.add_argument("--out", type=Path, required=True)
    options = parser.parse_args(argv)
    program = str(options.program)
    try:
        if options.root:
            sys.path.insert(0, str(options.root))
        with from_files.beside(options.program):
            held = runpy.run_path(program)
            name = options.name or chosen(held)
            if name not in held:
                known = ", ".join(from_files.names(held)) or "nothing that can be drawn"
                raise ProgramError(f"there is no {name!r} in it", options.program.name, f"it has: {known}")
            began = time.perf_counter()
            spec, facts = shown(name, held[name], held.get("paint"))
        facts["made_s"] = round(time.perf_counter() - began, 2)
        _write(spec, options.out)
        write_json(options.out / FACTS, facts)
        write_json(options.out / "result.json", {"ok": True, "pass": "sheet", "name": name})
    except Exception as error:  # author code may raise anything
        report_failure(error, program, 1, options.out)
        return 1
    return 0


def chosen(held: dict[str, Any]) -> str:
    """What is drawn of a file when nobody says: the last thing in it that is sculpted, else its `build`."""
    if not from_files.names(held) and callable(held.get("build")):
        return "build"
    return from_files.last(held)


def shown(name: str, value: Any, paint: Any = None) -> "tuple[mujoco.MjSpec, dict[str, Any]]":
    """A world with one thing on the floor and four cameras around it, and what was measured of it.

    Args:
        name: what it is called.
        value: one of `from_files.KINDS`, or a function that gives a whole world.
        paint: of a bare shape.

    Raises:
        ProgramError: it is none of them.
    """
    import mujoco

    from .. import scene

    if callable(value) and not isinstance(value, Shape):
        value = value()
    if isinstance(value, mujoco.MjSpec):
        model = value.compile()
        low, high = _bounds(model)
        _cameras(value, low, high)
        return value, {"name": name, "extent_m": _round(high - low), **_weight(model)}
    value = from_files.parts_of(name, value, paint)
    solids = {part.name: part.made() for part in value}
    low, high = box_around(value)
    spec = scene.new("sheet", time_step=0.01, setting="studio", floor="#8f8a84")
    middle = (low + high) / 2
    assemble(spec, value, pos=(0.0, 0.0, float(high[2] - low[2]) / 2), origin=tuple(middle), fixed=True)
    _cameras(spec, np.array([*(low - middle)[:2], 0.0]), np.array([*(high - middle)[:2], high[2] - low[2]]))
    model = spec.compile()
    rows = [
        {
            "name": part.name,
            "extent_m": _round(solid.high - solid.low),
            "volume_l": round(1000 * solid.volume, 4),
            "mass_kg": round(float(model.body(part.name).mass[0]), 4),
            "triangles": len(solid.faces),
            "cells": part.make.get("cells", CELLS) if isinstance(part.shape, Shape) else 0,
            "hulls": len(solid.hulls),
            "bits": solid.bits,
        }
        for part, solid in ((part, solids[part.name]) for part in value)
    ]
    return spec, {"name": name, "extent_m": _round(high - low), **_weight(model), "parts": rows}


def _weight(model: "mujoco.MjModel") -> dict[str, Any]:
    return {"bodies": model.nbody - 1, "mass_kg": round(float(model.body_mass.sum()), 4)}


def _round(values: Array) -> list[float]:
    return [round(float(v), 4) for v in values]


def _bounds(model: "mujoco.MjModel") -> tuple[Array, Array]:
    """Corners (3,), m, of the box around all geoms that have an end, at the start."""
    import mujoco

    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    geoms = [g for g in range(model.ngeom) if model.geom_rbound[g] > 0]
    if not geoms:
        raise ProgramError("there is nothing in this world to draw", "", "add a body first")
    clouds = [_corners(model, g) @ data.geom_xmat[g].reshape(3, 3).T + data.geom_xpos[g] for g in geoms]
    return np.concatenate(clouds).min(axis=0), np.concatenate(clouds).max(axis=0)


def _corners(model: "mujoco.MjModel", geom: int) -> Array:
    """Points (N, 3), m, that bound a geom in its frame: a mesh's vertices, else the corners of its box."""
    import mujoco

    mesh = int(model.geom_dataid[geom])
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH and mesh >= 0:
        start = int(model.mesh_vertadr[mesh])
        return np.asarray(model.mesh_vert[start : start + int(model.mesh_vertnum[mesh])], dtype=float)
    centre, half = model.geom_aabb[geom, :3], model.geom_aabb[geom, 3:]
    signs = np.array([[n & 1, n >> 1 & 1, n >> 2 & 1] for n in range(8)]) * 2 - 1
    return np.asarray(centre + signs * half)


def _cameras(spec: "mujoco.MjSpec", low: Array, high: Array) -> None:
    from .. import cameras

    middle, half = (low + high) / 2, (high - low) / 2
    corners = (np.array([[n & 1, n >> 1 & 1, n >> 2 & 1] for n in range(8)]) * 2 - 1) * half
    tall = np.tan(np.radians(FOV_DEG / 2))
    for name, way in SIDES.items():
        back = np.array(way) / np.linalg.norm(way)
        side = np.cross((0.0, 0.0, 1.0), back)
        side /= np.linalg.norm(side)
        up = np.cross(back, side)
        needed = corners @ back + np.maximum(np.abs(corners @ up), np.abs(corners @ side) / ASPECT) / tall
        ex, ey, ez = map(float, middle + 1.08 * back * needed.max())
        mx, my, mz = map(float, middle)
        cameras.add(spec, name, position=(ex, ey, ez), target=(mx, my, mz), fovy=FOV_DEG)


def _write(spec: "mujoco.MjSpec", out: Path) -> None:
    """The world and what the engine's process wants to know of it."""
    from .. import asked

    build: Callable[[], Any] = lambda: spec  # noqa: E731
    asked.Asked(build, None, 0.01, 24, (960, 720), (), 0, (), 1, 0, None).write(out)


if __name__ == "__main__":
    sys.exit(main())
