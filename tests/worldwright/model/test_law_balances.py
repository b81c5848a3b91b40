"""The sums of an author's law, held against the ledger of what its bodies were given; what makes no sense is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

from worldwright.model.errors import RecordingError
from worldwright.model.recording import law_balances
from worldwright.model.recording.records import Interventions

LAW = {"bodies": ["cart"], "law": {"name": "springs", "shown_by": "net"}}
GRAVITY = np.zeros(3)


class Sums(SimpleNamespace):
    def __len__(self) -> int:
        return len(self.step)


def recording(laws=(LAW,), medium=(0, 0, 0), energy=0.0):
    flat, pulled = np.zeros(3), np.outer([0.0, -0.02, -0.04], [1.0, 0.0, 0.0])
    columns = {"mass": flat + 1, "energy": flat + energy, "weight": flat, "stored": flat, "volume": flat}
    sums = Sums(step=np.array([0, 10, 20]), medium=np.array(medium), momentum=pulled, held=np.zeros((3, 3)), **columns)
    names = ("cart", "arm", "arm.left", "left/arm", "arm[1]")
    return SimpleNamespace(meta={"laws": list(laws)}, balances=sums, time_step=0.001, folder="trajectory", names=names)


def ledger(target: str) -> Interventions:
    """2 N along +x at every step."""
    value = np.tile([2.0, 0, 0, 0, 0, 0], (20, 1))
    return Interventions(np.arange(20) * 0.001, ["force"] * 20, [target] * 20, value, np.full(20, 0.5))


@pytest.mark.parametrize("target", ["cart", "cart/x"])
def test_a_push_counts_for_the_body_whatever_joint_it_names(target: str) -> None:
    (law,) = law_balances.read(recording(), ledger(target), GRAVITY)
    assert law.given[:, 0] == pytest.approx([0.0, 0.02, 0.04]) and law.work[-1] == pytest.approx(10.0)
    assert law.from_nowhere == pytest.approx(0.0, abs=1e-12) and law.pushed == pytest.approx(0.04)


@pytest.mark.parametrize("body", ["arm.left", "left/arm", "arm[1]"])
def test_a_push_counts_for_a_body_of_any_name_and_for_no_other(body: str) -> None:
    (law,) = law_balances.read(recording(({**LAW, "bodies": [body]},)), ledger(body), GRAVITY)
    assert law.given[-1, 0] == pytest.approx(0.04) and law.from_nowhere == pytest.approx(0.0, abs=1e-12)
    for other in ("arm", "left"):
        (law,) = law_balances.read(recording(({**LAW, "bodies": [other]},)), ledger(body), GRAVITY)
        assert not law.given.any() and not law.pushed


def test_a_recording_of_fewer_sums_is_refused() -> None:
    """As an earlier version wrote it."""
    old = recording()
    del old.balances.weight
    with pytest.raises(RecordingError, match=r"law springs it lacks a sum: .*weight"):
        law_balances.read(old, ledger("cart"), GRAVITY)


def test_what_goes_to_and_fro_within_and_is_rounded_comes_not_from_nowhere() -> None:
    t, rng = np.linspace(0.0, 2.0, 201), np.random.default_rng(0)
    nought, still = np.zeros(201), np.zeros((201, 3))
    sums = {"mass": nought + 1, "energy": nought + 50, "weight": nought, "stored": nought, "volume": nought}
    law = law_balances.LawBalance(
        "gas", ("cart",), t, momentum=1e-9 * rng.normal(size=(201, 3)), given=still, held=still, work=nought, pushed=0.0,
        gravity=GRAVITY, **sums,
    )  # fmt: skip
    assert law.from_nowhere < 0.01


@pytest.mark.parametrize("laws", [("springs",), ({"law": {"name": "springs"}},), ({**LAW, "bodies": None},), (3,)])
def test_rows_that_make_no_sense_are_refused(laws) -> None:
    with pytest.raises(RecordingError, match=r"meta\.json makes no sense"):
        law_balances.read(recording(laws), ledger("cart"), GRAVITY)


@pytest.mark.parametrize(
    ("made", "gravity", "says"),
    [
        ({"medium": (1, 1, 1)}, GRAVITY, "sums of the law springs are no numbers at two instants"),
        ({"energy": np.nan}, GRAVITY, "sums of the law springs are no numbers"),
        ({}, None, "says no gravity"),
    ],
)
def test_sums_that_make_no_sense_are_refused(made, gravity, says: str) -> None:
    with pytest.raises(RecordingError, match=says):
        law_balances.read(recording(**made), ledger("cart"), gravity)


def test_a_law_whose_pushes_were_taken_away_is_read_all_the_same() -> None:
    nothing = Interventions(np.zeros(0), [], [], np.zeros((0, 6)), np.zeros(0))
    (law,) = law_balances.read(recording(), nothing, GRAVITY)
    assert not law.given.any() and law.pushed == 0.0
