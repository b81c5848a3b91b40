"""What a planner reads before its first line of a common world: a token is taken as four bytes, as in `make test-harness`."""

from pathlib import Path

import pytest

from worldwright.contract.roles import PLAN
from worldwright.retrieve import tools

REPO = Path(__file__).parents[2]
READING_TOKENS, BYTES_A_TOKEN = 6000, 4
COMMON = (
    "A yo-yo rises and falls on its string",
    "A small and a large stone are rolled down a slope",
    "a steady wind turns a windmill",
    "A grandfather clock's pendulum swings",
    "A row of dominoes falls",
    "A mug slides across the table and stops",
    "A jack-in-the-box jumps out",
    "A crane lifts a crate by a rope",
    "A tennis ball is dropped on clay and bounces lower each time",
    "A plate is set down on a crowded dinner table",
    "A rock is hurled over a wall",
    "Newton's cradle clacks back and forth",
    "A see-saw tips when a heavier child sits down",
    "A catapult hurls a rock",
)


@pytest.mark.parametrize("sentence", COMMON)
def test_the_reading_for_a_common_world_is_short(sentence, tmp_path, monkeypatch, record_property):
    monkeypatch.chdir(tmp_path)
    begun = tools.begin(sentence)
    roles = (path for path in REPO.glob(".*/agents/*") if path.stem == PLAN.agent)
    own = max(path.stat().st_size for path in roles)  # the longest of the harnesses' forms
    pages = [REPO / "AGENTS.md", REPO / "skills/prompt-to-plan/SKILL.md", tmp_path / begun.plan]
    tokens = (own + sum(path.stat().st_size for path in pages) + len(begun.text().encode())) / BYTES_A_TOKEN
    record_property("tokens", tokens)
    print(f"{tokens:.0f} tokens to read, with the plan of {begun.like}")
    assert tokens <= READING_TOKENS
