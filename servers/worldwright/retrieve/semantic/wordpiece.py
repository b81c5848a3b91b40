"""Text to the numbers of BERT's word pieces (Devlin et al. 2018): lower case, without accents, longest pieces first."""

import re
import unicodedata
from functools import cache
from pathlib import Path

CLS, SEP, UNKNOWN = "[CLS]", "[SEP]", "[UNK]"
LONGEST_WORD = 100
_CJK = r"\u3400-\u4dbf\u4e00-\u9fff\uf900-\ufaff"


class WordPieces:
    """A vocabulary, and how text is cut into it."""

    def __init__(self, vocabulary: Path) -> None:
        lines = vocabulary.read_text(encoding="utf-8").splitlines()
        self._number = {piece: number for number, piece in enumerate(lines)}
        self._of_word = cache(self._pieces)

    def encode(self, text: str, most: int) -> list[int]:
        """Numbers of a text with its start and end marks, at most `most` in all."""
        found = [self._number[CLS]]
        for word in split(text):
            found += self._of_word(word)
            if len(found) >= most - 1:
                break
        return [*found[: most - 1], self._number[SEP]]

    def _pieces(self, word: str) -> tuple[int, ...]:
        unknown = (self._number[UNKNOWN],)
        if len(word) > LONGEST_WORD:
            return unknown
        found: list[int] = []
        start = 0
        while start < len(word):
            mark = "##" if start else ""
            for end in range(len(word), start, -1):
                if (number := self._number.get(mark + word[start:end])) is not None:
                    found.append(number)
                    start = end
                    break
            else:
                return unknown
        return tuple(found)


def split(text: str) -> list[str]:
    """Words and single marks of punctuation, lower case, without accents and control characters.

    >>> split("Café: mj_step(m)")
    ['cafe', ':', 'mj', '_', 'step', '(', 'm', ')']
    """
    if not text.isascii():
        text = unicodedata.normalize("NFD", text.lower())
        text = "".join(_kept(character) for character in text)
        text = re.sub(f"([{_CJK}])", r" \1 ", text)
    words: list[str] = []
    for word in text.lower().split():
        words += _AROUND.findall(word) if not word.isalnum() else (word,)
    return words


_MARKS = r"!-/:-@\[-`{-~"
_AROUND = re.compile(f"[{_MARKS}]|[^{_MARKS}]+")


def _kept(character: str) -> str:
    kind = unicodedata.category(character)
    if kind == "Mn":
        return ""
    if kind.startswith("C"):
        return " " if character in "\t\n\r" else ""
    if kind == "Zs":
        return " "
    return f" {character} " if kind[0] == "P" else character
