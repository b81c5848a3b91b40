"""A vehicle is one row of a plan, and drafted whole: its numbers, its driver, the controls that it declares, its rolling wheels."""

import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest
from pydantic import ValidationError

from worldkit.beside_program import below
from worldwright.draft import draft
from worldwright.lint.compiled.fetch import Outcome
from worldwright.lint.compiled.measure import facts
from worldwright.lint.compiled.view import ModelView
from worldwright.lint.rules.model import overlaps_at_start
from worldwright.lint.rules.model.acting import touchable_shape_differs
from worldwright.lint.tools import check_plan
from worldwright.model.errors import PlanError
from worldwright.model.plan.committed import AssetRow, Plan, Position, PredicateRow
from worldwright.model.plan.imported import all_of, contents, road_box
from worldwright.model.plan.plan_references import reference_problems
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.plan.vehicle_rows import Vehicle, rolling
from worldwright.place.engine import resolve
from worldwright.scan.anomalies.checks import moves_unexpectedly
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.known import analytic
from worldwright.stamp.gates.auto_approve import _chosen

DRIVEN = Path(__file__).parents[1] / "world" / "driven_car_plan.md"
BRAKES = [{"t": 0, "throttle": 0.2}, {"t": 0.5, "throttle": 0, "brake": 1.0, "over_s": 0.1}]


def plan(vehicle: dict, launch: tuple = (10.0, 0.0, 0.0), **row: object) -> Plan:
    made = {"name": "car", "type": "vehicle", "vehicle": vehicle, **row}
    return Plan.model_validate(
        {
            "title": "A car",
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": 0.002,
                "simulation_duration": 1.0,
                "materials": {"ground": {"friction": 0.9, "source": "handbook"}},
                "initial_motion": {"car": {"linear": launch}},
            },
            "objectives": [{"claim": "It drives."}],
            "implementation_steps": [{"description": "x", "cameras": ["perspective"], "motion_expectations": ["car"]}],
            "assets": [made],
            "topology": {"body_positions": {"car": {"x": 1.0, "y": 2.0, "z": 0.725}}},
        }
    )


def built(made: Plan, bare: bool = True) -> tuple[str, dict, mujoco.MjModel, mujoco.MjData]:
    """A draft's text and names, its world without paint, and that at the start."""
    drafted = draft(made, resolve(made).scene)
    assert drafted.complete, drafted.open_places
    space: dict = {"__name__": "drafted"}
    text = re.sub(r'(_VEHICLE,\s+name="\w+",\s)', r"\1look=None, ", drafted.source) if bare else drafted.source
    exec(compile(text, "drafted", "exec"), space)
    model = space["build"]().compile()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("start").id)
    mujoco.mj_forward(model, data)
    return drafted.source, space, model, data


def test_a_row_is_a_car_with_its_driver_and_nothing_is_left_to_an_author():
    made = plan({"kind": "car", "inputs": BRAKES})
    source, space, model, data = built(made)
    assert "vehicles.Timed(" in source and "vehicles.pedals(CAR_VEHICLE" in source
    assert data.body("car").xpos[:2] == pytest.approx((1, 2)) and data.joint("car").qvel[0] == 10
    assert data.joint("car_fl_axle").qvel[0] == pytest.approx(10 / 0.31)
    while data.time < 1.0:
        space["control"](model, data)
        mujoco.mj_step(model, data)
    assert data.qvel[0] < 10 - 0.35 * 0.9 * 9.81  # it brakes from the middle on


def test_what_a_plan_knows_of_its_parts_is_what_the_world_has():
    made = plan({"kind": "car", "inputs": BRAKES})
    _, _, model, _ = built(made)
    ((_, _, facts),) = all_of(made)
    assert set(facts.bodies) == {model.body(b).name for b in range(1, model.nbody)}
    assert set(facts.joints) == {model.joint(j).name for j in range(model.njnt)}
    assert set(facts.actuators) == {model.actuator(a).name for a in range(model.nu)}
    assert facts.mass_kg == pytest.approx(model.body_subtreemass[model.body("car").id])


def test_a_driven_car_declares_its_controls_and_rolls_from_the_start():
    made = plan({"kind": "car", "inputs": BRAKES}).simulation_parameters
    (control,) = made.interventions
    assert control.kind == "control" and {"car_drive", "car_steer_fl", "car_brake_rr"} <= {*control.bodies}
    assert made.initial_motion["car_rl_axle"].joint_velocity == pytest.approx(10 / 0.31)
    still = plan({"kind": "car"}, launch=(0, 0, 0)).simulation_parameters
    assert still.interventions == () and set(still.initial_motion) == {"car"}
    again = Plan.model_validate(plan({"kind": "car", "inputs": BRAKES}).model_dump())
    assert len(again.simulation_parameters.interventions) == 1


def test_wheels_go_where_their_car_is_expected_to_go():
    wheel = replace(analytic.falling(), names=("car_fl_wheel",))
    made = plan({"kind": "car"})
    assert list(moves_unexpectedly.check(wheel, Context(planned=True, movers=("car",), plan=made))) == []
    assert list(moves_unexpectedly.check(wheel, Context(planned=True, movers=("lamp",), plan=made)))
    stranger = replace(wheel, names=("car_crate",))
    assert list(moves_unexpectedly.check(stranger, Context(planned=True, movers=("car",), plan=made)))


def test_wheels_roll_the_way_the_car_goes_and_those_of_all_it_draws():
    assert rolling(plan({"kind": "car"}, launch=(-10.0, 0.0, 0.0)))["car_fl_axle"] == pytest.approx(-10 / 0.31)
    assert rolling(plan({"kind": "car"}, launch=(0.0, 10.0, 0.0))) == {}
    made = plan({"kind": "car"})
    turned = PredicateRow(subject="car", predicate="ON", object="base", orientation={"deg_z": 180.0})
    topology = made.topology.model_copy(update={"scene_predicates": (turned,)})
    assert rolling(made.model_copy(update={"topology": topology}))["car_fl_axle"] == pytest.approx(-10 / 0.31)
    vans = tuple(
        made.assets[0].model_copy(update={"name": name, "vehicle": Vehicle(kind="trailer")}) for name in ("van", "last")
    )
    hung = tuple(SimpleNamespace(type="ball", parent=a, child=b) for a, b in (("car", "van"), ("van", "last")))
    drawn = made.model_copy(
        update={"assets": (*made.assets, *vans), "topology": made.topology.model_copy(update={"joints": hung})}
    )
    assert rolling(drawn)["last_rl_axle"] == pytest.approx(10 / 0.31)


def test_whole_numbers_stay_whole():
    made = plan({"kind": "tracked", "numbers": {"road_wheels": 4}, "source": "x"})
    assert made.assets[0].vehicle.made().corners[-1] == "4r"


def test_what_a_driver_does_and_which_way_he_takes_was_chosen_by_somebody():
    follows = plan({"kind": "car", "follows": {"path": [[0, 0], [9, 0]], "speed_m_s": 5}})
    assert dict(_chosen(follows))["assets.car.vehicle.follows.speed_m_s"] == [5.0]
    assert "assets.car.vehicle.follows.across_m_s2" not in dict(_chosen(follows))
    assert dict(_chosen(follows))["assets.car.vehicle.follows.path"] == [0, 0, 9, 0]
    assert "assets.car.vehicle.follows.closed" not in dict(_chosen(follows))
    ring = {"path": [[0, 0], [9, 0], [9, 9]], "closed": True, "speed_m_s": 5}
    assert "assets.car.vehicle.follows.closed" in dict(_chosen(plan({"kind": "car", "follows": ring})))
    assert dict(_chosen(plan({"kind": "car", "inputs": BRAKES})))["assets.car.vehicle.inputs.0.throttle"] == [0.2]


def test_a_change_at_the_start_holds_at_once_and_leaves_room_for_the_next():
    made = plan({"kind": "car", "inputs": [{"t": 0, "throttle": 0.2}, {"t": 0.1, "brake": 1.0}]})
    assert [t for t, _ in made.assets[0].vehicle.commands()] == [0, 0.1, 0.3]


def test_the_speed_of_rolling_wheels_is_not_asked_for():
    made = plan({"kind": "car"})
    assert "initial_motion.car" in dict(_chosen(made)) and "initial_motion.car_fl_axle" not in dict(_chosen(made))
    motion = {"initial_motion": {"car": {"linear": [9, 0, 0]}, "car_fl_axle": {"joint_velocity": 3.0}}}
    spun = made.model_copy(update={"simulation_parameters": type(made.simulation_parameters)(
        time_step=0.002, simulation_duration=1.0, **motion)})  # fmt: skip
    assert dict(_chosen(spun))["initial_motion.car_fl_axle"] == [3.0]


def test_what_is_no_vehicle_is_refused_by_name():
    for vehicle, said in (
        ({"kind": "car", "numbers": {"mas_kg": 1500}, "source": "x"}, "did you mean `mass_kg`"),
        ({"kind": "car", "numbers": {"mass_kg": 1500}}, "need a `source`"),
        ({"kind": "car", "numbers": {"mass_kg": 50}, "source": "x"}, "a car of 50"),
        ({"kind": "car", "numbers": {"mass_kg": "heavy"}, "source": "x"}, "cannot be made of these numbers"),
        ({"kind": "hovercraft"}, "kind"),
        ({"kind": "car", "inputs": BRAKES, "follows": {"path": [[0, 0], [9, 0]], "speed_m_s": 5}}, "one driver"),
        ({"kind": "car", "inputs": [BRAKES[1], BRAKES[0]]}, "begins after"),
        ({"kind": "car", "follows": {"path": [[0, 0], [0, 0]], "speed_m_s": 5}}, "in one place"),
        ({"kind": "car", "follows": {"path": [[0, 0], [9, 0]], "speed_m_s": float("nan")}}, "speed_m_s"),
        ({"kind": "car", "follows": {"path": [[0, 0], [9, 0]], "closed": True, "speed_m_s": 5}}, "three of a closed"),
        ({"kind": "truck", "numbers": {"height_m": 1.5}, "source": "x"}, "bed would measure"),
    ):
        with pytest.raises(ValidationError, match=said):
            plan(vehicle)
    with pytest.raises(ValidationError, match="remove `fixed`"):
        plan({"kind": "car"}, fixed=True)
    with pytest.raises(ValidationError, match="reads no file"):
        plan({"kind": "car"}, filename="car.xml")
    made = {"name": "car", "type": "vehicle", "vehicle": {"follows": {"road": "car"}}}
    assert any("road `car`" in p.message for p in reference_problems({"assets": [made]}))


def test_a_plan_with_a_driven_car_stands_and_names_its_parts(tmp_path):
    assert [f for f in check_plan(DRIVEN).findings if f.severity != "info"] == []
    made = read_plan(DRIVEN).plan
    source = draft(made, resolve(made).scene).source
    assert "vehicles.Driver(" in source and "CAR_VEHICLE, vehicles.Course(" in source
    wrong = tmp_path / "plan.md"
    wrong.write_text(DRIVEN.read_text().replace("body: car_rl_wheel", "body: car_rl_weel"))
    (found,) = (f for f in check_plan(wrong).findings if f.severity != "info")
    assert found.code == "WP104" and "car_rl_wheel" in found.fix


@pytest.mark.parametrize("kind", ["truck", "bus", "bicycle", "tracked"])
def test_every_kind_is_drafted_where_its_row_stands(kind):
    made = plan({"kind": kind, "inputs": [{"t": 0, "throttle": 0.1}]}, launch=(2.0, 0, 0))
    height = made.assets[0].vehicle.made().extents[2]
    placed = made.topology.model_copy(update={"body_positions": {"car": Position(x=1.0, y=2.0, z=height / 2)}})
    made = Plan.model_validate({**made.model_dump(), "topology": placed.model_dump()})
    _, space, model, data = built(made)
    ((_, _, facts),) = all_of(made)
    assert set(facts.bodies) == {model.body(b).name for b in range(1, model.nbody)}
    assert set(facts.joints) == {model.joint(j).name for j in range(model.njnt)}
    assert set(facts.actuators) == {model.actuator(a).name for a in range(model.nu)}
    low, high = touched(model, data)
    assert (low + high) / 2 == pytest.approx((1, 2, height / 2), abs=0.003)
    assert high - low == pytest.approx(facts.extents, rel=0.03)
    for _ in range(100):
        space["control"](model, data)
        mujoco.mj_step(model, data)
    assert data.qvel[0] == pytest.approx(2, abs=0.2) and abs(data.qvel[2]) < 0.05


def test_a_trailer_hangs_on_what_draws_it_and_brakes_with_it():
    base = plan({"kind": "car", "inputs": BRAKES}).model_dump(exclude={"simulation_parameters": {"interventions"}})
    hitch = {"name": "hitch", "type": "ball", "parent": "car", "child": "van", "anchor": [-1.4, 2.0, 0.42]}
    van = {"name": "van", "type": "vehicle", "vehicle": {"kind": "trailer"}}
    base["assets"] = [*base["assets"], van]
    base["topology"] |= {
        "joints": [hitch],
        "body_positions": {"car": {"x": 1.0, "y": 2.0, "z": 0.725}, "van": {"x": -3.75, "y": 2.0, "z": 1.0}},
    }
    made = Plan.model_validate(base)
    source, space, model, data = built(made)
    assert [row.law for row in made.simulation_parameters.interventions][1] == "it brakes with car, which draws it"
    assert "brake=asked.brake" in source
    assert data.joint("van_rl_axle").qvel[0] == pytest.approx(10 / 0.31)
    assert np.abs(data.qfrc_constraint).max() < 1e6 and data.body("van").xpos[0] == pytest.approx(-2.9)
    while data.time < 1.0:
        space["control"](model, data)
        mujoco.mj_step(model, data)
    assert data.qvel[0] < 7 and data.body("van").cvel[3] < 7
    assert data.joint("hitch").qpos[0] == pytest.approx(1, abs=0.01)  # straight behind


def touched(model: mujoco.MjModel, data: mujoco.MjData) -> tuple[np.ndarray, np.ndarray]:
    """The box around all that can be touched besides the ground, m."""
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for g in range(model.ngeom):
        if model.geom_bodyid[g] and model.geom_contype[g]:
            half = model.geom_aabb[g, 3:]
            low, high = np.minimum(low, data.geom_xpos[g] - half), np.maximum(high, data.geom_xpos[g] + half)
    return low, high


def on_a_road(tmp_path, **follows):
    """A plan of a car on a bend of 80 m, whose file lies beside it."""
    u = np.arange(161) * 0.5
    rows = np.column_stack(
        [u / 40, np.zeros(161), 0.04 * np.cos(2 * np.pi * u / 80), *(np.zeros(161) for _ in range(3))]
    )
    head = (
        "$ROAD_CRG\nreference_line_end_u = 80\nreference_line_increment = 0.5\n$KD_DEFINITION\n#:KRBI\nU:u,m,0,0.5\n"
        "D:reference line phi,rad\nD:reference line banking,m/m\nD:reference line slope,m/m\n"
    )
    head += "".join(f"D:long section at v = {v},m\n" for v in (-3, 0, 3))
    (tmp_path / "roads").mkdir()
    (tmp_path / "roads" / "bend.crg").write_bytes((head + "$" * 80 + "\n").encode() + rows.astype(">f4").tobytes())
    base = plan(
        {"kind": "car", "follows": {"road": "road", "left_m": -1.0, "speed_m_s": 6, **follows}}, launch=(0, 0, 0)
    )
    data = base.model_dump(exclude={"simulation_parameters": {"interventions"}})
    road = {"name": "road", "type": "road", "filename": "roads/bend.crg", "material": "ground"}
    data["assets"] = [*data["assets"], road]
    low, high = road_box(AssetRow.model_validate(road), tmp_path)
    x, y = ((a + b) / 2 for a, b in zip(low[:2], high[:2], strict=True))
    data["topology"]["body_positions"] |= {
        "car": {"x": 2.0, "y": -0.9, "z": -low[2] + 0.725 + 0.1},
        "road": {"x": x, "y": y, "z": (high[2] - low[2]) / 2},
    }
    return Plan.model_validate(data).read_from(tmp_path)


def test_a_road_is_a_named_input_of_the_plan_and_what_it_drives_on(tmp_path):
    made = on_a_road(tmp_path)
    assert contents(made).keys() == {"roads/bend.crg"}
    with below(tmp_path):
        source, space, model, data = built(made)
        assert 'roads.read("roads/bend.crg")' in source and "left_m=-1.0" in source
        assert data.body("road").xpos == pytest.approx([*made.topology.body_positions["road"].vector], abs=1e-5)
        low = min(data.geom_xpos[g][2] for g in range(model.ngeom) if model.geom(g).name.startswith("road_"))
        assert low > 0.4  # above the ground of the scene
        while data.time < 8.0:
            space["control"](model, data)
            mujoco.mj_step(model, data, nstep=5)
        assert abs(space["CAR_DRIVER"].off_m) < 0.4 and data.qpos[1] > 12


def test_what_starts_in_a_road_is_found_in_the_built_world_alone(tmp_path):
    """The layout takes a road as the box around it, and asks nobody who stands in that."""
    made = on_a_road(tmp_path)
    places = made.topology.body_positions
    deeper = places["car"].model_copy(update={"z": places["car"].z - 0.4})
    sunk = made.topology.model_copy(update={"body_positions": places | {"car": deeper}})
    made = made.model_copy(update={"topology": sunk}).read_from(tmp_path)
    with below(tmp_path):
        model = built(made)[2]
    found = list(overlaps_at_start.check(ModelView(Outcome("compiled", *facts(model)), None, made)))
    assert any(f.message.startswith("road starts 2") and f.message.endswith(" deep in car_fl_wheel") for f in found)


def test_a_road_that_is_built_otherwise_is_found(tmp_path):
    made = on_a_road(tmp_path)
    with below(tmp_path):
        model = built(made)[2]
    there = ModelView(Outcome("compiled", *facts(model)))

    def found() -> list:
        return list(touchable_shape_differs.check(ModelView(Outcome("compiled", *facts(model)), None, made, there)))

    assert found() == []
    tiles = model.geom_type == mujoco.mjtGeom.mjGEOM_HFIELD
    straight = model.geom_quat[tiles].copy()
    model.geom_quat[tiles], model.geom_sameframe[tiles] = (0, 0, 0, 1), 0
    assert "road" in str(found()), "each tile is turned about its middle"
    model.geom_quat[tiles] = straight
    assert found() == []
    model.hfield_data[: model.hfield_ncol[0] * model.hfield_nrow[0]] *= 0.9
    assert "road" in str(found())


def test_a_road_that_is_none_is_told(tmp_path):
    made = on_a_road(tmp_path)
    file = tmp_path / "roads" / "bend.crg"
    file.write_bytes(file.read_bytes()[:-900])
    with pytest.raises(PlanError, match="is cut off"):
        road_box(made.assets[1], tmp_path)
    with pytest.raises(PlanError, match="no file roads/lost"):
        road_box(made.assets[1].model_copy(update={"filename": "roads/lost.crg"}), tmp_path)
    (tmp_path / "roads" / "text.md").write_text("no road")
    for name in (f"../{tmp_path.name}/roads/bend.crg", str(file), "roads/../roads/bend.crg", "roads/text.md"):
        other = made.assets[1].model_copy(update={"filename": name})
        assert contents(made.model_copy(update={"assets": (made.assets[0], other)})) == {}, name
        with pytest.raises(PlanError, match="no file"):
            road_box(other, tmp_path)
    for follows, said in (({"path": [[0, 0], [1, 0]]}, "a `path` of two"), ({"road": ""}, "a `path` of two")):
        with pytest.raises(ValidationError, match=said):
            plan({"kind": "car", "follows": {"road": "road", "speed_m_s": 6, **follows}})
    with pytest.raises(ValidationError, match="a road is one, fixed"):
        Plan.model_validate({**made.model_dump(exclude={"simulation_parameters": {"interventions"}}), "assets": [
            {"name": "road", "type": "road", "filename": "roads/bend.crg", "count": 2}]})  # fmt: skip
