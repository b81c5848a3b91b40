"""Find how big things are and where things rest on them; only this module asks the catalog.

Scene objects own their `size` (full extents). Assets are scaled uniformly from the catalog to the height that
`asset_dimensions` gives them.
"""

from collections.abc import Iterator
from dataclasses import replace

from ..model.errors import PlanError
from ..model.plan.committed import AssetRow, Plan, SceneObject
from ..model.plan.imported import is_model, is_road, is_sculpt, load, road_box, sculpture
from ..model.plan.object_parts import Vec3
from . import compounds, formed_boxes
from .anchors import Box, Surface, no_surface

AGREES = 0.01
"""A given height may differ from a model's own by this share."""
Unsized = tuple[str, str, tuple[str | int, ...]]
"""(cause, fix, path in the plan) of an object without a size."""


def boxes(plan: Plan) -> tuple[dict[str, Box], dict[str, Unsized]]:
    """Every object of the plan as an unplaced box, and the reasons for those without a size."""
    found: dict[str, Box] = {}
    unsized: dict[str, Unsized] = {}
    for row in plan.scene_objects:
        found.setdefault(row.name, _primitive(row))
    for index, asset in enumerate(plan.assets):
        try:
            made = _asset(plan, asset)
        except _UnknownSizeError as error:
            unsized |= dict.fromkeys(asset.instances, (error.cause, error.fix, ("assets", index, *error.path)))
            continue
        for name in asset.instances:
            found.setdefault(name, replace(made, name=name))
    return found, unsized


class _UnknownSizeError(Exception):
    def __init__(self, cause: str, fix: str, *path: str) -> None:
        super().__init__(cause)
        self.cause = cause
        self.fix = fix
        self.path = path


def _primitive(row: SceneObject) -> Box:
    if row.formed:
        return formed_boxes.box(row)
    sx, sy, sz = row.size
    ellipse = row.primitive in ("sphere", "cylinder", "capsule", "ellipsoid")
    surfaces = [Surface("top", sz, (sx, sy), shape="ellipse" if ellipse else "rectangle")]
    if row.wall_thickness is not None:
        inner = (max(sx - 2 * row.wall_thickness, 0.0), max(sy - 2 * row.wall_thickness, 0.0))
        surfaces.insert(0, Surface("inside", row.wall_thickness, inner))
    known = {surface.name: surface for surface in surfaces}

    def surface(name: str | None) -> Surface:
        if name is None:
            return surfaces[0]
        if name not in known:
            raise KeyError(f"{row.name} has no surface {name!r}; it has: {', '.join(known)}")
        return known[name]

    if row.parts:
        return compounds.box(row)
    floor = row.construction_source == "generated_boundary" and row.wall_thickness is not None
    if row.deg_x:
        return _tilted(row)
    shape = ellipse and sx == sy
    return Box(row.name, row.size, round=shape, surface=surface, surfaces=lambda: surfaces, floor_datum=floor)


def _tilted(row: SceneObject) -> Box:
    """The box around a tilted primitive; only a box that lies on another of its faces has a level top."""
    extents = row.extents
    level = row.primitive == "box" and row.deg_x % 90 == 0
    top = Surface("top", extents[2], extents[:2])

    def surface(name: str | None) -> Surface:
        if not level:
            raise KeyError(f"{row.name} is tilted by {row.deg_x:g} deg and has no level surface")
        if name not in (None, "top"):
            raise KeyError(f"{row.name} has no surface {name!r}; it has: top")
        return top

    ball = row.primitive == "sphere"
    return Box(row.name, extents, round=ball, surface=surface, surfaces=lambda: [top] if level else [])


def _asset(plan: Plan, row: AssetRow) -> Box:
    if is_model(row):
        return _model(plan, row)
    if is_sculpt(row):
        return _sculpt(plan, row)
    if is_road(row):
        try:
            low, high = road_box(row, plan.folder)
        except PlanError as error:
            raise _UnknownSizeError(error.cause, error.next_move, "filename") from error
        return _boxed(row.name, (high[0] - low[0], high[1] - low[1], high[2] - low[2]))
    if (told := row.vehicle or row.plant) is not None:
        return _boxed(row.name, told.made().extents)
    from worldkit import assets

    if row.name not in plan.asset_dimensions:
        raise _UnknownSizeError(
            f"asset `{row.name}` has no height", f"add `- {row.name}: <height in metres>` under asset_dimensions"
        )
    height = plan.asset_dimensions[row.name]
    try:
        entry = assets.find(row.filename)
        size = entry.extents(height)
    except (assets.UnknownAssetError, assets.AssetError, ValueError, OSError) as cause:
        fix = "name a catalog key (`worldwright retrieve find-asset`), or use a scene object with a size"
        raise _UnknownSizeError(str(cause), fix, "filename") from cause

    def surface(name: str | None) -> Surface:
        try:
            support = entry.support(name, height=height)
        except KeyError as cause:
            raise KeyError(f"{row.name}: {cause.args[0]}") from cause
        return Surface(support.name, support.z, support.extents, support.centre, support.shape)

    def surfaces() -> list[Surface]:
        names = dict.fromkeys([None, "top", *(row.name for row in entry.supports)])
        return list({found.name: found for found in map(surface, names)}.values())

    pieces = entry.collision
    ball = len(pieces) == 1 and pieces[0].type == "sphere"
    return Box(row.name, size, round=ball, surface=surface, surfaces=surfaces)


def _model(plan: Plan, row: AssetRow) -> Box:
    """The box around a model's rest pose; a model is metric, so a given height must agree with it."""
    try:
        size = load(row, plan.folder).extents
    except PlanError as error:
        raise _UnknownSizeError(error.cause, error.next_move, "filename") from error
    height = plan.asset_dimensions.get(row.name, size[2])
    if abs(height - size[2]) > AGREES * size[2]:
        raise _UnknownSizeError(
            f"{row.filename} is {size[2]:g} m high as it stands there, not {height:g} m",
            f"remove `{row.name}` from asset_dimensions: the file owns its size, and is not scaled",
        )
    return _boxed(row.name, size)


def _sculpt(plan: Plan, row: AssetRow) -> Box:
    """The box that the plan claims of what a file makes; lint holds the built world against it."""
    try:
        sculpture(row, plan.folder)
    except PlanError as error:
        raise _UnknownSizeError(error.cause, error.next_move, "filename") from error
    assert row.size is not None  # a row of this type has one
    return _boxed(row.name, row.size)


def _boxed(name: str, size: Vec3) -> Box:
    """A box that things stand on by its top."""
    top = Surface("top", size[2], size[:2])
    return Box(
        name, size, surface=lambda asked: top if asked in (None, "top") else no_surface(asked), surfaces=lambda: [top]
    )


def fixed_objects(plan: Plan) -> Iterator[str]:
    """Objects without a joint of their own to the world, which are scenery."""
    yield from (row.name for row in plan.scene_objects if row.fixed or not row.dynamic or row.visual_only)
    yield from (name for row in plan.assets if row.fixed or not row.is_dynamic for name in row.instances)
