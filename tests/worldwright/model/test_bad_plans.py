"""Every broken plan is refused with all its problems, each with its line, its cause and its fix."""

from pathlib import Path

import pytest

from worldwright.model.errors import PlanError
from worldwright.model.plan.plan_text import MAX_BYTES, read_plan

HERE = Path(__file__).parent
CORPUS = sorted((HERE / "bad_plans").glob("*.md"))


@pytest.mark.parametrize("path", CORPUS, ids=lambda p: p.stem)
def test_a_broken_plan_says_what_is_wrong_and_what_to_do(path, snapshot, monkeypatch):
    monkeypatch.chdir(path.parent)
    with pytest.raises(PlanError) as refusal:
        read_plan(path.name)
    findings = refusal.value.findings
    assert all(f.message and f.fix and f.file == path.name for f in findings)
    assert [f.line for f in findings if f.line] == sorted(f.line for f in findings if f.line)
    assert "\n".join(map(str, findings)) == snapshot


def test_the_plan_they_are_made_from_is_good():
    assert read_plan(HERE / "good_plan.md").plan.object_names() == ("box", "ball")


def test_a_plan_that_is_not_there_is_not_found(tmp_path):
    from worldwright.model.errors import NotFoundError

    for path in (tmp_path / "plan.md", tmp_path, tmp_path / "no" / "plan.md", Path("a\0b")):
        with pytest.raises(NotFoundError):
            read_plan(path)


def test_a_huge_file_is_refused_without_reading_it_all(tmp_path):
    path = tmp_path / "plan.md"
    with path.open("wb") as stream:
        stream.truncate(MAX_BYTES * 4)
    with pytest.raises(PlanError, match="larger than"):
        read_plan(path)


@pytest.mark.parametrize(
    ("data", "line", "words"),
    [
        (b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR", 1, "binary"),
        ("# Tisch\n\nEin B\xe4llchen\n".encode("latin-1"), 3, "byte 0xe4 is not UTF-8"),
        (b"# a\n\x00\n", 2, "binary"),
    ],
)
def test_what_is_not_utf8_text_is_refused_at_its_line(tmp_path, data, line, words):
    path = tmp_path / "plan.md"
    path.write_bytes(data)
    with pytest.raises(PlanError, match=words) as refusal:
        read_plan(path)
    assert [(f.code, f.line) for f in refusal.value.findings] == [("WP001", line)]
    assert path.read_bytes() == data
