"""Soft things side by side: each is held where it says, and what cannot be made is told by its name."""

import mujoco
import pytest

from worldkit import softs

SIZE = (0.5, 0.5, 0.01)


def test_what_holds_one_cloth_leaves_another_of_a_longer_name_free():
    spec = mujoco.MjSpec()
    for name, at, held in (("flag_2", 2.0, ()), ("flag", 0.0, ("-x",))):
        softs.add(spec, name, softs.Cloth(1e5, points=5, held=held), size=SIZE, pos=(at, 0, 1), mass=0.1)
    free = {body.name for body in spec.bodies if body.joints}
    assert len([name for name in free if name.startswith("flag_2_")]) == 25 and len(free) == 25 + 20


def test_a_cloth_thicker_than_its_points_are_apart_is_told_by_name():
    spec = mujoco.MjSpec()
    with pytest.raises(ValueError, match=r"^flag: its points lie 12 mm apart, and it is 20 mm thick"):
        softs.add(spec, "flag", softs.Cloth(1e5, points=41), size=(0.5, 0.5, 0.02), pos=(0, 0, 1), mass=0.1)
