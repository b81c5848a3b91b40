"""Ranking pieces for a question: the scores of words and of meaning are added, and weighted by where each piece stands.

A piece counts as its best window does, in words and in meaning: what stands beside an answer does not thin it. Both scores
are scaled to the best of their kind, so that words decide a question of rare names, and meaning one in everyday language.
"""

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from ..simulator import changelog, installed
from . import thesaurus, words
from .index import Index

if TYPE_CHECKING:
    import numpy as np

    from .semantic.ranker import Space

PART_WEIGHT = {
    "manual": 1.0,
    "changelog": 0.75,
    "skills": 1.0,
    "rules": 0.65,
    "api": 0.6,
    "python": 0.55,
    "examples": 0.45,
    "catalog": 0.7,
    "sources": 0.9,
}
"""Weight of each part: the manual explains what declarations and code only show."""
OURS_WEIGHT = 0.75
"""Weight of our own how-to texts beside the simulator's: they explain how this suite does it."""
OURS_MOST = 1
"""Texts of our own among the first `SHOWN` hits from which on the simulator's come before them,"""
OURS_BEST = 0.9
"""unless none of the simulator's scores this share of theirs: the question is about this suite."""
SHOWN = 5
ASIDE = {
    "doc/mjwarp/": frozenset({"warp", "mjwarp", "gpu", "cuda"}),
    "doc/mjx": frozenset({"mjx", "jax", "gpu", "tpu"}),
    "doc/unity": frozenset({"unity"}),
    "doc/OpenUSD/": frozenset({"usd", "openusd"}),
    "doc/studio/": frozenset({"studio", "viewer", "plugin", "web"}),
    "doc/skills/gui/": frozenset({"imgui", "gui", "implot"}),
    "doc/skills/studio/": frozenset({"studio", "viewer", "plugin", "web"}),
    "doc/skills/parity/": frozenset({"parity", "warp", "mjwarp", "mjx", "gpu"}),
    "doc/skills/accelerated/": frozenset({"warp", "mjwarp", "mjx", "gpu", "jax", "cuda"}),
}
"""Pages about something other than the engine itself, each with the words of questions about it."""
ASIDE_WEIGHT = 0.6
NAMED_WEIGHT = 1.6
"""Weight of a piece that stands under a name in the question."""
NEWEST = "version-" + installed.version().split(".")[0] + "-"
"""Anchor of the changelog entries of the installed major version, which are true now."""
_HISTORY_WORDS = """
    replaced replaces replacement gone old older newer changed change changes changelog removed renamed deprecated
    deprecation upgrade upgraded upgrading update updated version release migrate migration breaking longer anymore
"""
HISTORY = frozenset(_HISTORY_WORDS.split())


class Places(NamedTuple):
    """What the index knows of every piece besides its text; entry n of each array belongs to piece n."""

    weight: "np.ndarray"
    """(N + 1,) float32: the weight of its part."""
    aside: dict[str, "np.ndarray"]
    """Pieces of each page of `ASIDE`."""
    changes: "np.ndarray"
    """Pieces of the changelog."""
    newest: "np.ndarray"
    """Those of the installed major version."""
    first: "np.ndarray"
    """First lines."""
    parts: tuple[str, ...]
    anchors: tuple[str, ...]
    ours: "np.ndarray"
    """(N + 1,) bool: our own texts."""


@lru_cache(maxsize=2)
def places(path: str) -> Places:
    """The places of one index."""
    from pathlib import Path

    import numpy as np

    rows = Index(Path(path)).places()
    weight = np.zeros(len(rows) + 1, dtype=np.float32)
    ours = np.zeros(len(rows) + 1, dtype=bool)
    for number, root, _, part, anchor, _ in rows:
        ours[number] = root.startswith("worldwright-") and part in ("skills", "rules", "examples", "python")
        pointer = 0.5 if anchor.startswith("default-") else 1.0  # it only points to the attribute's own entry
        own = OURS_WEIGHT if ours[number] and part == "skills" else 1.0
        weight[number] = PART_WEIGHT.get(part, 1.0) * own * pointer
    numbers = lambda test: np.array([row[0] for row in rows if test(row)], dtype=np.int64)  # noqa: E731
    return Places(
        weight,
        {start: numbers(lambda row, start=start: row[2].startswith(start)) for start in ASIDE},
        numbers(lambda row: row[3] == "changelog"),
        numbers(lambda row: row[3] == "changelog" and row[4].startswith(NEWEST)),
        np.array([0, *(row[5] for row in rows)], dtype=np.int64),
        ("", *(row[3] for row in rows)),
        ("", *(row[4] for row in rows)),
        ours,
    )


def rank(index: Index, question: str, space: "Space | None", limit: int, full: bool = True) -> list[tuple[int, float]]:
    """(piece number, score), best first.

    Args:
        index: what is searched.
        question: in words or names.
        space: vectors to join, or None for full text alone.
        limit: how many.
        full: whether words count; without them meaning alone decides.
    """
    import numpy as np

    where = places(str(index.path))
    factor = weights(where, question)
    terms = words.terms(question)
    names = [term for term in terms if words.is_identifier(term) or words.is_code(term)]
    factor[index.named(names)] *= NAMED_WEIGHT
    total = np.zeros(len(where.weight), dtype=np.float32)
    if full:
        total += scaled(index.scores(spoken(question)))
    if space is not None:
        plain = 1.0 - full * len(names) / max(1, len(terms))  # what lies near a name lies there by chance
        total += plain * scaled(space.near(question, len(total) - 1))
    total *= factor
    order = np.argsort(-total, kind="stable")[:limit]
    return [(int(number), float(total[number])) for number in order if total[number] > 0.0]


@lru_cache(maxsize=16)
def spoken(question: str) -> dict[str, float]:
    """The question's terms and the manual's words for them, with their weights."""
    asked = words.asked(question)
    for meant, weight in thesaurus.expand(question).items():
        for form in words.forms(meant):
            asked.setdefault(form, weight)
    return asked


def scaled(scores: "np.ndarray") -> "np.ndarray":
    """The scores, scaled so that the best is 1."""
    best = float(scores.max()) if len(scores) else 0.0
    return scores / best if best > 0.0 else scores


def weights(where: Places, question: str) -> "np.ndarray":
    """(N + 1,) float32: how much each piece's place counts for the question."""
    asked = words.terms(question)
    lowered = {term.lower() for term in asked}
    factor = where.weight.copy()
    for start, called in ASIDE.items():
        if not called & lowered:
            factor[where.aside[start]] *= ASIDE_WEIGHT
    history = bool(lowered & HISTORY)
    if history:
        factor[where.changes] *= 1.0 / PART_WEIGHT["changelog"]
        for line in _told(asked):
            factor[where.changes[where.first[where.changes] == line]] *= 2.0
    factor[where.newest] *= 1.15
    return factor


def _told(asked: list[str]) -> set[int]:
    """First lines of the newest changelog entry that renames or removes each of the names in the question."""
    told = set()
    for term in asked:
        row = next((row for row in changelog.find(term) if row.weight(term) >= 2), None)
        if row is not None:
            told.add(row.lines[0])
    return told
