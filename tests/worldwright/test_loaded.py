"""What Python reads of a run is what was recorded: the whole state of a moment, and a plain word where nothing is left."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

import worldwright
from small_worlds import record
from worldkit import portable
from worldwright.campaign.campaign_file import Campaign
from worldwright.campaign.campaign_store import Base, Begun, Store
from worldwright.campaign.world_row import Cause, Row
from worldwright.loaded import World
from worldwright.model.errors import NotFoundError
from worldwright.model.evidence.run import Run

DRIVEN = """
<mujoco><worldbody>
  <body name="hand" mocap="true" pos="0 2 1"><geom size="0.05" contype="0" conaffinity="0"/></body>
  <body name="arm" pos="0 0 1"><joint name="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03"/></body>
  <body name="load" pos="0 2 0.8"><freejoint/><geom size="0.05"/></body>
</worldbody>
<equality><weld name="grip" body1="hand" body2="load"/></equality>
<actuator><general name="motor" joint="hinge" dyntype="filter" dynprm="0.1" gainprm="3"/></actuator>
</mujoco>"""


@pytest.fixture
def driven(tmp_path: Path) -> World:
    """A hand that is moved, an arm with a motor, a grip that lets go."""

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.ctrl[0] = 0.4
        data.mocap_pos[0, 0] = 0.5 * data.time
        data.eq_active[0] = data.time < 0.1

    spec = mujoco.MjSpec.from_string(DRIVEN)
    (tmp_path / "physics").mkdir()
    portable.write(spec, tmp_path / "physics/world.mjz")
    record(spec.compile(), tmp_path / "physics/trajectory", 100, control)
    world = World(Run(tmp_path))
    world.__dict__["folder"] = tmp_path  # of a plan it would be the evidence of its key
    return world


def test_a_moment_has_all_of_its_state(driven):
    data, arrays = driven.at(0.15), driven.arrays
    row = int(np.abs(arrays["time"] - 0.15).argmin())
    assert data.body("hand").xpos == pytest.approx(arrays["pos"][row, driven.names.index("hand")])
    assert data.body("hand").xpos[0] == pytest.approx(0.075, abs=0.002)
    assert data.ctrl[0] == 0.4 and data.act[0] == arrays["act"][row, 0] > 0
    assert not data.eq_active[0] and driven.at(0.05).eq_active[0]


def test_a_world_that_left_no_folder_says_why(tmp_path):
    begun = Begun(campaign=Campaign(name="walls", plans=("a",)), bases=(Base(source="a"),))
    (tmp_path / "campaign.json").write_text(begun.model_dump_json(by_alias=True))
    cause = Cause(kind="worker_died", step="worker", said="it was begun 3 times")
    Store(tmp_path).keep(Row(world="0" * 16, number=0, outcome="gave_up", cause=cause))
    with pytest.raises(NotFoundError, match="world 0 left nothing behind: it was begun 3 times"):
        worldwright.load(tmp_path).world(0)
