"""A hundred and fifty real simulations: every planted fault is found, and no clean world is blocked."""

import sys
import warnings
from pathlib import Path

import mujoco
import pytest

sys.path.insert(0, str(Path(__file__).parent / "corpus"))

import clean
import faulty
import heldout
import measure

from worldkit import portable

CLEAN = clean.worlds()
FAULTY = faulty.worlds()


def test_the_corpus_is_large_enough():
    assert len(CLEAN) >= 40 and len(FAULTY) >= 40
    assert len({world.name for world in (*CLEAN, *FAULTY)}) == len(CLEAN) + len(FAULTY)


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # MuJoCo writes its log into the working directory


@pytest.mark.parametrize("channels", ["everything", "no model", "poses alone"])
@pytest.mark.parametrize("world", CLEAN, ids=lambda world: world.name)
def test_a_clean_world_is_not_blocked(world, channels, tmp_path):
    found = measure.report(world, tmp_path, channels != "poses alone", channels == "everything")
    assert measure.blocking(found) == set()


@pytest.mark.parametrize("world", FAULTY, ids=lambda world: world.name)
def test_a_planted_fault_is_found(world, tmp_path):
    found = measure.report(world, tmp_path)
    names = measure.warned(found) if world.name in faulty.WARNED else measure.blocking(found)
    assert names & set(world.fault)


@pytest.mark.parametrize("world", heldout.worlds(), ids=lambda world: world.name)
def test_worlds_that_no_threshold_was_tuned_on(world, tmp_path):
    found = measure.report(world, tmp_path)
    names = measure.warned(found) if world.name in heldout.WARNED else measure.blocking(found)
    assert bool(names & set(world.fault)) if world.fault else not names


def test_every_world_of_the_corpus_goes_through_the_archive_bit_for_bit(tmp_path):
    texts = {world.xml: world.name for world in (*CLEAN, *FAULTY, *heldout.worlds())}
    with warnings.catch_warnings(action="ignore"):  # a fault may be one of the model
        facts = {
            name: portable.write(mujoco.MjSpec.from_string(xml), tmp_path / "world.mjz") for xml, name in texts.items()
        }
    assert len(facts) > 100 and {name: fact["rounded"] for name, fact in facts.items() if fact["rounded"]} == {}
