"""What a run sculpted becomes an asset with its source, which is found, shown and named; what cannot is refused, and says why."""

import hashlib
import json
import os
from pathlib import Path

import pytest
import yaml

from worldkit import assets
from worldwright.adding_assets import keep_sculpt
from worldwright.intake import keeping
from worldwright.intake.refusing import IntakeFailedError
from worldwright.intake.registering import RegisterError
from worldwright.model.errors import NotFoundError
from worldwright.model.evidence.run import Run
from worldwright.retrieve.tools import find_asset

BOX = """\
import shades
from worldkit import joints
from worldkit.sculpt import Part, crisp

WALLS = crisp.box((0.2, 0.2, 0.08)).translate(z=0.04) - crisp.box((0.18, 0.18, 0.08)).translate(z=0.05)
POT = (
    Part("pot", WALLS, look=shades.CLAY, make={"hulls": 5}),
    Part("lid", crisp.box((0.2, 0.2, 0.01)).translate(z=0.085), "pot", joints.Hinge("lid", (-0.1, 0, 0.08), (0, -1, 0), range_deg=(0, 90)), make={"hulls": 1}),
)
"""


def run_of(folder: Path, plan: str, source: str = BOX) -> Path:
    (folder / "sculpt").mkdir(parents=True)
    (folder / "plan.md").write_text(plan, encoding="utf-8")
    (folder / "sculpt/bowl.py").write_text(source, encoding="utf-8")
    (folder / "sculpt/shades.py").write_text('CLAY = "#b5653a"\n', encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def plan() -> str:
    text = (Path(__file__).parents[1] / "world/sculpted_plan.md").read_text(encoding="utf-8")
    said = "{friction: 0.4, torsional_friction: 0.02, rolling_friction: 0.003,"
    return text.replace("clay: {friction: 0.5,", f"clay: {said}")


@pytest.fixture(scope="module")
def kept(tmp_path_factory, plan):
    """The user's own folder with what a run sculpted, the run, and what was told of it."""
    patch = pytest.MonkeyPatch()
    own = tmp_path_factory.mktemp("own")
    patch.setenv("WORLDWRIGHT_ASSETS", str(own))
    run = run_of(tmp_path_factory.mktemp("runs") / "bowls", plan)
    told = keep_sculpt(
        str(run),
        "bowl",
        key="lidded_box",
        description="A box of clay with a lid",
        licence="CC0-1.0",
        creator="somebody",
    )
    yield own, run, told
    patch.undo()


def test_it_has_its_source_its_joints_its_weight_and_its_maker(kept):
    own, _, answer = kept
    told = answer.data
    assert told.ok and told.extents_m == pytest.approx((0.2, 0.2, 0.09)) and told.moving == {"lid": (0.0, 90.0)}
    volume = 0.2 * 0.2 * 0.08 - 0.18 * 0.18 * 0.07 + 0.2 * 0.2 * 0.01
    assert told.mass_kg == pytest.approx(1900 * volume, rel=1e-3), "the plan's material decides"
    assert told.licence == "CC0-1.0" and told.creator == "somebody" and "lidded_box/moving.xml" in told.text()
    assert answer.pictures[0].data[:8] == b"\x89PNG\r\n\x1a\n"
    folder = own / "lidded_box"
    assert (folder / "source/sculpt/bowl.py").read_text(encoding="utf-8") == BOX
    assert (folder / "source/sculpt/shades.py").is_file() and (folder / "thumbnail.png").is_file()
    text = (folder / "asset.yaml").read_text(encoding="utf-8")
    assert "asset keep" in text.splitlines()[0] and told.collides_as == "6 hulls"
    facts = yaml.safe_load(text)
    assert facts["measured"]["stands"] and facts["measured"]["moving_stands"]
    assert assets.find("lidded_box").contact == {
        "friction": 0.4,
        "torsional": 0.02,
        "rolling": 0.003,
        "restitution": 0.2,
    }
    assert "clay" in facts["contact_source"]
    assert facts["source"] == "sculpted by the run bowls (not accepted), sculpt/bowl.py:POT"


def test_it_is_called_accepted_only_as_it_was_accepted(plan, tmp_path):
    run = run_of(tmp_path / "run", plan)
    files = {"sculpt/bowl.py": (run / "sculpt/bowl.py").read_bytes()}
    assert keeping._state(Run(run), files) == "not accepted"
    digests = [hashlib.sha256(content).hexdigest() for content in (plan.encode(), *files.values())]
    (run / "accepted").mkdir()
    (run / "accepted/stamp.json").write_text(json.dumps({"subject": [{"digest": {"sha256": one}} for one in digests]}))
    assert keeping._state(Run(run), files) == "accepted"
    assert keeping._state(Run(run), {"sculpt/bowl.py": b"other"}) == "changed since it was accepted"


def test_it_is_found_and_another_plan_can_name_it(kept):
    assert any(hit.key == "lidded_box" for hit in find_asset("box with a lid").assets)
    asset = assets.find("lidded_box")
    assert asset.mass_at() == pytest.approx(kept[2].data.mass_kg, rel=1e-4) and len(asset.collision) == 6


@pytest.mark.parametrize(
    ("thing", "words", "kind", "said"),
    [
        ("vase", {}, NotFoundError, "sculpts nothing called 'vase'"),
        ("pea", {}, NotFoundError, "sculpts nothing called 'pea'"),
        ("bowl", {"key": "lidded_box"}, RegisterError, "there is an asset lidded_box already"),
        ("bowl", {"key": "Soup Bowl"}, IntakeFailedError, "no key of an asset"),
    ],
    ids=["no such thing", "no sculpt", "taken", "no key"],
)
def test_what_cannot_be_kept_is_refused_before_anything_runs(kept, thing, words, kind, said):
    own, run, _ = kept
    with pytest.raises(kind, match=said) as refused:
        keep_sculpt(str(run), thing, **words)
    assert refused.value.next_move
    assert sorted(path.name for path in own.iterdir()) == ["lidded_box"]


def test_a_run_of_another_user_and_none_at_all_are_refused(kept, monkeypatch, tmp_path):
    monkeypatch.setattr(os, "getuid", lambda: kept[1].stat().st_uid + 1)
    with pytest.raises(IntakeFailedError) as refused:
        keep_sculpt(str(kept[1]), "bowl", key="other")
    assert refused.value.code == "not_yours" and refused.value.place == str(kept[1])
    with pytest.raises(NotFoundError):
        keep_sculpt(str(tmp_path), "bowl")


def test_a_file_that_reads_what_does_not_lie_beside_it_is_refused(kept, plan, tmp_path):
    elsewhere = tmp_path / "outline.txt"
    elsewhere.write_text("0.2", encoding="utf-8")
    source = f"from worldkit.sculpt import crisp\n\nSIDE = float(open({str(elsewhere)!r}).read())\nPOT = crisp.box((SIDE, 0.2, 0.09))\n"
    run = run_of(tmp_path / "run", plan, source)
    with pytest.raises(IntakeFailedError) as refused:
        keep_sculpt(str(run), "bowl", key="other")
    assert refused.value.code == "reads_elsewhere" and refused.value.place == "sculpt/bowl.py:3"
    assert "outline.txt" in refused.value.cause and not (kept[0] / "other").exists()
