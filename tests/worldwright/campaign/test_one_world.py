"""Two real worlds of a sweep, from the plan to the table, and what Python reads of them."""

import itertools
import json

import mujoco
import numpy as np
import pytest
from click.testing import CliRunner

import worldwright
from worldwright.campaign import one_world, setting_out
from worldwright.campaign.campaign_file import CampaignError
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.one_world import task
from worldwright.cli import main
from worldwright.model.errors import NotFoundError
from worldwright.model.evidence import came
from worldwright.model.evidence.run import Run

BOTTOM = "topology.scene_predicates[0].params.bottom"


def started(folder, plan, **words) -> Store:
    """A campaign over a plan's text; no page of each world, which costs more than the world."""
    folder.mkdir(exist_ok=True)
    (folder / "plan.md").write_text(plan, encoding="utf-8")
    file = folder / "falls.yaml"
    file.write_text(json.dumps({"plan": "plan.md", "report": False, **words}))
    return setting_out.begun(setting_out.checked(file), file, folder / "campaign", approved=False)


@pytest.fixture(scope="module")
def short(small_plan) -> str:
    """A fall of 0.2 s."""
    short = small_plan.replace("simulation_duration: 0.5", "simulation_duration: 0.2")
    return short.replace("min_m: 0.3", "min_m: 0.1").replace("mode: cameras\nfps: 12\nsize: [160, 90]", "mode: none")


@pytest.fixture(scope="module")
def fallen(tmp_path_factory, short) -> Store:
    """Two heights: the ball falls 0.2 m, or 0.05 m and lies on the floor."""
    folder = tmp_path_factory.mktemp("falls")
    store = started(folder, short, sweep={"fields": {BOTTOM: {"values": [0.45, 0.05]}}}, category="falling")
    for number in range(2):
        one_world.perform(task(store, store.begun, number))
    return store


def test_a_world_that_holds_and_one_that_does_not_are_rows(fallen):
    held, refuted = sorted(fallen.rows(), key=lambda row: row.number)
    assert held.outcome == "held" and held.cause is None and held.ok
    assert refuted.outcome == "refuted" and refuted.cause.kind == "refuted" and refuted.cause.step == "expect"
    assert "The ball falls to the floor" in refuted.cause.said
    assert held.margin == pytest.approx(0.096, abs=0.005) and refuted.margin < 0
    assert held.values == {BOTTOM: 0.45} and held.category == "falling" and held.prompt == "A dropped ball"
    assert held.runs == held.iterations == held.begun == 1 and held.cpu_seconds > 0
    assert {"check", "place", "approve", "draft", "lint", "physics", "scan", "expect"} <= held.minutes.keys()
    assert held.trajectory_sha256 and held.trajectory_sha256 != refuted.trajectory_sha256
    assert (fallen.folder / held.recording / "meta.json").is_file() and not held.report
    assert not list(fallen.world(held.world).glob("evidence/*/storyboard")), "nobody asked for a picture"


def test_a_row_that_stands_is_not_paid_again(fallen, monkeypatch):
    monkeypatch.setattr(one_world, "_walked", None)
    one = task(fallen, fallen.begun, 0)
    assert one_world.perform(one) == fallen.row(one.world)
    assert fallen.begun_before(one.world) == 1


def test_what_is_lost_with_the_row_is_found_in_the_evidence(fallen, tmp_path):
    one = task(fallen, fallen.begun, 0)
    before = fallen.row(one.world)
    fallen.forget(before)
    after = one_world.perform(one)
    assert after.trajectory_sha256 == before.trajectory_sha256 and after.runs == before.runs == 1
    assert len(list(fallen.world(one.world).glob("jobs/physics-*"))) == 1, "physics was not run again"


def test_python_loads_a_world(fallen):
    campaign = worldwright.load(fallen.folder)
    assert campaign.table.num_rows == 2
    assert campaign.table["outcome"].to_pylist() == ["held", "refuted"]
    world = campaign.world(0)
    z = world.arrays["pos"][:, world.names.index("ball"), 2]
    assert z[0] - z[-1] == pytest.approx(0.5 * 9.81 * 0.2**2, abs=0.005)
    assert isinstance(world.model, mujoco.MjModel) and world.model.nq == world.arrays["qpos"].shape[1]
    data = world.at(0.1)
    assert data.time == pytest.approx(0.1) and data.body("ball").xpos[2] == pytest.approx(
        float(np.interp(0.1, world.arrays["time"], z))
    )
    assert world.expect.objectives[0].status == "proved" and world.scan is not None
    with pytest.raises(ValueError, match="read-only"):
        world.arrays["qpos"][0] = 0
    with pytest.raises(KeyError, match="recorded: "):
        world.arrays["mass"]
    with pytest.raises(NotFoundError, match="pass video"):
        next(world.frames())
    with pytest.raises(NotFoundError, match="no world `7`"):
        campaign.world(7)


def test_an_approval_of_the_campaign_says_how_the_word_came(tmp_path, short, monkeypatch):
    began = started(tmp_path, short, sweep={"fields": {BOTTOM: {"values": [0.45]}}}).begun
    seen = []
    monkeypatch.setattr("worldwright.stamp.tools.approve", lambda run, by, auto: seen.append((came.current(), auto)))
    word = came.Came(how="command_line", client="Codex")
    for begun in (began, began.model_copy(update={"approved": True, "word": word})):
        one_world._granting(Run(tmp_path), begun)()
    assert seen == [(came.Came(how="automation"), True), (word, False)]


def test_a_plan_that_a_value_breaks_says_so_and_costs_nothing(tmp_path, short):
    store = started(tmp_path, short, sweep={"fields": {"simulation_parameters.masses.ball": {"values": [-1, "1e300"]}}})
    rows = [one_world.perform(task(store, store.begun, number)) for number in range(2)]
    assert [row.outcome for row in rows] == ["failed", "failed"]
    assert [row.cause.kind for row in rows] == ["WP108", "WP118"]
    assert rows[0].cause.said.startswith("plan.md:") and "-1 kg" in rows[0].cause.said
    assert not list(store.folder.glob("worlds/*/*/evidence"))


def test_bad_plans_of_many_are_their_own_rows(tmp_path, short):
    (tmp_path / "empty").mkdir()
    (tmp_path / "empty/plan.md").write_text(short)
    (tmp_path / "empty/prompt.md").write_text(" \n")
    (tmp_path / "none.md").write_text("# nothing")
    file = tmp_path / "many.yaml"
    plans = ["missing.md", "none.md", "empty", {"plan": "empty", "prompt": "x" * 1_000_000}]
    file.write_text(json.dumps({"plans": plans, "report": False}))
    store = setting_out.begun(setting_out.checked(file), file, tmp_path / "campaign", approved=False)
    rows = [one_world.perform(task(store, store.begun, number)) for number in range(4)]
    assert [row.outcome for row in rows] == ["failed"] * 4
    assert [row.cause.kind for row in rows] == ["not_found", "WP002", "empty_prompt", "long_prompt"]
    assert all(row.cause.said for row in rows)


def test_a_sweep_of_what_the_plan_does_not_have_is_refused_before_a_folder_is_made(tmp_path, short):
    with pytest.raises(Exception, match="has no number"):
        started(tmp_path, short, sweep={"fields": {"simulation_parameters.masses.bell": {"values": [1]}}})
    assert not (tmp_path / "campaign").exists()


def test_the_command_line_counts_shows_and_reports(fallen, tmp_path, short):
    def call(*words):
        return CliRunner().invoke(main, ["campaign", *map(str, words)])

    file = fallen.folder.parent / "falls.yaml"
    counted = call("run", file, "--count")
    assert counted.exit_code == 0 and "2 worlds" in counted.output and f"{BOTTOM} 0.45" in counted.output
    told = call("status", fallen.folder)
    assert told.exit_code == 0 and "2 of 2 worlds" in told.output and "1 x refuted" in told.output
    assert json.loads(call("status", fallen.folder, "--format", "json").output)["outcomes"] == {"held": 1, "refuted": 1}
    assert call("run", file, "--folder", fallen.folder, "--hands", "processes").exit_code == 0, "all is done already"
    assert call("cancel", fallen.folder).output == "it is not at work\n"
    reported = call("report", fallen.folder)
    assert "table.parquet" in reported.output and (fallen.folder / "table.csv").is_file()
    (tmp_path / "bad.yaml").write_text("plann: x")
    refused = call("run", tmp_path / "bad.yaml")
    assert refused.exit_code == 2 and "known words: name, plan" in refused.output


@pytest.mark.parametrize("at_once", [1, 100, 1 << 22])
def test_the_recordings_are_a_data_set_that_is_split_by_the_draw(fallen, monkeypatch, at_once):
    from worldwright.campaign import trajectories

    monkeypatch.setattr(trajectories, "MOST_NUMBERS", at_once)
    counts = trajectories.write(fallen)
    assert sum(counts.values()) == 2
    about = json.loads((fallen.folder / "trajectories/schema.json").read_text())
    assert about["columns"]["sweep"]["pos"]["unit"] == "m" and about["worlds"] == counts
    rows = {row.world: row for row in fallen.rows()}
    campaign = worldwright.load(fallen.folder)
    for part in (part for part, count in counts.items() if count):
        table = campaign.trajectories(part).to_table()
        for name in set(table["world"].to_pylist()):
            here = table.filter(np.array([world == name for world in table["world"].to_pylist()]))
            arrays = campaign.world(name).arrays
            assert np.array_equal(np.array(here["qpos"].to_pylist()), arrays["qpos"])
            assert np.array_equal(here["time"].to_numpy(), arrays["time"])
            assert np.array_equal(np.array(here["pos"].to_pylist()).reshape(arrays["pos"].shape), arrays["pos"])
            assert set(here[f"vary.{BOTTOM}"].to_pylist()) == {rows[name].values[BOTTOM]}
    said = CliRunner().invoke(main, ["campaign", "trajectories", str(fallen.folder), "--shares", "1", "0", "0"])
    assert said.exit_code == 0 and "2 train, 0 validation, 0 test" in said.output
    assert len(list(fallen.folder.glob("trajectories/split=*/*.parquet"))) == 2, "no world is in two parts"
    with pytest.raises(NotFoundError, match="known: train, validation, test"):
        campaign.trajectories("testing")
    wrong = CliRunner().invoke(main, ["campaign", "trajectories", str(fallen.folder), "--column", "qposs"])
    assert wrong.exit_code == 2 and "no column `qposs`" in wrong.output and "qvel" in wrong.output


def test_what_an_earlier_call_left_of_other_worlds_is_taken_away(fallen):
    from worldwright.campaign import trajectories

    folder, (first, second) = fallen.folder / "trajectories", fallen.rows()
    trajectories.write(fallen)
    for name in ("split=test/0123456789abcdef.parquet", f"split=train/.{first.world}.parquet"):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(b"PAR1")
    fallen.keep(second.model_copy(update={"recording": ""}))  # as if it were begun again, and came to nothing
    try:
        assert sum(trajectories.write(fallen).values()) == 1
    finally:
        fallen.keep(second)
    assert [path.stem for path in folder.glob("split=*/*")] == [first.world]
    note, place = next(folder.glob("split=*/")) / "notes.txt", next(folder.glob("split=*/")) / "mine.parquet"
    note.write_text("mine")
    place.mkdir()
    for row in (first, second):
        fallen.keep(row.model_copy(update={"recording": ""}))
    try:
        with pytest.raises(CampaignError, match="no world of this campaign left a recording"):
            trajectories.write(fallen)
    finally:
        for row in (first, second):
            fallen.keep(row)
    assert not list(folder.glob("split=*/[!m]*.parquet")) and not (folder / "schema.json").exists(), (
        "it says no set is whole"
    )
    assert note.is_file() and place.is_dir(), "what is not ours stays"
    note.unlink()
    place.rmdir()
    trajectories.write(fallen)
    (folder / "schema.json").unlink()
    with pytest.raises(NotFoundError, match="not written to the end"):
        worldwright.load(fallen.folder).trajectories("train")


@pytest.mark.parametrize(
    "shares", [("nan", "0.5", "0.5"), ("0.5", "nan", "0.5"), ("0.8", "0.3", "-0.1"), ("1", "1", "0")]
)
def test_shares_that_are_none_are_refused(fallen, shares):
    said = CliRunner().invoke(main, ["campaign", "trajectories", str(fallen.folder), "--shares", *shares])
    assert said.exit_code == 2 and "add up to 1" in said.output


def test_places_in_a_list_never_leave_their_32_bits():
    from worldwright.campaign import trajectories

    for rows, width in ((50_000_000, 100), (3, 10**8), (0, 7), (5, 0)):
        found = list(trajectories.stretches(rows, width))
        assert found[0][0] == 0 and found[-1][1] == rows
        assert all((end - begin) * width < 2**31 for begin, end in found)
        assert all(first[1] == second[0] for first, second in itertools.pairwise(found))


def test_worlds_of_one_draw_are_in_one_part_and_stay_there():
    from worldwright.campaign import trajectories
    from worldwright.campaign.campaign_file import parse
    from worldwright.campaign.world_row import Row

    def parts(draws):
        text = f"plan: a\nsweep: {{draws: {draws}, fields: {{x: {{values: [1, 2]}}, y: {{uniform: [0, 1]}}}}}}"
        campaign = parse(text)
        rows = (Row(world=f"{n:016x}", number=n, outcome="held") for n in range(campaign.size))
        return [trajectories.part_of(campaign, row) for row in rows]

    many = parts(1000)
    assert many[:1000] == many[1000:] and many[:50] == parts(50)[:50]
    assert 700 < many[:1000].count("train") < 900 and {*many} == {*trajectories.PARTS}
