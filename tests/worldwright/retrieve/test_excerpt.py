"""What is shown of a long hit is where it answers."""

from worldwright.retrieve.excerpt import LONGEST, excerpt

TELLING = {"restitut": 3.0, "damp": 1.0}
FILLER = ["Nothing of use stands in this line, though it mentions damping."] * 40


def test_a_short_text_is_shown_whole():
    assert excerpt("one\ntwo", TELLING) == "one\ntwo"


def test_the_lines_that_say_most_are_shown():
    lines = [*FILLER, "The restitution follows from a negative solref.", *FILLER]
    shown = excerpt("\n".join(lines), TELLING)
    assert "negative solref" in shown and shown.startswith("… ") and shown.endswith(" …")
    assert len(shown) <= LONGEST + 4


def test_more_of_a_term_counts_for_less():
    damping = "damping " * 12
    shown = excerpt("\n".join([damping, *["nothing"] * 120, "damping and restitution"]), TELLING)
    assert "restitution" in shown


def test_one_endless_line_is_cut():
    assert len(excerpt("restitution " * 500, TELLING)) <= LONGEST + 4
