"""A finding blocks when a claim rests on it or a viewer can see it; else it is a remark that says so."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from worldwright.model.finding import Anomaly
from worldwright.model.plan.committed import Objective, Plan, RecordingMode
from worldwright.model.plan.implementation_steps import CameraRow, Step
from worldwright.model.recording.linkage import Rope
from worldwright.model.recording.mechanics import Mechanics
from worldwright.model.recording.records import Contacts
from worldwright.model.recording.stills import Lens
from worldwright.model.recording.trajectory import Trajectory
from worldwright.scan.anomalies import engine
from worldwright.scan.anomalies.relevance import weighed
from worldwright.scan.known import analytic


def scene(touching_row: int | None = None) -> Trajectory:
    """A body that falls, and a leaf that falls two metres beside it; they touch in one row, or never."""
    fall = analytic.falling(seconds=0.8)
    beside = fall.pos + np.array([2.0, 0.0, 0.0])
    pair = {name: np.repeat(getattr(fall, name), 2, axis=1) for name in ("quat", "linvel", "angvel")}
    rows = np.array([] if touching_row is None else [touching_row], int)
    none = np.zeros(len(rows))
    touch = Contacts(
        row=rows, body1=np.zeros(len(rows), int), body2=np.ones(len(rows), int), depth_m=none, normal_force=none
    )
    aside = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # x to the right, z up, it looks along +y
    lens = Lens(np.array([1.0, -9.0, 3.0]), aside, 40.0, (16, 16))
    return replace(
        fall, names=("body", "leaf"), cameras={"side": lens}, pos=np.concatenate((fall.pos, beside), axis=1), contacts=touch,
        contact_force_sum=None, mechanics=type(fall.mechanics)(), **pair,
    )  # fmt: skip


def plan(*expect: dict[str, object]) -> Plan:
    camera = CameraRow(name="side", subjects=("body", "leaf"))
    return Plan.model_construct(
        objectives=(Objective(claim="It falls.", expect=expect),),
        implementation_steps=(Step(description="all", cameras=(camera,)),),
        recording_mode=RecordingMode(size=(640, 360), fps=24),
        scene_objects=(), assets=(), geometry_relations=(), topology=Plan.model_fields["topology"].default,
    )  # fmt: skip


FALLS = {"falls": {"body": "body", "min_m": 0.5}}
STAYS = {"never_faster_than": {"body": "body", "max_mps": 50}}


def found(body: str, metres: float, start: float = 0.1, end: float = 0.7) -> Anomaly:
    return Anomaly(
        code="WS110", name="deep_penetration", severity="blocking", body=body, window_s=(start, end), measured=metres,
        threshold=0.001, unit="m", message="it sinks in",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("anomaly", "expect", "row", "severity", "why"),
    [
        (found("body", 0.001), FALLS, None, "blocking", "objective 0 rests on it"),
        (found("leaf and world", 0.001), FALLS, None, "info", "no claim rests on it and no planned picture shows it"),
        (found("leaf", 0.5), FALLS, None, "blocking", "pixels in camera side"),
        (found("leaf", 0.5, 0.3, 0.31), FALLS, None, "blocking", "pixels in camera side"),
        (found("leaf", 0.5, 0.8, 0.8), FALLS, None, "blocking", "pixels in camera side"),
        (found("leaf", 0.001, 0.3, 0.3), FALLS, None, "info", "no planned picture"),
        (found("leaf", 0.001), FALLS, 100, "blocking", "objective 0 rests on it"),
        (found("leaf", 0.5, 0.3, 0.3), FALLS, None, "blocking", "pixels in camera side"),
        (found("leaf", 0.5, 0.1, 0.3), FALLS, None, "blocking", "camera side, frame 3 (0.1"),
        (found("body and leaf", 0.001), STAYS, None, "blocking", "objective 0 rests on it"),
        (found("leaf", 0.001), FALLS, 390, "info", "no claim rests on it"),
        (found("body", 0.001, 0.6, 0.7), FALLS, None, "info", "no claim rests on it"),
        (found("body", 0.001, 0.6, 0.7), STAYS, None, "blocking", "objective 0 rests on it"),
        (found("world", 0.001), FALLS, None, "blocking", "it sinks in"),
    ],
)
def test_what_blocks_says_why_it_matters(anomaly, expect, row, severity, why):
    (said,) = weighed([anomaly], scene(row), plan(expect))
    assert said.severity == severity and why in said.message, said


def test_what_does_not_block_is_left_alone():
    quiet = found("leaf", 0.001).model_copy(update={"severity": "warn"})
    assert list(weighed([quiet], scene(), plan(FALLS))) == [quiet]


def test_what_is_outside_of_every_picture_is_a_remark_and_a_joint_passes_a_claim_on():
    away = scene()
    away = replace(away, pos=away.pos + np.array([[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]]))
    (said,) = weighed([found("leaf", 0.5)], away, plan(FALLS))
    assert said.severity == "info"
    behind = replace(away, pos=scene().pos + np.array([[0.0, 0.0, 0.0], [0.0, -20.0, 0.0]]))
    (said,) = weighed([found("leaf", 0.5)], behind, plan(FALLS))
    assert said.severity == "info"
    hung = replace(away, mechanics=replace(away.mechanics, parent=np.array([-1, 0])))
    (said,) = weighed([found("leaf", 0.5)], hung, plan(FALLS))
    assert said.severity == "blocking" and "objective 0" in said.message


def test_without_the_place_of_a_camera_everything_may_be_seen():
    (said,) = weighed([found("leaf", 0.001)], replace(scene(), cameras=None), plan(FALLS))
    assert said.severity == "blocking" and "may be seen" in said.message


def test_a_camera_that_follows_is_taken_along():
    lens = scene().cameras["side"]
    follows = replace(lens, follows=("leaf",), along=np.array([True, True, True]), away=np.array([0.0, -1.0, 0.0]))
    far = replace(scene(), pos=scene().pos + np.array([[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]]), cameras={"side": follows})
    (said,) = weighed([found("leaf", 0.5)], far, plan(FALLS))
    assert said.severity == "blocking" and "in camera side" in said.message


def test_staging_is_never_a_remark():
    assert not [entry.name for entry in engine.CHECKS.values() if entry.RELATIVE and entry.STAGING]


@pytest.mark.parametrize(
    ("kind", "extent_m", "seen"),
    [("box", 0.5, False), ("plane", 0.5, True), ("plane", None, True), ("plane", 0.001, False)],
)
def test_a_body_without_an_end_fills_the_picture_and_a_fault_on_it_has_its_size(kind, extent_m, seen):
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody><body name='leaf'><geom type='{kind}' size='1 1 0.1'/></body></worldbody></mujoco>"
    )
    geom = {"name": "flat", "body": "leaf", "type": kind, "aabb": model.geom_aabb[0].tolist(), "pos": [0, 0, 0]}
    leaf = {"name": "leaf", "parent": -1, "joints": []}
    meta = {"bodies": [{**leaf, "name": "body"}, leaf], "geoms": [{**geom, "quat": [1, 0, 0, 0]}]}
    flat = replace(scene(), mechanics=Mechanics.from_meta(meta, ("body", "leaf")))
    assert not np.isinf(flat.mechanics.half_extents).any(), "a body's box tells nothing of it"
    flat = replace(flat, pos=0.0 * flat.pos + np.array([[0.0, 0.0, 0.0], [90.0, 0.0, 0.0]]))
    anomaly = found("leaf", 0.5).model_copy(update={"unit": "rad", "extent_m": extent_m})
    (said,) = weighed([anomaly], flat, plan({"falls": {"body": "nobody", "min_m": 0.5}}))
    assert ("pixels in camera side" in said.message) == seen == (said.severity == "blocking"), said.message


def test_a_body_that_turns_in_place_passes_a_claim_on():
    turns = scene(10)
    still = np.zeros_like(turns.pos)
    angle = 0.5 * turns.t
    quat = np.zeros_like(turns.quat)
    quat[..., 0] = 1.0
    quat[:, 0, 0], quat[:, 0, 3] = np.cos(angle), np.sin(angle)
    away = replace(turns, pos=still + np.array([[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]]), quat=quat)
    away = replace(away, mechanics=replace(away.mechanics, dynamic=np.array([False, True])))
    (said,) = weighed([found("leaf", 0.5)], away, plan(STAYS))
    assert said.severity == "blocking" and "objective 0" in said.message


def test_a_rope_that_stretches_shows_at_any_end():
    away = scene()
    away = replace(away, pos=away.pos + np.array([[0.0, 0.0, 0.0], [40.0, 0.0, 0.0]]))
    rope = Rope("line", (0, 1), np.zeros((2, 3)), 1.0)
    stretched = found("leaf", 0.5).model_copy(update={"name": "tendon_limit", "message": "line stretches 0.5 m"})
    claims_other = plan({"falls": {"body": "nobody", "min_m": 0.5}})
    (said,) = weighed([stretched], away, claims_other)
    assert said.severity == "info"
    (said,) = weighed([stretched], replace(away, mechanics=replace(away.mechanics, ropes=(rope,))), claims_other)
    assert said.severity == "blocking" and "in camera side" in said.message
