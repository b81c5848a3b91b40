"""Fragments as bodies of a world, held together by welds that remember their section and their strength.

A weld is as stiff as the time step resolves: what one step finds open the next has closed (`-1 / h^2`, `-1 / h`), and its impedance
falls with its section, so that a small bond carries a small share. Its section, strength and place in the list of
equalities stand in the model (`numeric` fields), where `let_go` reads them.
"""

from typing import TYPE_CHECKING, Any

from .. import bodies
from ..joints import Vec3
from .strengths import Brittle, material

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .fragments import Fragments
    from .section import Section

FIELD = "bonds of "
"""A tuple of this name and the thing's lists the equalities (1: a hold, 0: between pieces), a numeric field holds `WIDTH` numbers for each."""
WIDTH = 14
"""Nine of its axes in the frame of the second body, area, three moduli, strength: m^2, m^3, Pa."""
YIELDING = 1e-4
"""One minus the impedance of the widest bond: the engine's own bound."""
HARD = (0.999, 0.9999, 0.001, 0.5, 2.0)
"""Impedance of the contacts of pieces, which counts a hundred times that of what they touch."""
GRIPS = 1e6
"""Section moduli of a hold, m^3: a bead or a clamp lets go by force alone; where an edge bends too much, the piece inside breaks."""
SOFTEST = 0.05
"""One minus the impedance of the smallest."""


def add(
    spec: "mujoco.MjSpec",
    name: str,
    fragments: "Fragments",
    of: "str | Brittle",
    *,
    pos: Vec3,
    yaw_deg: float = 0.0,
    tilt_deg: float = 0.0,
    mass: float | None = None,
    look: str | None = None,
    inside: str | None = None,
    surface: dict[str, Any] | None = None,
    held: "dict[str, tuple[Vec3, ...]] | None" = None,
    held_pa: float | None = None,
) -> "list[mujoco.MjsBody]":
    """Put a thing that can break into a world; returns the bodies of its pieces, `NAME_1`, `NAME_2` and so on.

    Args:
        spec: the world; its time step must stand.
        name: of the thing. Its bonds are called after what they hold together: `NAME_3/NAME_7`, and `NAME_3/frame_90` to a frame.
        fragments: from `plate`, `rod`, `grooved`, `vessel` or `convex`.
        of: a material's name (`strengths.MATERIALS`), or a `Brittle`.
        pos: the middle of its box, m, world frame.
        yaw_deg: about world z, after `tilt_deg`.
        tilt_deg: about its own x: 90 lays a rod along y.
        mass: kg of the whole, shared by volume; None: volume times density.
        look: of its old skin; None: the material's.
        inside: look of the faces that it breaks along; None: the same, and none where that is clear, so that no crack shows before.
        surface: contact properties (`worldkit.contacts.surface`); None: the material's friction.
        held: what holds it by its outer faces: the body (`world`, `frame`) and directions, before `yaw_deg`, into which those faces look.
        held_pa: the strength of that hold, Pa; None: the material's.

    Raises:
        ValueError: an unknown material, holding body (or one of its own pieces) or look, a direction in which it has no face, or a
                strength that is not above 0.
    """
    import mujoco
    import numpy as np

    from .. import contacts, materials
    from ..turning import about, matrices

    stuff = material(of) if isinstance(of, str) else of
    hold_pa = stuff.strength_pa if held_pa is None else held_pa
    for what, pa in (("strength", stuff.strength_pa), ("held_pa", hold_pa)):
        if not 0 < pa < np.inf:
            raise ValueError(f"{name} breaks at a {what} of {pa} Pa: give a finite number above 0")
    fragments = fragments.tilted(tilt_deg)
    quat = about((0.0, 0.0, 1.0), np.radians(yaw_deg))
    turn = matrices(quat)
    density = stuff.density if mass is None else mass / fragments.volume
    properties = surface or contacts.surface(friction=stuff.friction, time_constant=2 * spec.option.timestep)
    # The engine makes a contact as stiff as the touched body is heavy, and a shard is light beside what it is bonded to.
    properties = {**properties, "solimp": HARD, "solmix": 100.0}
    drawn = {False: materials.add(spec, look or stuff.look), True: materials.add(spec, inside or look or stuff.look)}
    # Two faces of clear glass that touch are none: drawn, they would show the cracks of a whole pane.
    drawn_inside = inside is not None or not materials.look(look or stuff.look).clear
    made = []
    for number, piece in enumerate(fragments.pieces, start=1):
        body = spec.worldbody.add_body(name=f"{name}_{number}", pos=np.array(pos) + turn @ piece.centre, quat=quat)
        body.add_freejoint(name=f"{name}_{number}")
        body.mass, body.ipos, body.explicitinertial = density * piece.volume, (0.0, 0.0, 0.0), True
        body.fullinertia = body.mass * piece.inertia[(0, 1, 2, 0, 0, 1), (0, 1, 2, 1, 2, 2)]
        hull = bodies.mesh(spec, piece.hull - piece.centre)
        kind = mujoco.mjtGeom.mjGEOM_MESH
        body.add_geom(name=f"{name}_{number}", type=kind, meshname=hull, **properties, **bodies.COLLIDES)
        for within, label in ((False, "look"), *([(True, "inside")] if drawn_inside else [])):
            skin = piece.skin(within)
            if skin is not None:
                shown = bodies.mesh(spec, skin[0] - piece.centre, _flat(*skin), skin[1])
                called = f"{name}_{number}/{label}"
                body.add_geom(name=called, type=kind, meshname=shown, material=drawn[within], **bodies.DRAWN)
        made.append(body)
    bonds: list[tuple[str, str, str, Section, float]] = []
    for one, other, section in fragments.bonds:
        ends = (f"{name}_{one + 1}", f"{name}_{other + 1}")
        bonds.append((f"{ends[0]}/{ends[1]}", *ends, section, stuff.strength_pa))
    own = {body.name for body in made}
    for frame, directions in (held or {}).items():
        if frame in own:
            raise ValueError(f"{name} is held by {frame!r}, a piece of its own: name a body beside it, or `world`")
        if frame != "world" and spec.body(frame) is None:
            known = ", ".join(b.name for b in spec.bodies)
            raise ValueError(f"{name} is held by {frame!r}, which is not in the world yet; known: {known}")
        for way in directions:
            rim = fragments.rim(np.array(way, float))
            if not rim:
                raise ValueError(f"{name} has no outer face that looks along {way}: name a direction of its own frame")
            for one, section in rim:
                end, section = f"{name}_{one + 1}", section._replace(moduli=np.full(3, GRIPS))
                bonds.append((f"{end}/{frame}_{len(bonds)}", end, frame, section, hold_pa))
    _tie(spec, name, bonds, own, np.array(pos, float), turn)
    return made


def _tie(
    spec: "mujoco.MjSpec",
    name: str,
    bonds: "list[tuple[str, str, str, Section, float]]",
    own: set[str],
    pos: "np.ndarray",
    turn: "np.ndarray",
) -> None:
    """Add the welds, and the field that says what each is worth."""
    import mujoco
    import numpy as np

    from ..poses import world_pose

    step, widest = spec.option.timestep, max(section.area for *_, section, _ in bonds)
    rows = []
    for label, one, other, section, strength in bonds:
        give = min(YIELDING * widest / section.area, SOFTEST)
        weld = spec.add_equality(
            name=label,
            type=mujoco.mjtEq.mjEQ_WELD,
            name1=one,
            name2="" if other == "world" else other,
            solref=(-1 / step**2, -1 / step),
            solimp=(1 - give, 1 - give, 0.001, 0.5, 2.0),
        )
        weld.objtype = mujoco.mjtObj.mjOBJ_BODY
        # The anchor is given in the frame of the second body, the world's where there is none.
        origin, frame = world_pose(spec.body(other)) if other != "world" else (np.zeros(3), np.eye(3))
        weld.data[:3] = frame.T @ (pos + turn @ section.centre - origin)
        axes = section.axes @ turn.T @ frame
        rows += [*axes.ravel(), section.area, *section.moduli, strength]
    spec.add_numeric(name=FIELD + name, size=len(rows), data=rows)
    labels = [label for label, *_ in bonds]
    holds = [0.0 if other in own else 1.0 for _, _, other, *_ in bonds]
    kinds = [int(mujoco.mjtObj.mjOBJ_EQUALITY)] * len(labels)
    spec.add_tuple(name=FIELD + name, objtype=kinds, objname=labels, objprm=holds)


def _flat(points: "np.ndarray", triangles: "np.ndarray") -> "np.ndarray":
    """(N, 3) the normals of triangles that share no corners over an edge."""
    import numpy as np

    from ..turning import cross

    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.zeros_like(points)
    for k in range(3):
        normals[triangles[:, k]] = cross(b - a, c - a)
    return np.asarray(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300))
