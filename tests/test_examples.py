"""Every accepted world is proved again from what version control keeps of it: physics and measurements, no pictures."""

from pathlib import Path

import pytest

from worldwright.stamp import bundle, keyring
from worldwright.stamp import tools as stamp

EXAMPLES = sorted(path.parent for path in (Path(__file__).parents[1] / "examples").glob("*/plan.md"))


def test_there_are_examples():
    assert len(EXAMPLES) >= 13


@pytest.mark.slow
@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_an_example_is_proved_again_from_its_small_form(example: Path):
    assert bundle.is_small(example)
    listed = (example.parent / keyring.KNOWN).is_file()  # then one of those keys must have signed every example
    result = stamp.verify(str(example), timeout_s=300, anybody=not listed)
    assert result.ok, result.text()
    assert stamp.status(str(example)).state == "accepted"
