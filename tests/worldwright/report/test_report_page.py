"""The page comes out whatever is there, holds what is there, and never asks anybody for anything."""

import base64
import json
import random
import re
import shutil
from collections.abc import Callable
from html.parser import HTMLParser
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright import report
from worldwright.cli import main
from worldwright.model.errors import WorldwrightError
from worldwright.model.evidence.run import Run
from worldwright.report.sections import SECTIONS
from worldwright.stamp import tools as stamp

Copy = Callable[[Path], Path]
VOID = {"meta", "img", "br", "hr", "link", "input", "line", "polyline", "circle", "path"}


class Page(HTMLParser):
    """Checks nesting and collects text, ids and addresses."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.problems: list[str] = []
        self.text: list[str] = []
        self.ids: list[str] = []
        self.addresses: list[str] = []
        self.tags: list[str] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        values = dict(attributes)
        self.ids += [values["id"]] if values.get("id") else []
        self.addresses += [values[n] or "" for n in ("src", "href", "poster") if n in values]
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        if tag in VOID:
            return
        if not self.open or self.open[-1] != tag:
            self.problems.append(f"</{tag}> closes {self.open[-1:]} at {self.getpos()}")
            if tag not in self.open:
                return
            while self.open[-1] != tag:
                self.open.pop()
        self.open.pop()

    def handle_data(self, data: str) -> None:
        if not self.open or self.open[-1] not in ("script", "style"):
            self.text.append(data)


def read(folder: Path) -> tuple[Page, str]:
    path = report.write(Run(folder))
    assert path == folder / "report.html"
    html = path.read_text(encoding="utf-8")
    page = Page(html)
    assert page.problems == []
    assert page.open == []
    assert len(page.ids) == len(set(page.ids))
    for address in page.addresses:
        assert address.startswith(("data:", "#")), address[:80]
    assert "default-src 'none'" in html
    assert not re.search(r"url\(|@import|fetch\(|XMLHttpRequest|//[a-z]+\.[a-z]", re.sub(r"data:[^\"]+", "", html))
    return page, " ".join(" ".join(page.text).split())


def test_a_half_finished_run_says_what_is_missing(planned: Path, copy: Copy) -> None:
    _, text = read(copy(planned))
    assert "Not accepted yet" in text
    assert "A dropped ball" in text
    assert "“Drop a ball.”" in text
    assert "worldwright stamp approve" in text
    assert "No picture yet." in text
    assert "not measured yet" in text
    assert "The motion has not been scanned yet." in text


def test_a_law_of_the_authors_is_shown_with_what_it_gives_the_world_and_draws_from_store(
    planned: Path, copy: Copy
) -> None:
    from worldwright.report.material import gather
    from worldwright.report.page import render
    from worldwright.scan.known.own_laws import spring

    found = gather(Run(copy(planned)))
    found.laws = (spring(ballast=10.0),)
    text = " ".join(" ".join(Page(render(found)).text).split())
    assert "Impulse to the world" in text and "Drawn from its store" in text
    given, drawn = 11.0 * 9.81 * 2.0, found.laws[0].drawn_j
    assert found.laws[0].to_world == pytest.approx(given) and drawn == pytest.approx(2.0, rel=0.01)
    assert "216 N·s" in text and "2 J" in text


def test_a_plan_that_is_none_still_gets_a_page(tmp_path: Path) -> None:
    folder = tmp_path / "broken"
    folder.mkdir()
    (folder / "plan.md").write_text("# <script>alert('hm')</script>\n\n## plan_type\n\nnonsense\n", encoding="utf-8")
    (folder / "journal.jsonl").write_text('{"action": "<b>x</b>", "time": 7}\nnot json\n', encoding="utf-8")
    page, text = read(folder)
    assert page.tags.count("script") == 1
    assert "cannot be read as a plan" in text


def test_a_blocked_run_shows_its_cause(planned: Path, copy: Copy) -> None:
    folder = copy(planned)
    stamp.block(str(folder), cause="balls do not fall <upwards>")
    _, text = read(folder)
    assert "Blocked" in text
    assert "balls do not fall <upwards>" in text


def test_an_accepted_run_shows_everything(accepted: Path, copy: Copy) -> None:
    page, text = read(copy(accepted))
    assert "Accepted" in text
    assert "worldwright stamp verify" in text
    for words in ("The ball falls to the floor.", "proved", "by eye", "Height", "Speed", "Energy", "Contacts"):
        assert words in text
    assert "nothing but the engine's own step acted on this world" in text
    assert page.tags.count("video") == 2
    assert page.tags.count("polyline") >= 5
    for heading in ("Stamp", "Files", "Environment", "preview (PyOpenGL", "Journal", "The program", "The plan"):
        assert heading in text


def test_a_fresh_clone_shows_what_the_stamp_carries(accepted: Path, tmp_path: Path) -> None:
    clone = tmp_path / "clone"
    clone.mkdir()
    for name in ("plan.md", "prompt.md", "simulation.py", "journal.jsonl"):
        shutil.copy(accepted / name, clone / name)
    shutil.copytree(accepted / "accepted", clone / "accepted")
    page, text = read(clone)
    assert "Accepted" in text
    assert page.tags.count("video") == 2
    assert "Height" in text
    assert "only the stamp's samples" in text
    assert "nothing but the engine's own step acted on this world" in text


@pytest.mark.parametrize("seed", range(12))
def test_a_spoiled_run_still_gets_a_page(accepted: Path, copy: Copy, seed: int) -> None:
    folder = copy(accepted)
    choices = random.Random(seed)
    for _ in range(4):
        path = choices.choice([p for p in folder.rglob("*") if p.is_file()])
        data = path.read_bytes()
        path.write_bytes(choices.choice([b"", data[: len(data) // 2], choices.randbytes(200), b"null", b'{"a": []}']))
    try:
        found = stamp.status(str(folder))
    except WorldwrightError:  # nothing that makes it a run is left
        return
    read(folder)
    assert found.run == folder.name


def test_the_command_writes_the_page_and_a_recording(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    result = CliRunner().invoke(main, ["report", str(folder)])
    assert (result.exit_code, result.output.strip()) == (0, str(folder / "report.html"))
    result = CliRunner().invoke(main, ["report", str(folder), "--rerun"])
    assert result.exit_code == 0, result.output
    assert (folder / "recording.rrd").stat().st_size > 10_000
    result = CliRunner().invoke(main, ["report", str(folder / "nowhere")])
    assert result.exit_code == 2


def test_a_page_of_a_recording_is_reasonably_small(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    read(folder)
    videos = sum(p.stat().st_size for p in (folder / "accepted" / "video").iterdir())
    page = (folder / "report.html").stat().st_size
    assert page < 1.4 * videos + 700_000


def test_objectives_of_a_refuted_run_are_red(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    path = Run(folder).evidence(stamp.status(str(folder)).key) / "expect.json"
    told = json.loads(path.read_text())
    told["objectives"][0]["status"] = "refuted"
    told["objectives"][0]["expectations"][0] |= {"status": "fails", "margin": -0.2, "message": "it hung in the air"}
    path.write_text(json.dumps(told))
    _, text = read(folder)
    assert "refuted" in text
    assert "it hung in the air" in text
    assert "−0.2" in text


@pytest.fixture(scope="module")
def whole(reviewed: Path) -> str:
    """The page of a run that passed its review, made once: it shows every section."""
    return report.write(Run(reviewed)).read_text(encoding="utf-8")


@pytest.mark.parametrize("name", [entry.name for entry in SECTIONS.values()])
def test_a_section_draws(whole: str, name: str) -> None:
    assert f"The section {name} " not in whole


def test_a_section_that_fails_is_named_and_the_others_are_shown(reviewed: Path, whole: str, monkeypatch) -> None:
    assert "itself failed" not in whole

    def breaks(material: object) -> dict:
        raise RuntimeError("<ink>")

    monkeypatch.setattr(SECTIONS["RS020"].module, "context", breaks)
    page = report.write(Run(reviewed)).read_text(encoding="utf-8")
    assert "The section movement_section (RS020) itself failed (RuntimeError: &lt;ink&gt;)" in page
    assert 'id="claims"' in page
    assert Page(page).problems == []


def test_a_scene_of_the_present_recording_is_turned_by_hand_and_one_of_another_is_not(
    reviewed: Path, copy: Copy
) -> None:
    run = Run(copy(reviewed))
    assert 'id="replay"' not in report.write(run).read_text()
    usd = run.folder / "elsewhere.usda"
    done = CliRunner().invoke(main, ["export", str(run.folder), "--format", "usd", "--out", str(usd)])
    assert done.exit_code == 0, done.output
    assert usd.read_text().startswith("#usda 1.0")
    done = CliRunner().invoke(main, ["report", str(run.folder)])
    assert done.exit_code == 0, done.output
    html = run.report.read_text()
    page = Page(html)
    assert not page.problems and "replay" in page.ids and "replay-scene" in page.ids
    scene = run.folder / "scene.glb"
    data = scene.read_bytes()
    assert base64.b64encode(data).decode() in html
    digest = re.search(rb'"recording_sha256":"([0-9a-f]{64})"', data)
    assert digest
    scene.write_bytes(data.replace(digest[1], b"0" * 64))
    assert 'id="replay"' not in report.write(run).read_text()


@pytest.mark.parametrize("sign", ["&#8238;", "&#x202E;", "\u202e", "&#x2066;"])
def test_no_sign_of_a_plan_turns_the_direction_in_which_the_page_is_read(planned: Path, copy: Copy, sign: str) -> None:
    """Markdown makes a sign of an entity after all that looks for signs in the plan has looked."""
    folder = copy(planned)
    plan = folder / "plan.md"
    head, rest = plan.read_text(encoding="utf-8").split("\n", 1)
    plan.write_text(f"{head}\n\nIt falls {sign}m 92.0\u202c far.\n{rest}", encoding="utf-8")
    _, html = read(folder)
    assert not re.search("[\u202a-\u202e\u2066-\u2069]", html)
    assert "m 92.0\\u202c far" in html
