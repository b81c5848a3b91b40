"""A world a little otherwise: what varies, by how much, and what stays."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.variants.altered import Variant, alter
from worldengine.variants.varied import _depths
from worldkit.errors import ProgramError
from worldkit.world import START, start


def two_balls(**options: object) -> mujoco.MjModel:
    """Two balls on a floor, one beside the other, that begin with a velocity."""
    spec = empty()
    floor(spec)
    ball(spec, "left", (0, 0, 0.1), **options)
    ball(spec, "right", (1, 0, 0.1), **options)
    key = spec.add_key(name=START)
    key.qpos = [0, 0, 0.1, 1, 0, 0, 0, 1, 0, 0.1, 1, 0, 0, 0]
    key.qvel = [2.0, 0, 0, 0, 0, 0, 3.0, 0, 0, 0, 0, 0]
    return spec.compile()


def varied(model: mujoco.MjModel, *words: str) -> mujoco.MjModel:
    alter(model, Variant.parse(None, [], [], words))
    return model


def test_friction_is_that_of_every_contact_in_force() -> None:
    before, now = two_balls(friction=(0.5, 0.01, 0.001)), varied(two_balls(friction=(0.5, 0.01, 0.001)), "friction=1.2")
    pressed = [start(model) for model in (before, now)]
    for model, data in zip((before, now), pressed, strict=True):
        data.qpos[2] -= 0.01
        mujoco.mj_forward(model, data)
    one, other = (data.contact.friction[0] for data in pressed)
    assert other == pytest.approx(1.2 * one)


def test_masses_vary_in_turn_with_their_inertia_and_without_moving_anything_else() -> None:
    before, now = two_balls(), varied(two_balls(), "masses=1.01")
    assert now.body_mass[1:] / before.body_mass[1:] == pytest.approx([1.01, 1 / 1.01])
    assert now.body_inertia[1] == pytest.approx(1.01 * before.body_inertia[1])
    assert now.body_subtreemass[0] == pytest.approx(before.body_mass[1] * (1.01 + 1 / 1.01))
    assert np.array_equal(before.key_qpos, now.key_qpos) and np.array_equal(before.geom_friction, now.geom_friction)


def test_the_start_varies_in_velocity_and_across_gravity() -> None:
    before, now = two_balls(), varied(two_balls(), "start=1.01")
    assert now.key_qvel[0][[0, 6]] == pytest.approx([2.0 * 1.01, 3.0 / 1.01])
    moved = (now.key_qpos[0] - before.key_qpos[0]).reshape(2, 7)
    assert np.linalg.norm(moved[:, :3], axis=1) == pytest.approx([0.001, 0.1 * (1 - 1 / 1.01)])
    assert not moved[:, 2:].any()


def test_what_would_be_pressed_into_a_wall_stays_where_it_is() -> None:
    spec = empty()
    floor(spec)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 1, 1), pos=(0.2, 0, 0))
    ball(spec, "leaning", (0, 0, 0.1))
    model = spec.compile()
    before = model.qpos0.copy()
    varied(model, "start=1.01")
    assert np.array_equal(model.qpos0, before)
    varied(model, "start=0.99")
    assert model.qpos0[0] < before[0]


def test_a_flex_that_is_pressed_into_the_floor_says_nothing_about_the_first_body() -> None:
    """A contact of a flex names no geom on that side; it is not one of geom 0."""
    spec = mujoco.MjSpec.from_string(
        """<mujoco><worldbody>
        <body name="first" pos="-3 0 5"><freejoint/><geom size=".1" mass="1"/></body>
        <body name="slab" pos="0 0 -.1"><freejoint/><geom type="box" size="1 1 .1" mass="9"/></body>
        <flexcomp name="pad" type="grid" count="3 3 3" spacing=".1 .1 .1" pos="0 0 .09" radius=".01" dim="3" mass="1"/>
        </worldbody></mujoco>"""
    )
    model = spec.compile()
    data = start(model)
    depths = _depths(model, data, model.qpos0)
    assert (data.contact.geom < 0).any() and data.contact.dist.min() < 0
    first, slab = (int(model.body_treeid[model.body(name).id]) for name in ("first", "slab"))
    assert model.geom_bodyid[0] == model.body("first").id
    assert depths[first] == 0 < depths[slab]


def test_loose_bodies_share_one_data(monkeypatch: pytest.MonkeyPatch) -> None:
    """The world collides once for each of them, and once before."""
    model, collided = two_balls(), []
    real = mujoco.mj_fwdPosition
    monkeypatch.setattr(mujoco, "mj_fwdPosition", lambda m, d: (collided.append(id(d)), real(m, d)))
    varied(model, "start=1.01")
    assert len(collided) == 3 and len(set(collided)) == 1


def test_what_is_tied_stays_where_it_is() -> None:
    spec = empty()
    body = ball(spec, "hung", (0, 0, 1))
    spec.add_equality(type=mujoco.mjtEq.mjEQ_CONNECT, name1=body.name, name2="world", objtype=mujoco.mjtObj.mjOBJ_BODY)
    model = spec.compile()
    before = model.qpos0.copy()
    varied(model, "start=1.01")
    assert np.array_equal(model.qpos0, before)


@pytest.mark.parametrize("words", ["friction", "friction=-1", "=2", "friction=much"])
def test_what_says_nothing_is_refused(words: str) -> None:
    with pytest.raises(ProgramError, match="does not say what to vary"):
        Variant.parse(None, [], [], [words])


def test_an_unknown_kind_lists_the_known_ones() -> None:
    with pytest.raises(ProgramError) as refused:
        varied(two_balls(), "luck=2")
    assert "friction, masses, start" in refused.value.next_move


def test_variants_without_it_are_described_as_before() -> None:
    """What their recordings are known by must not change."""
    assert Variant.parse(0.5, [], []).as_meta() == {"time_step_factor": 0.5, "without": [], "weaken": []}
    assert Variant.parse(None, [], [], ["start=0.99"]).as_meta()["vary"] == [["start", 0.99]]
