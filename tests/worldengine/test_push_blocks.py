"""What pushed is kept in blocks; the ledger's rows are made of them, whatever else it holds."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, record
from worldengine.inputs.pushes import twist
from worldengine.recording import push_blocks, stored, stream_files
from worldengine.recording.push_blocks import Block, PushStream


def told(folder: Path, *blocks: Block) -> dict[str, np.ndarray]:
    """The ledger of a folder with these blocks and no other rows."""
    stream = PushStream(folder)
    stream.write(blocks)
    stream.close()
    table = stored.Table(folder / "interventions.arrows", stored.TABLES["interventions"])
    return dict(push_blocks.join(table, [batch for batch, _ in stream_files.batches(folder / push_blocks.FILE)]))


def block(kind: str, acts: np.ndarray, names: list[str], width: int, first_s: float = 0.0) -> Block:
    """Numbers that say their step, number and target."""
    steps, targets = acts.shape
    numbers = np.arange(steps)[:, None, None] + np.arange(width)[:, None] / 10 + np.arange(targets) / 100
    return Block(kind, first_s + np.arange(steps) / 8, names, acts, numbers, numbers.sum(axis=1))


@pytest.mark.parametrize("all_act", [True, False])
def test_rows_are_those_that_act_in_the_order_of_steps_and_targets(all_act: bool, tmp_path: Path) -> None:
    acts = np.ones((5, 3), bool) if all_act else np.random.default_rng(0).random((5, 3)) < 0.5
    made = block("torque", acts, ["a", "b", "c"], 3)
    found = told(tmp_path, made)
    step, target = np.nonzero(acts)
    assert found["time"].tolist() == (step / 8).tolist()
    assert found["target"].tolist() == [made.targets[n] for n in target] and set(found["kind"]) == {"torque"}
    wanted = np.zeros((len(step), 6))
    wanted[:, 3:] = made.numbers.swapaxes(1, 2)[step, target]
    np.testing.assert_array_equal(found["value"], wanted)
    np.testing.assert_array_equal(found["work_j"], made.works[step, target])


def test_blocks_are_told_by_time_and_of_one_time_in_their_order(tmp_path: Path) -> None:
    two, none = np.ones((2, 1), bool), np.zeros((2, 1), bool)
    blocks = [block("control", two, ["motor"], 2), block("force", two, ["a"], 3), block("torque", none, ["a"], 3)]
    found = told(tmp_path, *blocks, block("force", two, ["b"], 3, 0.125))
    rows = list(zip(found["time"].tolist(), found["kind"].tolist(), found["target"].tolist(), strict=True))
    assert rows == [
        (0.0, "control", "motor"), (0.0, "force", "a"), (0.125, "control", "motor"), (0.125, "force", "a"),
        (0.125, "force", "b"), (0.25, "force", "b"),
    ]  # fmt: skip


def chain() -> mujoco.MjSpec:
    """Two links that carry each other, and a ball alone."""
    spec = empty(gravity=-3.0)
    body = spec.worldbody
    for n in range(2):
        body = body.add_body(name=f"link_{n}", pos=(0.2, 0, 0))
        body.add_joint(type=mujoco.mjtJoint.mjJNT_BALL)
        body.add_geom(size=(0.05, 0, 0), pos=(0.1, 0.02, 0), mass=1.0 + n)
    ball(spec, "ball", (0, 2, 0))
    return spec


def test_work_is_the_force_times_the_mean_velocity_of_what_it_pushes(tmp_path: Path) -> None:
    motion: list[np.ndarray] = []
    forces = np.random.default_rng(1).normal(size=(60, 4, 6))
    forces[20:30] = 0.0
    forces[40, 2], forces[:, 0] = 0.0, 0.0

    def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        motion.append(np.array([twist(model, data, body) for body in range(4)]))
        data.xfrc_applied[:] = forces[len(motion) - 1]

    recording = record(chain(), tmp_path / "t", 60, push, batch_rows=17)
    table, names = recording.interventions, ("world", *recording.names)
    speeds, step_s = np.array(motion), recording.time_step
    count = 0
    for kind, target, time, value, work in zip(
        table.kind, table.target, table.time, table.value, table.work_j, strict=True
    ):
        step, body = round(time / step_s), names.index(target)
        part = slice(0, 3) if kind == "force" else slice(3, 6)
        np.testing.assert_array_equal(value[part], forces[step, body][part])
        if step < 59:
            mean = (speeds[step, body] + speeds[step + 1, body])[part] / 2
            assert work == pytest.approx(value[part] @ mean * step_s, rel=1e-9, abs=1e-12)
            count += 1
    assert count == 2 * (49 * 3 - 1) and recording.ending["rows"] == 61


@pytest.mark.parametrize("rows", [16, 49, 51, None])
@pytest.mark.parametrize("integrator", ["IMPLICITFAST", "RK4"])
def test_a_force_does_not_do_the_work_of_a_velocity_that_is_written_after_it(
    integrator: str, rows: int | None, tmp_path: Path
) -> None:
    def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1, 0] = 3.0
        if abs(data.time - 0.05) < 1e-6:
            data.qvel[0] += 1.0

    spec = empty(gravity=0.0, integrator=integrator)
    ball(spec, "ball", (0, 0, 0), mass=2.0)
    table = record(spec, tmp_path / "t", 60, push, batch_rows=rows).interventions
    works = table.work_j[table.kind == "force"]
    step = 1.5e-3  # of velocity, m/s
    wanted = 3e-3 * (step * (np.arange(60) + 0.5) + (np.arange(60) >= 50))
    np.testing.assert_allclose(works, wanted, rtol=1e-9)


def test_a_ledger_of_rows_alone_is_read_as_before(tmp_path: Path) -> None:
    def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1, 0] = 3.0
        data.qpos[2] += 0.001

    spec = empty(gravity=0.0)
    ball(spec, "ball", (0, 0, 0))
    whole = record(spec, tmp_path / "t", 20, push).interventions
    assert set(whole.kind) == {"force", "pose"} and len(whole) == 40
    (tmp_path / "t" / push_blocks.FILE).unlink()
    rest = stored.open(tmp_path / "t").interventions
    assert set(rest.kind) == {"pose"} and len(rest) == 20
