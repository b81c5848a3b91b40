"""Each textbook case is within its bound, and the README's table has it."""

from pathlib import Path

import pytest

from validation import textbook

README = Path(__file__).parents[2] / "README.md"


@pytest.mark.parametrize("case", textbook.CASES, ids=[case.says for case in textbook.CASES])
def test_a_textbook_case_comes_out(case: textbook.Case) -> None:
    error = case.error()
    assert error <= case.bound, f"{case.says}: {error:.3g} ({case.source})"


def test_the_readme_lists_every_case_with_its_bound() -> None:
    text = README.read_text(encoding="utf-8")
    for case in textbook.CASES:
        (row,) = [line for line in text.splitlines() if line.startswith(f"| {case.says} |")]
        reached, allowed = (float(cell) for cell in row.strip("| ").split(" | ")[2:])
        assert allowed == case.bound and reached <= allowed, row
