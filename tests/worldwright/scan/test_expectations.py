"""Every expectation on its own cases; and what must hold of all of them."""

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit.turning import about, product
from worldwright.model.plan.committed import Objective
from worldwright.model.recording.shown_points import ShownPoints
from worldwright.scan.audits.moment import event_s
from worldwright.scan.known.analytic import bouncing, falling, resting, sliding
from worldwright.scan.known.motions import thrown
from worldwright.scan.known.pictured import from_above
from worldwright.scan.objectives.claims import EXPECTATIONS
from worldwright.scan.objectives.events import moment_s
from worldwright.scan.objectives.expecting import _objective, argument_problem, measure

CASES = [
    pytest.param(entry, maker, args, good, id=f"{entry.name}-{'good' if good else 'bad'}{k}")
    for entry in EXPECTATIONS.values()
    for good, pairs in ((True, entry.GOOD), (False, entry.BAD))
    for k, (maker, args) in enumerate(pairs)
]
FAMILIES = {
    "kinematics", "contact", "rotation", "oscillation", "energy", "deformation", "fracture", "flow", "comparison",
    "picture",
}  # fmt: skip


def family(entry):
    return entry.module.__name__.split(".")[-2]


@pytest.mark.parametrize(("entry", "maker", "arguments", "good"), CASES)
def test_what_is_so_holds_and_what_is_not_fails(entry, maker, arguments, good):
    assert argument_problem(entry.name, arguments) is None
    result = measure(maker(), entry.name, arguments)
    assert result.status == ("holds" if good else "fails"), result.message
    assert (result.margin >= 0) == good
    assert result.message and result.expected and result.unit
    assert arguments.get("body", "") in result.message or entry.name == "happens_at"


def test_the_vocabulary_is_large_complete_and_documented():
    assert len(EXPECTATIONS) >= 50
    assert {family(entry) for entry in EXPECTATIONS.values()} == FAMILIES
    for code, entry in EXPECTATIONS.items():
        assert code.startswith("WE") and len(code) == 5
        assert entry.GOOD and entry.BAD
        assert "Source:" in entry.doc
        assert entry.measure.__doc__
        for name, field in entry.Given.model_fields.items():
            assert field.description, f"{entry.name}.{name} does not say what it is"
            for suffix, unit in {
                "_m": "m",
                "_s": "s",
                "_n": "N",
                "_deg": "deg",
                "_m_s": "m/s",
                "_rad_s": "rad/s",
            }.items():
                if name.endswith(suffix) and not name.endswith(("_m_s", "_rad_s", "_n_s", "_n_m")):
                    assert unit in field.description, f"{entry.name}.{name} does not say its unit"


@pytest.mark.parametrize("entry", [e for e in EXPECTATIONS.values() if e.EVENT], ids=lambda e: e.name)
def test_an_event_is_false_of_a_recording_that_ends_before_it(entry):
    moments = []
    for maker, arguments in entry.GOOD:
        trajectory = maker()
        moment = moment_s(trajectory, {entry.name: arguments})
        moments.append(moment)
        if moment > trajectory.t[0]:
            row = int(np.searchsorted(trajectory.t, moment - 1e-12))
            assert measure(trajectory.before(row), entry.name, arguments).status != "holds"
            assert measure(trajectory.before(row + 1), entry.name, arguments).status == "holds"
            assert event_s(trajectory, entry.name, arguments) == pytest.approx(moment)
    assert any(moment > 0 for moment in moments), "no case shows it come true"


@pytest.mark.parametrize(("entry", "maker", "arguments", "good"), CASES)
def test_a_short_beginning_never_ends_in_a_traceback(entry, maker, arguments, good):
    trajectory = maker()
    for rows in (1, 2, 3, 7):
        result = measure(trajectory.before(rows), entry.name, arguments)
        assert "the expectation itself failed" not in result.message, result.message


ABSOLUTE = {
    "place",
    "direction",
    "center",
    "about",
    "low",
    "high",
    "axis",
    "at_m",
    "surface_m",
    "along",
    "camera",
    "ground",
}


RELATIVE = [case for case in CASES if not ABSOLUTE & set(case.values[2])]
"""Cases that speak of no place and no direction of the world."""


@pytest.mark.parametrize(("entry", "maker", "arguments", "good"), RELATIVE)
def test_where_the_world_begins_and_which_way_it_faces_does_not_matter(entry, maker, arguments, good):
    trajectory = maker()
    before = measure(trajectory, entry.name, arguments)
    after = measure(moved(trajectory, 0.7, (3.0, -2.0)), entry.name, arguments)
    assert after.status == before.status, after.message
    assert after.margin == pytest.approx(before.margin, rel=1e-5, abs=1e-6)


def moved(trajectory, yaw, shift):
    """The same world turned about the vertical and moved over the ground."""
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1.0]])
    rows, bodies = trajectory.pos.shape[:2]
    quat = product(about((0, 0, 1), yaw), trajectory.quat.reshape(-1, 4))
    contacts = trajectory.contacts
    if contacts is not None:
        contacts = replace(
            contacts,
            force=contacts.force @ turn.T,
            normal=contacts.normal @ turn.T,
            position=contacts.position @ turn.T + [*shift, 0],
        )
    media = {name: replace(lay, flat=lay.flat @ turn.T + [*shift, 0]) for name, lay in trajectory.media.known.items()}
    return replace(
        trajectory,
        media=ShownPoints(media),
        pos=trajectory.pos @ turn.T + [*shift, 0],
        linvel=trajectory.linvel @ turn.T,
        angvel=trajectory.angvel @ turn.T,
        quat=quat.reshape(rows, bodies, 4),
        contacts=contacts,
    )


THRESHOLDS = [
    (entry, maker, arguments, key)
    for entry in EXPECTATIONS.values()
    for maker, arguments in entry.GOOD
    for key, value in arguments.items()
    if key.startswith(("min_", "max_", "tolerance")) and isinstance(value, float | int) and not isinstance(value, bool)
]


@pytest.mark.parametrize(
    ("entry", "maker", "arguments", "key"), THRESHOLDS, ids=[f"{e.name}-{k}" for e, _, _, k in THRESHOLDS]
)
def test_a_stricter_demand_never_has_a_larger_margin_and_at_last_fails(entry, maker, arguments, key):
    trajectory, value = maker(), arguments[key]
    stricter = (lambda k: value * 3**k) if key.startswith("min_") else (lambda k: value / 3**k)
    margins = []
    for k in range(0, 40, 4):
        wanted = round(stricter(k)) if isinstance(value, int) and key == "min_count" else stricter(k)
        if argument_problem(entry.name, {**arguments, key: wanted}):
            break  # e.g. a share beyond 1: refused before anything runs
        result = measure(trajectory, entry.name, {**arguments, key: wanted})
        if result.status == "holds":
            margins.append((result.unit, result.margin))
        else:
            break
    same = [margin for unit, margin in margins if unit == margins[0][0]]
    assert all(later <= earlier + 1e-12 for earlier, later in pairwise(same))


@settings(max_examples=40, deadline=None)
@given(height=st.floats(0.2, 20), share=st.floats(0.5, 1.5))
def test_the_margin_changes_sign_exactly_at_what_was_measured(height, share):
    trajectory = falling(height, seconds=0.6)
    drop = measure(trajectory, "falls", {"body": "body", "min_m": 0.1}).measured
    result = measure(trajectory, "falls", {"body": "body", "min_m": drop * share})
    assert (result.status == "holds") == (drop * share <= drop)
    assert result.margin == pytest.approx(drop - drop * share)


@settings(max_examples=30, deadline=None)
@given(speed=st.floats(0.8, 4), friction=st.floats(0.1, 0.9), height=st.floats(0.3, 3), bounce=st.floats(0.3, 0.95))
def test_laws_are_measured_whatever_the_numbers(speed, friction, height, bounce):
    seconds = min(speed / (friction * 9.80665) + 0.3, 6)
    slide = measure(
        sliding(speed, friction * 9.80665, seconds=seconds),
        "slides_and_stops",
        {"body": "body", "friction": friction, "tolerance": 0.05, "max_speed_m_s": 0.02},
    )
    assert slide.status == "holds", slide.message
    impact = measure(
        bouncing(height, bounce),
        "rebounds",
        {"bodies": ["ball", "ground"], "restitution": bounce, "tolerance": 0.03},
    )
    assert impact.status == "holds", impact.message


def test_known_answers():
    assert measure(falling(seconds=0.5), "falls", {"body": "body", "min_m": 1}).measured == pytest.approx(
        9.81 / 8, rel=1e-3
    )
    assert measure(falling(seconds=0.5), "reaches_speed", {"body": "body", "min_m_s": 1}).measured == pytest.approx(
        4.905, rel=1e-3
    )
    weight = measure(resting(), "supported_by", {"body": "body", "support": "ground"})
    assert weight.measured == pytest.approx(1.0, rel=1e-2)


def test_a_bounce_is_as_high_as_the_restitution_says():
    result = measure(bouncing(1.0, 0.8), "bounces", {"body": "ball", "min_count": 3, "decays": True})
    assert "up to 0.639" in result.message  # e^2 = 0.64, sampled every millisecond


def test_unknown_names_and_arguments_list_the_known():
    unknown = measure(resting(), "jumps", {"body": "body"})
    assert unknown.status == "unknown"
    assert "stays" in unknown.message
    wrong = measure(resting(), "stays", {"body": "body", "max": 1})
    assert wrong.status == "unknown"
    assert "max_m" in wrong.message
    nobody = measure(resting(), "stays", {"body": "nobody", "max_m": 1})
    assert nobody.status == "unknown"
    assert "body" in nobody.message


@pytest.mark.parametrize(
    ("name", "arguments", "said"),
    [
        ("stays", {"body": "b", "max_m": float("nan")}, "finite"),
        ("stays", {"body": "b", "max_m": 1, "window_s": [2, 1]}, "write [start, end]"),
        ("reaches", {"body": "b", "tolerance_m": 1}, "exactly one of place, other"),
        ("touches", {"bodies": ["a", "a"]}, "two different bodies"),
        ("has_period", {"body": "b", "period_s": 1, "pendulum_m": 1}, "exactly one of period_s"),
        ("stays_within", {"body": "b", "low": [0, 0, 1], "high": [1, 1, 0]}, "`low` must be below `high`"),
        (
            "happens_before",
            {"first": {"stays": {"body": "b", "max_m": 1}}, "then": {}},
            "`stays` is no event; events: ",
        ),
        ("happens_at", {"event": {"falls": {"body": "b"}}, "at_s": 1, "tolerance_s": 1}, "`falls`: min_m"),
        ("happens_at", {"event": {}, "at_s": 1, "tolerance_s": 1}, "an event is one name with its arguments"),
        ("scales_with", {"bodies": ["a", "b"], "of": "path", "exponent": 1}, "give `with` or `values`"),
        ("spring_becomes_kinetic", {"body": "b", "stiffness_n_m": 3}, "give both"),
    ],
)
def test_arguments_are_refused_before_anything_runs(name, arguments, said):
    problem = argument_problem(name, arguments)
    assert problem and said in problem[0], problem
    assert "its arguments: " in problem[1]


def test_what_a_recording_cannot_answer_is_unknown_with_a_way_on():
    foreign = replace(falling(seconds=0.5), contacts=None, mechanics=replace(falling().mechanics, mass=None))
    for name, arguments, said in (
        ("touches", {"bodies": ["body", "ground"]}, "no contacts were recorded"),
        ("conserves", {"body": "body", "quantity": "energy", "tolerance": 1}, "does not tell masses"),
        ("breaks", {"constraint": "bolt"}, "there is no constraint 'bolt'"),
        ("bends", {"joint": "knee", "min_deg": 5}, "there is no joint 'knee'"),
        ("spreads", {"parts": "sand_*", "min_ratio": 2}, "no body is called 'sand_*'"),
        ("moves", {"body": "ground", "min_m": 1}, "the world itself"),
        ("falls", {"body": "body", "min_m": 0.1, "window_s": [3, 4]}, "the recording goes from 0.000 to 0.500 s"),
    ):
        result = measure(foreign, name, arguments)
        assert result.status == "unknown" and said in result.message, result.message


def test_a_recording_that_is_not_finite_neither_proves_nor_refutes():
    broken = falling(seconds=0.5)
    broken.pos[100:] = np.nan
    result = measure(broken, "falls", {"body": "body", "min_m": 0.1})
    assert result.status == "unknown" and "not finite" in result.message


@pytest.mark.parametrize(
    ("expect", "visual_only", "status"),
    [
        ([{"stays": {"body": "body", "max_m": 0.1}}], None, "proved"),
        ([{"stays": {"body": "body", "max_m": 0.1}}, {"moves": {"body": "body", "min_m": 1}}], None, "refuted"),
        ([{"stays": {"body": "body", "max_m": 0.1}}, {"jumps": {"body": "body"}}], None, "unproved"),
        ([{"stays": {"body": "body", "max_m": 0.1, "window_s": [0, 9]}}], None, "unproved"),
        ([], "it is a matter of taste", "visual_only"),
        ([], None, "unproved"),
    ],
)
def test_an_objective_ends_up_in_one_of_four_states(expect, visual_only, status):
    objective = Objective.model_validate({"claim": "c", "expect": expect, "visual_only": visual_only})
    result = _objective(resting(), 0, objective)
    assert result.status == status
    assert result.reason or status == "proved"


def degenerate(t):
    """Recordings that a formula may stumble over."""
    zero = np.zeros_like
    yield replace(t, pos=np.repeat(t.pos[:1], len(t.t), 0), linvel=zero(t.linvel), angvel=zero(t.angvel))
    yield replace(t, pos=zero(t.pos), linvel=zero(t.linvel), angvel=zero(t.angvel))
    yield replace(t, pos=np.where(np.arange(len(t.t))[:, None, None] > 3, np.nan, t.pos))
    yield replace(t, pos=t.pos * 1e200, linvel=t.linvel * 1e200)
    yield replace(t, quat=zero(t.quat))
    yield replace(t, contacts=None, mechanics=type(t.mechanics)(), meta={}, loads=None, coordinates=None, energy=None)
    yield replace(t, mechanics=replace(t.mechanics, gravity=np.zeros(3), mass=np.zeros(len(t.names))))
    noise = np.random.default_rng(0).normal(size=(3, *t.pos.shape))
    yield replace(t, pos=noise[0], linvel=noise[1], angvel=noise[2])


@pytest.mark.parametrize("entry", EXPECTATIONS.values(), ids=lambda e: e.name)
def test_nothing_recorded_ends_in_a_traceback_and_nan_proves_nothing(entry):
    maker, arguments = entry.GOOD[0]
    for k, recorded in enumerate(degenerate(maker())):
        result = measure(recorded, entry.name, arguments)
        assert "the expectation itself failed" not in result.message, (k, result.message)
        assert result.status != "holds" or recorded.finite
        assert type(result).model_validate_json(result.model_dump_json()).status == result.status


@settings(max_examples=60, deadline=None)
@given(
    name=st.sampled_from(sorted(e.name for e in EXPECTATIONS.values())),
    arguments=st.recursive(
        st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
        lambda inner: (
            st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6) | st.integers(), inner, max_size=3)
        ),
        max_leaves=6,
    ),
)
def test_whatever_a_plan_says_is_told_not_raised(name, arguments):
    problem = argument_problem(name, arguments)
    assert problem is None or all(problem)
    objective = Objective(claim="c", expect=({name: arguments},))
    assert _objective(resting(), 0, objective).status in ("proved", "refuted", "unproved")


def test_events_of_events_are_refused():
    inner = {"happens_at": {"event": {"falls": {"body": "b", "min_m": 1}}, "at_s": 1, "tolerance_s": 1}}
    problem = argument_problem("happens_at", {"event": inner, "at_s": 1, "tolerance_s": 1})
    assert problem and "made of events itself" in problem[0]


@pytest.mark.parametrize(
    ("row", "duration", "status"),
    [
        ({"stays": {"body": "body", "max_m": 0.1}}, 2.0, "proved"),
        ({"stays": {"body": "body", "max_m": 0.1}}, 5.0, "unproved"),
        ({"stays": {"body": "body", "max_m": 0.1, "window_s": [0, 1]}}, 5.0, "proved"),
        ({"touches": {"bodies": ["body", "ground"]}}, 5.0, "proved"),
    ],
)
def test_a_state_that_lasts_is_not_proved_by_a_recording_that_was_cut_off(row, duration, status):
    objective = Objective(claim="c", expect=(row,))
    result = _objective(resting(), 0, objective, duration)
    assert result.status == status
    assert status == "proved" or "the recording ends at 2.000 s, the claim speaks of 5 s" in result.reason


def test_a_claim_about_a_picture_waits_until_the_stills_are_drawn():
    light = {"light": {"camera": "camera", "of": "brightness", "place": [-0.5, -0.5, 0], "min_share": 0.5}}
    objective = Objective.model_validate({"claim": "The ground is bright.", "expect": [light]})
    drawn = from_above()
    assert _objective(drawn, 0, objective).status == "proved"
    blind = _objective(replace(drawn, stills=None), 0, objective)
    assert blind.status == "unproved" and blind.waits and "stage start" in blind.reason
    both = Objective.model_validate({"claim": "…", "expect": [light, {"moves": {"body": "body", "min_m": 1}}]})
    assert not _objective(replace(drawn, stills=None), 0, both).waits  # the rest of it is wrong already
    away = {"light": {**light["light"], "place": [9, 9, 0]}}
    unseen = _objective(drawn, 0, Objective.model_validate({"claim": "…", "expect": [away]}))
    assert unseen.status == "unproved" and not unseen.waits


@pytest.mark.parametrize(
    ("trajectory", "name", "arguments", "time_s"),
    [
        (thrown((0, 0, 3.0)), "rises", {"body": "body", "min_m": 0.2}, 0.0767),  # 3 t - g t^2 / 2 = 0.2
        (sliding(1.0, seconds=2.0), "crosses", {"body": "body", "axis": "x", "at_m": 1.5}, 1.5),
    ],
)
def test_what_rises_or_crosses_says_when(trajectory, name, arguments, time_s):
    result = measure(trajectory, name, arguments)
    assert result.status == "holds"
    told = float(re.search(r"(?:at|by [0-9.]+ m at) ([0-9.]+) s", result.message)[1])
    assert told == pytest.approx(time_s, abs=1.5 * trajectory.interval_s + 1e-3)


def test_what_holds_as_its_window_opens_has_no_moment_and_what_comes_later_has():
    trajectory = sliding(1.0, seconds=2.0)
    past = {"body": "body", "low": [0.4, None, None], "high": [None] * 3, "window_s": [0.5, 2.0]}
    assert measure(trajectory, "stays_within", past).status == "holds"
    assert event_s(trajectory, "stays_within", past) is None
    crossing = {"body": "body", "axis": "x", "at_m": 1.5, "window_s": [0.5, 2.0]}
    assert event_s(trajectory, "crosses", crossing) == pytest.approx(1.5, abs=2 * trajectory.interval_s)


def blow(rows, impulse, interval_s=0.002):
    """A ground that pushes a body up evenly over so many rows."""
    still = resting(seconds=1.0)
    t = np.arange(len(still.t)) * interval_s
    force = np.zeros_like(still.contacts.force)
    struck = (still.contacts.row >= 10) & (still.contacts.row < 10 + rows)
    force[struck, 2] = impulse / (struck.sum() * interval_s)
    return replace(still, t=t, contacts=replace(still.contacts, force=force))


@pytest.mark.parametrize(
    ("rows", "least", "status"),
    [
        (5, 4.7, "unknown"),
        (5, 4.2, "holds"),
        (5, 5.2, "unknown"),
        (5, 5.6, "fails"),
        (20, 4.85, "holds"),
        (60, 4.99, "holds"),
    ],
)
def test_an_impulse_within_its_uncertainty_of_a_bound_is_not_decided(rows, least, status):
    found = measure(blow(rows, 5.0), "receives_impulse", {"body": "body", "other": "ground", "min_n_s": least})
    assert found.status == status, found.message
    if status == "unknown":  # a step that makes the uncertainty as small as what is between the two
        finer = float(re.search(r"rows of ([0-9.e-]+) s would decide", found.message)[1])
        assert finer == pytest.approx(0.002 * rows * abs(least - 5.0) / (0.4 * 5.0), rel=0.15)
