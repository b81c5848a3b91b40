"""One driver at a time, whose words are checked: what is wrong is refused with its cause, and nothing of it reaches the world."""

import json

import pytest

from worldwright.ends.seats import MOST_HZ, MOST_SEATS, MOST_SPANS, Refusal, Seats


class World:
    def __init__(self):
        self.now, self.sent, self.lefts, self.notes = 0.0, [], 0, []

    def left(self):
        self.lefts += 1


@pytest.fixture
def world():
    return World()


@pytest.fixture
def seats(world):
    return Seats(
        ("pull", "push"), world.sent.append, world.left, lambda: world.now, lambda *told: world.notes.append(told),
        lambda: world.now,
    )  # fmt: skip


def drive(n, **values):
    return json.dumps({"kind": "drive", "n": n, "values": values})


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ("{", "no JSON"),
        ("[" * 100_000, "no JSON"),
        ("[1]", "no message"),
        ('{"kind": "jump"}', "no message 'jump'"),
        ('{"kind": "drive", "n": 1}', "`values`"),
        ('{"kind": "drive", "n": true, "values": {"pull": 1}}', "`n`"),
        (drive(1, steer=1.0), "no command steer"),
        ('{"kind": "drive", "n": 1, "values": {"pull": NaN}}', "pull: no finite number"),
        ('{"kind": "drive", "n": 1, "values": {"pull": 1, "push": 1e999}}', "push: no finite"),
        ('{"kind": "drive", "n": 1, "values": {"pull": ' + "9" * 400 + "}}", "pull: no finite"),
        ('{"kind": "drive", "n": 1, "values": {"pull": true}}', "pull: no finite"),
        (drive(1, pull=-1e12), "pull: no finite number below 1e+12"),
        (drive(0, pull=1.0), "late"),
    ],
)
def test_what_is_wrong_is_refused_with_its_cause_and_moves_nothing(seats, world, text, cause):
    seat = seats.sit("Ada", "here")
    assert seat.say(drive(0, pull=0.5)) is None
    refusal = seat.say(text)
    assert isinstance(refusal, Refusal) and cause in refusal.cause and refusal.next_move and not refusal.leave
    assert world.sent == [{"pull": 0.5}] and seat.drives and seat.refused == 1


def test_the_second_watches_until_the_wheel_is_free(seats, world):
    first, second = seats.sit("Ada", "here"), seats.sit("Bob\n\x1b[31m", "there")
    assert first.drives and not second.drives and second.name == "Bob[31m"
    assert "Ada drives" in second.say(drive(1, pull=1.0)).cause
    assert "Ada drives" in second.say('{"kind": "take"}').cause and world.sent == []
    world.now = 2.5
    first.leave()
    assert world.lefts == 1, "a driver who goes lets the failsafes act"
    assert second.say('{"kind": "take"}') is None and second.say(drive(1, pull=1.0)) is None
    world.now = 4.0
    assert second.say('{"kind": "release"}') is None and not second.drives
    spans = [(span.driver, span.from_s, span.to_s) for span in seats.spans]
    assert spans == [("Ada", 0.0, 2.5), ("Bob[31m", 2.5, 4.0)]
    assert world.sent == [{"pull": 1.0}] and world.lefts == 2


def test_who_floods_must_leave_and_a_second_has_its_own_count(seats, world):
    seat = seats.sit("Ada", "here")
    said = [seat.say(drive(n, pull=0.0)) for n in range(MOST_HZ + 1)]
    assert said[:-1] == [None] * MOST_HZ and said[-1].leave
    world.now = 1.0
    assert seat.say(drive(MOST_HZ + 5, pull=0.0)) is None
    world.now = 0.5  # a clock that jumps back begins a new second, and refuses nobody for long
    assert seat.say(drive(MOST_HZ + 6, pull=0.0)) is None


def test_there_are_so_many_seats(seats):
    for _ in range(MOST_SEATS):
        assert not isinstance(seats.sit("x", "y", watches=True), Refusal)
    assert seats.sit("x", "y").leave and seats.driver is None


def test_the_wheel_changes_hands_so_seldom_that_nobody_fills_a_disk(seats, world):
    seat = seats.sit("Ada", "here")
    for n in range(150):
        world.now = n / 100
        seat.say('{"kind": "release"}')
        said = seat.say('{"kind": "take"}')
        assert said is None or "a moment ago" in said.cause
    assert [what for what, _ in world.notes].count("drives") == 3
    seat.leave()
    assert not seats.sit("Bob", "there").drives
    for n in range(2 * MOST_SPANS):
        world.now = 10.0 + n
        seats.sit("Eve", "there").leave()
    assert len(seats.spans) == MOST_SPANS


@pytest.mark.parametrize(
    "cause", [BrokenPipeError("the terminal is gone"), OSError(28, "no space"), ValueError("closed")]
)
def test_a_note_that_cannot_be_written_holds_up_no_failsafe_and_keeps_no_seat(world, cause):
    def note(what, more):
        raise cause

    seats = Seats(("pull",), world.sent.append, world.left, lambda: world.now, note, lambda: world.now)
    seat = seats.sit("Ada", "here")
    assert seat.drives and "no JSON" in seat.say("{").cause
    seat.leave()
    assert world.lefts == 1 and seats.taken == [] and seats.driver is None


def test_the_failsafes_act_before_anything_is_noted(world):
    order = []
    seats = Seats(
        (), world.sent.append, lambda: order.append("left"), lambda: 0.0, lambda what, more: order.append(what)
    )
    seats.sit("Ada", "here").leave()
    assert order == ["came", "drives", "left", "released", "left"]
