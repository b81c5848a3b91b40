"""No trick gets a false claim stamped. `make test-tricks` tries all of them, `make test` the most telling dozen."""

import os
from collections import Counter
from pathlib import Path

import pytest

from . import (
    attack,
    bundle_tricks,
    contact_tricks,
    evidence_tricks,
    field_tricks,
    input_tricks,
    law_tricks,
    linked_tricks,
    new_word_tricks,
    plan_tricks,
    program_tricks,
    shape_tricks,
    weight_tricks,
)
from .attack import Trick
from .won import AT_FIRST, WON

PHYSICAL = (contact_tricks, law_tricks, shape_tricks, weight_tricks, linked_tricks, input_tricks)
"""Here the plan's claim is false in numbers, whatever the trick."""
ALL: tuple[Trick, ...] = tuple(
    trick
    for family in (
        *PHYSICAL,
        program_tricks,
        evidence_tricks,
        bundle_tricks,
        plan_tricks,
        new_word_tricks,
        field_tricks,
    )
    for trick in family.TRICKS
)
TELLING = frozenset(
    [
        "ice_by_pair",
        "no_gravity_by_number",
        "wall_on_a_body",
        "negative_gap_of_the_crate",
        "wind_from_the_other_side",
        "hidden_spring",
        "friction_undeclared",
        "lies_by_its_command_line",
        "world_behind_a_link",
        "recording_stretched_with_hashes",
        "stamp_boasts_by_a_key_made_known",
        "key_twice",
        "facts_drawn_only",
        "magnet_turned",
    ]
)
"""What `make test` tries: one of each way to be refused."""
EVERY = "WORLDWRIGHT_TRICKS" in os.environ


def _param(trick: Trick) -> object:
    won = WON.get(trick.name)
    marks = [pytest.mark.xfail(strict=True, reason=won)] if won else []
    return pytest.param(trick, id=f"{trick.family}-{trick.name}", marks=marks)


@pytest.mark.parametrize("trick", [_param(t) for t in ALL if EVERY or t.name in TELLING])
def test_the_liar_does_not_win(trick: Trick, tmp_path: Path) -> None:
    ending = attack.attempt(trick, tmp_path / "run")
    assert not ending.won, f"{trick.does} Nothing said a word: {ending.said}"
    if "accepted" in trick.touch:  # refused earlier, it would be refused for another reason than its lie
        assert ending.at == "verify", ending
    assert not trick.refused_by or trick.refused_by in ending.refused, ending


def test_every_trick_has_a_name_of_its_own_and_the_lists_know_only_those() -> None:
    names = Counter(trick.name for trick in ALL)
    assert not [name for name, count in names.items() if count > 1]
    assert WON.keys() <= names.keys()
    assert names.keys() >= TELLING


def test_the_readme_counts_them() -> None:
    readme = " ".join((Path(__file__).parents[3] / "README.md").read_text(encoding="utf-8").split())
    assert f"tries {len(ALL)} ways to have a false claim stamped" in readme
    assert f"{AT_FIRST} of them won when they were first tried, and {len(WON)} are open" in readme


def test_the_same_world_with_an_honest_claim_is_accepted(tmp_path: Path) -> None:
    """Else the tricks would be refused for another reason than their lie."""
    honest = Trick(
        "honest",
        "none",
        "It claims what it does.",
        plan=(("min_m: 0.55", "min_m: 0.28"), ("about 0.6 m", "about 0.29 m")),
    )
    ending = attack.attempt(honest, tmp_path / "run")
    assert ending.won, ending
    assert attack.attempt(Trick("bare", "none", "It claims too much."), tmp_path / "bare").at == "expect"


if EVERY:
    CLAIMS = {(trick.world, trick.plan): trick for family in PHYSICAL for trick in family.TRICKS if trick.name in WON}

    @pytest.mark.parametrize("trick", CLAIMS.values(), ids=str)
    def test_what_is_claimed_is_false_without_the_trick(trick: Trick, tmp_path: Path) -> None:
        """Else nothing would be won by it."""
        honest = Trick("honest", "none", trick.does, world=trick.world, plan=trick.plan)
        ending = attack.attempt(honest, tmp_path / "run")
        assert ending.at in ("expect", "scan"), ending
