"""An accepted world as a Gymnasium environment: the recorded rows again, honest rewards, and typed refusals."""

import dataclasses
import json
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


def test_what_drove_a_world_is_held_against_its_stamp(roped, tmp_path):
    facts = "accepted/world"
    for number, (part, content) in enumerate(
        [(f"{facts}/inputs.arrows", b"forged"), (f"{facts}/inputs.arrows", None), (f"{facts}/edits.arrows", b"more"),
         (f"{facts}/media.arrows", b"more"), (f"{facts}/balances.arrows", b"more"), ("accepted/trajectory.npz", b"other")]
    ):  # fmt: skip
        copied = tmp_path / str(number)
        shutil.copytree(roped.run, copied)
        if content is None:
            (copied / part).unlink()
        else:
            (copied / part).write_bytes(content)
        with pytest.raises(GateError, match=f"{part.removeprefix('accepted/')} is not what the stamp lists"):
            AcceptedWorld.read(copied)


def test_copies_with_rewards_are_judged_apart_by_what_one_found(roped, monkeypatch):
    from worldwright.ends.judging import Judge

    built, of = [], Judge.of
    monkeypatch.setattr(Judge, "of", lambda *given: built.append(1) or of(*given))
    many = gymnasium.make_vec(ID, num_envs=3, run=roped.run)
    first, second, _ = (env.unwrapped.judge for env in many.envs)
    assert len(built) == 1 and len(first.rows) == len(second.rows) > 1
    first.rows[0].paid = True
    assert not second.rows[0].paid


def test_a_copy_that_blows_up_is_over_as_it_is_alone(roped):
    wild = {"box": {"speed_m_s": 1e12}}
    alone = made(roped, reward=False, jitter=wild)
    alone.reset(seed=1)
    *_, terminated, truncated, _ = alone.step([0.0])
    assert terminated and not truncated
    batch = gymnasium.make_vec(ID, num_envs=2, run=roped.run, reward=False)
    batch.reset(seed=1, options={"jitter": wild})
    *_, terminated, truncated, _ = batch.step(np.zeros((2, 1)))
    assert terminated.all() and not truncated.any()
    batch.step(np.zeros((2, 1)))
    *_, terminated, _, _ = batch.step(np.zeros((2, 1)))
    assert not terminated.any()


def test_the_engines_word_of_a_blow_up_counts_in_a_batch(roped):
    batch = gymnasium.make_vec(ID, num_envs=2, run=roped.run, reward=False)
    batch.reset(seed=1)
    unwrapped = batch.unwrapped
    unwrapped._batch.warning[1, unwrapped._bad[-1], 1] = 1
    assert unwrapped._sane().tolist() == [True, False]


def test_a_jitter_of_the_options_lasts_one_episode_in_a_batch_too(roped):
    batch = gymnasium.make_vec(ID, num_envs=2, run=roped.run, reward=False)
    plain, _ = batch.reset(seed=1)
    first, _ = batch.reset(seed=1, options={"jitter": OFF})
    assert not np.array_equal(first["qpos"], plain["qpos"])
    for _ in range(401):
        seen, *_ = batch.step(np.zeros((2, 1)))
    assert np.array_equal(seen["qpos"], plain["qpos"])


def test_an_episode_ends_with_the_plans_duration_where_actions_do_not_divide_it(roped, seal, tmp_path):
    copied = tmp_path / "rope"
    shutil.copytree(roped.run, copied)
    facts = copied / "accepted/world"
    for name, content in {"duration": 0.1, "control_every": 30, "control": ""}.items():
        said = json.loads((facts / "program.json").read_bytes())
        (facts / "program.json").write_text(json.dumps(said | {name: content}))
    (facts / "inputs.arrows").unlink()
    seal(copied)
    words = {"run": copied, "reward": False, "observation": "flat"}
    alone = gymnasium.make(ID, disable_env_checker=True, **words)
    batch = gymnasium.make_vec(ID, num_envs=2, **words)
    alone.reset(seed=1), batch.reset(seed=1)
    for _ in range(4):
        one, _, _, truncated, _ = alone.step([])
        both, *_ = batch.step(np.zeros((2, 0)))
    assert truncated and one[0] == pytest.approx(0.1)
    assert np.array_equal(both, [one, one])


@pytest.mark.parametrize("action", [[np.nan], [], [0.0, 0.0], [[0.0]], None, "left"])
def test_a_broken_action_is_refused(roped, action):
    alone, batch = made(roped, reward=False), gymnasium.make_vec(ID, num_envs=2, run=roped.run, reward=False)
    for env, given in ((alone, action), (batch, [action, action])):
        with pytest.raises(GateError, match=r"call reset\(\) first"):
            env.unwrapped.step(given)
        env.reset(seed=1)
        with pytest.raises(GateError, match="finite numbers"):
            env.unwrapped.step(given)


def test_a_broken_start_is_refused(roped):
    alone, batch = made(roped, reward=False), gymnasium.make_vec(ID, num_envs=2, run=roped.run, reward=False)
    for env in (alone, batch):
        for amount in (np.nan, np.inf, "far", None):
            with pytest.raises(GateError, match="speed_m_s must be finite"):
                env.reset(seed=1, options={"jitter": {"box": {"speed_m_s": amount}}})
            with pytest.raises(GateError, match=r"call reset\(\) first"):
                env.unwrapped.step(np.zeros((2, 1)) if env is batch else [0.0])
    with pytest.raises(GateError, match="3 seeds for 2 copies"):
        batch.reset(seed=[1, 2, 3])
