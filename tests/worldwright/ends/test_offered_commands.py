"""A car is offered by its pedals, and in silence it brakes, unless the plan says otherwise; any other control by its own name."""

import pytest

from small_worlds import empty, floor
from worldengine.given import Given
from worldkit import vehicles
from worldwright.ends.live_source import LiveSource
from worldwright.ends.offered_commands import offered
from worldwright.model.errors import GateError
from worldwright.model.plan.declared_inputs import Intervention, Live


@pytest.fixture(scope="module")
def model():
    spec = empty(time_step=0.002)
    floor(spec)
    vehicles.add(spec, vehicles.Car(steering_deg=30.0), name="car", look=None)
    return spec.compile()


@pytest.fixture
def plan(roped):
    return LiveSource.find(roped.run).plan


def of(model, plan, tmp_path, names, live):
    """The commands of a world whose plan declares these controls, by name."""
    row = Intervention(kind="control", bodies=names, law="as the driver does", source="the prompt's driver", live=live)
    said = plan.simulation_parameters.model_copy(update={"interventions": (row,)})
    given = Given(tmp_path, 1.0, 24, (64, 48), (), (), 0, "", 10, 0, (("control", frozenset(names)),))
    found = offered(model, plan.model_copy(update={"simulation_parameters": said}), given, None)
    return {command.name: command for command in found}


@pytest.mark.parametrize(
    ("live", "silent", "ends"),
    [
        (None, ["hold", 0.0, 1.0], float("inf")),
        (Live(failsafe="brake", ends_after_s=9.0), ["hold", 0.0, 1.0], 9.0),
        (Live(failsafe="hold"), ["hold"] * 3, float("inf")),
        (Live(ends_after_s=8.0), ["hold", 0.0, 1.0], 8.0),
    ],
)
def test_a_car_is_driven_by_its_pedals(model, plan, tmp_path, live, silent, ends):
    found = of(model, plan, tmp_path, vehicles.Car().actuators("car"), live)
    assert list(found) == ["car.steering", "car.throttle", "car.brake"]
    assert [row.failsafe for row in found.values()] == silent and {row.ends_after_s for row in found.values()} == {ends}
    bounds = [(row.low, row.high) for row in found.values()]
    assert bounds == [(pytest.approx(-30), pytest.approx(30)), (-1, 1), (0, 1)]


def test_one_number_for_three_pedals_is_refused(model, plan, tmp_path):
    with pytest.raises(GateError, match="three pedals") as refused:
        of(model, plan, tmp_path, vehicles.Car().actuators("car"), Live(failsafe=0.0))
    assert "`brake` or `hold`" in refused.value.next_move


def test_a_row_that_names_no_failsafe_leaves_a_servo_where_it_stands(model, plan, tmp_path):
    found = of(model, plan, tmp_path, vehicles.Car().actuators("car")[:-1], Live(timeout_s=2.0))
    assert found["car_steer_fl"].failsafe == "hold" and found["car_drive"].failsafe == 0.0
    assert {row.timeout_s for row in found.values()} == {2.0}


def test_a_car_of_which_a_brake_is_not_declared_is_offered_control_by_control(model, plan, tmp_path):
    names = vehicles.Car().actuators("car")[:-1]
    found = of(model, plan, tmp_path, names, None)
    assert list(found) == [*names] and found["car_drive"].low == -found["car_drive"].high
    assert (
        found["car_steer_fl"].failsafe == "hold"
        and found["car_drive"].failsafe == found["car_brake_fl"].failsafe == 0.0
    )


def test_any_vehicle_is_driven_by_its_pedals(plan, tmp_path):
    for kind in (vehicles.Truck(), vehicles.Tracked(), vehicles.Bicycle()):
        spec = empty(time_step=0.002)
        floor(spec)
        vehicles.add(spec, kind, name="it", look=None)
        found = of(spec.compile(), plan, tmp_path, kind.actuators("it"), None)
        assert list(found) == ["it.steering", "it.throttle", "it.brake"], kind.word
        assert found["it.steering"].high == pytest.approx(kind.steering_deg)
