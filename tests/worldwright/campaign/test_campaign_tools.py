"""A campaign for an agent: started in a process of its own, followed by short calls, stopped, gone on with."""

import json
import time

import pytest

from stub_worlds import MASS
from worldwright.campaign import setting_out, tools
from worldwright.campaign.campaign_file import CampaignError
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.world_row import Cause, Row
from worldwright.model.errors import NotFoundError


@pytest.fixture
def file(tmp_path, small_plan):
    """Two balls without mass: what a check of the plan refuses, at no cost."""
    (tmp_path / "plan.md").write_text(small_plan, encoding="utf-8")
    path = tmp_path / "c.yaml"
    said = {"plan": "plan.md", "hands": "processes", "report": False, "workers": 1}
    path.write_text(json.dumps({**said, "sweep": {"fields": {MASS: {"values": [-1, -2]}}}}))
    return path


def test_results_take_two_readings_of_each_row(file, tmp_path, monkeypatch):
    store = setting_out.begun(setting_out.checked(file), file, tmp_path / "campaign", approved=False)
    held, died = "ff" * 8, "00" * 8
    store.keep(Row(world=held, number=0, outcome="held", values={MASS: 1}, seconds=2))
    store.keep(Row(world=died, number=1, outcome="gave_up", cause=Cause(kind="over_time", step="worker", said="slow")))
    read, row = [], Store.row
    monkeypatch.setattr(Store, "row", lambda self, world: read.append(world) or row(self, world))
    monkeypatch.setattr(tools, "MOST_ROWS", 1)
    found = tools.campaign_results(str(store.folder))
    assert read == [died, held, held, died]
    assert [one.number for one in found.results] == [0] and found.said == {"over_time": "slow (world 1)"}
    assert found.standing == tools.campaign_status(str(store.folder)) and found.standing.outcomes == {
        "gave_up": 1,
        "held": 1,
    }


def test_a_campaign_is_started_followed_and_read(file, tmp_path):
    folder = tmp_path / "campaign"
    started = tools.campaign_start(str(file), folder)
    assert started.worlds == 2
    for _ in range(240):  # on a busy machine a driver may begin after `campaign_start` has answered
        if (now := tools.campaign_wait(str(folder), timeout_s=20)).done == 2 and not now.at_work:
            break
        time.sleep(0.5)
    assert now.done == 2 and now.outcomes == {"failed": 2} and now.causes == {"WP108": 2}, (
        folder / tools.LOG
    ).read_text()
    assert tools.campaign_status(str(folder)) == now
    read = tools.campaign_results(str(folder), cause="WP108")
    assert [one.values[MASS] for one in read.results] == [-1, -2] and "-1 kg" in read.said["WP108"]
    assert [path.rsplit("/", 1)[-1] for path in read.files] == ["table.parquet", "table.csv", "index.html"]
    assert not tools.campaign_results(str(folder), outcome="held").results
    assert "0 failed (WP108): ball -1" in read.text()
    assert tools.campaign_cancel(str(folder)).done == 2
    assert tools.campaign_wait(str(folder), timeout_s=1) == now, "what has ended is not waited for"


def test_what_cannot_be_run_is_refused_before_anything_is_started(file, tmp_path):
    file.write_text("plann: x")
    with pytest.raises(CampaignError, match="no word `plann`"):
        tools.campaign_start(str(file), tmp_path / "campaign")
    with pytest.raises(CampaignError, match="cannot be read"):
        tools.campaign_start(str(tmp_path / "none.yaml"), tmp_path / "campaign")
    assert not (tmp_path / "campaign").exists()
    with pytest.raises(NotFoundError, match="no campaign"):
        tools.campaign_status(str(tmp_path / "campaign"))
