"""A failure that ends an episode must be final: whatever holds of a whole motion holds of its beginnings."""

import numpy as np
import pytest

from worldwright.ends.judging import FINAL
from worldwright.scan.objectives import expecting
from worldwright.scan.objectives.claims import EXPECTATIONS

GOOD = [(name, k) for name in sorted(FINAL) for k in range(len(EXPECTATIONS[name].GOOD))]


@pytest.mark.parametrize(("name", "number"), GOOD)
def test_no_beginning_of_a_good_motion_fails(name, number):
    make, arguments = EXPECTATIONS[name].GOOD[number]
    motion = make()
    assert expecting.measure(motion, name, expecting.named(arguments)).status == "holds"
    for rows in np.unique(np.linspace(2, len(motion.t), 12).astype(int)):
        assert expecting.measure(motion.before(int(rows)), name, expecting.named(arguments)).status != "fails"


def test_what_recovers_is_not_final():
    assert not FINAL & {"stays_in_contact", "moves_straight", "keeps_speed", "ends_at"}
