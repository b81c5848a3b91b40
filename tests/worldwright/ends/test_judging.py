"""What is paid stays true: a failure that ends an episode is final, and an event that holds no more is taken back."""

import numpy as np
import pytest

from worldwright.ends.judging import FINAL, Judge, Judged
from worldwright.scan.objectives import expecting
from worldwright.scan.objectives.claims import EXPECTATIONS

GOOD = [(name, k) for name in sorted(FINAL) for k in range(len(EXPECTATIONS[name].GOOD))]

BAD = [(row.name, k) for row in EXPECTATIONS.values() if row.EVENT for k in range(len(row.BAD))]


class Begun:
    """An episode that has come so far."""

    def __init__(self, motion, rows):
        self.rows, self.motion = rows, lambda: motion.before(rows)

    def __len__(self):
        return self.rows


def rewards(motion, *judged, ended=True):
    """Of a motion that is judged at twelve moments, the last one being its end."""
    judge = Judge([Judged(0, "", *row) for row in judged], float(motion.t[-1]))
    moments = np.unique(np.linspace(2, len(motion.t), 12).astype(int))
    return [judge.judge(Begun(motion, int(k)), ended and k == len(motion.t))[0] for k in moments]


@pytest.mark.parametrize(("name", "number"), GOOD)
def test_no_beginning_of_a_good_motion_fails(name, number):
    make, arguments = EXPECTATIONS[name].GOOD[number]
    motion = make()
    assert expecting.measure(motion, name, expecting.named(arguments)).status == "holds"
    for rows in np.unique(np.linspace(2, len(motion.t), 12).astype(int)):
        assert expecting.measure(motion.before(int(rows)), name, expecting.named(arguments)).status != "fails"


def test_what_recovers_is_not_final():
    assert not FINAL & {"stays_in_contact", "moves_straight", "keeps_speed", "ends_at"}


@pytest.mark.parametrize(("name", "number"), BAD)
def test_a_bad_motion_is_paid_nothing_in_the_end(name, number):
    make, arguments = EXPECTATIONS[name].BAD[number]
    assert sum(rewards(make(), (name, expecting.named(arguments), "event"))) == 0


def test_what_was_paid_is_taken_back_where_a_broken_claim_ends_the_episode():
    make, arguments = EXPECTATIONS["bounces"].BAD[1]
    event = ("bounces", expecting.named(arguments), "event")
    assert sum(rewards(make(), event, ended=False)) == 1.0  # it holds for a while
    broken = ("never_faster_than", {"body": "ball", "max_m_s": 1e-3}, "lasting")
    judge = Judge([Judged(0, "", *event, paid=True), Judged(1, "", *broken)], 3.0)
    assert judge.judge(Begun(make(), len(make().t)), at_end=False) == (-0.5, True)
