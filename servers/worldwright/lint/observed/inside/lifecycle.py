"""Watch a program over its life: specifications, models, callbacks, pictures, saved states, batches."""

import sys
from typing import Any

import mujoco
import numpy as np
import owners
import quaternion_names
from owners import CALL, DataState, model_state
from said import SAID, meeting
from tracked import Note, Tracked, plain, safe

SAVED = (("act", "ACT"), ("qvel", "QVEL"), ("qpos", "QPOS"), ("plastic", "PLASTIC"), ("history", "HISTORY"))


class Life:
    """What has happened so far."""

    def __init__(self) -> None:
        self.edits: list[tuple[int, list[tuple[int, int]]]] = []
        self.compiled: dict[int, tuple[Any, str, int, list[tuple[int, int]]]] = {}
        """For each model: its specification, the text of it, the number of edits until then, and where it was compiled."""
        self.callbacks = owners.CALLBACKS
        self.saved: dict[bytes, dict[str, Any]] = {}
        self.forces: dict[int, tuple[set[int], set[int]]] = {}

    def before_step(self, state: DataState, line: int) -> None:
        """Ask of a model that is stepped whether it is the one that the program means."""
        model = state.model
        if not model.first_step_line:
            model.first_step_line = line
        if state.replaced:
            SAID.event("recompiled_in_vain", state.replaced)
        made = self.compiled.get(id(model.of))
        if made is not None:
            spec, text, edits, stack = made
            if len(self.edits) > edits:
                last = self.edits[-1]
                self.compiled[id(model.of)] = (spec, text, len(self.edits), stack)
                if spec.to_xml() != text:
                    SAID.event("edited_too_late", meeting(stack, last[1]), edit=last[0])
        for name, (function, where, models) in self.callbacks.items():
            if function is not None:
                models.add(id(model.of))
                if len(models) > 1:
                    SAID.event("callback_left", where, name=name, step=line)

    def callback(self, name: str, function: Any) -> None:
        """Note that a global callback is set or cleared."""
        self.callbacks[name] = (function, SAID.line(), set())

    def contact_force(self, state: DataState, everything: list[Any], line: int) -> None:
        """Note which geoms are first and which second in the contacts whose force a line asks for."""
        contact = owners.raw(state.of, "contact")[int(everything[2])]
        first, second = self.forces.setdefault(line, (set(), set()))
        first.add(int(contact.geom1))
        second.add(int(contact.geom2))
        frame = SAID.frame()
        if first & second and frame is not None:
            import re

            import made_worlds

            begin = frame.f_code.co_firstlineno if frame.f_code.co_name != "<module>" else max(line - 8, 1)
            text = "\n".join(made_worlds.TEXT[begin - 1 : line + 8])
            signed = r"geom[12]?(\[[01]\])?\s*[=!]=|[=!]=\s*\w+\.geom|-=|sign|abs\(|norm|\[0\]|-\s*1|-\s*\w*(world|force|f\b)"
            if re.search(r"\bin\b[^\n]*geom", text) and not re.search(signed, text):
                SAID.event("both_sides", line + 2 if line + 2 <= len(made_worlds.TEXT) else line)

    def state_got(self, state: DataState, everything: list[Any]) -> None:
        """Note, for a state that is saved in part, the rest of it."""
        vector = next((g for g in everything if isinstance(g, np.ndarray)), None)
        if vector is not None and len(self.saved) < 500:
            self.saved[vector.tobytes()] = {n: owners.raw(state.of, n).copy() for n, _ in SAVED}

    def state_set(self, state: DataState, everything: list[Any], line: int) -> None:
        """Report what is not as it was when a state is put back."""
        vector = next((g for g in everything if isinstance(g, np.ndarray)), None)
        old = self.saved.get(vector.tobytes()) if vector is not None else None
        if old is None:
            return
        bits = next((int(g) for g in everything[::-1] if not isinstance(g, np.ndarray | mujoco.MjData)), 0)
        left = []
        for name, word in SAVED:
            bit = getattr(mujoco.mjtState, f"mjSTATE_{word}", None)
            now = owners.raw(state.of, name)
            if bit is None or bits & int(bit) or now.shape != old[name].shape:
                continue
            if not np.allclose(now, old[name], rtol=1e-6, atol=1e-9):
                left.append(name)
        if left:
            SAID.event("state_in_part", line, name=", ".join(left))

    def unstable(self, state: DataState, line: int) -> None:
        """Report that the engine gave up and reset the state."""
        for which in (
            mujoco.mjtWarning.mjWARN_BADQACC,
            mujoco.mjtWarning.mjWARN_BADQPOS,
            mujoco.mjtWarning.mjWARN_BADQVEL,
        ):
            if owners.raw(state.of, "warning")[int(which)].number:
                state.warned = True
                SAID.event("unstable", line, time=round(float(owners.raw(state.of, "time")), 4))


LIFE = Life()


def _edits(cls: type) -> None:
    for name, member in list(vars(cls).items()):
        if type(member) is property and member.fset is not None:

            def put(self: Any, value: Any, _set: Any = member.fset, _name: str = name) -> None:
                if sys._getframe(1).f_code.co_filename == SAID.program:
                    LIFE.edits.append((SAID.line(), SAID.stack()))
                    if _name == "quat":
                        safe(quaternion_names.given, value, _name)
                _set(self, plain(value))

            setattr(cls, name, property(member.fget, put, doc=member.__doc__))
        elif name.startswith(("add_", "attach", "delete", "set_to", "make_", "detach")) and callable(member):

            def call(self: Any, *given: Any, _call: Any = member, **named: Any) -> Any:
                if sys._getframe(1).f_code.co_filename == SAID.program:
                    LIFE.edits.append((SAID.line(), SAID.stack()))
                    if "quat" in named:
                        safe(quaternion_names.given, named["quat"], "quat")
                return _call(self, *map(plain, given), **{k: plain(v) for k, v in named.items()})

            setattr(cls, name, call)


def _specifications() -> None:
    for name, cls in list(vars(mujoco._specs).items()):
        if isinstance(cls, type) and name.startswith("Mjs"):
            _edits(cls)
    _edits(mujoco.MjSpec)
    compile_, recompile = mujoco.MjSpec.compile, mujoco.MjSpec.recompile

    def compiled(self: Any, *given: Any, **named: Any) -> Any:
        model = compile_(self, *given, **named)
        if isinstance(model, mujoco.MjModel):
            LIFE.compiled[id(model)] = (self, self.to_xml(), len(LIFE.edits), SAID.stack())
            _note_model(model, "")
        return model

    def again(self: Any, model: Any, data: Any) -> Any:
        found = recompile(self, model, data)
        if isinstance(found, tuple) and len(found) == 2 and found[1] is not data:
            owners.data_state(data).replaced = SAID.line()
            LIFE.compiled[id(found[0])] = (self, self.to_xml(), len(LIFE.edits), SAID.stack())
        return found

    mujoco.MjSpec.compile, mujoco.MjSpec.recompile = compiled, again
    for name in ("from_xml_string", "from_xml_path"):
        original = getattr(mujoco.MjModel, name)

        def made(*given: Any, _original: Any = original, _name: str = name, **named: Any) -> Any:
            model = _original(*given, **named)
            safe(_note_model, model, str(given[0]) if given and _name == "from_xml_string" else "")
            return model

        setattr(mujoco.MjModel, name, staticmethod(made))


def _note_model(model: Any, text: str) -> None:
    state = model_state(model)
    state.made_line, state.made_stack = SAID.line(), SAID.stack()
    state.keyed_text = "<key " in text
    import made_worlds

    made_worlds.look(state, text)


def _pictures() -> None:
    renderer = mujoco.Renderer
    update, render, segment = renderer.update_scene, renderer.render, renderer.enable_segmentation_rendering
    stop = renderer.disable_segmentation_rendering
    seen: dict[int, list[Any]] = {}

    def updated(self: Any, data: Any, *given: Any, **named: Any) -> Any:
        if SAID.frame() is not None:
            state = owners.data_state(data)
            if state.dirty and "" not in state.dirty:
                safe(state.read, "geom_xpos", SAID.line())
            seen[id(self)] = [state, state.epoch, 0]
        return update(self, data, *map(plain, given), **{k: plain(v) for k, v in named.items()})

    def rendered(self: Any, *given: Any, **named: Any) -> Any:
        last = seen.get(id(self))
        if last is not None:
            last[2] += 1
            if last[2] > 1 and last[0].epoch != last[1]:
                SAID.event("picture_not_updated")
        found = render(self, *map(plain, given), **{k: plain(v) for k, v in named.items()})
        if id(self) in segmenting and isinstance(found, np.ndarray):
            picture = found.view(Tracked)
            picture.note = Note(kind="segmentation")
            return picture
        return found

    segmenting: set[int] = set()

    def start(self: Any) -> Any:
        segmenting.add(id(self))
        return segment(self)

    def end(self: Any) -> Any:
        segmenting.discard(id(self))
        return stop(self)

    renderer.update_scene, renderer.render = updated, rendered
    renderer.enable_segmentation_rendering, renderer.disable_segmentation_rendering = start, end


FREELY_READ = {
    "qpos",
    "qvel",
    "ctrl",
    "act",
    "time",
    "xfrc_applied",
    "qfrc_applied",
    "mocap_pos",
    "mocap_quat",
    "eq_active",
}


def _batches() -> None:
    try:
        from mujoco import batch
    except ImportError:
        return
    bind, stepped = batch.Batch.bind, set()

    def bound(self: Any, *given: Any, **named: Any) -> Any:
        found = bind(self, *given, **named)
        late = id(self) in stepped and given and isinstance(given[0], str) and given[0] not in FREELY_READ
        if late and isinstance(found, np.ndarray) and found.size and not found.any():
            SAID.event("bound_too_late", name=given[0])
        return found

    batch.Batch.bind = bound
    for name in ("step", "forward", "rollout"):
        original = getattr(batch.Batch, name)

        def run(self: Any, *given: Any, _original: Any = original, **named: Any) -> Any:
            stepped.add(id(self))
            return _original(self, *map(plain, given), **named)

        setattr(batch.Batch, name, run)


def at_end() -> None:
    """Report what is only known when the program is over."""
    import gc

    import angle_sizes
    import half_sizes
    import inputs_held
    import jacobian_points
    import ray_lengths
    import uses

    safe(inputs_held.at_end, list(owners.OWNERS.values()))
    for end in (ray_lengths.at_end, half_sizes.at_end, jacobian_points.at_end, angle_sizes.at_end, inputs_held.noise):
        safe(end)
    for state in list(owners.OWNERS.values()):
        if isinstance(state, owners.ModelState) and state.keyed_text and not state.key_used and state.first_step_line:
            SAID.event("keyframe_unused", state.reset_line or state.made_line)
    for state in list(owners.OWNERS.values()):
        if isinstance(state, DataState):
            import made_worlds

            safe(made_worlds.fell_through, state)
    for held in gc.get_objects():
        if type(held) in (list, tuple) and 1 < len(held) < 100_000 and isinstance(held[0], Tracked | tuple | list):
            first = held[0]
            if isinstance(first, Tracked):
                safe(uses.same_views, held)
            elif len(first) and isinstance(first, tuple | list) and len(first) < 20:
                for place in range(len(first)):
                    if isinstance(first[place], Tracked):
                        column = [h[place] for h in held if isinstance(h, tuple | list) and len(h) > place]
                        safe(uses.same_views, column)


def install() -> None:
    """Watch specifications, pictures and batches."""
    _specifications()
    _pictures()
    _batches()
    assert CALL is not None
