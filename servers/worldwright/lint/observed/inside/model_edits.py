"""Watch changes of a compiled model: those that pile up, that reach nothing, or that leave half of a thing as it was."""

import re
from typing import Any

import called_names
import meaning
import numpy as np
from owners import CALL, DataState, ModelState, raw
from said import SAID
from tracked import Tracked, note_of, plain

ANEW = re.compile(r"reset|random|sample|episode|perturb|vary|domain|setup|apply|trial")


def wrote(array: Tracked, key: Any, value: Any, operation: Any, places: Any, line: int) -> None:
    """Look at a write into a model's array before it happens."""
    note = array.note
    assert note is not None
    owner, field = note.owner, note.field or ""
    flat = np.ravel(places)
    other = note_of(value)
    if operation is None and isinstance(value, Tracked) and other is not None and other.live and other.field == field:
        return  # the second half of `a[i] *= b`
    owner.version += 1
    changes = owner.changes.setdefault(field, {})
    places_now = [int(p) for p in flat[:2000]]
    if not places_now:
        return
    first = places_now[0]
    own = operation is not None and operation[0].__name__ in ("multiply", "add", "true_divide", "divide", "subtract")
    if operation is None and other is not None and field in other.labels and other.since is not None:
        model, version = other.since
        own = model == id(owner) and version >= changes.get(first, (0, 0))[1]
    started, _ = changes.get(first, (-1, 0))
    changes.update(dict.fromkeys(places_now, (owner.starts if own else -1, owner.version)))
    if not own:
        return
    operand = plain(operation[1][1]) if operation is not None and len(operation[1]) > 1 else value
    seen = owner.operands.setdefault((field, line, first), [])
    seen.append(np.ravel(np.asarray(plain(operand), float)).tolist()[:4])
    if 0 <= started < owner.starts:
        owner.piled[line] = owner.piled.get(line, 0) + 1
        varied = any(s != seen[0] for s in seen) and operation is not None
        if owner.piled[line] >= 2 and (varied or ANEW.search(called_names.function_at(line))):
            SAID.event("change_piles_up", line)


def after_step(state: ModelState, data: DataState) -> None:
    """Look at a changed model after a step."""
    if "body_mass" in state.written and "inertia" not in state.told:
        _heavier(state, data)
    if "geom_pos" in state.written and "place" not in state.told:
        _moved(state, data)


def _moved(state: ModelState, data: DataState) -> None:
    """Report a body whose only shape is moved while its mass stays where it was."""
    model = state.of
    line, places = state.written["geom_pos"]
    inertial = state.written.get("body_ipos", (0, set()))[1]
    for geom in {p // 3 for p in places}:
        body = int(raw(model, "geom_bodyid")[geom])
        alone = int(raw(model, "body_geomnum")[body]) == 1 and float(raw(model, "body_mass")[body]) > 0
        apart = np.abs(raw(model, "geom_pos")[geom] - raw(model, "body_ipos")[body]).max()
        turning = [d for d in range(model.nv) if _turns(model, d, [body])]
        followed = inertial & {3 * body, 3 * body + 1, 3 * body + 2}
        turns = bool(turning) and np.abs(raw(data.of, "qvel")[turning]).max() > 0.05
        if alone and body and not followed and apart > 1e-3 and turns:
            state.told.add("place")
            SAID.event("mass_left", line)


def before_step(state: ModelState, data: DataState) -> None:
    """Look at a changed model before a step."""
    model = state.of
    for name in ("body_pos", "body_quat"):
        if name in state.written:
            _placed(state, data, name)
    if "geom_size" in state.written and "size" not in state.told and model.ngeom:
        _larger(state)


def _placed(state: ModelState, data: DataState, name: str) -> None:
    """Report a changed body frame that a free joint, or the program itself, carries."""
    line, places = state.written[name]
    model, width = state.of, 3 if name == "body_pos" else 4
    kinds, first = raw(model, "jnt_type"), raw(model, "body_jntadr")
    bodies = {p // width for p in places}
    if len(bodies) > 0.5 * model.nbody > 2:
        return
    for body in bodies:
        joint = int(first[body])
        if (
            joint >= 0
            and int(kinds[joint]) == meaning.FREE
            and not data.free_written & {int(raw(model, "jnt_qposadr")[joint])}
        ):
            SAID.event("body_frame_unused", line, name=name, instead="data.qpos")
        mocap = int(raw(model, "body_mocapid")[body])
        live = "mocap_pos" if name == "body_pos" else "mocap_quat"
        if mocap >= 0 and not np.allclose(raw(data.of, live)[mocap], raw(model, name)[body]) and live not in data.ever:
            SAID.event("body_frame_unused", line, name=name, instead=f"data.{live}")


def _heavier(state: ModelState, data: DataState) -> None:
    """Report a body that turns, whose mass is changed and whose inertia is not."""
    model = state.of
    line, places = state.written["body_mass"]
    whole = state.written.get("body_inertia", (0, set()))[1]
    mass, old = raw(model, "body_mass"), state.first["body_mass"]
    alone = [
        b for b in places
        if b and old[b] > 0 and not {3 * b, 3 * b + 1, 3 * b + 2} & whole and abs(mass[b] / old[b] - 1) > 0.05
    ]  # fmt: skip
    if not alone:
        return
    turning = [d for d in range(model.nv) if _turns(model, d, alone)]
    if not turning or np.abs(raw(data.of, "qvel")[turning]).max(initial=0.0) < 0.05:
        return
    state.looked += 1
    if state.looked >= 8:
        state.told.add("inertia")
    import copy

    import mujoco

    twin = copy.copy(model)
    for body in alone:
        raw(twin, "body_inertia")[body] *= mass[body] / old[body]
    one, other = copy.copy(model), twin
    for each in (one, other):
        CALL["mj_setConst"](each, mujoco.MjData(each))
    a, b = raw(one, "dof_M0")[turning], raw(other, "dof_M0")[turning]
    if (np.abs(a - b) > 0.1 * np.abs(b)).any():
        state.told.add("inertia")
        SAID.event("inertia_left", line)


def _turns(model: Any, dof: int, bodies: list[int]) -> bool:
    """Whether a degree of freedom turns one of the bodies."""
    kind = int(raw(model, "jnt_type")[int(raw(model, "dof_jntid")[dof])])
    first = int(raw(model, "jnt_dofadr")[int(raw(model, "dof_jntid")[dof])])
    if kind == 2 or (kind == meaning.FREE and dof - first < 3):
        return False
    carrier, parent = int(raw(model, "dof_bodyid")[dof]), raw(model, "body_parentid")
    for body in bodies:
        while body > 0:
            if body == carrier:
                return True
            body = int(parent[body])
    return False


def _larger(state: ModelState) -> None:
    """Report a shape that grows while the bounds with which the engine looks for contacts do not."""
    line, places = state.written["geom_size"]
    model = state.of
    size, old = raw(model, "geom_size"), state.first["geom_size"]
    bounds, kinds = raw(model, "geom_rbound"), raw(model, "geom_type")
    changed = state.written.get("geom_rbound", (0, set()))[1] | state.written.get("geom_aabb", (0, set()))[1]
    for geom in {p // 3 for p in places}:
        grown = int(kinds[geom]) in (2, 3, 5, 6) and size[geom].max() > 1.02 * old[geom].max() > 0
        if grown and not changed and float(bounds[geom]) < float(size[geom].max()) * 0.99:
            state.told.add("size")
            SAID.event("bounds_left", line)
            return
