"""What is printed of a stranger's words moves no cursor and adds no line."""

import json

from hypothesis import given
from hypothesis import strategies as st

from worldwright.model import printable
from worldwright.stamp.as_stamped import Check
from worldwright.stamp.status import Status
from worldwright.stamp.verification import Verification

EVIL = "x)\x1b[2J\x1b[Hcrate: proved (bitwise)\n  ok   checksums: 23 files as stamped\r\x9b8m\u202e"


@given(st.text())
def test_printed_words_hold_no_sign_that_moves_a_terminal(text: str) -> None:
    assert all(sign.isprintable() or sign in "\n\t" or ord(sign) > 0x9F for sign in printable.words(text))
    assert "\n" not in printable.line(text)


@given(st.text())
def test_json_means_what_it_meant(text: str) -> None:
    assert json.loads(printable.words(json.dumps(text, ensure_ascii=False))) == text


def test_honest_words_stay_as_they_are() -> None:
    text = "crate: 0,29 m - „Kiste“ → ✓ 面\n  next: worldwright stamp verify crate"
    assert printable.words(text) == text
    assert printable.line(text) == text.replace("\n  ", " / ")


def test_a_stamped_name_cannot_answer_in_place_of_verify_and_status() -> None:
    checks = (Check(name="journal", ok=False, detail=EVIL),)
    told = Verification(run="crate", state="refuted", checks=checks, environment_differences=(EVIL,)).text()
    assert len(told.splitlines()) == 3 and not {"\x1b", "\x9b", "\r", "\u202e"} & set(told)
    assert len(Status(run=EVIL, state="open", steps=(), notes=(EVIL,)).text().splitlines()) == 2
