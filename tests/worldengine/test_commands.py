"""Commands hold as long as they are repeated; then the failsafe acts, and in the end the drive is over, as planned."""

import json
import math

import mujoco
import numpy as np
import pytest

from small_worlds import empty, floor
from worldengine.inputs.commands import Command, Console, read
from worldkit import vehicles
from worldkit.errors import ProgramError
from worldkit.vehicles.found_cars import find_cars

ROWS = (
    Command("motor", control=0, low=-1, high=1, failsafe=0.0),
    Command("arm", control=1, failsafe="hold", timeout_s=0.5),
    Command("brake", control=2, low=0, high=1, failsafe=1.0, timeout_s=2.0),
)


@pytest.fixture
def wall():
    return [0.0]


@pytest.fixture
def console(wall):
    return Console(ROWS, {}, np.array([0.3, 0.7, 0.0]), lambda: wall[0])


def said(**values):
    return json.dumps({"values": values}).encode()


def test_each_falls_back_in_its_own_time(console, wall):
    assert console.values == {"motor": 0.0, "arm": 0.7, "brake": 1.0}, "before anybody has spoken"
    assert console.hear(said(motor=5.0, arm=-3.0, brake=0.0)) and console.settle()
    assert console.values == {"motor": 1.0, "arm": -3.0, "brake": 0.0} and console.silent == ()
    wall[0] = 1.0
    assert console.settle() and console.silent == ("motor", "arm")
    assert console.values == {"motor": 0.0, "arm": -3.0, "brake": 0.0}
    wall[0] = 3.0
    assert console.settle() and console.values["brake"] == 1.0


def test_who_leaves_is_silent_at_once_and_who_follows_is_heard(console):
    console.hear(said(motor=0.5, brake=0.0))
    assert console.hear(b'{"left": true}') and console.settle()
    assert console.values["motor"] == 0.0 and console.values["brake"] == 1.0
    assert console.hear(b'{"left": true, "values": {"motor": 0.25}}') and console.settle()
    assert console.values["motor"] == 0.25 and console.silent == ("arm", "brake")


@pytest.mark.parametrize(
    "line",
    [b"{", b"[]", b'{"values": 1}', b'{"values": {"motor": NaN}}', b'{"values": {"arm": 1, "motor": Infinity}}',
     b'{"values": {"arm": 1, "wheel": 1}}', b'{"values": {"arm": 1e300}}', b'{"values": {"arm": "1"}}', b'{"values": {"arm": true}}', b"[" * 100_000],
)  # fmt: skip
def test_of_a_message_with_one_bad_number_nothing_is_taken(console, line):
    before = dict(console.values)
    assert not console.hear(line) and console.values == before


def test_silence_ends_the_drive_where_the_plan_says_so_and_not_before_anybody_drove(wall):
    console = Console((Command("motor", control=0, ends_after_s=5.0),), {}, np.zeros(1), lambda: wall[0])
    wall[0] = 100.0
    assert console.settle()
    console.hear(said(motor=0.1))
    console.hear(b'{"left": true}')
    wall[0] = 104.9
    assert console.settle()
    wall[0] = 105.1
    assert not console.settle()


def test_a_list_of_commands_is_read_strictly(tmp_path):
    path = tmp_path / "commands.json"
    path.write_text(json.dumps([row.written() for row in ROWS]))
    assert read(path, 3) == ROWS and math.isinf(read(path, 3)[1].high)
    for rows in (
        [{"name": "x", "control": 3}], [{"name": "x"}], [{"name": "x", "control": 0, "low": 2, "high": 1}],
        [{"name": "x", "control": 0}] * 2, [{"name": "x", "control": 0, "failsafe": "fly"}], {"x": 1}, [{"nam": "x"}],
    ):  # fmt: skip
        path.write_text(json.dumps(rows))
        with pytest.raises(ProgramError, match="commands"):
            read(path, 3)


@pytest.mark.parametrize("driven", ["front", "rear", "all"])
def test_a_car_is_found_in_its_world_and_driven_as_by_its_own_numbers(driven):
    car = vehicles.Car(wheelbase_m=2.5, track_m=1.4, steering_deg=28.0, drive_n_m=1234.0, driven=driven)
    spec = empty(time_step=0.002)
    floor(spec)
    vehicles.add(spec, car, name="car", look=None)
    model = spec.compile()
    found = find_cars(model)
    assert list(found) == ["car"] and find_cars(empty().compile()) == {}
    for name, value in vars(found["car"]).items():
        own = getattr(car, name)
        assert (own == pytest.approx(value)) if isinstance(value, float) else own == value, name
    data, mine = mujoco.MjData(model), mujoco.MjData(model)
    rows = tuple(Command(f"car.{pedal}", car="car", pedal=pedal) for pedal in ("steering", "throttle", "brake"))
    console = Console(rows, found, data.ctrl, lambda: 0.0)
    console.hear(json.dumps({"values": {"car.steering": 12.0, "car.throttle": 0.4, "car.brake": 0.2}}).encode())
    console.write(model, data)
    vehicles.pedals(car, model, mine, "car", steering_deg=12.0, throttle=0.4, brake=0.2)
    assert np.allclose(data.ctrl, mine.ctrl, rtol=1e-9) and np.count_nonzero(data.ctrl) == 7
