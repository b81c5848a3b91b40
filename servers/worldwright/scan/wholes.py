"""A recording in which everything welded together is one body: what its parts touch, weigh and reach is the whole's.

Checks about motion, contact and flight look at wholes (`WHOLE = True` in a check): a bag's runner that scrapes is the
bag scraping, and a body with parts flies as one, with the mass, the centre of mass and the inertia of all of it. An
expectation that names a body means the whole thing as well; a part that it names stands for itself, with what is
welded on below it, and then no longer counts for the rest. Checks of the recording itself, and of how thick or how
deep a single part is, look at the bodies as they were recorded.

Parts that the recording shows to move against each other are no rigid body, whatever the model says: they stay apart.

Source: rigid-body mechanics: parallel axes (Goldstein, Classical Mechanics, section 5.3).
"""

from collections.abc import Collection, Iterable
from dataclasses import replace
from fnmatch import fnmatchcase
from typing import Any

import numpy as np

from ..model import assemblies
from ..model.declared import owner
from ..model.mechanics import Mechanics, rotation
from ..model.records import Interventions
from ..model.trajectory import Trajectory
from .sign import Context

Array = np.ndarray
_VIEWS, _LOOSE = "_assembled", "_loose_parts"
MOST_KEPT = 4
SHIFT, TURN = 1e-5, 1e-6
"""What moves more against its head (as a share of its way from there; as 1 - |cos| of half the angle) is not welded to it."""


def heads(trajectory: Trajectory, apart: Collection[int] = ()) -> Array:
    """(B,) index of the body that each one is welded to, directly or through others; its own where that is none."""
    facts = trajectory.mechanics
    if facts.jointed is None or facts.parent is None:
        return np.arange(len(trajectory.names))
    return assemblies.heads(facts.parent, facts.jointed, {*apart, *_loose(trajectory)})


def head_names(trajectory: Trajectory) -> dict[str, str]:
    """By the name of each body, the name of the one that heads its assembly."""
    found = heads(trajectory)
    return {name: trajectory.names[h] for name, h in zip(trajectory.names, found, strict=True)}


def assembled(trajectory: Trajectory, apart: Collection[int] = ()) -> Trajectory:
    """The same recording with each rigid assembly as one body; the recording itself where no body is welded to another.

    Args:
        trajectory: the bodies as they were recorded.
        apart: bodies (indices) to keep for themselves, with what is welded on below them.
    """
    cache = trajectory.__dict__.setdefault(_VIEWS, {})
    facts = trajectory.mechanics
    split = frozenset(b for b in apart if facts.jointed is not None and not facts.jointed[b])
    if split not in cache:
        while len(cache) >= MOST_KEPT:
            cache.pop(next(iter(cache)))
        cache[split] = _assembled(trajectory, heads(trajectory, split))
    return cache[split]


def as_named(trajectory: Trajectory, names: Iterable[str]) -> Trajectory:
    """The recording as a sentence speaks of it: each name (or pattern) a whole, the rest merged into theirs."""
    said = set(names)
    patterns = [name for name in said if any(sign in name for sign in "*?[")]
    apart = [
        b
        for b, name in enumerate(trajectory.names)
        if name in said or any(fnmatchcase(name, pattern) for pattern in patterns)
    ]
    return assembled(trajectory, apart)


def asked_of_wholes(context: Context, trajectory: Trajectory) -> Context:
    """What the plan says, said of wholes: a part that should move, rest, or is pushed means the body that it belongs to."""
    head = head_names(trajectory)
    if all(name == other for name, other in head.items()):
        return context

    def wholes(names: Iterable[str]) -> tuple[str, ...]:
        return tuple(dict.fromkeys(head.get(name, name) for name in names))

    declared = tuple(
        row.model_copy(update={"bodies": tuple(dict.fromkeys((*row.bodies, *wholes(row.bodies))))})
        for row in context.interventions
    )
    return replace(context, movers=wholes(context.movers), rests=wholes(context.rests), interventions=declared)


def _loose(trajectory: Trajectory) -> frozenset[int]:
    """Parts that the recording shows to move on their heads; looked up once."""
    known = trajectory.__dict__.get(_LOOSE)
    if known is None:
        facts = trajectory.mechanics
        assert facts.parent is not None and facts.jointed is not None
        head = assemblies.heads(facts.parent, facts.jointed)
        parts = np.flatnonzero(head != np.arange(len(head)))
        known = frozenset(int(b) for b in parts if not _rides(trajectory, int(b), int(head[b])))
        trajectory.__dict__[_LOOSE] = known
    return known


def _rides(trajectory: Trajectory, part: int, head: int) -> bool:
    """Whether a part keeps its place and its turn on its head in every row."""
    arm = trajectory.pos[:, part] - trajectory.pos[:, head]
    place = np.einsum("tji,tj->ti", rotation(trajectory.quat[:, head]), arm)
    reach = float(np.sqrt((place[0] ** 2).sum())) + float(trajectory.size_m[part])
    rounding = 1e-6 * float(np.abs(trajectory.pos[:, head]).max())
    if not np.abs(place - place[0]).max() <= SHIFT * reach + rounding:
        return False
    turn = _product(_conjugate(trajectory.quat[:, head]), trajectory.quat[:, part])
    return bool((1.0 - np.abs(turn @ turn[0]) <= TURN).all())


def _assembled(trajectory: Trajectory, head: Array) -> Trajectory:
    kept = np.flatnonzero(head == np.arange(len(head)))
    if len(kept) == len(head):
        return trajectory
    to_new = np.full(len(head) + 1, -1)  # the last one is the world's, which -1 finds
    to_new[:-1] = np.searchsorted(kept, head)
    changed: dict[str, Any] = {name: getattr(trajectory, name)[:, kept] for name in ("pos", "quat", "linvel", "angvel")}
    if trajectory.contact_force_sum is not None:
        total = np.zeros((len(trajectory.t), len(kept)))
        for b in range(len(head)):
            total[:, to_new[b]] += trajectory.contact_force_sum[:, b]
        changed["contact_force_sum"] = total
    touches = trajectory.contacts
    if touches is not None:
        changed["contacts"] = replace(touches, body1=to_new[touches.body1], body2=to_new[touches.body2])
    if trajectory.interventions is not None:
        changed["interventions"] = _of_wholes(trajectory.interventions, trajectory.names, head)
    return replace(
        trajectory,
        names=tuple(trajectory.names[b] for b in kept),
        mechanics=_mechanics(trajectory, head, kept, to_new),
        **changed,
    )


def _of_wholes(ledger: Interventions, names: tuple[str, ...], head: Array) -> Interventions:
    called = {name: names[h] for name, h in zip(names, head, strict=True) if names[h] != name}
    found = []
    for target in ledger.target:
        body = owner(str(target))
        found.append(called[body] + str(target)[len(body) :] if body in called else str(target))
    return replace(ledger, target=found)


def _mechanics(trajectory: Trajectory, head: Array, kept: Array, to_new: Array) -> Mechanics:
    """Facts about the wholes. Joints, ties and ropes are left out: they are told in the frames of the parts."""
    facts = trajectory.mechanics
    own = {
        name: None if (column := getattr(facts, name)) is None else np.array(column[kept])
        for name in ("mass", "com", "inertia", "inertia_quat", "center", "half_extents", "dynamic", "mocap")
    }
    place, turn = _seats(trajectory, head)
    for k, h in enumerate(kept):
        members = np.flatnonzero(head == h)
        if len(members) > 1:
            _weigh(facts, own, k, members, place, turn)
            _bound(facts, own, k, members, place, turn)
    parent, jointed = facts.parent, facts.jointed
    assert parent is not None and jointed is not None
    # An assembly that was split, or is none in the recording, is not one loose body.
    model = assemblies.heads(parent, jointed)
    whole = ~assemblies.any_member(model, head != model)
    found: dict[str, Any] = {
        "parent": to_new[parent[kept]],
        "jointed": jointed[kept],
        **{
            name: None if (column := getattr(facts, f"whole_{name}")) is None else (column & whole)[kept]
            for name in ("free", "unforced")
        },
        "joints": (),
        "ropes": (),
        "ties": (),
    }
    found |= {"whole_free": found["free"], "whole_unforced": found["unforced"]}
    if facts.visual_only is not None:
        found["visual_only"] = np.array([facts.visual_only[head == h].all() for h in kept], dtype=bool)
    if facts.geom_body is not None:
        found["geom_body"] = to_new[facts.geom_body]
        if facts.geom_pos is not None and facts.geom_quat is not None:
            found |= _geoms(facts, place, turn)
    return replace(facts, **own, **found)


def _seats(trajectory: Trajectory, head: Array) -> tuple[Array, Array]:
    """(B, 3) m and (B, 4): where each body sits in the frame of its head, and how it is turned there."""
    pos, quat = trajectory.pos[0], trajectory.quat[0]
    place = np.einsum("bji,bj->bi", rotation(quat[head]), pos - pos[head])
    return place, _product(_conjugate(quat[head]), quat)


def _weigh(facts: Mechanics, own: dict[str, Any], k: int, members: Array, place: Array, turn: Array) -> None:
    """Mass, centre of mass and inertia of all members, in place of the head's."""
    if facts.mass is None:
        return
    mass = facts.mass[members]
    total = float(mass.sum())
    own["mass"][k] = total
    if facts.com is None or total <= 0:
        return
    frames = rotation(turn[members])
    centres = place[members] + np.einsum("bij,bj->bi", frames, facts.com[members])
    middle = mass @ centres / total
    own["com"][k] = middle
    if facts.inertia is None or facts.inertia_quat is None:
        return
    axes = frames @ rotation(facts.inertia_quat[members])
    tensor = np.einsum("bij,bj,bkj->ik", axes, facts.inertia[members], axes)
    arms = centres - middle
    tensor += np.einsum("b,bi,bi->", mass, arms, arms) * np.eye(3) - np.einsum("b,bi,bj->ij", mass, arms, arms)
    moments, principal = np.linalg.eigh(tensor)
    if np.linalg.det(principal) < 0:
        principal[:, 2] = -principal[:, 2]
    own["inertia"][k], own["inertia_quat"][k] = moments, _quaternion(principal)


def _bound(facts: Mechanics, own: dict[str, Any], k: int, members: Array, place: Array, turn: Array) -> None:
    """The box around all members, in the frame of the head."""
    if facts.center is None or facts.half_extents is None:
        return
    if facts.geom_pos is not None and facts.geom_quat is not None and facts.geom_half_extents is not None:
        assert facts.geom_body is not None
        mine = np.isin(facts.geom_body, members) & np.isfinite(facts.geom_half_extents).all(axis=1)
        on, half = facts.geom_body[mine], facts.geom_half_extents[mine]
        middle, frames = facts.geom_pos[mine], rotation(turn[on]) @ rotation(facts.geom_quat[mine])
    else:
        on = members[~np.isnan(facts.half_extents[members]).any(axis=1)]
        half, middle, frames = facts.half_extents[on], facts.center[on], rotation(turn[on])
    if not len(on):
        return
    middle = place[on] + np.einsum("bij,bj->bi", rotation(turn[on]), middle)
    reach = np.einsum("bij,bj->bi", np.abs(frames), half)
    low, high = (middle - reach).min(axis=0), (middle + reach).max(axis=0)
    own["center"][k], own["half_extents"][k] = (low + high) / 2, (high - low) / 2


def _geoms(facts: Mechanics, place: Array, turn: Array) -> dict[str, Array]:
    """Where the geoms sit in the frames of the wholes."""
    assert facts.geom_body is not None and facts.geom_pos is not None and facts.geom_quat is not None
    on, at = facts.geom_body, np.maximum(facts.geom_body, 0)
    moved = place[at] + np.einsum("gij,gj->gi", rotation(turn[at]), facts.geom_pos)
    turned = _product(turn[at], facts.geom_quat)
    world = (on < 0)[:, None]
    return {
        "geom_pos": np.where(world, facts.geom_pos, moved),
        "geom_quat": np.where(world, facts.geom_quat, turned),
    }


def _conjugate(quat: Array) -> Array:
    return np.asarray(quat * np.array([1.0, -1.0, -1.0, -1.0]))


def _product(one: Array, other: Array) -> Array:
    """(..., 4) Hamilton product."""
    w, v = one[..., :1], one[..., 1:]
    w2, v2 = other[..., :1], other[..., 1:]
    scalar = w * w2 - (v * v2).sum(axis=-1, keepdims=True)
    return np.concatenate((scalar, w * v2 + w2 * v + np.cross(v, v2)), axis=-1)


def _quaternion(turn: Array) -> Array:
    """(4,) wxyz of a rotation matrix: the eigenvector of its largest eigenvalue (Bar-Itzhack, 2000)."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = turn
    k = np.array(
        [
            [xx + yy + zz, zy - yz, xz - zx, yx - xy],
            [zy - yz, xx - yy - zz, xy + yx, xz + zx],
            [xz - zx, xy + yx, yy - xx - zz, yz + zy],
            [yx - xy, xz + zx, yz + zy, zz - xx - yy],
        ]
    )
    return np.asarray(np.linalg.eigh(k)[1][:, -1])
