"""What a plan is made of: primitives with a size, compounds of them, and catalog assets.

Full extents in metres along the object's own axes (z up, +X front); see `plan` for the frame and for who owns which number.
"""

import math
from typing import TYPE_CHECKING, Any, Literal

from pydantic import Field, field_validator, model_validator

from worldkit.parts import Whole, laid_out, plus, rotation, turned

from ..frozen import Frozen
from . import soft_rows
from .arm_rows import Picks
from .breakage import Breaks
from .flight_rows import Flies
from .formed import BY_POINTS, NUMBERS, foreign, form
from .object_parts import ObjectPart, Vec3
from .plant_rows import Plant
from .soft_rows import Soft
from .vehicle_rows import Vehicle
from .walking_rows import Walks

if TYPE_CHECKING:
    from worldkit.forms import Form

Primitive = Literal[
    "box", "sphere", "cylinder", "capsule", "ellipsoid", "plane", "box_container", "compound",
    "cone", "torus", "wedge", "rounded_box", "lathe", "tube", "hill",
]  # fmt: skip
AGREES_M = 1e-3
"""How far the `size` of a compound may be from the box around its parts, or that of a lathe from its points."""


def _tupled(value: Any) -> Any:
    """Lists as tuples: behind a `before` validator, pydantic takes JSON for Python, where a list is strictly no tuple."""
    if isinstance(value, dict):
        return {key: _tupled(item) for key, item in value.items()}
    return tuple(_tupled(item) for item in value) if isinstance(value, list | tuple) else value


def tilted(primitive: str, size: Vec3, deg_x: float) -> Vec3:
    """Full extents of a primitive's bounding box when it is turned about its own x by `deg_x` degrees.

    With c = |cos deg_x| and s = |sin deg_x|: a box takes size_y c + size_z s along y; an ellipsoid twice the root of
    (r_y c)^2 + (r_z s)^2; a cylinder of radius r takes height s + 2 r c; a capsule (height - 2 r) s + 2 r.
    Along z the same with c and s exchanged.
    """
    x, y, z = size
    turn = deg_x % 180
    c, s = abs(math.cos(math.radians(turn))), math.sin(math.radians(turn))
    c, s = (0.0, 1.0) if turn == 90 else (1.0, 0.0) if turn == 0 else (c, s)
    if primitive == "cylinder":
        return (x, z * s + y * c, z * c + y * s)
    if primitive == "capsule":
        return (x, (z - x) * s + x, (z - x) * c + x)
    if primitive in ("sphere", "ellipsoid"):
        return (x, math.hypot(y * c, z * s), math.hypot(y * s, z * c))
    return (x, y * c + z * s, y * s + z * c)


class SceneObject(Frozen):
    """A procedural primitive, a form of `worldkit.forms`, or a generated boundary."""

    name: str
    role: str = ""
    construction_source: Literal["procedural_primitive", "generated_boundary"] = "procedural_primitive"
    primitive: Primitive
    size: Vec3
    """Full extents in metres along the object's own x, y, z (never half extents); of a compound the box around its parts,
    of a lathe, a tube and a hill that around its points: then it may be left out."""
    count: int = Field(1, ge=1, le=2_000)
    """So many of it, called `name_1` … `name_N`; rows about `name` are about each, `spread` tells them apart."""
    parts: tuple[ObjectPart, ...] = ()
    """The primitives that together are one rigid body, of a `compound`."""
    wall_thickness: float | None = Field(None, gt=0)
    """Metres, of a `box_container`; a `lathe` with it is a vessel, a `tube` a pipe."""
    profile: tuple[tuple[float, float], ...] = ()
    """Of a `lathe` (radius, height), of a `hill` (x, height), metres, in order."""
    path: tuple[Vec3, ...] = ()
    """Of a `tube`: points of its middle line, metres; where they are measured from does not matter."""
    diameter: float | None = Field(None, gt=0)
    """Metres, outside, of a `tube`."""
    top_diameter: float | None = Field(None, gt=0)
    """Metres, of a `cone` that is cut off."""
    radius: float | None = Field(None, gt=0)
    """Metres, of the edges of a `rounded_box`."""
    width: float | None = Field(None, gt=0)
    """Metres along y, of a `hill`."""
    smooth: int = Field(0, ge=0, le=24)
    """Points put between each two of `profile` or `path`, on a smooth curve through them."""
    breaks: Breaks | None = None
    """How it breaks, if it can: its pieces are called `name_1` … `name_N`."""
    soft: Soft | None = None
    """How it is soft, if it is: cloth or jelly."""
    deg_x: float = Field(0.0, ge=-180, le=180)
    """Tilt about its own x, degrees, before any yaw: 90 lays a cylinder along y. Not for containers and planes."""
    hollow: bool = False
    """All of its mass in its surface, as of a football; needs `masses`. Of one primitive only."""
    fixed: bool = False
    dynamic: bool = True
    material: str | None = None
    """Key into `simulation_parameters.materials`."""
    look: str | None = None
    """Name of a worldkit look, e.g. `wood_oak`; `#rrggbb`; or `clear #rrggbb 10mm`, clear and of that colour so deep."""
    visual_only: str | None = None
    """Why the object is drawn without being simulated, when it is."""
    built: bool = False
    """Written down from the program's world by `worldwright plan complete`; nobody claimed it before."""
    description: str = ""

    @model_validator(mode="before")
    @classmethod
    def _sized_by_parts(cls, data: Any) -> Any:
        """Give what has no size of its own that of its parts or points; their problems are reported by their own fields."""
        if not isinstance(data, dict) or "size" in data or data.get("primitive") not in ("compound", *BY_POINTS):
            return _tupled(data)
        try:
            if data["primitive"] in BY_POINTS:
                return _tupled({**data, "size": form(data["primitive"], data).extents})
            parts = [ObjectPart.model_validate(row) for row in data.get("parts") or ()]
            size = laid_out(str(data.get("name")), [row.part() for row in parts]).extents
        except (ValueError, TypeError):
            size = (1.0, 1.0, 1.0)
        return _tupled({**data, "size": size})

    @field_validator("size")
    @classmethod
    def _positive(cls, value: Vec3) -> Vec3:
        if not all(0 < extent < float("inf") for extent in value):
            raise ValueError(f"every extent must be a positive, finite number of metres, got {value}")
        return value

    @model_validator(mode="after")
    def _walled(self) -> "SceneObject":
        if (self.primitive == "box_container") > (self.wall_thickness is not None):
            raise ValueError("a box_container needs `wall_thickness`")
        if self.wall_thickness is not None and self.primitive not in ("box_container", "lathe", "tube"):
            raise ValueError("`wall_thickness` is of a box_container, a lathe or a tube")
        if self.hollow and self.primitive in ("box_container", "plane", "compound", *NUMBERS):
            raise ValueError(f"a {self.primitive} has no one surface to be hollow in: remove `hollow`")
        if self.deg_x and self.primitive in ("box_container", "plane"):
            raise ValueError(f"a {self.primitive} cannot be tilted: remove `deg_x`")
        if self.soft is not None:
            soft_rows.fits(self)
        return self

    @model_validator(mode="after")
    def _of_parts(self) -> "SceneObject":
        if (self.primitive == "compound") != bool(self.parts):
            raise ValueError("`parts` are needed by a compound, and only by it: a list of at least one primitive")
        if self.parts:
            box = self.whole(0.0).extents
            if max(abs(a - b) for a, b in zip(box, self.size, strict=True)) > AGREES_M:
                told = ", ".join(f"{extent:g}" for extent in box)
                raise ValueError(
                    f"the box around its parts measures [{told}] m, not {list(self.size)}: leave `size` out"
                )
        return self

    @model_validator(mode="after")
    def _of_points(self) -> "SceneObject":
        if others := foreign(self.primitive, vars(self)):
            raise ValueError(f"a {self.primitive} has no {' and no '.join(f'`{key}`' for key in others)}: remove it")
        if self.formed:
            box = self.form(0.0).extents
            if max(abs(a - b) for a, b in zip(box, self.size, strict=True)) > AGREES_M:
                told = ", ".join(f"{extent:g}" for extent in box)
                raise ValueError(f"the box around it measures [{told}] m, not {list(self.size)}: leave `size` out")
        return self

    @property
    def formed(self) -> bool:
        """Whether it is a form of `worldkit.forms`: a mesh that collides as convex pieces."""
        return self.primitive in NUMBERS

    def form(self, deg_x: float | None = None) -> "Form":
        """Its shape in the frame of the box around it, by default after its tilt; of a form only."""
        return form(self.primitive, vars(self), self.deg_x if deg_x is None else deg_x)

    @property
    def instances(self) -> tuple[str, ...]:
        """Object names: `name` alone, or `name_1` … `name_N`."""
        count = self.breaks.pieces if self.breaks is not None else self.count
        return (self.name,) if count == 1 else tuple(f"{self.name}_{i + 1}" for i in range(count))

    def whole(self, deg_x: float | None = None) -> Whole:
        """The parts of a compound in the frame of their box, by default after its tilt."""
        return laid_out(self.name, [row.part() for row in self.parts], self.deg_x if deg_x is None else deg_x)

    @property
    def tilt_shift(self) -> Vec3:
        """Where the centre of its own box lies from that of the box after its tilt, metres; nil for primitives."""
        if self.formed and self.deg_x:
            ax, ay, az = turned(rotation(self.deg_x), _vector(self.form(0.0).shift))
            return plus(_vector(self.form().shift), (-ax, -ay, -az))
        if not self.parts or not self.deg_x:
            return (0.0, 0.0, 0.0)
        x, y, z = turned(rotation(self.deg_x), self.whole(0.0).shift)
        return plus(self.whole().shift, (-x, -y, -z))

    @property
    def extents(self) -> Vec3:
        """Full extents of its bounding box along its own x, y, z after the tilt, metres."""
        if self.parts:
            return self.whole().extents
        if self.formed:
            return self.form().extents if self.deg_x else self.size
        return self.size if not self.deg_x else tilted(self.primitive, self.size, self.deg_x)


def _vector(values: Any) -> Vec3:
    x, y, z = (float(v) for v in values)
    return (x, y, z)


class AssetRow(Frozen):
    """A catalog mesh, a model, something sculpted, a vehicle, a plant or a surveyed road, `count` times."""

    name: str
    type: Literal["mesh", "mjcf", "urdf", "sculpt", "vehicle", "plant", "road"] = "mesh"
    filename: str
    """The exact catalog key; of an mjcf or urdf the file, relative to the plan's folder or the catalog; of a sculpt the file
    beside the plan that makes it, `sculpt/vase.py` or `sculpt/vase.py:NAME`; a vehicle or plant has none: its kind stands for it; of a
    road an OpenCRG file beside the plan."""
    vehicle: Vehicle | None = None
    """What it is and how it is driven, of a vehicle."""
    plant: Plant | None = None
    """What it is, of a plant, whose root is held."""
    walks: Walks | None = None
    """The policy that walks it, of an mjcf or urdf."""
    picks: Picks | None = None
    """What it picks up and where it puts it, of an mjcf that is an arm."""
    flies: Flies | None = None
    """Where it flies, of an mjcf that is a drone."""
    size: Vec3 | None = None
    """Full extents in metres of a sculpt: what the plan claims, and the file is held to. Of nothing else."""
    count: int = Field(1, ge=1, le=10_000)
    fixed: bool = False
    is_dynamic: bool = True
    material: str | None = None
    """Key into `simulation_parameters.materials`; None: the catalog's own constants."""
    look: str | None = None

    @model_validator(mode="before")
    @classmethod
    def _of_its_kind(cls, data: Any) -> Any:
        """A vehicle or plant is called after its kind where others name a file; a road never moves, nor does a plant's root."""
        if not isinstance(data, dict):
            return _tupled(data)
        of = data.get("type")
        held = {"fixed": True} if of in ("road", "plant") else {}
        if of not in ("vehicle", "plant"):
            return _tupled({**held, **data})
        told = data.get(of)
        kind = str(told.get("kind", "") if isinstance(told, dict) else getattr(told, "kind", ""))
        if data.get("filename", kind) != kind:
            raise ValueError(f"a {of} is made of its kind and its numbers, and reads no file: remove `filename`")
        return _tupled({**held, **data, "filename": kind})

    @model_validator(mode="after")
    def _as_a_road(self) -> "AssetRow":
        if self.type == "road" and (not self.fixed or self.count > 1 or self.look):
            raise ValueError(
                "a road is one, fixed, and asphalt with grass beside it: remove `fixed`, `count` and `look`"
            )
        return self

    @model_validator(mode="after")
    def _as_a_vehicle(self) -> "AssetRow":
        if (self.type == "vehicle") != (self.vehicle is not None):
            raise ValueError("`type: vehicle` and `vehicle: {kind: car, …}` go together")
        if self.vehicle is not None and (self.fixed or not self.is_dynamic or self.material):
            raise ValueError(
                "a vehicle rolls, and its tyres' friction is one of its `numbers`: remove `fixed`, `is_dynamic` and `material`"
            )
        return self

    @model_validator(mode="after")
    def _as_a_plant(self) -> "AssetRow":
        if (self.type == "plant") != (self.plant is not None):
            raise ValueError("`type: plant` and `plant: {kind: bough}` (or tree, bush) go together")
        if self.plant is not None and not self.fixed:
            raise ValueError("the root of a plant is held: remove `fixed`")
        return self

    @model_validator(mode="after")
    def _on_its_feet(self) -> "AssetRow":
        if self.walks is not None and (self.type not in ("mjcf", "urdf") or self.fixed or not self.is_dynamic):
            raise ValueError("what `walks` is a model (`type: mjcf` or `urdf`) that is free to move: remove `fixed`")
        if self.flies is not None and (self.type != "mjcf" or self.fixed or self.count > 1):
            raise ValueError(
                "what `flies` is one model (`type: mjcf`) that is free to move: remove `fixed` and `count`"
            )
        if self.picks is not None and (self.type != "mjcf" or not self.fixed or self.count > 1):
            raise ValueError(
                "what `picks` is one model (`type: mjcf`) whose base stands: say `fixed: true`, no `count`"
            )
        if sum(told is not None for told in (self.walks, self.picks, self.flies)) > 1:
            raise ValueError("a robot does one of `walks`, `picks` and `flies`")
        return self

    @model_validator(mode="after")
    def _sized(self) -> "AssetRow":
        if (self.type == "sculpt") != (self.size is not None):
            raise ValueError(
                "a sculpt needs `size: [x, y, z]`, its full extents in metres: `worldwright sculpt sheet FILE` tells them"
                if self.size is None
                else f"`size` is of a sculpt; a {self.type} has its own, or a height in asset_dimensions: remove it"
            )
        if self.size is not None and not all(0 < extent < float("inf") for extent in self.size):
            raise ValueError(f"every extent must be a positive, finite number of metres, got {self.size}")
        return self

    @property
    def sculpted(self) -> tuple[str, str]:
        """Of a sculpt: the file that makes it, and the name of it in there, if one is given."""
        file, _, of = self.filename.partition(":")
        return file, of

    @property
    def instances(self) -> tuple[str, ...]:
        """Object names: `name` alone, or `name_1` … `name_N`."""
        return (self.name,) if self.count == 1 else tuple(f"{self.name}_{i + 1}" for i in range(self.count))
