"""A campaign comes to its end whatever dies on the way: nothing is paid twice, and one bad world is one row."""

import fcntl
import json
import multiprocessing as mp
import os
import signal
import threading
import time

import pytest

import stub_worlds
from stub_worlds import FAILS, KILLS, MASS, SLEEPS, WAITS, door, let_in, paid
from worldwright.campaign import conducting, setting_out
from worldwright.campaign.campaign_file import CampaignError
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.one_world import task
from worldwright.contract import harnesses
from worldwright.model import try_lock
from worldwright.model.evidence.came import Came


@pytest.fixture
def begun(tmp_path, small_plan):
    """Begins a campaign over masses of the dropped ball."""

    def begin(masses, **words) -> Store:
        (tmp_path / "plan.md").write_text(small_plan, encoding="utf-8")
        file = tmp_path / "c.yaml"
        said = {"plan": "plan.md", "hands": "processes", "workers": 2, "report": False, **words}
        said["sweep"] = {"fields": {MASS: {"values": list(masses)}}}
        file.write_text(json.dumps(said))
        return setting_out.begun(setting_out.checked(file), file, tmp_path / "campaign", approved=False)

    return begin


@pytest.fixture
def here(monkeypatch):
    """Worlds are done in the test's own process: for what a driver decides, whoever does the work."""
    monkeypatch.setattr(conducting, "crew_of", lambda *_: stub_worlds.Here())


def test_every_world_is_one_row_and_a_second_run_pays_for_nothing(begun):
    store, seen = begun(range(1, 7)), []
    first = conducting.conduct(store, stub_worlds.do, watch=lambda now, row: seen.append((now.done, row)))
    assert first.done == first.worlds == 6 and first.outcomes == {"held": 6} and not first.at_work and first.ok
    assert [done for done, row in seen if row] == [1, 2, 3, 4, 5, 6]
    assert sorted(row.values[MASS] for row in store.rows()) == [1, 2, 3, 4, 5, 6]
    again = conducting.conduct(store, stub_worlds.do)
    assert again.done == 6 and set(paid(store.folder).values()) == {1}


def test_a_bad_world_and_a_dying_worker_are_rows_among_the_others(begun):
    store = begun([1, KILLS, FAILS, 2], per_world={"begun": 2}, workers=1)
    end = conducting.conduct(store, stub_worlds.do)
    rows = {row.values[MASS]: row for row in store.rows()}
    assert end.done == 4 and end.outcomes == {"failed": 1, "gave_up": 1, "held": 2}
    assert rows[FAILS].cause.kind == "WL101" and rows[FAILS].cause.next_move == "mend it"
    assert rows[KILLS].outcome == "gave_up" and rows[KILLS].cause.kind == "worker_died"
    assert "signal 9" in rows[KILLS].cause.said and rows[KILLS].begun == 2
    assert end.causes == {"WL101": 1, "worker_died": 1}


def test_a_world_without_end_is_given_up_and_the_next_is_begun(begun, monkeypatch):
    monkeypatch.setattr(conducting, "GRACE_S", 0.0)
    store = begun([SLEEPS, SLEEPS - 0.5], per_world={"seconds": 0.2}, workers=1)
    end = conducting.conduct(store, stub_worlds.do)
    assert end.outcomes == {"gave_up": 2} and end.causes == {"over_time": 2}
    assert end.seconds >= 2 * 0.2 and conducting.standing(store).seconds == end.seconds, "what hung was paid, too"


def test_a_worker_that_dies_before_it_begins_is_not_started_for_ever(begun):
    store = begun([1], per_world={"begun": 1})
    end = conducting.conduct(store, os._exit)  # type: ignore[arg-type]
    assert end.causes == {"worker_died": 1}


def _drive(folder: str) -> None:
    conducting.conduct(Store(folder), stub_worlds.do)


def _waits(store, number) -> int:
    """The worker at a world that waits to be let in."""
    path = door(store.folder, number, "waits")
    until(path.exists)
    return int(path.read_text())


def test_a_campaign_goes_on_whoever_is_killed_and_nothing_is_paid_twice(begun):
    held = (8, 16, 20)
    store = begun(n + (WAITS if n in held else 1) for n in range(24))
    driver = mp.get_context("spawn").Process(target=_drive, args=(str(store.folder),))
    driver.start()
    left, killed = _waits(store, 8), _waits(store, 16)
    until(lambda: len(list(store.rows())) == 15)
    os.kill(driver.pid, signal.SIGKILL)
    driver.join()
    os.kill(killed, signal.SIGKILL)
    assert not store.driven and conducting.standing(store).done == 15

    def watch(now, row):
        if row is None:
            let_in(store.folder, 16)
        elif now.done == 17:  # by now somebody else waits for the world that the dead driver's worker is at
            os.kill(left, 0)
            let_in(store.folder, 8)
        elif now.done == 23:  # all but the world whose worker is killed under a living driver
            os.kill(_waits(store, 20), signal.SIGKILL)
            let_in(store.folder, 20)

    end = conducting.conduct(store, stub_worlds.do, watch=watch)
    assert end.done == 24 and end.outcomes == {"held": 24}
    assert list(paid(store.folder).values()) == [1] * 24
    assert {row.number: row.begun for row in store.rows()} == {n: 2 if n in (16, 20) else 1 for n in range(24)}


def test_a_cancelled_campaign_stops_and_goes_on(begun):
    store = begun([SLEEPS, 1, 2, 3])
    driver = threading.Thread(target=conducting.conduct, args=(store, stub_worlds.do), daemon=True)
    driver.start()
    until(lambda: len(list(store.rows())) == 3)
    with pytest.raises(CampaignError, match="at work already"):
        conducting.conduct(store, stub_worlds.do)
    assert setting_out.cancelled(store).startswith("cancelled")
    driver.join()
    standing = conducting.standing(store)
    assert standing.stopped == "cancelled" and standing.done == 3 and not standing.ok
    sleeping = task(store, store.begun, 0)
    assert store.begun_before(sleeping.world) == 0, "what was broken off from outside was not its fault"
    assert setting_out.cancelled(store) == "it is not at work"


def test_a_budget_ends_the_handing_out_and_more_of_it_goes_on(begun, here):
    store = begun(range(1, 7), budget={"runs": 3})
    end = conducting.conduct(store, stub_worlds.do)
    assert end.done == end.runs == 3 and end.stopped == "the budget of 3 runs is used up" and not end.ok
    begun(range(1, 7), budget={"seconds": 4})
    end = conducting.conduct(store, stub_worlds.do)
    assert 4 <= end.done < 6 and "4 s" in end.stopped
    begun(range(1, 7))
    assert conducting.conduct(store, stub_worlds.do).done == 6


def test_worlds_of_one_outcome_are_begun_again(begun, here):
    store = begun([1, FAILS])
    conducting.conduct(store, stub_worlds.do)
    assert conducting.forget(store, "WL101") == 1
    assert conducting.conduct(store, stub_worlds.do).outcomes == {"failed": 1, "held": 1}
    assert sorted(paid(store.folder).values()) == [1, 2]
    with pytest.raises(CampaignError, match="no world ended as `x`"):
        conducting.forget(store, "x")
    with store.driving(), pytest.raises(CampaignError, match="at work already"):
        conducting.forget(store, "held")
    assert len(list(store.rows())) == 2, "a driver counted them"


def test_a_damaged_row_is_made_again(begun, here):
    store = begun([1, 2])
    conducting.conduct(store, stub_worlds.do)
    first = next(store.rows())
    store.row_path(first.world).write_text("{")
    assert conducting.conduct(store, stub_worlds.do).done == 2 and store.row(first.world).values == first.values
    assert sorted(paid(store.folder).values()) == [1, 2]


def test_a_folder_keeps_its_campaign(begun, tmp_path):
    store = begun([1, 2])
    with pytest.raises(CampaignError, match="another campaign"):
        begun([1, 2, 3])
    begins = store.begun
    for edited in ("no plan any more", None):
        (tmp_path / "plan.md").write_text(edited) if edited else (tmp_path / "plan.md").unlink()
        with pytest.raises(CampaignError, match="no longer what this campaign began with") as refused:
            store.begin(begins.campaign, tmp_path / "c.yaml")
        assert "--folder" in refused.value.next_move and "resume" in refused.value.next_move
    assert store.begun == begins and (store.base(0) / "plan.md").is_file()


def test_a_word_that_was_given_stands_as_it_was_given(begun, tmp_path, monkeypatch):
    store, file = begun([1]), tmp_path / "c.yaml"
    assert not store.begun.approved and store.begun.word.how == "automation"
    monkeypatch.setattr(harnesses, "around", lambda: "Codex")
    given = setting_out.begun(setting_out.checked(file), file, store.folder, approved=True).begun
    assert given.approved and given.word == Came(how="command_line", client="Codex")
    monkeypatch.setattr(harnesses, "around", lambda: "")
    for approved in (False, True):
        assert setting_out.begun(setting_out.checked(file), file, store.folder, approved).begun == given


def test_while_it_is_driven_only_limits_change(begun, tmp_path):
    store, file = begun([1]), tmp_path / "c.yaml"
    with store.driving():
        for change in ({"report": True}, {"hands": "auto"}):
            with pytest.raises(CampaignError, match=r"only its limits change \(budget, per_world, workers\)"):
                begun([1], **change)
        with pytest.raises(CampaignError, match="only its limits"):
            setting_out.changed(store, None, "auto", None)
        begun([1])
        with pytest.raises(CampaignError, match="only its limits"):
            setting_out.begun(setting_out.checked(file), file, store.folder, approved=True)
        begun([1], workers=1, budget={"runs": 7})
    assert store.begun.campaign.budget.runs == 7 and not store.begun.approved
    assert begun([1], report=True).begun.campaign.report


def test_who_asks_whether_it_is_at_work_does_not_refuse_a_driver(begun, monkeypatch):
    store, answers, real = begun([1]), [False, False], try_lock.taken
    monkeypatch.setattr(try_lock, "taken", lambda handle: answers.pop() if answers else real(handle))
    with store.driving():
        assert not answers and store.driven

    def writable(handle):
        assert fcntl.fcntl(handle, fcntl.F_GETFL) & os.O_ACCMODE == os.O_RDWR
        return True

    monkeypatch.setattr(try_lock, "taken", writable)
    assert not store.driven


def test_before_a_driver_has_ended_a_world_the_time_left_is_that_of_earlier_ones(begun):
    store = begun([1, 2, 3, 4], workers=2)
    done = conducting.Count(done=1, seconds=240.0)
    told = conducting.told(store, store.begun, done, at_work=True)
    assert told.left_s == 3 * 240 / 2 and "about 6 min left" in told.text() and told.rate_per_minute is None
    assert conducting.told(store, store.begun, done, at_work=False).left_s is None, "nobody is at work"
    assert conducting.told(store, store.begun, conducting.Count(), at_work=True).left_s is None


def test_the_first_world_does_not_wait_for_the_thousandth(begun, here):
    store = begun(range(1, 1001), budget={"runs": 1})
    assert conducting.conduct(store, stub_worlds.do).done == 1
    assert len(paid(store.folder)) == 1


def test_a_campaign_that_is_not_there_is_answered_with_those_that_are(begun, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(Exception, match="none yet"):
        Store.find("nothing")
    assert Store.find(begun([1]).folder).begun.campaign.size == 1


def test_without_ray_our_own_processes_do_the_work_and_it_is_said_once(begun, monkeypatch):
    said = []
    monkeypatch.setattr(conducting.on_ray, "installed", lambda: False)
    conducting.crew_of(begun([1], hands="auto").begun.campaign, stub_worlds.do, conducting.Count(), said.append).close()
    assert len(said) == 1 and "2 worker processes" in said[0]


def until(condition) -> None:
    for _ in range(1200):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("it did not come to that within a minute")
