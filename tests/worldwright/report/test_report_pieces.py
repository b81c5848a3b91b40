"""Charts, series and texts of a report."""

import math
import re

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from worldwright.model.recording.records import Contacts
from worldwright.model.recording.trajectory import Trajectory
from worldwright.report import chart, series, text
from worldwright.report.bar import bar
from worldwright.report.facts import _named, strength

finite = st.floats(-1e6, 1e6, allow_nan=False)


@given(finite, finite)
def test_ticks_are_round_ordered_and_inside(a: float, b: float) -> None:
    low, high = min(a, b), max(a, b)
    found = chart.ticks(low, high)
    assert 1 <= len(found) <= 12 or high - low < 1e-9
    assert found == sorted(found)
    if high > low:
        slack = 1e-6 * (high - low)
        assert all(low - slack <= tick <= high + slack for tick in found)


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_any_number_can_be_written(value: float) -> None:
    assert chart.quantity(value)


def test_numbers_are_written_as_people_write_them() -> None:
    assert [chart.quantity(v) for v in (0, 1.23456, -0.5, 12345.6, 1.5e-7, math.inf)] == [
        "0", "1.23", "−0.5", "12\u202f346", "1.50e-7", "inf",
    ]  # fmt: skip


@given(st.lists(finite, min_size=1, max_size=3000))
def test_reducing_a_curve_keeps_its_extremes(values: list[float]) -> None:
    t = np.arange(len(values), dtype=float)
    x, y = series.reduce(t, np.array(values))
    assert len(x) == len(y) <= 2 * series.POINTS + 2
    assert (min(y), max(y)) == (min(values), max(values))
    assert x == sorted(x)
    assert (x[0], x[-1]) == (t[0], t[-1])


def test_values_that_are_no_numbers_are_left_out() -> None:
    assert series.reduce(np.arange(3.0), np.array([1.0, np.nan, np.inf])) == ([0.0], [1.0])
    nothing = chart.over_time(
        "Height", "m", [series.Line("x", *series.reduce(np.arange(2.0), np.full(2, np.nan)))], 1, {}
    )
    assert nothing.curves[0].points == ""


def trajectory() -> Trajectory:
    t = np.linspace(0, 1, 101)
    pos = np.zeros((101, 2, 3))
    pos[:, 0, 2] = np.abs(1 - 2 * t)
    touching = np.flatnonzero(np.abs(t - 0.5) < 0.015)
    zeros = np.zeros(len(touching), dtype=int)
    contacts = Contacts(touching, zeros, zeros - 1, 0.001 + 0.0 * touching, 5.0 + touching)
    return Trajectory.from_arrays(
        t, ("ball", "table"), pos, contacts=contacts, energy=np.ones((101, 2)), time_step=0.01
    )


def test_a_trajectory_becomes_lines_and_contacts() -> None:
    motion = series.of(trajectory())
    assert [line.name for line in motion.heights] == ["ball"]
    assert (motion.rows, motion.bodies, motion.duration_s) == (101, 2, 1.0)
    (touch,) = motion.contacts
    assert touch.name == "ball · world"
    assert len(touch.spans) == 1
    assert 0.48 < touch.spans[0][0] < 0.5 < touch.spans[0][1] < 0.54
    (row,) = chart.timeline(motion.contacts, motion.duration_s)
    assert row.bars[0].left + row.bars[0].width <= 100
    drawn = chart.over_time("Height", "m", motion.heights, 1.0, {})
    points = [tuple(map(float, p.split(","))) for p in drawn.curves[0].points.split()]
    assert points[0][0] == 0.0
    assert points[-1][0] == 1000.0
    assert all(0 <= y <= 1000 for _, y in points)


def test_markdown_and_code_cannot_smuggle_html() -> None:
    evil = (
        "<script>alert(1)</script>\n\n![x](http://example.org/x.png)\n\n[y](javascript:alert(1))\n\n```html\n<b>\n```\n"
    )
    html = text.markdown(evil)
    assert "<script" not in html
    assert "<img" not in html
    assert 'href="javascript' not in html
    assert "<b>" not in html
    assert "<script" not in text.code("x = '<script>'\n")


def test_code_has_one_anchor_a_line_even_in_long_strings() -> None:
    html = text.code('x = """\na\nb\n"""\ny = 1\n')
    assert re.findall(r'id="L(\d+)"', html) == ["1", "2", "3", "4", "5"]
    for line in html.split('<span class="line"')[1:]:
        assert line.count("<span") == line.count("</span>") - 1  # every colour ends on its own line


def test_units_follow_their_numbers() -> None:
    assert _named("min_m", 1.5) == "min 1.5\u202fm"
    assert _named("window_s", [0.1, 0.3]) == "window 0.1 to 0.3\u202fs"
    assert _named("max_speed_m_s", 0.05) == "max speed 0.05\u202fm/s"
    assert _named("bodies", ["cue_ball", "object_ball"]) == "bodies cue ball object ball"


def test_strength_is_a_share() -> None:
    from worldwright.model.evidence.reports import ExpectationResult

    def made(measured: float | None, margin: float | None) -> ExpectationResult:
        return ExpectationResult(name="x", arguments={}, status="holds", measured=measured, margin=margin)

    assert strength(made(None, None)) == 0
    assert strength(made(0.0, 0.0)) == 0
    assert strength(made(1.0, 0.5)) == 1 / 3
    assert strength(made(0.0, 2.0)) == 1.0


def test_the_progress_bar_is_a_progress_and_silent_without_a_terminal(capsys) -> None:  # type: ignore[no-untyped-def]
    with bar() as progress:
        progress(0, 10, "physics")
        progress(10, 10)
    assert capsys.readouterr().out == ""


def test_what_hardly_changes_is_drawn_flat_and_every_tick_differs():
    ball = series.Line("marble", [0.0, 1.0, 2.0], [0.7579, 0.75791, 0.7579])
    drawn = chart.over_time("Height", "m", [ball], 2.0, {})
    labels = [tick.label for tick in drawn.y_ticks]
    assert len(set(labels)) == len(labels) > 1
    heights = [float(point.split(",")[1]) for point in drawn.curves[0].points.split()]
    assert max(heights) - min(heights) < 5  # of a thousand


def test_a_plan_that_nobody_read_was_approved_by_nobody() -> None:
    """The committed stamps of auto mode name a user, who never saw the plan."""
    from worldwright.gallery.worlds import EXAMPLES
    from worldwright.model.evidence.run import Run
    from worldwright.report.facts import provenance, story
    from worldwright.report.material import gather

    found = gather(Run(EXAMPLES / "ladder-leans"))
    assert found.stamp is not None and found.stamp.predicate.approval.auto
    ((name, said),) = [row for row in provenance(found)["Stamp"] if row[0] == "approved"]
    assert (name, said.split(",")[0].split(" (")[0]) == ("approved", "by nobody: auto mode")
    assert {e.actor for e in story(found) if e.action == "approve"} == {"nobody: auto mode"}
