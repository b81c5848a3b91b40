"""What the liar wins today, and why: each entry is a defect that waits to be mended.

A trick that no longer wins must leave this list (`xfail(strict=True)` tells), and the README's count goes down.
"""

AT_FIRST = 93
"""How many won when they were first tried."""

WORDS = "nothing holds the words of a claim against what is measured for it, but for its numbers"

WON: dict[str, str] = {
    "claim_of_another_body": WORDS,
    "claim_in_a_window": WORDS,
    "vast_tolerance": WORDS,
    "vacuous_box": WORDS,
}
