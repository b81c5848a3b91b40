"""A thing holds like one body until the stress in a bond is its strength, and breaks there, once, for good."""

import math
from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldkit import bodies, breaking, scene
from worldkit.errors import ProgramError
from worldkit.mirror import Mirror, address
from worldkit.strays import Derived

STEP = 0.001


def loaded(
    spec: mujoco.MjSpec, load: Callable[[mujoco.MjModel, mujoco.MjData], float], most_s: float
) -> tuple[float, list[str], mujoco.MjModel, mujoco.MjData]:
    """Step a world under a load until a bond breaks: the load then, names of what broke, the world."""
    model = spec.compile()
    data, let_go = mujoco.MjData(model), breaking.LettingGo()
    while data.time < most_s:
        mujoco.mj_step1(model, data)
        force = load(model, data)
        if let_go(model, data):
            broken = [model.equality(n).name for n in range(model.neq) if not data.eq_active[n]]
            return force, broken, model, data
        mujoco.mj_step2(model, data)
    return force, [], model, data


def pulled(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    """A force that grows by 5 kN/s, down the axis of the lowest piece."""
    force, body = 5000.0 * data.time, model.body("chalk_1").id
    arm = np.array([0, 0, data.xipos[body, 2]]) - data.xipos[body]
    data.xfrc_applied[body] = [0, 0, -force, *np.cross(arm, [0, 0, -force])]
    return force


@pytest.mark.parametrize("skew", [0.0, 1.0])
def test_a_rod_pulled_apart_breaks_at_strength_times_section(skew: float) -> None:
    """Cut straight or aslant: the largest tension in the material is the same."""
    spec = scene.new("pull", time_step=STEP, gravity=(0, 0, 0))
    rod = breaking.rod(0.01, 0.1, pieces=4, seed=1, skew=skew)
    breaking.add(spec, "chalk", rod, "chalk", pos=(0, 0, 1), held={"world": ((0, 0, 1),)})
    force, broken, _, _ = loaded(spec, pulled, 0.2)
    exact = 3e6 * math.pi * 0.005**2
    assert broken and exact <= force <= exact + 2 * 5000.0 * STEP


def test_a_bent_bar_breaks_in_the_middle_at_its_modulus_of_rupture() -> None:
    """Three-point bending: sigma = 3 F L / (2 b h^2)."""
    b, h, span = 0.04, 0.01, 0.2
    spec = scene.new("bend", time_step=STEP, gravity=(0, 0, 0))
    edges = np.linspace(-0.11, 0.11, 7)
    corners = [(x, y, z) for x in (-0.11, 0.11) for y in (-b / 2, b / 2) for z in (-h / 2, h / 2)]
    bar = breaking.convex(corners, [(x, 0, 0) for x in (edges[1:] + edges[:-1]) / 2])
    breaking.add(spec, "bar", bar, "chalk", pos=(0, 0, 0.3))
    for side, x in (("left", -span / 2), ("right", span / 2)):
        bodies.cylinder(spec, side, diameter=0.01, height=0.1, pos=(x, 0, 0.29), tilt_deg=90, fixed=True)

    def pressed(model: mujoco.MjModel, data: mujoco.MjData) -> float:
        force = 100.0 * data.time
        for n in (3, 4):  # half on either side of the middle, so that the moment there is F L / 4
            body = model.body(f"bar_{n}").id
            arm = np.array([0, 0, 0.305]) - data.xipos[body]
            data.xfrc_applied[body] = [0, 0, -force / 2, *np.cross(arm, [0, 0, -force / 2])]
        return force

    force, broken, _, _ = loaded(spec, pressed, 0.6)
    assert broken == ["bar_3/bar_4"]
    assert force == pytest.approx(3e6 * 2 * b * h**2 / (3 * span), rel=0.02)


TURNS = {
    "not at all": (1.0, 0.0, 0.0, 0.0),
    "about x": (0.5**0.5, 0.5**0.5, 0.0, 0.0),
    "about y": (0.5**0.5, 0.0, 0.5**0.5, 0.0),
    "about z": (0.5**0.5, 0.0, 0.0, 0.5**0.5),
    "aslant": (0.1, 0.5, -0.7, 0.5),
}
B, H = 0.02, 0.01
LOADS = {
    "pulled": ((-100, 0, 0), (0, 0, 0), 100 / (B * H)),
    "pressed": ((100, 0, 0), (0, 0, 0), 0.0),
    "bent": ((0, 0, 0), (0, 1, 0), 6 / (B * H**2)),
    "bent the other way": ((0, 0, 0), (0, 0, 1), 6 / (H * B**2)),
    "twisted": ((0, 0, 0), (1, 0, 0), (3 + 1.8 * H / B) / (B * H**2)),
}


@pytest.mark.parametrize("turned", TURNS)
@pytest.mark.parametrize("way", LOADS)
@pytest.mark.parametrize("built", [True, False])
def test_a_bond_carries_the_same_however_it_is_turned(turned: str, way: str, built: bool) -> None:
    """A pair of blocks along x, turned as one, in its own world or since; the load, N and N m, turns with it."""
    force, torque, exact = LOADS[way]
    spec = scene.new("pair", time_step=STEP, gravity=(0, 0, 0))
    corners = [(x, y, z) for x in (-0.05, 0.05) for y in (-B / 2, B / 2) for z in (-H / 2, H / 2)]
    pair = breaking.convex(corners, [(-0.025, 0, 0), (0.025, 0, 0)])
    breaking.add(spec, "bar", pair, "chalk", pos=(0, 0, 1), yaw_deg=37.0 if built else 0.0)
    model = spec.compile()
    data, frame, turn, middle = mujoco.MjData(model), np.zeros(9), np.array(TURNS[turned]), np.array([0, 0, 1.0])
    for first in (0, 7):
        start = data.qpos[first : first + 7].copy()
        mujoco.mju_rotVecQuat(data.qpos[first : first + 3], start[:3] - middle, turn)
        data.qpos[first : first + 3] += middle
        mujoco.mju_mulQuat(data.qpos[first + 3 : first + 7], turn, start[3:])
    mujoco.mju_quat2Mat(frame, data.qpos[3:7])
    for body, sign in ((1, 1), (2, -1)):
        data.xfrc_applied[body] = sign * np.concatenate([frame.reshape(3, 3) @ force, frame.reshape(3, 3) @ torque])
    mujoco.mj_forward(model, data)
    carried = breaking.stresses(breaking.bonds_of(model), data)
    assert carried == pytest.approx([exact], rel=2e-3, abs=1.0)


def test_a_hold_is_pulled_along_the_face_it_holds_however_its_frame_is_turned() -> None:
    spec = scene.new("hold", time_step=STEP, gravity=(0, 0, 0))
    bodies.box(spec, "frame", size=(0.02, 0.02, 0.02), pos=(0, 0, 0.1), yaw_deg=60, fixed=True)
    rod = breaking.rod(0.01, 0.1, pieces=2, skew=0)
    breaking.add(spec, "chalk", rod, "chalk", pos=(0, 0, 0.5), tilt_deg=90, yaw_deg=25, held={"frame": ((0, 1, 0),)})
    model = spec.compile()
    data, bonds = mujoco.MjData(model), breaking.bonds_of(model)
    hold = next(n for n in range(2) if "frame" in model.equality(int(bonds.equality[n])).name)
    piece = int(bonds.pieces[hold, 0])
    mujoco.mj_forward(model, data)
    along = data.xmat[int(bonds.second[hold])].reshape(3, 3) @ bonds.axes[hold, 0]
    outward = (-math.sin(math.radians(25)), math.cos(math.radians(25)), 0)
    assert along == pytest.approx(outward, abs=1e-9)
    for pull, exact in ((-50, 50 / (math.pi * 0.005**2)), (50, 0.0)):
        data.xfrc_applied[piece, :3] = pull * along
        mujoco.mj_forward(model, data)
        assert breaking.stresses(bonds, data)[hold] == pytest.approx(exact, rel=2e-3, abs=10.0)


def pane(step: float = STEP, of: str = "glass") -> mujoco.MjSpec:
    spec = scene.new("pane", time_step=step)
    made = breaking.plate((0.4, 0.003, 0.4), 16, seed=3, struck_at=(0, 0, 0))
    breaking.add(spec, "pane", made, of, pos=(0, 0, 0.6), held={"world": ((1, 0, 0), (-1, 0, 0))})
    return spec


def test_pieces_weigh_as_much_as_the_whole() -> None:
    model = pane().compile()
    assert model.body_mass.sum() == pytest.approx(0.4 * 0.4 * 0.003 * 2500, rel=1e-12)


@pytest.mark.parametrize("step", [0.002, 0.0005])
def test_what_is_whole_neither_sags_nor_trembles_nor_touches_itself(step: float) -> None:
    model = pane(step).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    first = data.xpos.copy()
    mujoco.mj_step(model, data, 40)
    assert np.abs(data.xpos - first).max() < 1e-6
    assert np.abs(data.qvel).max() < 1e-5
    assert data.ncon == 0


def test_a_load_below_the_strength_breaks_nothing_and_one_above_breaks_for_good() -> None:
    spec = scene.new("pull", time_step=STEP, gravity=(0, 0, 0))
    rod = breaking.rod(0.01, 0.1, pieces=3, seed=1)
    breaking.add(spec, "chalk", rod, "chalk", pos=(0, 0, 1), held={"world": ((0, 0, 1),)})
    model = spec.compile()
    data, let_go = mujoco.MjData(model), breaking.LettingGo()
    counts = []
    for share in (0.9, 1.1, 0.0, 0.0):
        data.xfrc_applied[model.body("chalk_1").id, 2] = -share * 3e6 * math.pi * 0.005**2
        for _ in range(3):
            mujoco.mj_step1(model, data)
            counts.append(let_go(model, data))
            mujoco.mj_step2(model, data)
    assert sum(counts[:3]) == 0 and sum(counts[3:6]) > 0
    assert not data.eq_active.all()


def test_what_is_loose_collides_with_what_was_its_neighbour() -> None:
    spec = scene.new("fall", time_step=STEP, gravity=(0, 0, -9.81))
    breaking.add(
        spec, "bar", breaking.rod(0.02, 0.1, 2, skew=0), "chalk", pos=(0, 0, 0.3), held={"world": ((0, 0, -1),)}
    )
    model = spec.compile()
    data = mujoco.MjData(model)
    data.eq_active[model.equality("bar_1/bar_2").id] = 0
    mujoco.mj_step(model, data, 100)
    assert data.body("bar_2").xpos[2] > 0.32  # it stands on the lower piece


def test_solving_for_the_forces_again_is_no_stray(tmp_path: Path) -> None:
    """The rule changes what the engine derives, which nobody has to be told; its switches are the input."""
    program = tmp_path / "simulation.py"
    program.write_text(
        "from worldkit import breaking\nLET_GO = breaking.LettingGo()\ndef control(model, data):\n    LET_GO(model, data)\n"
    )
    space: dict = {}
    exec(compile(program.read_text(), str(program), "exec"), space)
    model = pane().compile()
    data = mujoco.MjData(model)
    mirror = Mirror(model, data)
    memory = np.zeros(mirror.size // 8 + 1)
    mujoco.mj_step1(model, data)
    mirror.send(address(memory))
    space["control"](model, data)
    derived = Derived(data, mirror, space["control"])
    assert data.qacc.any()
    assert list(derived.written(address(memory), mirror.buffer_in(address(memory)), sample=True)) == []


def test_a_hold_that_is_not_there_is_refused() -> None:
    spec = scene.new("pane", time_step=STEP)
    made = breaking.plate((0.4, 0.003, 0.4), 5)
    with pytest.raises(ValueError, match="not in the world yet"):
        breaking.add(spec, "pane", made, "glass", pos=(0, 0, 1), held={"frame": ((1, 0, 0),)})
    with pytest.raises(ValueError, match="no outer face"):
        breaking.add(spec, "pain", made, "glass", pos=(0, 0, 1), held={"world": ((1, 1, 1),)})


@pytest.mark.parametrize(
    ("strength", "held"), [(0.0, None), (-1.0, None), (math.nan, None), (math.inf, None), (3e6, 0.0)]
)
def test_a_strength_that_is_none_is_refused(strength: float, held: float | None) -> None:
    """A hold of 0 Pa is not the material's."""
    stuff, rod = breaking.material("chalk")._replace(strength_pa=strength), breaking.rod(0.01, 0.1, pieces=2)
    with pytest.raises(ValueError, match="finite number above 0"):
        breaking.add(scene.new("w", time_step=STEP), "chalk", rod, stuff, pos=(0, 0, 1), held_pa=held)


@pytest.mark.parametrize("force", [math.nan, 1e300])
def test_forces_that_are_no_numbers_end_in_a_word_about_them(force: float) -> None:
    model = pane().compile()
    data = mujoco.MjData(model)
    data.xfrc_applied[1, :3] = force, force, -force
    mujoco.mj_step1(model, data)
    with pytest.raises(ProgramError, match="no finite numbers at 0 s") as refused:
        breaking.LettingGo()(model, data)
    assert refused.value.next_move


def numbers(spec: mujoco.MjSpec) -> mujoco.MjsNumeric:
    return next(n for n in spec.numerics if n.name.startswith("bonds of "))


def list_again(spec: mujoco.MjSpec, kind: str, name: str) -> None:
    """A field of bonds whose tuple lists one thing, and whose numbers are sound."""
    spec.add_numeric(name="bonds of it", size=14, data=list(numbers(spec).data)[:14])
    spec.add_tuple(name="bonds of it", objtype=[int(getattr(mujoco.mjtObj, kind))], objname=[name], objprm=[0.0])


def tied(spec: mujoco.MjSpec, kind: str, one: str, other: str) -> None:
    tie = spec.add_equality(name="tie", type=getattr(mujoco.mjtEq, kind), name1=one, name2=other)
    tie.objtype = mujoco.mjtObj.mjOBJ_BODY
    list_again(spec, "mjOBJ_EQUALITY", "tie")


def renumbered(spec: mujoco.MjSpec, place: int, value: float) -> None:
    told = list(numbers(spec).data)
    told[place] = value
    numbers(spec).data = told


def shortened(spec: mujoco.MjSpec) -> None:
    numbers(spec).data, numbers(spec).size = list(numbers(spec).data)[:14], 14


MALFORMED = {
    "no numbers": (lambda s: setattr(numbers(s), "name", "of bonds"), "no numeric field of its name"),
    "too few numbers": (shortened, "each has 14"),
    "bodies": (lambda s: list_again(s, "mjOBJ_BODY", "pane_1"), "no equality"),
    "a ball joint": (lambda s: tied(s, "mjEQ_CONNECT", "pane_1", "pane_2"), "no weld"),
    "what stands still": (lambda s: tied(s, "mjEQ_WELD", "post", "world"), "cannot move"),
    "one weld twice": (lambda s: list_again(s, "mjOBJ_EQUALITY", s.equalities[0].name), "twice"),
    "no area": (lambda s: renumbered(s, 9, 0.0), "above 0"),
    "an endless strength": (lambda s: renumbered(s, 13, math.inf), "no finite number"),
    "axes that are none": (lambda s: renumbered(s, 0, 0.5), "no frame"),
    "axes that are no numbers": (lambda s: renumbered(s, 0, math.nan), "no finite number"),
}


@pytest.mark.parametrize("name", MALFORMED)
def test_a_field_of_bonds_that_nobody_can_read_is_refused_in_words(name: str) -> None:
    change, words = MALFORMED[name]
    spec = pane()
    bodies.box(spec, "post", size=(0.1, 0.1, 0.1), pos=(1, 0, 0.05), fixed=True)
    change(spec)
    with pytest.raises(ProgramError, match=words):
        breaking.bonds_of(spec.compile())


def test_a_holder_may_have_a_name_that_begins_as_the_things() -> None:
    spec = scene.new("window", time_step=STEP)
    bodies.box(spec, "window_frame", size=(0.02, 0.02, 0.4), pos=(0.21, 0, 0.6), fixed=True)
    made = breaking.plate((0.4, 0.003, 0.4), 5)
    breaking.add(spec, "window", made, "glass", pos=(0, 0, 0.6), held={"window_frame": ((1, 0, 0),)})
    model = spec.compile()
    bonds = breaking.bonds_of(model)
    assert bonds is not None
    holds = bonds.second == model.body("window_frame").id
    assert holds.any() and (bonds.pieces[holds, 0] == bonds.pieces[holds, 1]).all()
    with pytest.raises(ValueError, match="a piece of its own"):
        breaking.add(spec, "pane", made, "glass", pos=(0, 2, 0.6), held={"pane_1": ((1, 0, 0),)})
