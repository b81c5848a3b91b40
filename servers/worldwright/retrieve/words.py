"""Words and identifiers: how text is cut for the index, and a question for a match."""

import re

_STOP_WORDS = """
    a an and any are as at be because been but by can could do does for from get got had has have how i if in
    into is it its just like make makes me mujoco my need not of on one or our please should so some than that
    the their them then there these they this those to too use used using want was way we were what when where
    which while who why will with would you your
"""
STOP = frozenset(_STOP_WORDS.split())
_TOKEN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*|\d+(?:\.\d+)*")
_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])|_+")


def parts(identifier: str) -> list[str]:
    """The words inside an identifier.

    >>> parts("mj_rayFlex")
    ['mj', 'ray', 'Flex']
    """
    return [part for part in _CAMEL.split(identifier) if part]


def is_identifier(token: str) -> bool:
    """A name from code rather than a word of a language."""
    return "_" in token or bool(re.search(r"[a-z][A-Z]", token))


def tokens(text: str) -> list[str]:
    """Words and identifiers, in order."""
    return _TOKEN.findall(text)


def names(text: str) -> str:
    """Every identifier of a text once, whole and in parts: the index's column for names."""
    found: dict[str, None] = {}
    for token in tokens(text):
        if is_identifier(token):
            found[token] = None
            for part in parts(token):
                found[part] = None
    return " ".join(found)


def terms(question: str) -> list[str]:
    """The words of a question that carry meaning, each once; all of them when none would be left."""
    found = list(dict.fromkeys(token.lower() if not is_identifier(token) else token for token in tokens(question)))
    kept = [token for token in found if token.lower() not in STOP and len(token) > 1]
    return (kept or found)[:24]


def match(question: str) -> str:
    """A full-text match expression: any term, identifiers whole or as their words. Empty when nothing can match."""
    clauses = []
    for term in terms(question):
        clauses.append(f'"{term}"')
        if is_identifier(term) and len(parts(term)) > 1:
            clauses.append("(" + " AND ".join(f'"{part}"' for part in parts(term)) + ")")
    return " OR ".join(clauses)
