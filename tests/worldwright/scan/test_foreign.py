"""Foreign recordings as they come: names that the model does not have, clocks that are broken, one row, nothing at all."""

import json
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.scan.anomalies import engine
from worldwright.scan.known import modelled
from worldwright.scan.predicting.joint_coordinates import fitted

ARRAYS = ("t", "pos", "quat", "linvel", "angvel", "contact_force_sum", "ncon", "max_penetration")
SCENE = modelled.scene(
    '<body name="arm" pos="0 0 1.5"><joint axis="0 1 0"/><joint axis="1 0 0"/>'
    '<geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.03"/><body name="hand" pos="0.4 0 0"><joint type="ball"/>'
    '<geom size="0.06" pos="0.1 0.02 0"/></body></body>',
    modelled.box("crate", "1 0 0.4"),
    modelled.box("lift", "-1 0 0.5", body='gravcomp="1"'),
)


def stored(folder, *, names=None, xml=SCENE, extra=0, **changed):
    """A recording of the scene as npz with its MJCF beside it; `extra` repeats the last body that often."""
    made = modelled.run(SCENE, 0.6)
    arrays = {key: getattr(made, key) for key in ARRAYS} | changed
    for key in ("pos", "quat", "linvel", "angvel", "contact_force_sum"):
        arrays[key] = np.concatenate([arrays[key]] + [arrays[key][:, -1:]] * extra, axis=1)
    path = folder / "scene.npz"
    np.savez(path, names=np.array(names or made.names), **arrays)
    if xml:
        path.with_suffix(".xml").write_text(xml, encoding="utf-8")
    return path


@pytest.mark.parametrize("more", [["world"], ["camera_rig"], ["world", "marker"]])
def test_names_that_the_model_does_not_have_cost_only_their_own_facts(tmp_path, more):
    plain = engine.scan(read_trajectory(stored(tmp_path, names=["arm", "hand", "crate", "lift"])))
    names = ["arm", "hand", "crate", "lift", *more]
    trajectory = read_trajectory(stored(tmp_path, names=names, extra=len(more)))
    assert trajectory.mechanics.unmatched == tuple(more)
    assert trajectory.mechanics.mass[:4] == pytest.approx(read_trajectory(stored(tmp_path)).mechanics.mass)
    report = engine.scan(trajectory)
    ran = {c.name for c in report.checks if c.status != "skipped"}
    assert ran == {c.name for c in plain.checks if c.status != "skipped"}
    told = {(a.name, a.body) for a in report.anomalies if a.body not in more and a.name != "unmatched_name"}
    assert told == {(a.name, a.body) for a in plain.anomalies}
    assert {a.body for a in report.anomalies if a.name == "unmatched_name"} == set(more) - {"world"}


def test_what_the_joints_say_is_what_the_engine_had(tmp_path):
    trajectory = read_trajectory(stored(tmp_path))
    found = fitted(trajectory)
    assert found.gap_m.max() < 1e-9 and found.gap_rad.max() < 1e-7 and found.slip.max() < 1e-9


@pytest.mark.parametrize(
    "times",
    [
        lambda t: np.where(np.arange(len(t)) == 3, t, np.nan),
        lambda t: np.where(np.arange(len(t)) % 2, t, np.nan),
        lambda t: np.where(np.arange(len(t)) > 5, np.inf, t),
        lambda t: t[::-1].copy(),
        lambda t: np.where(np.arange(len(t)) > 30, t - 0.2, t),
    ],
)
@pytest.mark.parametrize("xml", [SCENE, ""])
def test_no_check_fails_on_a_broken_clock(tmp_path, times, xml):
    made = modelled.run(SCENE, 0.6)
    report = engine.scan(read_trajectory(stored(tmp_path, xml=xml, t=times(made.t))))
    assert not [c for c in report.checks if "the check itself failed" in c.reason]


@pytest.mark.parametrize("rows", [1, 2, 3])
def test_no_check_fails_on_a_few_rows(tmp_path, rows):
    made = modelled.run(SCENE, 0.6)
    few = {key: getattr(made, key)[:rows] for key in ARRAYS}
    report = engine.scan(read_trajectory(stored(tmp_path, **few)))
    assert not [c for c in report.checks if "the check itself failed" in c.reason]


def test_json_tells_what_was_skipped(tmp_path, capsys):
    from worldwright import cli

    path = stored(tmp_path, xml="")
    with pytest.raises(SystemExit):
        cli.main(["scan", "scan", str(path), "--format", "json"])
    told = json.loads(capsys.readouterr().out)
    skipped = {row["name"] for row in told["skipped"]}
    assert "flight_force" in skipped and all(row["reason"] for row in told["skipped"])


CHANNELS = (*ARRAYS[1:], "energy")
VALUES = st.sampled_from((np.nan, np.inf, -np.inf, 0.0, -1.0, 1e9, -1e9))
PLACES = st.sampled_from(("all", "first row", "last row", "head", "tail", "first column", "one"))


def spoiled(values, place, value):
    """The array with `value` written where `place` says."""
    made = np.array(values, dtype=float)
    half = len(made) // 2
    parts = {"first row": made[:1], "last row": made[-1:], "head": made[:half], "tail": made[half:], "all": made}
    part = parts | {"first column": made[:, :1] if made.ndim > 1 else made, "one": made.reshape(-1)[half : half + 1]}
    part[place][...] = value
    return made


@settings(max_examples=25, deadline=None, derandomize=True)
@given(
    st.dictionaries(st.sampled_from(CHANNELS), st.tuples(PLACES, VALUES), min_size=1, max_size=4),
    st.sampled_from((SCENE, "")),
)
@example({"max_penetration": ("all", np.nan)}, SCENE)
@example({"max_penetration": ("tail", np.nan)}, "")
@example({"quat": ("all", np.nan)}, SCENE)
@example({"quat": ("first row", np.inf)}, SCENE)
def test_no_check_fails_whatever_the_arrays_hold(broken, xml):
    made = modelled.run(SCENE, 0.6)
    whole = {key: getattr(made, key) for key in ARRAYS} | {"energy": np.zeros((len(made.t), 2))}
    arrays = {key: spoiled(whole[key], *how) for key, how in broken.items()}
    with tempfile.TemporaryDirectory() as folder:
        report = engine.scan(read_trajectory(stored(Path(folder), xml=xml, **arrays)))
    assert not [c for c in report.checks if "the check itself failed" in c.reason]
    if any(
        place in ("all", "first row") and not np.isfinite(v) and key in CHANNELS[:4]
        for key, (place, v) in broken.items()
    ):
        assert {c.status for c in report.checks if not engine.CHECKS[c.code].UNCUT} == {"skipped"}


def test_a_depth_that_some_rows_do_not_tell_is_judged_by_the_others(tmp_path):
    made = modelled.run(SCENE, 0.6)
    deep = np.where(np.arange(len(made.t)) < 3, np.nan, 0.5)
    (found,) = [
        a for a in engine.scan(read_trajectory(stored(tmp_path, max_penetration=deep))).anomalies if a.code == "WS110"
    ]
    assert found.severity == "blocking" and found.window_s[0] == pytest.approx(made.t[3])
