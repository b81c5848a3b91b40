"""The page of sculpting words says what the code does."""

from worldkit import sculpt
from worldwright import sculpting_words


def test_the_page_is_written_from_the_code():
    assert sculpting_words.PAGE.read_text(encoding="utf-8") == sculpting_words.page(), (
        "run: .venv/bin/python -m worldwright.sculpting_words"
    )


def test_every_public_word_stands_on_it():
    page = sculpting_words.page()
    apart = {"brushes", "crisp", "Shape", "Made", "Leaf", "noise"}
    assert not [word for word in sculpt.__all__ if word not in apart and f"`{word}(" not in page]
