"""The tools on real files: written back losslessly, checked, settled, explained, drawn."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.model.errors import NotFoundError, PlanError
from worldwright.model.plan.plan_text import parse_plan, read_plan
from worldwright.place import tools
from worldwright.place.drawing.labels import Item, _overlap, arrange
from worldwright.place.drawing.panel import metres, nice
from worldwright.place.overlaps import overlapping

REPO = Path(__file__).parents[3]
EXAMPLES = sorted(path.parent.name for path in (REPO / "examples").glob("*/plan.md"))
ROW = "  - {subject: ball, predicate: PLACE-ON, object: box, params: {offset: [0, 0]}}"


@pytest.fixture
def plan(tmp_path) -> Path:
    return Path(shutil.copy(REPO / "tests/worldwright/model/good_plan.md", tmp_path / "plan.md"))


@pytest.fixture
def breakfast(tmp_path) -> Path:
    return Path(shutil.copy(REPO / "examples/breakfast-table/plan.md", tmp_path / "plan.md"))


def change(plan: Path, old: str, new: str) -> Path:
    text = plan.read_text(encoding="utf-8")
    assert old in text
    plan.write_text(text.replace(old, new), encoding="utf-8")
    return plan


def codes(report) -> set[str]:
    return {f.code for f in report.findings}


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_resolve_check_and_settle(name, tmp_path):
    plan = Path(shutil.copy(REPO / "examples" / name / "plan.md", tmp_path / "plan.md"))
    layout = tools.resolve(plan)
    assert layout.ok, layout.text()
    assert {o.name for o in layout.objects} == set(read_plan(plan).plan.object_names())
    report = tools.check(plan)
    assert report.ok, report.text()
    assert not [f for f in report.findings if f.severity == "warning"]
    assert tools.settle(plan).ok
    again = plan.read_bytes()
    assert not tools.resolve(plan).written
    assert plan.read_bytes() == again


def test_resolving_adds_only_poses_and_provenance(breakfast):
    import re

    resolved = r',\s*position: \{[^}]*\},\s*orientation: \{[^}]*\},\s*provenance: "[^"]*"'
    before = re.sub(resolved, "", breakfast.read_text(encoding="utf-8"))  # the example itself is committed resolved
    assert "provenance" not in before
    breakfast.write_text(before, encoding="utf-8")
    assert tools.resolve(breakfast).written
    after = breakfast.read_text(encoding="utf-8")
    kept = iter(after.splitlines())
    for line in before.splitlines():  # every line survives in order; a row's closing brace moved behind its pose
        assert any(line.rstrip("}") in other for other in kept), line
    rows = read_plan(breakfast).plan.topology.scene_predicates
    assert all(r.position and r.orientation and r.provenance for r in rows)
    mug = [r for r in rows if r.subject == "mug"]
    assert len({r.position for r in mug}) == 1
    assert any(r.provenance.startswith("x = plate.max_x + gap + mug.half_x = ") for r in mug)


def test_a_moved_reference_moves_what_rests_on_it(breakfast):
    tools.resolve(breakfast)
    before = {o.name: o.position for o in tools.resolve(breakfast, write=False).objects}
    change(
        breakfast, "predicate: PLACE-ON-BASE, params: {x: 0, y: 0}", "predicate: PLACE-ON-BASE, params: {x: 1, y: 0}"
    )
    assert "WP305" in codes(tools.check(breakfast))
    after = {o.name: o.position for o in tools.resolve(breakfast).objects}
    assert all(after[n][0] - before[n][0] == pytest.approx(1, abs=3e-6) for n in before)
    assert "WP305" not in codes(tools.check(breakfast))


def test_nothing_is_written_while_something_is_wrong(plan):
    change(plan, ROW, ROW.replace(", params: {offset: [0, 0]}", ""))
    before = plan.read_bytes()
    layout = tools.resolve(plan)
    assert codes(layout) == {"WP205"}
    assert plan.read_bytes() == before
    assert not (plan.parent / "journal.jsonl").exists()
    with pytest.raises(PlanError) as refusal:
        tools.settle(plan)
    assert refusal.value.findings
    picture = tools.draw(plan)  # what is placed is still drawn
    assert picture.data.unplaced == ("ball",)


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_line_ends_survive(plan, end):
    plan.write_bytes(plan.read_bytes().replace(b"\n", end.encode()))
    assert tools.resolve(plan).written
    data = plan.read_bytes()
    assert data.count(b"\n") == data.count(end.encode())
    assert parse_plan(data.decode()).plan.topology.scene_predicates[1].position.z == 0.55


def test_check_finds_what_penetrates_hovers_and_sinks(plan):
    change(plan, ROW, ROW.replace("PLACE-ON, object: box, params: {offset: [0, 0]}", "HEIGHT, params: {bottom: 0.48}"))
    change(plan, "```\n\n## visualization", "  - {subject: ball, predicate: ALIGN-CENTER-LR, object: box}\n"
           "  - {subject: ball, predicate: ALIGN-CENTER-FB, object: box}\n```\n\n## visualization")  # fmt: skip
    report = tools.check(plan)
    overlap = next(f for f in report.findings if f.code == "WP302")
    assert "0.02 m" in overlap.message
    assert not report.ok
    change(plan, "bottom: 0.48", "bottom: 0.9")
    report = tools.check(plan)
    assert report.ok
    assert "starts 0.4 m above `box`" in next(f for f in report.findings if f.code == "WP304").message
    change(plan, "bottom: 0.9", "bottom: -0.05")
    assert {"WP303", "WP302"} <= codes(tools.check(plan))


def test_exact_shapes_forgive_boxes_that_only_seem_to_meet(plan):
    boxes = plan.read_text(encoding="utf-8").replace(
        "primitive: box\n  size: [1, 1, 0.5]", "primitive: sphere\n  size: [1, 1, 1]"
    )
    plan.write_text(
        boxes.replace(ROW, "  - {subject: ball, predicate: PLACE-ON-BASE, params: {x: 0.45, y: 0.45}}"),
        encoding="utf-8",
    )
    report = tools.check(plan)
    assert report.pairs_tested == 1
    assert "WP302" not in codes(report)


def test_a_centre_beyond_the_edge_is_a_violated_row(plan):
    change(plan, "offset: [0, 0]", "offset: [0.6, 0]")
    report = tools.check(plan)
    assert codes(report) == {"WP301"}
    assert "0.1 m" in report.findings[0].message
    assert report.margins[0].margin == pytest.approx(-0.099)


def test_settle_tells_what_does_not_stay(breakfast):
    change(breakfast, "subject: lamp, predicate: PLACE-ON, object: table, params: {offset: [-0.58, 0.24]}",
           "subject: lamp, predicate: PLACE-ON, object: mug, params: {surface: top, offset: [0.06, 0]}")  # fmt: skip
    report = tools.settle(breakfast)
    assert not report.ok
    fallen = next(f for f in report.findings if "`lamp`" in f.message)
    assert fallen.code == "WP306"
    assert fallen.line
    assert "tilts" in fallen.message


def test_settle_measures_a_drop(breakfast):
    moved = {o.name: o for o in tools.settle(breakfast).objects}
    assert moved["toast"].drop_m == pytest.approx(0.04, abs=2e-3)
    assert moved["plate"].drop_m == pytest.approx(0.0, abs=1e-3)
    assert "table" not in moved


def test_explain_goes_back_to_the_base(breakfast):
    explanation = tools.explain(breakfast, "upper_book")
    assert [link.name for link in explanation.chain] == ["table", "lower_book", "upper_book"]
    assert all(len(link.formulas) >= 4 and link.size_source for link in explanation.chain)
    assert "asset_dimensions" in explanation.text()
    with pytest.raises(NotFoundError, match="no object `nobody`"):
        tools.explain(breakfast, "nobody")


def test_a_drawing_is_a_picture_in_a_file_and_in_the_answer(breakfast, tmp_path):
    import cv2

    out = tmp_path / "deep" / "layout.png"
    shown = tools.draw(breakfast, out=out)
    (picture,) = shown.pictures
    assert out.read_bytes() == picture.data
    assert len(picture.data) < 1_000_000
    image = cv2.imdecode(np.frombuffer(picture.data, np.uint8), cv2.IMREAD_COLOR)
    assert image.shape[1] == 1600
    assert shown.data.objects == 13
    assert len(np.unique(image.reshape(-1, 3), axis=0)) > 200
    assert tools.draw(breakfast).pictures[0].data == picture.data  # the same plan, the same picture


def test_problems_are_drawn_in_red(breakfast):
    import cv2

    def red(data: bytes) -> int:
        image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR).astype(int)
        return int(((image[..., 2] > 190) & (image[..., 1] < 70) & (image[..., 0] < 70)).sum())

    clean = red(tools.draw(breakfast).pictures[0].data)
    change(breakfast, "offset: [0.52, 0.06]", "offset: [0.95, 0.06]")
    broken = tools.draw(breakfast)
    assert any(f.code == "WP301" for f in broken.data.findings)
    assert red(broken.pictures[0].data) > clean + 500


def test_tools_are_found_by_run_folder_too(plan):
    assert tools.resolve(plan.parent, write=False).ok
    with pytest.raises(NotFoundError):
        tools.resolve(plan.parent / "nowhere")


boxes_of = st.lists(
    st.tuples(st.floats(0, 900), st.floats(0, 500), st.floats(2, 300), st.floats(2, 200), st.floats(20, 120)),
    min_size=1,
    max_size=25,
)


@given(boxes_of)
@settings(max_examples=60, deadline=None)
def test_labels_never_cover_each_other(rows):
    items = [Item(f"n{i}", (x, y, x + w, y + h), wide, 20) for i, (x, y, w, h, wide) in enumerate(rows)]
    panel, bar = (0.0, 0.0, 1200.0, 700.0), (1000.0, 640.0, 1190.0, 690.0)
    labels, left = arrange(items, panel, [bar])
    assert len(labels) + len(left) == len(items)
    for i, label in enumerate(labels):
        assert _overlap(label.box, bar) == 0
        assert label.box[0] >= 0
        assert label.box[3] <= 700
        assert all(_overlap(label.box, other.box) == 0 for other in labels[:i])


corners = st.tuples(*[st.floats(-2, 2)] * 3, *[st.floats(0.01, 2)] * 3)


@given(st.lists(corners, max_size=20))
@settings(max_examples=60, deadline=None)
def test_the_grid_finds_what_brute_force_finds(rows):
    bounds = [(f"n{i}", r[:3], tuple(a + b for a, b in zip(r[:3], r[3:], strict=True))) for i, r in enumerate(rows)]
    swept = {(a, b): depth for a, b, depth in overlapping(bounds, deeper_than_m=1e-3)}
    for i, (first, low, high) in enumerate(bounds):
        for second, other_low, other_high in bounds[i + 1 :]:
            depth = min(min(h, k) - max(v, w) for v, h, w, k in zip(low, high, other_low, other_high, strict=True))
            pair = tuple(sorted((first, second)))
            assert (pair in swept) == (depth > 1e-3)
            if pair in swept:
                assert swept[pair] == depth


def test_round_numbers():
    assert [nice(v) for v in (0.07, 0.1, 0.13, 3, 8)] == [0.1, 0.1, 0.2, 5, 10]
    assert [metres(0.5, 0.2), metres(-1.0, 1), metres(-0.0, 0.1)] == ["0.5", "−1", "0"]


SUNK = "  - {subject: ball, predicate: PLACE-ON, object: box, params: {offset: [0, 0], gap: 0.003}}"


def test_settled_poses_are_written_only_within_the_tolerance(plan):
    text = plan.read_text(encoding="utf-8")
    assert ROW in text
    movers = text.replace("motion_expectations: [ball]", "motion_expectations: []")
    plan.write_text(movers.replace(ROW, SUNK), encoding="utf-8")
    before = plan.read_bytes()
    refused = tools.settle(plan, write=True, tolerance_m=0.002)
    assert [f.code for f in refused.findings] == ["WP323"]
    assert "`ball` moved 0.003" in refused.findings[0].message
    assert plan.read_bytes() == before
    done = tools.settle(plan, write=True, tolerance_m=0.005)
    assert done.ok
    assert done.written == ("ball",)
    after = read_plan(plan).plan
    assert after.topology.settled["ball"].z == pytest.approx(-0.003, abs=6e-4)
    resolved = tools.resolve(plan)
    assert not resolved.written, "settling wrote the poses too"
    assert "topology.settled" in " ".join(resolved["ball"].provenance)
    assert not [f for f in tools.check(plan).findings if f.code == "WP305"]
    again = tools.settle(plan, write=True)
    assert not again.written
    assert again.objects[0].moved[2] == pytest.approx(0, abs=1e-4)


def test_a_settled_pose_written_by_hand_is_found(plan):
    text = plan.read_text(encoding="utf-8")
    plan.write_text(
        text.replace("scene_predicates:", "settled: {ball: {x: 0.2}}\nscene_predicates:", 1), encoding="utf-8"
    )
    found = [f for f in tools.check(plan).findings if f.code == "WP305" and f.severity == "error"]
    assert len(found) == 1
    assert "0.2 m" in found[0].message


OBSERVED = """gravity_axis: -z
image_observation:
  image: reference.png
  viewpoint: side_minus_y
  visible: [table, chair, {name: laptop, described: open}]
  relations:
    - {subject: toast, relation: on, object: plate}
    - {subject: apple, relation: inside, object: bowl}
    - {subject: bowl, relation: behind, object: plate}
    - {subject: lamp, relation: right_of, object: laptop}
  facing:
    - {subject: chair, direction: away}
    - {subject: laptop, toward: chair}
"""


def test_a_plan_with_an_image_is_compared_with_it(breakfast):
    text = breakfast.read_text(encoding="utf-8").replace("gravity_axis: -z\n", OBSERVED, 1)
    breakfast.write_text(text, encoding="utf-8")
    report = tools.check(breakfast)
    (finding,) = report.findings
    assert finding.code == "WP321"
    assert "`lamp` right_of `laptop`" in finding.message
    assert "1.1 m" in finding.message
    assert "relation: right_of" in text.splitlines()[finding.line - 1]
    assert report.views[0].camera == "reference_view"


def test_the_picture_that_a_person_gave_is_kept_beside_the_plan(breakfast, tmp_path):
    import cv2

    photos = tmp_path / "elsewhere"
    photos.mkdir()
    cv2.imwrite(str(photos / "Desk.PNG"), np.full((8, 8, 3), 200, np.uint8))
    outside = tmp_path / "outside.png"
    (breakfast.parent / "reference.png").symlink_to(outside)
    for _ in range(2):
        tools.resolve(breakfast, image=photos / "Desk.PNG")
    kept = breakfast.parent / "reference.png"
    assert kept.read_bytes() == (photos / "Desk.PNG").read_bytes() and not kept.is_symlink() and not outside.exists()
    (photos / "notes.txt").write_text("no picture")
    (photos / "fake.png").write_text("no picture")
    for wrong in ("notes.txt", "fake.png", "nowhere.png"):
        with pytest.raises(NotFoundError):
            tools.resolve(breakfast, image=photos / wrong)
    assert sorted(path.name for path in breakfast.parent.glob("reference*")) == ["reference.png"]
