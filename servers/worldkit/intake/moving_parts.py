"""Parts of a thing that move against it, where its file has them apart: doors, windows, lids and their hinges or rails, as MJCF.

How far a leaf opens no file tells: a closed one opens towards the front or away from the rest, one that is drawn open closes until
it meets it.
"""

from dataclasses import dataclass, replace
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from ..errors import IntakeError
from . import mending, touchable
from .drawn_pieces import Array, Drawn

FILE = "moving.xml"
SLIM = 1.5
"""A pin is so many times longer along its axis than across; what is rounder tells no axis."""
WIDE_OPEN, FURTHER = np.radians(110), np.radians(30)
"""How far a closed leaf opens, and how much further one that is drawn open."""
INSIDE = 0.5
"""Share of a leaf's box that lies within that of the rest when it is closed."""
DRY, VISCOUS = 0.01, 0.02
"""Friction of a hinge as a share of the leaf's weight times its width, and damping as one of mass times width squared per s:
a leaf comes to rest within some seconds; our judgement."""
HELD = 1.2
"""Friction at least as a share of what gravity pulls at the joint anywhere in its turn: a lid, too, stays where it is left."""
HOLDS = 0.9999
"""`solimpfriction`: by the engine's own 0.9, a lid that its friction holds sinks all the same, 13 degrees in 5 s."""
FLATTER = 1e-9


@dataclass(frozen=True)
class Leaf:
    """A part that moves. axis: unit (3,). pos: a point of the axis, m. low, high: rad, or m of a slide. pulled: see `_pulled`."""

    name: str
    kind: str
    axis: Array
    pos: Array
    low: float
    high: float
    pulled: float = 0.0


def model(
    key: str, pieces: list[Drawn], facts: dict[str, Any]
) -> tuple[dict[str, bytes], dict[str, list[float]]] | None:
    """The files of a thing whose parts move, `moving.xml` and its hulls, and the range of each joint; None if none moves.

    Args:
        key: of the asset.
        pieces: in the frame of the asset, m; each drawn by the file of its number.
        facts: the asset's `visual`, `materials`, `friction`, and `mass` or `density` with `solid_volume`.
    """
    names = sorted({piece.part for piece in pieces if piece.part and not piece.part.startswith("at ")})
    rest = [piece for piece in pieces if piece.part not in names]
    if not names or not rest:
        return None
    leaves: dict[str, Leaf] = {}
    for number, part in enumerate(names):
        name = "leaf" if len(names) == 1 else f"leaf_{number + 1}"
        if (found := _leaf(name, part, pieces, rest)) is None:
            return None
        leaves[part] = found
    try:
        rows, hulls, _ = touchable.pieces(mending.solid_of(rest, key))
    except IntakeError:
        return None
    made: dict[str, bytes] = {}
    weights: dict[str, list[tuple[str, float]]] = {"": _shapes(rows, hulls, made)}
    for part, leaf in list(leaves.items()):
        own = [_corners(piece) for piece in pieces if piece.part == part]
        shells = [corners for corners in own if len(corners) >= 4 and touchable.volume_of(corners) > FLATTER]
        hull_rows = [{"type": "hull", "hull": number} for number in range(len(shells))]
        weights[part] = _shapes(hull_rows, shells, made)
        if not shells:
            return None
        leaves[part] = replace(leaf, pulled=_pulled(leaf, shells))
    total = facts.get("mass") or facts["density"] * facts["solid_volume"]
    scale = total / sum(volume for group in weights.values() for _, volume in group)
    made[FILE] = _text(key, pieces, leaves, weights, scale, facts, made).encode()
    kinds = {"hinge": 180 / np.pi, "slide": 1.0}
    ranges = {
        f"{leaf.name}_{leaf.kind}": [round(float(end) * kinds[leaf.kind], 3) for end in (leaf.low, leaf.high)]
        for leaf in leaves.values()
    }
    return made, ranges


def _leaf(name: str, part: str, pieces: list[Drawn], rest: list[Drawn]) -> Leaf | None:
    kind, _, number = part.partition(" ")
    own = np.concatenate([piece.vertices for piece in pieces if piece.part == part])
    body = np.concatenate([piece.vertices for piece in rest if not piece.part.startswith("at hinge")] or [own])
    if kind == "rail":
        share = np.ptp(own, axis=0) / np.maximum(np.ptp(body, axis=0), 1e-9)
        along = int(share[1:].argmin()) + 1  # across the front, or up
        axis = np.eye(3)[along]
        free = float(np.ptp(body[:, along]) - np.ptp(own[:, along]))
        if free <= 0:
            return None
        ahead = float(body[:, along].mean() + body[:, along].max() - own[:, along].max() - body[:, along].mean())
        behind = float(own[:, along].min() - body[:, along].min())
        low, high = (0.0, 0.95 * ahead) if ahead > behind else (-0.95 * behind, 0.0)
        return Leaf(name, "slide", axis, own.mean(axis=0), low, high)
    pin = [piece.vertices for piece in pieces if piece.part == f"at hinge {number}"]
    if not pin:
        return None
    points = np.concatenate(pin)
    size = np.ptp(points, axis=0)
    order = size.argsort()
    if size[order[2]] < SLIM * size[order[1]]:
        return None
    axis, pos = np.eye(3)[order[2]], (points.min(axis=0) + points.max(axis=0)) / 2
    return Leaf(name, "hinge", axis, pos, *_swing(axis, pos, own, body))


def _swing(axis: Array, pos: Array, own: Array, body: Array) -> tuple[float, float]:
    """How far a leaf turns either way, rad, from where it is drawn: away from the rest, or towards the front where it lies in it."""
    arm = _across(_middle(own) - pos, axis)
    away = _across(_middle(body) - pos, axis)
    low, high = body.min(axis=0), body.max(axis=0)
    within = np.prod(
        np.clip(
            np.minimum(own.max(axis=0), high + 0.02) - np.maximum(own.min(axis=0), low - 0.02), 0.0, None
        ) / np.maximum(np.ptp(own, axis=0), 1e-3)
    )  # fmt: skip
    turn = float(np.arctan2(np.cross(away, arm) @ axis, away @ arm))  # from the rest to the leaf
    if within < INSIDE:  # drawn open: it closes until it meets the rest
        way = 1.0 if turn > 0 else -1.0
        ends = sorted((-way * max(abs(turn) - 0.05, 0.1), way * FURTHER))
        return ends[0], ends[1]
    step = np.cross(axis, arm)  # where a little turn takes it
    front = float(step[0]) if abs(step[0]) > 0.2 * np.linalg.norm(step) else -float(step @ away)
    return (0.0, float(WIDE_OPEN)) if front >= 0 else (-float(WIDE_OPEN), 0.0)


def _pulled(leaf: Leaf, shells: list[Array]) -> float:
    """The most that gravity pulls at a joint wherever its leaf is, by the leaf's weight: m of a hinge, a share of a slide."""
    import trimesh

    if leaf.kind == "slide":
        return float(abs(leaf.axis[2]))
    hulls = [trimesh.convex.convex_hull(corners) for corners in shells]
    middle = np.average([hull.center_mass for hull in hulls], axis=0, weights=[hull.volume for hull in hulls])
    return float(np.linalg.norm(_across(middle - leaf.pos, leaf.axis)) * np.hypot(*leaf.axis[:2]))


def _middle(points: Array) -> Array:
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2)


def _across(vector: Array, axis: Array) -> Array:
    return np.asarray(vector - np.multiply.outer(vector @ axis, axis))


def _corners(piece: Drawn) -> Array:
    from ..sculpt.hulls import corners_of

    try:
        return np.asarray(corners_of(piece.vertices[np.unique(piece.faces)]))
    except Exception:  # flat, or in one line: Qhull says so in several ways
        return np.zeros((0, 3))


def _shapes(rows: list[dict[str, Any]], hulls: list[Array], made: dict[str, bytes]) -> list[tuple[str, float]]:
    """Attributes of the geoms that touch, each with its volume, m^3; their meshes are put among the files."""
    found = []
    for row in rows:
        if row["type"] == "hull":
            corners = hulls[row["hull"]]
            stem = f"part_{len(made):02d}"
            made[f"{stem}.obj"] = touchable.hull_text(corners).encode()
            found.append((f'type="mesh" mesh="{stem}"', touchable.volume_of(corners)))
            continue
        pos, quat = _numbers(row["pos"]), _numbers(row.get("quat", (1, 0, 0, 0)))
        half = [float(v) / 2 for v in row.get("extents", (row.get("diameter", 0), row.get("height", 0)))]
        volume = (
            8 * float(np.prod(half))
            if row["type"] == "box"
            else float(np.pi * half[0] ** 2 * max(2 * half[1], half[0]))
        )
        found.append((f'type="{row["type"]}" size="{_numbers(half)}" pos="{pos}" quat="{quat}"', volume))
    return found


def _text(
    key: str, pieces: list[Drawn], leaves: dict[str, Leaf], weights: dict[str, list[tuple[str, float]]], scale: float,
    facts: dict[str, Any], made: dict[str, bytes],
) -> str:  # fmt: skip
    lines = [f"<mujoco model={quoteattr(key)}>", '<compiler angle="radian"/>', "<asset>"]
    pictures = {row["texture"] for row in facts["materials"].values() if "texture" in row}
    lines += [f'<texture type="2d" name="{name[:-4]}" file="{name}"/>' for name in sorted(pictures)]
    for name, row in facts["materials"].items():
        worn = f' texture="{row["texture"][:-4]}"' if "texture" in row else ""
        shine = "".join(f' {word}="{row[word]}"' for word in ("roughness", "metallic") if word in row)
        lines.append(f'<material name="{name}" rgba="{_numbers(row["rgba"])}"{shine}{worn}/>')
    lines += [f'<mesh name="{row["mesh"][:-4]}" file="{row["mesh"]}" inertia="shell"/>' for row in facts["visual"]]
    lines += [f'<mesh name="{name[:-4]}" file="{name}" inertia="convex"/>' for name in made]
    lines += [
        "</asset>",
        "<worldbody>",
        f"<body name={quoteattr(key)}>",
        *_geoms("", pieces, weights, scale, facts, leaves),
    ]
    for part, leaf in leaves.items():
        own = np.concatenate([piece.vertices for piece in pieces if piece.part == part])
        mass = scale * sum(volume for _, volume in weights[part])
        width = float(np.linalg.norm(_across(own - leaf.pos, leaf.axis), axis=1).max())
        arm = width if leaf.kind == "hinge" else 1.0
        dry = max(DRY * arm, HELD * leaf.pulled) * 9.81 * mass
        joint = (
            f'<joint name="{leaf.name}_{leaf.kind}" type="{leaf.kind}" axis="{_numbers(leaf.axis)}" pos="{_numbers(leaf.pos)}" '
            f'limited="true" range="{_numbers((leaf.low, leaf.high))}" frictionloss="{dry:.5g}" '
            f'solimpfriction="{HOLDS} {HOLDS} 0.001" damping="{VISCOUS * mass * arm**2:.5g}"/>'
        )
        lines += [f'<body name="{leaf.name}">', joint, *_geoms(part, pieces, weights, scale, facts, leaves), "</body>"]
    # A leaf and what it hangs on overlap as hulls do, and the engine lets only what moves through its children.
    apart = [f'<exclude body1={quoteattr(key)} body2="{leaf.name}"/>' for leaf in leaves.values()]
    return "\n".join([*lines, "</body>", "</worldbody>", "<contact>", *apart, "</contact>", "</mujoco>", ""])


def _geoms(
    part: str, pieces: list[Drawn], weights: dict[str, list[tuple[str, float]]], scale: float, facts: dict[str, Any],
    leaves: dict[str, Leaf],
) -> list[str]:  # fmt: skip
    name = leaves[part].name if part else "rest"
    seen = [
        f'<geom name="{name}_{row["mesh"][:-4]}" type="mesh" mesh="{row["mesh"][:-4]}" material="{row["material"]}" '
        'contype="0" conaffinity="0" group="2" mass="0"/>'
        for piece, row in zip(pieces, facts["visual"], strict=True)
        if (piece.part if piece.part in leaves else "") == part
    ]
    friction = f'friction="{facts.get("friction", 0.5)} 0.005 0.0001"'
    touched = [
        f'<geom name="{name}_{number}" {shape} group="3" mass="{scale * volume:.6g}" {friction}/>'
        for number, (shape, volume) in enumerate(weights[part])
    ]
    return [*seen, *touched]


def _numbers(values: Any) -> str:
    return " ".join(f"{float(value):.7g}" for value in values)
