"""Watch the engine's classes and functions: what they return carries notes, and what they do is remembered."""

import re
import threading
from typing import Any

import angle_sizes
import inputs_held
import jacobian_points
import made_worlds
import meaning
import model_edits
import mujoco
import owners
import quaternion_names
import ray_lengths
import state_columns
import uses
from fields import Attention, Enough, Progress, here, raw_time, watch_fields
from named import watch_access, watch_views
from owners import CALL, OWNERS, DataState, data_state, model_state
from said import SAID, meeting
from tracked import Index, Note, Real, Tracked, note_of, plain, safe

STEPS = ("mj_step", "mj_step1", "mj_step2", "mj_RungeKutta", "mj_Euler", "mj_implicit")
COMPUTE = (*STEPS, "mj_forward", "mj_forwardSkip", "mj_inverse", "mj_fwdPosition", "mj_kinematics", "mj_invPosition",
    "mj_fwdKinematics")  # fmt: skip
READERS = {"mj_jac": "cdof", "mj_jacBody": "cdof", "mj_jacBodyCom": "cdof", "mj_jacSite": "cdof", "mj_jacGeom": "cdof",
    "mj_jacSubtreeCom": "cdof", "mj_jacPointAxis": "cdof", "mj_objectVelocity": "cvel", "mj_mulM": "M", "mj_fullM": "M",
    "mj_ray": "geom_xpos", "mj_multiRay": "geom_xpos", "mj_geomDistance": "geom_xpos", "mj_applyFT": "cdof"}  # fmt: skip


# -- functions ------------------------------------------------------------------------------------------------------


def watch_functions() -> None:
    """Watch every function of the engine that takes data or arrays."""
    for name in dir(mujoco):
        if not re.match(r"(mj_|mju_|mjd_|mjv_|mjr_|set_mjcb_)", name):
            continue
        original = getattr(mujoco, name)
        if not callable(original) or isinstance(original, type):
            continue
        CALL[name] = original
        setattr(mujoco, name, _function(name, original))


def _function(name: str, original: Any) -> Any:
    def call(*given: Any, **named: Any) -> Any:
        if SAID.frame(2) is None:
            return original(*map(plain, given), **{k: plain(v) for k, v in named.items()})
        bare = [getattr(plain(g), "_of", plain(g)) for g in given]
        bare_named = {k: plain(v) for k, v in named.items()}
        everything = [*bare, *bare_named.values()]
        data = next((g for g in everything if isinstance(g, mujoco.MjData)), None)
        state = safe(data_state, data) if data is not None else None
        line = SAID.line()
        if state is not None:
            safe(_before, name, state, line, everything, given)
        elif name.startswith("mju_"):
            safe(quaternion_names.called, name, given)
            safe(angle_sizes.turned, name, everything, line)
        if name in STEPS and threading.get_ident() != Progress.main and state is not None and len(state.threads) > 1:
            raise Enough
        if state is not None:
            state.busy += 1
        try:
            found = original(*bare, **bare_named)
        finally:
            if state is not None:
                state.busy -= 1
        return safe_after(name, state, line, given, everything, found)

    call.__name__ = name
    call.__doc__ = original.__doc__
    return call


def safe_after(name: str, state: Any, line: int, given: tuple[Any, ...], everything: list[Any], found: Any) -> Any:
    """Look at the result of a call and return it as the program sees it."""
    changed = safe(_after, name, state, line, given, everything, found)
    if Progress.steps > Progress.most:
        raise Enough
    return found if changed is None else changed


def _before(name: str, state: DataState, line: int, everything: list[Any], given: tuple[Any, ...]) -> None:
    from lifecycle import LIFE

    if name in READERS and state.dirty:
        state.read(READERS[name], line)
    if name in ("mj_applyFT", "mj_jac"):
        jacobian_points.applied(state, everything, line)
    if name in ("mj_jacBody", "mj_jacBodyCom"):
        jacobian_points.asked(name, state, everything, line)
    if name == "mj_contactForce":
        LIFE.contact_force(state, everything, line)
    here_now = threading.get_ident()
    if here_now != Progress.main or name in STEPS:
        state.threads.add(here_now)
        others = state.threads - {Progress.main}
        if (len(others) > 1 or (state.busy and len(state.threads) > 1)) and not state.shared:
            state.shared = True
            SAID.event("shared_data", line)
    if name in STEPS:
        if state.model.written:
            owners.without_effect(state.model, state)
            model_edits.before_step(state.model, state)
        state.still_on = []
        inputs_held.before_step(state, _steps(name, everything))
        state.before_step(line)
        for field in state.still_on:
            inputs_held.left_over(state, field)
        LIFE.before_step(state, line)


def _steps(name: str, everything: list[Any]) -> int:
    """How many steps a call takes."""
    return next((g for g in everything if type(g) is int), 1) if name == "mj_step" else 1


def _after(
    name: str, state: DataState | None, line: int, given: tuple[Any, ...], everything: list[Any], found: Any
) -> Any:
    from lifecycle import LIFE

    if state is not None:
        if name in COMPUTE:
            state.partial = line if name == "mj_kinematics" and (state.dirty or state.partial) else 0
            state.dirty.clear()
        elif name in ("mj_resetData", "mj_resetDataKeyframe", "mj_resetDataDebug"):
            state.cleared()
            if name == "mj_resetData":
                state.model.reset_line = state.model.reset_line or line
            else:
                state.model.key_used = True
        elif name == "mj_setConst":
            state.model.told.add("setConst")
        elif name == "mj_setState":
            state.cleared()
            LIFE.state_set(state, everything, line)
        elif name == "mj_getState":
            LIFE.state_got(state, everything)
            state_columns.got(state, given, everything)
        elif name == "mj_integratePos":
            state.wrote("qpos", line)
        elif name == "mj_copyData":
            state.cleared()
        if name == "mj_jacBodyCom":
            made_worlds.com_jacobian(state, everything, line)
        if name in STEPS and state.model.written:
            model_edits.after_step(state.model, state)
        if name in STEPS:
            Attention.tick += 1
            if not state.looked:
                state.looked = 1
                made_worlds.first_step(state, line)
            number = _steps(name, everything)
            Progress.steps += min(max(number, 1), 200)
            state.epoch += max(number, 1)
            state.reset = False
            now = raw_time(state)
            fell, state.last_time = now <= state.last_time or state.epoch <= 5, now
            if fell and not state.warned:
                LIFE.unstable(state, line)
    _outputs(name, state, given)
    if name in ("mj_ray", "mj_multiRay") and state is not None:
        return ray_lengths.cast(name, state, line, given, everything, found)
    if name == "mj_integratePos":
        target = note_of(given[1]) if len(given) > 1 else None
        if target is not None and target.live and isinstance(target.owner, DataState):
            target.owner.wrote("qpos", line)
    if name == "mj_name2id" and len(everything) > 1:
        word = str(getattr(everything[1], "name", mujoco.mjtObj(int(everything[1])).name)).removeprefix("mjOBJ_")
        kind = meaning.OF_OBJECT.get(word)
        return Index.of(found, kind, Note(line=line)) if kind else None
    if name.startswith("set_mjcb_"):
        LIFE.callback(name, given[0] if given else None)
    return None


def _outputs(name: str, state: Any, given: tuple[Any, ...]) -> None:
    """Note on the arrays that a function filled what is in them now."""
    if not name.startswith(("mj_jac", "mj_objectV", "mj_objectA", "mj_contactForce", "mju_", "mj_mulM", "mj_rne")):
        return
    places = [g for g in given if isinstance(g, Tracked) and g.note is not None and g.note.store is not None]
    frame: Any = None
    if name in ("mj_objectVelocity", "mj_objectAcceleration") and len(given) > 5:
        frame = ("object", int(given[3])) if int(given[5]) else "world"
    elif name == "mj_contactForce":
        frame = ("contact", int(given[2]))
    elif name == "mju_mat2Quat" or (
        name.startswith("mju_") and "Quat" in name and name not in ("mju_subQuat", "mju_rotVecQuat")
    ):
        if places and places[0].shape == (4,) and places[0] is given[0]:
            places[0].note.kind = "wxyz"
        return
    for place in places:
        store, at = place.note.store, place.note.at
        label = name
        if at is not None and (place is given[0] or not name.startswith("mju_")):
            filled = set(at.ravel().tolist())
            store["frames"] = [f for f in store["frames"] if not f[0] & filled]
        if name.startswith("mj_jac") and len(given) > 3 and place is given[3]:
            label = "angular jacobian"
        if name == "mju_subQuat":
            if place is not given[0]:
                continue
            store["labels"] = frozenset(word for word in store["labels"] if "mat" not in word)
        elif name.startswith("mju_"):
            continue
        store["labels"] |= {label}
        if frame is not None and at is not None:
            parts = (at.ravel()[:3], at.ravel()[3:6])
            store["frames"] = [*[f for f in store["frames"] if not f[0] <= set(at.ravel().tolist())],
                *[(frozenset(p.tolist()), frame) for p in parts]]  # fmt: skip


def install() -> None:
    """Watch everything."""
    import lifecycle

    Progress.main = threading.get_ident()
    watch_fields(mujoco.MjModel, model_state)
    watch_fields(mujoco.MjData, data_state)
    watch_access(mujoco.MjModel, model_state)
    watch_access(mujoco.MjData, data_state)
    for name, cls in list(vars(mujoco._structs).items()):
        if name.endswith("Views") and isinstance(cls, type):
            watch_views(cls)
    option = mujoco.MjOption
    step = vars(option)["timestep"]

    def timestep(self: Any) -> Any:
        found = step.fget(self)
        return Real.of(found, Note(labels=frozenset(("timestep",)))) if here() else found

    option.timestep = property(timestep, lambda self, v: step.fset(self, plain(v)))  # type: ignore[assignment]
    watch_functions()
    lifecycle.install()
    state_columns.install()
    assert uses is not None and OWNERS is not None and meeting is not None
