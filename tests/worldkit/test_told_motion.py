"""The velocities that an author's law tells are held against the way that its points go."""

from types import SimpleNamespace

import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.told_motion import ToldMotion

START = np.array([[0.0, 0.0, 1.0], [0.1, 0.0, 1.0]])


def law(points, velocities, mass=(1.0, 1.0)) -> SimpleNamespace:
    return SimpleNamespace(points=points, velocities=np.broadcast_to(velocities, (2, 3)), mass=np.array(mass))


def looked(states) -> None:
    motion = ToldMotion("oil")
    for number, state in enumerate(states):
        motion.look(state, 0.01, 0.01 * number)


def going(speed: float, told: float, questions: int = 30, mass=lambda n: (1.0, 1.0)) -> list[SimpleNamespace]:
    return [law(START + np.array([speed * 0.01 * n, 0, 0]), (told, 0, 0), mass(n)) for n in range(questions)]


@pytest.mark.parametrize(("speed", "told"), [(0.5, 0.0), (0.0, 3.0), (0.5, -0.5), (0.5, 3.0)])
def test_velocities_that_points_do_not_have_are_refused(speed: float, told: float) -> None:
    with pytest.raises(ProgramError, match=r"law oil tells velocities .* until t = 0\.\d+ s they went .* m in 0\.1 s"):
        looked(going(speed, told))


def test_those_that_they_have_are_not() -> None:
    looked(going(0.5, 0.5))
    fall = [law(START - (0, 0, 4.905 * t**2), (0, 0, -9.81 * t)) for t in 0.01 * np.arange(40)]
    looked(fall)
    looked(going(0.0, 0.0))


def flowing(told: float, way: float = 0.0) -> list[SimpleNamespace]:
    """Matter that flows from the first point of a grid to the other, 0.1 m away, at a hundredth a question: 0.001 m by 0.01 s."""
    places = [START + np.array([way * n, 0, 0]) for n in range(30)]
    return [law(place, (told, 0, 0), (1.0 - 0.01 * n, 1.0 + 0.01 * n)) for n, place in enumerate(places)]


def test_what_flows_through_a_grid_is_held_by_its_centre_of_mass() -> None:
    looked(flowing(0.05))  # of 2 kg 0.01 kg go 0.1 m in 0.01 s
    for told in (0.0, -0.05, 0.5):
        with pytest.raises(ProgramError, match="tells velocities"):
            looked(flowing(told))


def test_masses_that_keep_changing_hide_no_motion() -> None:
    jitter = [lambda n: (1.0 + 1e-12 * (n % 2), 1.0 - 1e-12 * (n % 2)), lambda n: (1.0 + 1e-6 * n, 1.0 - 1e-6 * n)]
    for mass in jitter:
        looked(going(0.5, 0.5, mass=mass))
        for speed, told in ((0.5, 0.0), (0.5, -0.5), (0.0, 3.0)):
            with pytest.raises(ProgramError, match="tells velocities"):
                looked(going(speed, told, mass=mass))
    there_and_back = [
        law(START + 0.005 * n * np.array([[1.0, 0, 0], [-1.0, 0, 0]]), (0, 0, 0), jitter[0](n)) for n in range(30)
    ]
    with pytest.raises(ProgramError, match="they went"):  # whose centre of mass stays
        looked(there_and_back)


def test_what_flows_in_and_what_is_poured_is_not_asked() -> None:
    looked(going(0.0, 0.5, mass=lambda n: (1.0 + n, 1.0 - 0.01 * n)))
    looked([law(START, (0, 0, 0))] * 5 + [law(START + np.array([3.0, 0, 0]), (0, 0, 0))] * 25)


def test_what_waited_begins_elsewhere_only_once() -> None:
    with pytest.raises(ProgramError, match="tells velocities"):
        looked([law(START + np.array([3.0 * (n // 5), 0, 0]), (0, 0, 0)) for n in range(25)])


def test_velocities_that_only_turn_to_and_fro_are_no_motion() -> None:
    with pytest.raises(ProgramError, match="tells velocities"):
        looked([law(START, (0, 200.0 * (-1) ** n, 0)) for n in range(15)])


def test_what_trembles_between_two_questions_is_honest() -> None:
    t = 0.01 * np.arange(200)
    looked([law(START + np.array([0, 0, 1e-3 * np.sin(300 * n)]), (0, 0, 0.3 * np.cos(300 * n))) for n in t])
