"""Turn everything that is welded together into one body: what its parts touch, weigh and reach belongs to the whole.

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

from worldkit.turning import conjugate, matrices, product, quaternion

from ...model.plan.declaration import owner
from ...model.recording import assemblies
from ...model.recording.mechanics import Mechanics
from ...model.recording.records import Interventions
from ...model.recording.trajectory import CUT_OF, Trajectory
from .sign import Context

Array = np.ndarray
_VIEWS, _LOOSE = "_assembled", "_loose_parts"
MOST_KEPT = 8
SHIFT, TURN = 1e-5, 1e-6
"""A part that moves more against its head is not welded to it: a share of the distance; 1 - |cos| of half the angle."""


def heads(trajectory: Trajectory, apart: Collection[int] = ()) -> Array:
    """(B,) index of the body to which each is welded, directly or through others; its own index where there is none."""
    facts = trajectory.mechanics
    if facts.jointed is None or facts.parent is None:
        return np.arange(len(trajectory.names))
    return assemblies.heads(facts.parent, facts.jointed, {*apart, *_loose(trajectory)})


def head_names(trajectory: Trajectory) -> dict[str, str]:
    """The name of the body that heads the assembly of each body, by the body's name."""
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
        if (cut := trajectory.__dict__.get(CUT_OF)) is not None:
            # The whole recording tells which parts are welded; a part of it takes the answer over.
            whole = assembled(cut[0], split)
            cache[split] = trajectory if whole is cut[0] else whole.before(cut[1])
        else:
            cache[split] = _assembled(trajectory, heads(trajectory, split))
    return cache[split]


def as_named(trajectory: Trajectory, names: Iterable[str]) -> Trajectory:
    """The recording as a sentence speaks of it: each name (or pattern) is a whole, the others merge into theirs."""
    said = set(names)
    patterns = [name for name in said if any(sign in name for sign in "*?[")]
    apart = [
        b
        for b, name in enumerate(trajectory.names)
        if name in said or any(fnmatchcase(name, pattern) for pattern in patterns)
    ]
    return assembled(trajectory, apart)


def asked_of_wholes(context: Context, trajectory: Trajectory) -> Context:
    """The plan's facts about wholes: if a part should move or rest, or is pushed, so is the body that it belongs to."""
    head = head_names(trajectory)
    if all(name == other for name, other in head.items()):
        return context

    def wholes(names: Iterable[str]) -> tuple[str, ...]:
        return tuple(dict.fromkeys(head.get(name, name) for name in names))

    declared = tuple(
        row.model_copy(update={"bodies": tuple(dict.fromkeys((*row.bodies, *wholes(row.bodies))))})
        for row in context.interventions
    )
    claims = tuple(
        (name, {**given, **{key: _named(given[key], head) for key in ("body", "bodies") if key in given}})
        for name, given in context.rest_claims
    )
    rests = wholes(context.rests)
    return replace(context, movers=wholes(context.movers), rests=rests, rest_claims=claims, interventions=declared)


def _named(said: Any, head: dict[str, str]) -> Any:
    """Replace the names of bodies by those of the wholes that they belong to."""
    return (
        [head.get(str(name), name) for name in said] if isinstance(said, (list, tuple)) else head.get(str(said), said)
    )


def _loose(trajectory: Trajectory) -> frozenset[int]:
    """Parts that the recording shows to move against their heads; computed once."""
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
    place = np.einsum("tji,tj->ti", matrices(trajectory.quat[:, head]), arm)
    reach = float(np.sqrt((place[0] ** 2).sum())) + float(trajectory.size_m[part])
    rounding = 1e-6 * float(np.abs(trajectory.pos[:, head]).max())
    if not np.abs(place - place[0]).max() <= SHIFT * reach + rounding:
        return False
    turn = product(conjugate(trajectory.quat[:, head]), trajectory.quat[:, part])
    return bool((1.0 - np.abs(turn @ turn[0]) <= TURN).all())


def _assembled(trajectory: Trajectory, head: Array) -> Trajectory:
    kept = np.flatnonzero(head == np.arange(len(head)))
    if len(kept) == len(head):
        return trajectory
    to_new = np.full(len(head) + 1, -1)  # the last one belongs to the world, which has the index -1
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
        changed["interventions"] = _ledger_of_wholes(trajectory.interventions, trajectory.names, head)
    return replace(
        trajectory,
        names=tuple(trajectory.names[b] for b in kept),
        mechanics=_mechanics(trajectory, head, kept, to_new),
        **changed,
    )


def _ledger_of_wholes(ledger: Interventions, names: tuple[str, ...], head: Array) -> Interventions:
    called = {name: names[h] for name, h in zip(names, head, strict=True) if names[h] != name}
    found = []
    for target in ledger.target:
        body = owner(str(target))
        found.append(called[body] + str(target)[len(body) :] if body in called else str(target))
    return replace(ledger, target=found)


def _mechanics(trajectory: Trajectory, head: Array, kept: Array, to_new: Array) -> Mechanics:
    """Facts about the wholes. Joints, ties and ropes are left out, as the frames of the parts describe them."""
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
    # An assembly that was split, or that the recording shows to be none, is not one loose body.
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
    """(B, 3) m and (B, 4) quaternion: place and turn of each body in the frame of its head."""
    pos, quat = trajectory.pos[0], trajectory.quat[0]
    place = np.einsum("bji,bj->bi", matrices(quat[head]), pos - pos[head])
    return place, product(conjugate(quat[head]), quat)


def _weigh(facts: Mechanics, own: dict[str, Any], k: int, members: Array, place: Array, turn: Array) -> None:
    """Replace the head's mass, centre of mass and inertia by those of all members."""
    if facts.mass is None:
        return
    mass = facts.mass[members]
    total = float(mass.sum())
    own["mass"][k] = total
    if facts.com is None or total <= 0:
        return
    frames = matrices(turn[members])
    centres = place[members] + np.einsum("bij,bj->bi", frames, facts.com[members])
    middle = mass @ centres / total
    own["com"][k] = middle
    if facts.inertia is None or facts.inertia_quat is None:
        return
    axes = frames @ matrices(facts.inertia_quat[members])
    tensor = np.einsum("bij,bj,bkj->ik", axes, facts.inertia[members], axes)
    arms = centres - middle
    tensor += np.einsum("b,bi,bi->", mass, arms, arms) * np.eye(3) - np.einsum("b,bi,bj->ij", mass, arms, arms)
    moments, principal = np.linalg.eigh(tensor)
    if np.linalg.det(principal) < 0:
        principal[:, 2] = -principal[:, 2]
    own["inertia"][k], own["inertia_quat"][k] = moments, quaternion(principal)


def _bound(facts: Mechanics, own: dict[str, Any], k: int, members: Array, place: Array, turn: Array) -> None:
    """Compute the box around all members, in the frame of the head."""
    if facts.center is None or facts.half_extents is None:
        return
    if facts.geom_pos is not None and facts.geom_quat is not None and facts.geom_half_extents is not None:
        assert facts.geom_body is not None
        mine = np.isin(facts.geom_body, members) & np.isfinite(facts.geom_half_extents).all(axis=1)
        on, half = facts.geom_body[mine], facts.geom_half_extents[mine]
        middle, frames = facts.geom_pos[mine], matrices(turn[on]) @ matrices(facts.geom_quat[mine])
    else:
        on = members[~np.isnan(facts.half_extents[members]).any(axis=1)]
        half, middle, frames = facts.half_extents[on], facts.center[on], matrices(turn[on])
    if not len(on):
        return
    middle = place[on] + np.einsum("bij,bj->bi", matrices(turn[on]), middle)
    reach = np.einsum("bij,bj->bi", np.abs(frames), half)
    low, high = (middle - reach).min(axis=0), (middle + reach).max(axis=0)
    own["center"][k], own["half_extents"][k] = (low + high) / 2, (high - low) / 2


def _geoms(facts: Mechanics, place: Array, turn: Array) -> dict[str, Array]:
    """Place and turn of the geoms in the frames of the wholes."""
    assert facts.geom_body is not None and facts.geom_pos is not None and facts.geom_quat is not None
    on, at = facts.geom_body, np.maximum(facts.geom_body, 0)
    moved = place[at] + np.einsum("gij,gj->gi", matrices(turn[at]), facts.geom_pos)
    turned = product(turn[at], facts.geom_quat)
    world = (on < 0)[:, None]
    return {
        "geom_pos": np.where(world, facts.geom_pos, moved),
        "geom_quat": np.where(world, facts.geom_quat, turned),
    }
