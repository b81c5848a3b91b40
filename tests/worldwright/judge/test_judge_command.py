"""`worldwright judge` from films to the table: whose film is whose, what is sent where, and rows that are computed."""

import csv
import hashlib
import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from judge_stands import CRITERIA, chat, said
from worldwright.cli import main
from worldwright.judge import entrants, planted
from worldwright.judge.entrants import Entrant, EntrantError

BALL = "A basketball hits the ground after being dropped, where it bounces off the ground, gradually losing height with each bounce."


def call(*words):
    return CliRunner().invoke(main, ["judge", *map(str, words)])


@pytest.fixture
def criteria(tmp_path):
    record = {
        "Basic_Standards": {"Objects": CRITERIA.objects, "Event": CRITERIA.event},
        "Key_Standards": CRITERIA.standards,
    }
    folder = tmp_path / "criteria"
    folder.mkdir()
    (folder / "all.json").write_text(
        json.dumps({"Dynamics": {"Falls": [{**record, "Prompt_index": f"{n}-1"} for n in ("001", "005", "039")]}})
    )
    return folder


@pytest.fixture(autouse=True)
def data(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(tmp_path / "data"))
    for name in ("WORLDWRIGHT_JUDGE_KEY", "WORLDWRIGHT_JUDGE_OPENAI"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("worldwright.contract.harnesses.around", lambda: "")


def test_films_are_judged_and_stand_in_the_table_beside_the_published_rows(stand_in, film, criteria, tmp_path):
    film("001-2"), film("039")
    how = ("--criteria", criteria, "--judge", "openai_compatible", "--address", stand_in.address, "--model", "eye-1")
    counted = call("run", tmp_path / "films", *how, "--votes", 3, "--count")
    assert counted.exit_code == 0 and "6 questions about 2 films" in counted.output and stand_in.asked == []
    assert stand_in.address in counted.output
    stand_in.replies = [*[(200, chat(said()), {})] * 3, (200, chat(said("Standard_2")), {})]
    done = call("run", tmp_path / "films", *how, "--votes", 3)
    assert done.exit_code == 0, done.output
    verdicts = tmp_path / "data/judged/films"
    assert len(list((verdicts / "verdicts").iterdir())) == 2
    shown = call("report", "films", "--to", tmp_path / "table")
    assert shown.exit_code == 0, shown.output
    text = (tmp_path / "table/scores.md").read_text()
    row = next(line for line in text.splitlines() if line.startswith("| films |"))
    assert "| 80 | 2.5 % [0.7, 8.7] | 1.2 % [0.2, 6.7] |" in row and "judge not calibrated" in row
    assert "6 of 8 fields" not in text and "8 of 8 fields unanimous" in text and "counted as not passed: 78" in text
    assert "eye-1-2026" in text and "| 039 | Standard_2 |" in text
    rows = list(csv.DictReader((tmp_path / "table/scores.csv").read_text().splitlines()))
    own = [r for r in rows if r["system"] == "films" and r["category"] == "Overall"]
    assert [(r["metric"], r["passed"], r["n"]) for r in own] == [
        ("SA", "2", "80"),
        ("PC", "1", "80"),
        ("SA and PC", "1", "80"),
    ]
    given = call("report", "films", "--given-only")
    assert "| films | 2 | 100.0 %" in given.output


def test_films_of_another_place_are_not_mixed_in_and_only_the_last_hearing_counts(stand_in, film, criteria, tmp_path):
    how = ("--criteria", criteria, "--judge", "openai_compatible", "--address", stand_in.address)
    stand_in.replies = [(200, chat(said()), {})]
    for model in ("pika", "kling"):
        (tmp_path / model / "videos").mkdir(parents=True)
    one, other = tmp_path / "pika/videos/001.mp4", tmp_path / "kling/videos/039.mp4"
    for path in (one, other):
        path.write_bytes(film().read_bytes())
    assert call("run", one.parent, *how).exit_code == 0
    refused = call("run", other.parent, *how)
    assert refused.exit_code == 2 and "other films" in refused.output and "--out" in refused.output, refused.output
    one.rename(one.with_stem("005"))
    assert call("run", one.parent, *how).exit_code == 0
    assert "| videos | 1 | 100.0 %" in call("report", "videos", "--given-only").output


def test_a_film_of_no_scenario_of_the_set_is_named_and_does_not_count(stand_in, film, criteria):
    text = (criteria / "all.json").read_text()
    (criteria / "all.json").write_text(text.replace('"005-1"', '"999-1"'))
    film("999"), film("039")
    stand_in.replies = [(200, chat(said()), {})]
    call(
        "run", film("039").parent, "--criteria", criteria, "--judge", "openai_compatible", "--address", stand_in.address
    )
    told = call("report", "films").output
    assert "| films | 80 | 1.2 %" in told and "not counted (`--given-only` counts them): 999." in told
    assert "| films | 2 | 100.0 %" in call("report", "films", "--given-only").output


def test_a_judge_that_says_yes_to_all_is_found_by_its_calibration(stand_in, film, criteria, tmp_path, monkeypatch):
    monkeypatch.setattr(planted, "films", lambda folder: {id: Entrant(film()) for id in planted.scenarios()})
    two = json.dumps(dict.fromkeys(("Objects", "Event", "Standard_1", "Standard_2"), "Yes"))
    stand_in.replies = [(200, chat(two), {})]
    how = ("--judge", "openai_compatible", "--address", stand_in.address)
    found = call("calibrate", "films", *how)
    assert found.exit_code == 1 and "UNFIT to judge: it says Yes to all" in found.output, found.output
    assert call("run", film().parent, "--criteria", criteria, *how).exit_code == 0
    text = call("report", "films").output
    assert "judge UNFIT" in text and "| it is not so | 21 | 0 |" in text and "| frozen | 3 | 0 |" in text
    assert len(stand_in.asked) == 18 + 1


@pytest.mark.parametrize(
    ("words", "said_of_it"),
    [
        (("--judge", "nobody"), "openai_compatible"),
        (("--judge", "gemini"), "only for an address that you name"),
        (("--judge", "openai_compatible", "--address", "http://127.0.0.1:9", "--votes", 2), "tie"),
        (("--judge", "openai_compatible", "--address", "http://127.0.0.1:9", "--words", "/nowhere"), "cannot be read"),
        (("--judge", "codex_headless", "--address", "/nowhere/codex"), "not here"),
        (
            ("--judge", "openai_compatible", "--address", "http://127.0.0.1:9", "--out", "PROJECT"),
            "where builders read",
        ),
    ],
)
def test_what_cannot_be_asked_is_said_with_status_2_and_without_a_traceback(
    film, criteria, tmp_path, words, said_of_it
):
    (tmp_path / "project").mkdir()
    (tmp_path / "project/AGENTS.md").write_text("")
    words = [str(tmp_path / "project/judged") if word == "PROJECT" else word for word in words]
    done = call("run", film().parent, "--criteria", criteria, *words)
    assert done.exit_code == 2 and said_of_it in done.output and "next:" in done.output, done.output


def test_an_agents_shell_hears_no_verdict(film, criteria, monkeypatch):
    monkeypatch.setattr("worldwright.contract.harnesses.around", lambda: "Codex")
    how = ("--judge", "openai_compatible", "--address", "http://127.0.0.1:9")
    for words in (("run", film().parent, "--criteria", criteria, *how), ("calibrate", "x", *how), ("report", "x")):
        done = call(*words)
        assert done.exit_code == 2 and "nobody who builds hears" in done.output
    assert call("report").exit_code == 0, "published figures are anybody's"


def test_criteria_and_prompts_are_told(criteria):
    (criteria / "bad.json").write_text("{")
    told = call("criteria", criteria)
    assert (
        told.exit_code == 2
        and "3 scenarios, 3 of the set's 80, 6 key standards" in told.output
        and "not_json" in told.output
    )
    assert len(call("prompts").output.splitlines()) == 80 and call("judges").output.count("--address") == 6


def run_folder(folder: Path, prompt: str, *films: str) -> Path:
    (folder / "accepted/video").mkdir(parents=True)
    (folder / "plan.md").write_text("")
    (folder / "prompt.md").write_text(prompt)
    stamp = json.loads((Path(__file__).parents[3] / "examples/rolling-marble/stamp.json").read_text())
    for name in films:
        (folder / f"accepted/video/{name}.mp4").write_bytes(name.encode())
        digest = {"sha256": hashlib.sha256(name.encode()).hexdigest()}
        stamp["subject"].append({"name": f"video/{name}.mp4", "digest": digest})
    stamp["subject"] = list({one["name"]: one for one in stamp["subject"]}.values())
    (folder / "accepted/stamp.json").write_text(json.dumps(stamp))
    return folder


def test_a_film_that_nobody_stamped_is_no_accepted_one(tmp_path):
    for name in ("a", "b"):
        run_folder(tmp_path / "runs" / name, BALL, "film")
    (tmp_path / "runs/a/accepted/stamp.json").unlink()
    (tmp_path / "runs/b/accepted/video/film.mp4").write_bytes(b"another")
    found = entrants.find(tmp_path / "runs", {"039": [BALL]})
    assert (
        not found.entrants and ["not accepted" in found.left_out[0], "not the film" in found.left_out[1]] == [True] * 2
    )


def test_runs_are_found_by_their_prompts_and_only_accepted_ones_stand(tmp_path):
    run_folder(tmp_path / "runs/a", f"  {BALL.upper()}\n", "side", "film")
    run_folder(tmp_path / "runs/b", "A marble rolls along a flat table in a straight line")
    run_folder(tmp_path / "runs/c", "Something else.", "side")
    prompts = {"039": [BALL], "005": ["A marble rolls along a flat table in a straight line."]}
    found = entrants.find(tmp_path / "runs", prompts)
    assert {id: one.film.stem for id, one in found.entrants.items()} == {"039": "film"}
    assert found.entrants["039"].run == tmp_path / "runs/a"
    assert [line.partition(":")[0] for line in found.left_out] == ["b", "c"] and "not accepted" in found.left_out[0]
    assert entrants.find(tmp_path / "runs", prompts, "side").entrants["039"].film.stem == "side"
    run_folder(tmp_path / "runs/d", BALL, "side")
    with pytest.raises(EntrantError, match="two films"):
        entrants.find(tmp_path / "runs", prompts)
    (tmp_path / "list.yaml").write_text('"39": runs/d\n')
    assert entrants.find(tmp_path / "list.yaml", prompts).entrants["039"].run == tmp_path / "runs/d"
    for text in ("[1]", "'39': a\n39: b", "a: {", "39: 3"):
        (tmp_path / "list.yaml").write_text(text)
        with pytest.raises(EntrantError):
            entrants.find(tmp_path / "list.yaml", prompts)
