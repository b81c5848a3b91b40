"""An accepted world as a Gymnasium environment: the recorded rows again, honest rewards, and typed refusals."""

import dataclasses
import shutil

import numpy as np
import pytest

from worldengine.solvers import Row
from worldwright.ends.accepted_world import AcceptedWorld
from worldwright.ends.stepping import Stepped
from worldwright.model.errors import GateError, NotFoundError

gymnasium = pytest.importorskip("gymnasium", reason="the extra `gym` is not installed")
ID = "worldwright.envs:worldwright/RUN-v0"
COLUMNS = ("qpos", "qvel", "pos", "quat", "linvel", "angvel")
OFF = {"box": {"position_m": 0.01, "turn_deg": 3, "speed_m_s": 0.05, "spin_deg_s": 4}, "way": {"position_m": 0.02}}


def made(roped, **words):
    return gymnasium.make(ID, run=roped.run, disable_env_checker=True, **words)


@pytest.fixture(scope="module")
def judged(roped):
    return made(roped)


def test_the_recorded_actions_give_the_recorded_rows_bit_for_bit_and_the_whole_reward(roped, judged):
    recording, total = roped.recording, 0.0
    seen, info = judged.reset(seed=1)
    for number, action in enumerate(judged.unwrapped.stepped.recorded_controls()):
        assert all(np.array_equal(seen[name], getattr(recording, name)[10 * number]) for name in COLUMNS), number
        seen, reward, terminated, truncated, info = judged.step(action)
        total += reward
        assert not terminated
    assert truncated and all(np.array_equal(seen[name], getattr(recording, name)[-1]) for name in COLUMNS)
    assert total == pytest.approx(1.0)
    assert {row["status"] for row in info["objectives"]} == {"holds"}


def test_it_says_what_it_judges_and_what_not(judged):
    (pull,) = judged.unwrapped.inputs
    assert (pull.name, pull.unit, pull.low, pull.high) == ("pull", "m/s", -0.25, 0.25)
    how = {(row.name, row.how) for row in judged.unwrapped.judge.rows}
    assert {("stays", "lasting"), ("moves", "event"), ("carries_load", "rest")} <= how
    assert [reason for reason in judged.unwrapped.judge.left_out.values() if "picture" in reason]


def test_nothing_done_pays_only_what_happens_by_itself(judged):
    judged.reset(seed=1)
    total = 0.0
    for _ in range(400):
        *_, reward, _, truncated, info = judged.step([0.0])
        total += reward
    held = {row["name"] for row in info["objectives"] if row["status"] == "holds"}
    assert truncated and 0 < total < 0.8
    assert "stays_upright" in held and not held & {"slides", "happens_at", "keeps_speed"}


def test_a_broken_claim_ends_the_episode(judged):
    judged.reset(seed=2, options={"jitter": {"box": {"speed_m_s": 2.0}}})
    for _ in range(20):
        _, _, terminated, truncated, info = judged.step([0.0])
        if terminated:
            break
    assert terminated and not truncated
    assert [row["name"] for row in info["objectives"] if row["status"] == "fails" and row["judged"] == "lasting"]
    with pytest.raises(GateError, match="over"):
        judged.step([0.0])


@pytest.mark.parametrize("observation", ["columns", "flat"])
def test_gymnasiums_own_checker_passes(roped, observation):
    from gymnasium.utils.env_checker import check_env

    check_env(made(roped, observation=observation, reward=False).unwrapped, skip_render_check=True)


def test_a_batch_passes_through_the_same_states(roped):
    batch = gymnasium.make_vec(ID, num_envs=3, run=roped.run, reward=False, jitter=OFF, threads=2)
    assert type(batch).__name__ == "BatchedWorlds"
    alone = made(roped, reward=False, jitter=OFF)
    actions = np.random.default_rng(0).uniform(-0.25, 0.25, (50, 3, 1))
    first, _ = batch.reset(seed=5)
    for action in actions:
        seen, *_ = batch.step(action)
    for k in range(3):
        begun, _ = alone.reset(seed=5 + k)
        assert all(np.array_equal(first[name][k], begun[name]) for name in begun)
        for action in actions:
            there, *_ = alone.step(action[k])
        assert all(np.array_equal(seen[name][k], there[name]) for name in there)
    assert len({float(x) for x in first["pos"][:, 0, 0]}) == 3


def test_a_batch_begins_anew_after_the_plans_duration(roped):
    batch = gymnasium.make_vec(ID, num_envs=2, run=roped.run, reward=False, observation="flat")
    batch.reset(seed=1)
    for _ in range(400):
        seen, _, _, truncated, _ = batch.step(np.zeros((2, 1)))
    assert truncated.all() and seen[:, 0] == pytest.approx(4.0)
    seen, _, _, truncated, _ = batch.step(np.zeros((2, 1)))
    assert not truncated.any() and (seen[:, 0] == 0).all()


def test_with_rewards_copies_are_stepped_one_after_the_other(roped):
    many = gymnasium.make_vec(ID, num_envs=2, run=roped.run)
    many.reset(seed=1)
    seen, rewards, *_ = many.step(np.full((2, 1), 0.25))
    assert type(many).__name__ == "SyncVectorEnv" and seen["qpos"].shape == (2, 8) and rewards.shape == (2,)


@pytest.mark.gl
def test_a_picture_is_drawn_by_the_house(roped):
    world = made(roped, reward=False, render_mode="rgb_array", camera="side")
    world.reset(seed=1)
    before = world.render()
    for _ in range(250):
        world.step([0.25])
    after = world.render()
    assert before.shape == (90, 160, 3) and before.dtype == np.uint8 and before.std() > 5
    assert np.abs(after.astype(int) - before).max() > 30
    world.close()


def test_what_cannot_be_is_refused_by_name(roped, tmp_path):
    with pytest.raises(NotFoundError, match="pull"):
        made(roped, reward=False, bounds={"push": (0, 1)})
    with pytest.raises(NotFoundError, match="box, way"):
        made(roped, reward=False, jitter={"bax": {"position_m": 1}}).reset(seed=1)
    with pytest.raises(NotFoundError, match="position_m"):
        made(roped, reward=False, jitter={"way": {"turn_deg": 1}}).reset(seed=1)
    world = made(roped, reward=False)
    world.reset()
    with pytest.raises(GateError, match="finite"):
        world.step([np.nan])
    copied = tmp_path / "rope"
    shutil.copytree(roped.run, copied)
    (copied / "accepted/world/inputs.json").write_text("[]")
    with pytest.raises(GateError, match="not what the stamp lists"):
        AcceptedWorld.read(copied)
    shutil.rmtree(copied / "accepted")
    with pytest.raises(GateError, match="nothing is accepted"):
        AcceptedWorld.read(copied)


def test_a_world_with_a_solver_beside_it_is_no_plain_world(roped):
    world = AcceptedWorld.read(roped.run)
    row = Row(solver="basin", bodies=("box",), constants={})
    with pytest.raises(GateError, match="basin works beside the engine"):
        Stepped(dataclasses.replace(world, given=dataclasses.replace(world.given, solvers=(row,))))
