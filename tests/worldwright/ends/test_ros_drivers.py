"""Peers of a network at the wheel: one at a time, checked as a page's are, and gone when they fall silent, flood or leave."""

import math
from types import SimpleNamespace

import pytest

from worldwright.ends import ros_drivers
from worldwright.ends.ros_drivers import BARRED_S, NAMELESS_S, SILENT_S, RosDrivers, of_drive, of_twist
from worldwright.ends.ros_node import Sender
from worldwright.ends.seats import MOST_HZ, MOST_SEATS, Seats

ADA, BOB = Sender("aa", "/ada"), Sender("bb", "/bob")


class Stage:
    def __init__(self):
        self.now, self.sent, self.lefts, self.told, self.notes = 0.0, [], 0, [], []
        self.seats = Seats(
            ("pull",),
            self.sent.append,
            self.left,
            lambda: self.now,
            lambda *told: self.notes.append(told),
            lambda: self.now,
        )
        self.drivers = RosDrivers(
            self.seats, lambda name, refusal: self.told.append((name, refusal.cause)), lambda: self.now
        )

    def left(self):
        self.lefts += 1


@pytest.fixture
def stage():
    return Stage()


def test_the_first_who_speaks_drives_under_its_nodes_name_and_the_second_is_told_once(stage):
    stage.drivers.hear(ADA, {"pull": 0.5})
    for _ in range(3):
        stage.drivers.hear(BOB, {"pull": -0.5})
    assert stage.sent == [{"pull": 0.5}] and stage.seats.driver.name == "/ada"
    assert stage.told == [("/bob", "/ada drives, you watch")]
    assert stage.seats.driver.where == "ROS 2, participant aa"


@pytest.mark.parametrize("gone", ["left", "silent"])
def test_who_leaves_or_falls_silent_gives_the_wheel_back(stage, gone):
    stage.drivers.hear(ADA, {"pull": 0.5})
    stage.now = 1.0
    stage.drivers.hear(BOB, {"pull": 0.1})
    stage.drivers.settle({"aa", "bb"})
    assert stage.seats.driver.name == "/ada" and stage.lefts == 0
    stage.now = 1.5 if gone == "left" else SILENT_S + 0.1
    stage.drivers.settle({"bb"} if gone == "left" else {"aa", "bb"})
    assert stage.seats.driver is None and stage.lefts == 1, "the failsafes act"
    stage.drivers.hear(BOB, {"pull": 0.2})
    assert stage.sent == [{"pull": 0.5}, {"pull": 0.2}] and stage.seats.driver.name == "/bob"
    stage.drivers.close()
    assert stage.lefts == 2 and stage.seats.taken == []


def test_who_floods_is_shown_the_door_and_heard_again_later(stage):
    for _ in range(3 * MOST_HZ):
        stage.drivers.hear(ADA, {"pull": 0.5})
    assert len(stage.sent) == MOST_HZ and stage.told == [("/ada", f"more than {MOST_HZ} messages in a second")]
    assert stage.seats.driver is None and stage.lefts == 1
    stage.now = BARRED_S / 2
    stage.drivers.settle({"aa"})
    stage.drivers.hear(ADA, {"pull": 0.5})
    assert len(stage.sent) == MOST_HZ
    stage.now = BARRED_S + 0.1
    stage.drivers.settle({"aa"})
    stage.drivers.hear(ADA, {"pull": 0.5})
    assert len(stage.sent) == MOST_HZ + 1


def test_who_tells_no_name_is_heard_after_a_while_and_who_tells_it_late_drives_under_it(stage):
    nameless = Sender("cc", "")
    stage.drivers.hear(nameless, {"pull": 0.1})
    stage.drivers.settle({"cc"})
    assert stage.sent == [] and stage.seats.taken == []
    stage.now = NAMELESS_S / 2
    stage.drivers.hear(ADA, {"pull": 0.2})
    assert stage.seats.driver.name == "/ada"
    stage.drivers.close()
    stage.now = NAMELESS_S + 0.1
    stage.drivers.hear(nameless, {"pull": 0.3})
    assert stage.sent == [{"pull": 0.2}, {"pull": 0.3}] and stage.seats.driver.name == "a ROS 2 node"


def test_what_is_no_number_moves_nothing_and_the_next_good_word_counts(stage):
    for value in (math.nan, math.inf, 1e13):
        stage.drivers.hear(ADA, {"pull": value})
    assert stage.sent == [] and [cause for _, cause in stage.told] == ["pull: no finite number below 1e+12"]
    stage.drivers.hear(ADA, {"pull": 0.5})
    assert stage.sent == [{"pull": 0.5}]


def test_no_seat_is_told_once(stage):
    for number in range(MOST_SEATS):
        stage.seats.sit(f"{number}", "a page")
    for _ in range(3):
        stage.drivers.hear(ADA, {"pull": 0.5})
    assert stage.told == [("/ada", f"all {MOST_SEATS} seats are taken")] and stage.sent == []


CAR = SimpleNamespace(wheelbase_m=2.5, steering_deg=30.0, wheel_radius_m=0.3, drive_n_m=600.0)


def twist(speed, wanted, turn):
    message = SimpleNamespace(linear=SimpleNamespace(x=wanted), angular=SimpleNamespace(z=turn))
    return {name.removeprefix("car."): value for name, value in of_twist("car", CAR, 1000.0, speed, message).items()}


def test_a_twist_is_the_circle_of_its_turn():
    # tan(steering) = wheelbase x turn / speed: of the bicycle model.
    assert twist(2.0, 2.0, 0.4)["steering"] == pytest.approx(math.degrees(math.atan(2.5 * 0.4 / 2.0)))
    assert twist(-2.0, -2.0, 0.4)["steering"] == pytest.approx(-math.degrees(math.atan(2.5 * 0.4 / 2.0)))
    assert twist(0.0, 0.0, 0.4)["steering"] == 30.0 and twist(0.0, 0.0, -9.0)["steering"] == -30.0
    assert twist(2.0, 2.0, 9.0)["steering"] == 30.0, "as far as it goes"


def test_a_twist_makes_up_for_speed_by_throttle_and_brake():
    push = 1000.0 * (2.0 * 0.5 + ros_drivers.ROLLING * 9.81) * 0.3 / 600.0
    assert twist(1.5, 2.0, 0.0) == pytest.approx({"steering": 0.0, "throttle": push, "brake": 0.0})
    assert twist(0.0, -4.0, 0.0)["throttle"] == -1.0 and twist(0.0, 9.0, 0.0)["throttle"] == 1.0
    assert twist(3.0, 1.0, 0.0) == pytest.approx({"steering": 0.0, "throttle": 0.0, "brake": 4.0 / 9.81})
    assert twist(3.0, -5.0, 0.0)["brake"] == 1.0, "it stops before it turns back"
    assert twist(0.0, 0.0, 0.0) == {"steering": 0.0, "throttle": 0.0, "brake": 1.0}


@pytest.mark.parametrize(("wanted", "turn"), [(math.nan, 0.0), (0.0, math.nan), (math.inf, 0.0), (1.0, -math.inf)])
def test_a_twist_that_is_no_number_becomes_one_that_is_refused(wanted, turn):
    assert all(math.isnan(value) for value in twist(1.0, wanted, turn).values())


def test_a_drive_steers_in_radians():
    message = SimpleNamespace(steering=math.pi / 12, throttle=0.5, brake=0.25)
    assert of_drive("car", message) == pytest.approx({"car.steering": 15.0, "car.throttle": 0.5, "car.brake": 0.25})
