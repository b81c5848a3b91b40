"""Words that come out of files, as they may be printed: no sign in them moves a terminal's cursor, hides or turns what follows.

Whoever sent a stamp chose the words in it. Printed as they are, they could clear the screen and write another answer.
"""

import re

ODD = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters but for tab and new line, what turns the direction of writing, line separators, halves of characters."""


def words(text: str) -> str:
    """A text of several lines, with each sign that is not printed written out, as in `\\u001b`: JSON stays what it was."""
    return ODD.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


def line(text: str) -> str:
    """The same on one line: what was on further lines follows behind a slash, and cannot pass for a line of ours."""
    return words(" / ".join(part.strip() for part in text.split("\n")) if "\n" in text else text)
