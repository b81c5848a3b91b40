"""Soft things of one call: a cloth held by its edges, a block, ball or drum of jelly; MuJoCo's flex with the numbers of a handbook.

    softs.add(spec, "cloth", softs.Cloth(modulus_pa=2e5, thickness_m=4e-4, held=("-x", "+x")), size=(1, 1, 0.006), pos=(0, 0, 1), mass=0.2)

As an object of a plan: `soft: {kind: cloth, modulus: cotton, thickness_m: 0.0004, held: [-x, +x]}`. They need the integrator `discrete`.
"""

from dataclasses import dataclass
from math import cos, radians, sin
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco

Vec3 = tuple[float, float, float]
SIDES = {"-x": (0, -1), "+x": (0, 1), "-y": (1, -1), "+y": (1, 1), "-z": (2, -1), "+z": (2, 1)}
CORNERS = "corners"
SHAPES = {"box": "grid", "ellipsoid": "ellipsoid", "sphere": "ellipsoid", "cylinder": "cylinder"}
"""Type of a flex by the primitive that a jelly is."""
MOST_POINTS = 41
TOUCHED_STEPS = 2.0
"""Time constant of a touch, in steps: the engine's own of 20 ms lets a ball sink centimetres into it."""
TOUCHED = (0.9, 0.999, 0.001, 0.5, 2.0)
"""Impedance of a touch: a point weighs a gram, and would give by centimetres under what weighs kilograms."""
PREVAILS = 100.0
"""Its own touch counts so much more than that of what touches it."""
OF_A_FLEX = ("friction", "condim")
"""What of a surface a soft thing has, too; how it rebounds and gives way is the matter's own doing."""


@dataclass(frozen=True)
class Cloth:
    """Cloth, paper, a sheet, a membrane: it bends and stretches; seen as thick as its `size` says."""

    modulus_pa: float
    """Young's modulus, Pa; with `thickness_m` it is the stretch stiffness (E t, N/m)."""
    thickness_m: float = 4e-4
    """Of the stuff, m."""
    poisson: float = 0.3
    damping_s: float = 0.1
    """As a time: 0.02 s flutters on, 0.1 s calms within two seconds."""
    points: int = 13
    """Along its longer side."""
    held: tuple[str, ...] = ()
    """Edges that are held where they are (`-x`, `+x`, `-y`, `+y`), or `corners`."""


@dataclass(frozen=True)
class Jelly:
    """Jelly, rubber, foam: a solid that is squashed and springs back; strains over 0.3 are beyond it."""

    modulus_pa: float
    """Young's modulus, Pa."""
    poisson: float = 0.0
    damping_s: float = 0.02
    points: int = 7
    """Along its longest side."""
    cells: int = 3
    """That stretch and shear, along its longest side."""
    held: tuple[str, ...] = ()
    """Sides that are held where they are: `-x` to `+z`."""


def _counts(size: Vec3, most: int, axes: int) -> tuple[int, ...]:
    """So many points along each side, as dense along all of them, three at least."""
    longest = max(size[:axes])
    return tuple(max(3, round((most - 1) * extent / longest) + 1) for extent in size[:axes])


def add(
    spec: "mujoco.MjSpec",
    name: str,
    soft: Cloth | Jelly,
    *,
    size: Vec3,
    pos: Vec3,
    mass: float,
    shape: str = "box",
    yaw_deg: float = 0.0,
    look: str = "plastic_white",
    surface: dict[str, Any] | None = None,
) -> "mujoco.MjsFlex":
    """Add a soft thing whose box has full extents `size` and its middle at `pos`, m, in the world; `mass` is of the whole, kg.

    Its points are the bodies `NAME_0` … of a cloth, its nodes `NAME_0_0_0` … of a jelly.

    Args:
        shape: of a jelly: box, ellipsoid, sphere or cylinder.

    Raises:
        ValueError: a name that is taken, too many points, a side that it does not have, or nothing that it weighs.
    """
    import mujoco

    from . import materials

    if name in {flex.name for flex in spec.flexes} or spec.body(name) is not None:
        raise ValueError(f"there is something called {name!r} already: name this soft thing otherwise")
    if not mass > 0:
        raise ValueError(f"{name} weighs {mass} kg: a soft thing needs a mass above 0")
    if not 3 <= soft.points <= MOST_POINTS:
        raise ValueError(f"{name} has {soft.points} points along a side: 3 to {MOST_POINTS}")
    turn = radians(yaw_deg) / 2
    common: dict[str, Any] = {"mass": mass, "pos": pos, "quat": (cos(turn), 0.0, 0.0, sin(turn))}
    if isinstance(soft, Cloth):
        if shape != "box":
            raise ValueError(f"{name}: a cloth is flat and square-cut; its shape is `box`, not `{shape}`")
        radius, counts = size[2] / 2, _counts(size, soft.points, 2)
        spans = [extent - 2 * radius for extent in size[:2]]
        if min(spans) <= 0:
            raise ValueError(f"{name} measures {size} m: a cloth is thinner than it is wide")
        spacing = (*(span / (n - 1) for span, n in zip(spans, counts, strict=True)), 1.0)
        if min(spacing) <= size[2]:
            raise ValueError(
                f"{name}: its points lie {1000 * min(spacing):.3g} mm apart, and it is {1000 * size[2]:g} mm thick: make it thinner "
                "(its third extent is only seen), or give it fewer `points`"
            )
        flex = spec.worldbody.make_flex(
            name, type="grid", dim=2, count=(*counts, 1), spacing=spacing, radius=radius, elastic2d=3, **common
        )
        flex.thickness = soft.thickness_m
    else:
        if shape not in SHAPES:
            raise ValueError(f"{name}: a jelly is a {', '.join(SHAPES)}, not a `{shape}`")
        counts, cells = _counts(size, soft.points, 3), _counts(size, soft.cells + 1, 3)
        spacing = tuple(extent / (n - 1) for extent, n in zip(size, counts, strict=True))
        flex = spec.worldbody.make_flex(
            name, type=SHAPES[shape], dim=3, dof="trilinear", count=counts, cellcount=tuple(max(1, n - 1) for n in cells),
            spacing=spacing, **common,
        )  # fmt: skip
    flex.young, flex.poisson, flex.damping = soft.modulus_pa, soft.poisson, soft.damping_s
    flex.solref, flex.solimp, flex.solmix = (TOUCHED_STEPS * spec.option.timestep, 1.0), TOUCHED, PREVAILS
    flex.selfcollide = mujoco.mjtFlexSelf.mjFLEXSELF_NONE
    flex.material = [materials.add(spec, look)]
    for key, value in (surface or {}).items():
        if key in OF_A_FLEX:
            setattr(flex, key, value)
    _hold(spec, name, soft, counts)
    return flex


def _hold(spec: "mujoco.MjSpec", name: str, soft: Cloth | Jelly, counts: tuple[int, ...]) -> None:
    """Take the joints of the points of what holds it: a point without joints stays where it is."""
    flat = isinstance(soft, Cloth)
    its = [*(word for word, (axis, _) in SIDES.items() if axis < len(counts)), *([CORNERS] if flat else [])]
    if unknown := [word for word in soft.held if word not in its]:
        raise ValueError(f"{name} is held by {unknown[0]!r}: it has {', '.join(its)}")
    if not soft.held:
        return
    places = {
        body: (tuple(divmod(index[0], counts[1])) if flat else index)
        for body in spec.bodies
        if body.joints and len(index := _index(body.name, name)) == (1 if flat else 3)  # of `flag`, not of `flag_2`
    }
    ends = [max(place[axis] for place in places.values()) for axis in range(len(counts))]
    sides = [SIDES[word] for word in soft.held if word != CORNERS]
    for body, place in places.items():
        corner = all(at in (0, end) for at, end in zip(place, ends, strict=True))
        if (corner and CORNERS in soft.held) or any(
            place[axis] == (0 if way < 0 else ends[axis]) for axis, way in sides
        ):
            for joint in list(body.joints):
                spec.delete(joint)


def _index(body: str, name: str) -> tuple[int, ...]:
    """Which point of a soft thing a body is; nothing if it is none of its points."""
    parts = body.removeprefix(f"{name}_").split("_")
    return tuple(map(int, parts)) if body.startswith(f"{name}_") and all(part.isdigit() for part in parts) else ()
