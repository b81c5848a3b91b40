"""Tables for the reader: what acted on the state besides the engine, what carried the loads, and what is only drawn.

Only a reader can tell whether an idealisation presupposes its claim, and whether a command is the actor's own choice or a
helper's hand. The tables give everything that there is to judge, with names and numbers.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...model.evidence.audits import Acting, Carrier, InterventionReport, LoadPath, Seen
from ...model.finding import Anomaly
from ...model.plan.declaration import declaration, owner
from ...model.recording.trajectory import Trajectory
from ..anomalies.checks.self_driven import self_driven
from ..anomalies.checks.unloaded_tendon import weights
from ..anomalies.declared import when
from ..anomalies.engine import CHECKS
from ..anomalies.sign import Context, spans
from .standing_drives import standing

MOST_ROWS = 40
LOADED = 1e-3
"""Something counts as loaded from this share of the weight on."""
UNITS = {
    "force": "N",
    "torque": "N·m",
    "control": "N, N·m",
    "pose": "m, rad",
    "velocity": "m/s, rad/s",
    "mocap": "m, rad",
}


def report(trajectory: Trajectory, context: Context, anomalies: tuple[Anomaly, ...] = ()) -> InterventionReport:
    """The tables of one recording; of the scan's `anomalies`, those about staging are repeated here."""
    overlaps = () if trajectory.loads is None else trajectory.loads.overlaps or ()
    return InterventionReport(
        trajectory_sha256=trajectory.sha256,
        acting=tuple(acting(trajectory, context)),
        standing=tuple(standing(trajectory, context))[:MOST_ROWS],
        load_paths=tuple(load_paths(trajectory))[:MOST_ROWS],
        carriers=tuple(carriers(trajectory))[:MOST_ROWS],
        overlaps=tuple(
            Seen.model_validate({**row, "geoms": tuple(row["geoms"]), "bodies": tuple(row["bodies"])})
            for row in overlaps[:MOST_ROWS]
        ),
        anomalies=tuple(a for a in anomalies if a.code in CHECKS and CHECKS[a.code].STAGING),
    )


def acting(trajectory: Trajectory, context: Context) -> Iterator[Acting]:
    """Each kind of intervention on each target, with the actuators that push without any control."""
    ledger, context = trajectory.interventions, context.of_recording(trajectory)
    if ledger is None:
        return
    step = trajectory.time_step or trajectory.interval_s
    for (kind, target), rows in sorted(ledger.groups.items()):
        times, values = ledger.time[rows], ledger.value[rows]
        force = values[:, 1:2] if kind == "control" else values[:, :3]
        impulse = force.sum(axis=0) * (step if kind in ("force", "control") else 0.0)
        body = owner(target)
        if kind == "velocity" and trajectory.mechanics.mass is not None and body in trajectory.names:
            impulse = values[:, :3].sum(axis=0) * trajectory.mechanics.mass[trajectory.names.index(body)]
        torque = float(np.sqrt((values[:, 3:] ** 2).sum(axis=1)).sum() * step) if kind == "torque" else 0.0
        size = np.abs(values[:, 1]) if kind == "control" else np.sqrt((values**2).sum(axis=1))
        yield _row(
            context,
            kind=kind,
            target=target,
            body=body,
            count=len(rows),
            stretches=1 + int((np.diff(times) > 1.5 * step).sum()),
            first_s=float(times.min()),
            last_s=float(times.max()),
            peak=float(size.max()),
            unit=UNITS.get(kind, ""),
            work_j=float(np.nansum(ledger.work_j[rows])),
            impulse_n_s=float(np.sqrt((impulse**2).sum())),
            angular_impulse_n_m_s=torque,
            airborne_s=_airborne(trajectory, body, times) * step if kind in ("force", "torque") else 0.0,
        )
    if trajectory.loads is None:
        return
    for name, bodies, force in self_driven(trajectory):
        on = np.flatnonzero(force)
        yield _row(
            context,
            kind="control",
            target=f"{bodies[0]}/{name}" if len(bodies) == 1 else name,
            body=bodies[0] if len(bodies) == 1 else name,
            count=len(on),
            stretches=len(spans(force != 0)),
            first_s=float(trajectory.t[on[0]]),
            last_s=float(trajectory.t[on[-1]]),
            peak=float(np.abs(force).max()),
            unit=UNITS["control"],
            work_j=0.0,
            impulse_n_s=float(abs(force.sum()) * trajectory.interval_s),
        )


def _row(context: Context, **facts: Any) -> Acting:
    row = declaration(facts["kind"], facts["target"], context.interventions)
    if row is None:
        return Acting(**facts)
    return Acting(**facts, declared=True, law=row.law, trigger=row.trigger, when=when(row.trigger), source=row.source)


def _airborne(trajectory: Trajectory, body: str, times: np.ndarray) -> int:
    """The number of these instants at which nothing of the body's mechanism touches anything."""
    touching, parent = trajectory.touching, trajectory.mechanics.parent
    if touching is None or body not in trajectory.names:
        return 0
    tree = [trajectory.names.index(body)]
    if parent is not None:
        roots = _roots(parent)
        tree = np.flatnonzero(roots == roots[tree[0]]).tolist()
    rows = np.clip(np.searchsorted(trajectory.t, times + 1e-9) - 1, 0, len(trajectory.t) - 1)
    return int((~touching[:, tree].any(axis=1)[rows]).sum())


def _roots(parent: np.ndarray) -> np.ndarray:
    """(B,) the topmost body above each, itself included."""
    roots = np.arange(len(parent))
    for _ in range(len(parent)):
        up = np.where(parent[roots] >= 0, parent[roots], roots)
        if (up == roots).all():
            break
        roots = up
    return roots


def load_paths(trajectory: Trajectory) -> Iterator[LoadPath]:
    """The pairs of geoms that pass on impulse, the largest first: what really carries, stops or breaks something."""
    contacts, geoms = trajectory.contacts, trajectory.meta.get("geoms") or ()
    if contacts is None or contacts.geom1 is None or contacts.geom2 is None or not geoms or not len(contacts.row):
        return
    size = contacts.normal_force if contacts.force is None else np.sqrt((contacts.force**2).sum(axis=1))
    live = size > 0
    dt = trajectory.interval_s
    low, high = np.minimum(contacts.geom1, contacts.geom2)[live], np.maximum(contacts.geom1, contacts.geom2)[live]
    rows, size = contacts.row[live], size[live]
    names = [(str(g["name"]), str(g["body"])) for g in geoms] + [("flex", "flex")]
    per_body: dict[str, float] = {}
    found = []
    for pair in np.unique(np.stack([low, high], axis=1), axis=0):
        mine = (low == pair[0]) & (high == pair[1])
        (one, body1), (other, body2) = names[pair[0]], names[pair[1]]
        impulse = float(size[mine].sum() * dt)
        for body in {body1, body2}:
            per_body[body] = per_body.get(body, 0.0) + impulse
        at = rows[mine]
        peak = float(np.bincount(at - at.min(), size[mine]).max())
        found.append((impulse, one, other, body1, body2, peak, trajectory.t[at.min()], trajectory.t[at.max()]))
    for impulse, one, other, body1, body2, peak, first, last in sorted(found, reverse=True):
        yield LoadPath(
            geoms=(one, other),
            bodies=(body1, body2),
            impulse_n_s=impulse,
            share=(impulse / per_body[body1], impulse / per_body[body2]),
            peak_n=peak,
            first_s=float(first),
            last_s=float(last),
        )


def carriers(trajectory: Trajectory) -> Iterator[Carrier]:
    """The load of each tendon, equality and joint."""
    loads, weight = trajectory.loads, weights(trajectory)
    if loads is not None:
        channels = (
            ("tendon", "tendons", loads.tendon_force, "N"),
            ("equality", "equalities", loads.eq_force, "N, N·m"),
        )
        for kind, key, forces, unit in channels:
            rows = trajectory.meta.get(key) or ()
            for column, row in enumerate(rows if forces.shape[1] == len(rows) else ()):
                yield _carrier(
                    trajectory, kind, str(row["name"]), tuple(row["bodies"]), forces[:, column], unit, weight
                )
    for name, bodies, force in joint_loads(trajectory):
        yield _carrier(trajectory, "joint", name, bodies, force, "N", weight)


def _carrier(
    trajectory: Trajectory, kind: Any, name: str, bodies: tuple[str, ...], force: np.ndarray, unit: str, weight: Any
) -> Carrier:
    size = np.abs(force)
    threshold = max(1e-6, LOADED * sum(weight.get(b, 0.0) for b in bodies))
    return Carrier(
        kind=kind,
        name=name,
        bodies=bodies,
        peak=float(size.max(initial=0.0)),
        unit=unit,
        impulse=float(size.sum() * trajectory.interval_s),
        loaded_share=float((size > threshold).mean()),
    )


def joint_loads(trajectory: Trajectory) -> Iterator[tuple[str, tuple[str, ...], np.ndarray]]:
    """Each joint with its body and the force (T,), N, that it passes on.

    By Newton's second law for everything beyond the joint, the force that gravity and contacts do not explain came through
    it. A joint is left out where an equality, a tendon or a recorded push may have helped.
    """
    facts, meta = trajectory.mechanics, trajectory.meta
    mass, parent, contacts = facts.mass, facts.parent, trajectory.contacts
    if mass is None or parent is None or contacts is None or contacts.force is None or len(trajectory.t) < 3:
        return
    ledger = trajectory.interventions
    helped = (
        {owner(str(t)) for t, k in zip(ledger.target, ledger.kind, strict=True) if k != "control"} if ledger else set()
    )
    for key in ("equalities", "tendons"):
        helped.update(name for row in meta.get(key) or () for name in row.get("bodies") or ())
    below = _below(parent)
    acceleration: np.ndarray | None = None
    for joint in (meta.get("joints") or ())[:MOST_ROWS]:
        if joint["type"] == "free" or joint["body"] not in trajectory.names:
            continue
        body = trajectory.names.index(joint["body"])
        part = np.flatnonzero(below[:, body])
        if not mass[part].sum() or helped.intersection(trajectory.names[i] for i in part):
            continue
        if acceleration is None:
            acceleration = np.gradient(trajectory.com_velocity, trajectory.t, axis=0) - trajectory.gravity
        force = np.einsum("tbi,b->ti", acceleration[:, part], mass[part])
        for sign, side in ((1.0, contacts.body2), (-1.0, contacts.body1)):
            mine = np.isin(side, part)
            for axis in range(3):
                pushed = np.bincount(contacts.row[mine], contacts.force[mine, axis], minlength=len(trajectory.t))
                force[:, axis] -= sign * pushed
        yield str(joint["name"]), (str(joint["body"]),), np.sqrt((force**2).sum(axis=1))


def _below(parent: np.ndarray) -> np.ndarray:
    """(B, B) bool: [i, b] tells whether body i is b or hangs below it."""
    found = np.eye(len(parent), dtype=bool)
    for i in range(len(parent)):
        up = int(parent[i])
        while up >= 0:
            found[i, up] = True
            up = int(parent[up])
    return found
