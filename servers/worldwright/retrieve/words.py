"""Words and identifiers: how the pieces of the corpus, and a question, become the same terms.

A word is stemmed. An identifier counts whole and as its words (`geom_friction`, `mj_rayFlex`, `mjGEOM_BOX`), so that it is
found by either.
"""

import re
from functools import cache

_STOP_WORDS = """
    a about after also am an and any anyone anything are as at be because been before being but by can cannot cant could did
    do does doesnt doing dont each either else even every for from get gets getting give got had has have having help here
    how however i if im in instead into is isnt it its just like make makes making may me might mujoco my need needs no not
    of on one only or our out over please possible really right see seem seems should since so some somehow something
    still such suggestions than thanks that the their them then there these they thing things this those though to too try
    trying two under understand use used using very want was way we were what whats when where whether which while who why
    will with without would you your
"""
STOP = frozenset(_STOP_WORDS.split())
_TOKEN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*|\d+(?:\.\d+)*")
_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_+")
_ENDING_WORDS = """
    izations ization ibility ability ations ation ements ement ingly ings ing edly ness ions ion ors or ers er ies ied ive
    al ed es ly s e y
"""
_ENDINGS = tuple(_ENDING_WORDS.split())
_LEFT = 4
"""Least number of letters that a stem keeps (three before a plain ending)."""


def parts(identifier: str) -> list[str]:
    """The words inside an identifier.

    >>> parts("mj_rayFlex")
    ['mj', 'ray', 'Flex']
    """
    return [part for part in _CAMEL.split(identifier) if part]


@cache
def is_identifier(token: str) -> bool:
    """A name from code rather than a word of a language."""
    return "_" in token or bool(re.search(r"[a-z][A-Z]", token))


def is_code(token: str) -> bool:
    """A letter-and-number code such as a lint rule's.

    >>> is_code("WL115"), is_code("2d"), is_code("words")
    (True, False, False)
    """
    return re.fullmatch(r"[A-Za-z]{2,}\d{2,}", token) is not None


def tokens(text: str) -> list[str]:
    """Words and identifiers, in order."""
    return _TOKEN.findall(text)


@cache
def stem(word: str) -> str:
    """The stem that the forms of a word share, cut lightly so that different words stay different.

    >>> stem("slippage"), stem("damping"), stem("damped"), stem("bodies"), stem("body")
    ('slippag', 'damp', 'damp', 'bod', 'bod')
    """
    lowered = word.lower()
    if len(lowered) < 4 or not lowered.isascii() or lowered[0].isdigit():
        return lowered
    for ending in _ENDINGS:
        least = 3 if len(ending) <= 3 else _LEFT
        if lowered.endswith(ending) and len(lowered) - len(ending) >= least and not lowered.endswith("ss"):
            kept = lowered[: -len(ending)]
            doubled = len(kept) > 3 and kept[-1] == kept[-2] and kept[-1] not in "lsz"
            return kept[:-1] if doubled else kept
    return lowered


@cache
def forms(token: str) -> tuple[str, ...]:
    """The terms a token of a text counts as.

    >>> forms("geom_friction")
    ('geom_friction', 'geom', 'frict')
    """
    inside = parts(token)
    if len(inside) > 1:
        return (token.lower().strip("_"), *(stem(part) for part in inside))
    return (stem(token.strip("_")),) if token.strip("_") else ()


def counted(text: str) -> list[str]:
    """Every term of a text, in order."""
    return [term for token in tokens(text) for term in forms(token)]


def terms(question: str) -> list[str]:
    """The words of a question that carry meaning, each once; all of them when none would be left."""
    plain = re.sub(r"(?<=\w)['’](?=\w)", "", question)
    found = list(dict.fromkeys(token.lower() if not is_identifier(token) else token for token in tokens(plain)))
    kept = [token for token in found if token.lower() not in STOP and len(token) > 1]
    return (kept or found)[:40]


def asked(question: str) -> dict[str, float]:
    """The terms of a question and their weights: identifiers whole and, for less, in parts."""
    weights: dict[str, float] = {}
    for token in terms(question):
        whole, *inside = forms(token) or ("",)
        weights[whole] = 1.0
        for part in inside:
            weights[part] = max(weights.get(part, 0.0), 0.6 if len(part) > 2 else 0.2)
    weights.pop("", None)
    return weights
