"""From rankings to an answer: full text, sharpened by structure; more rankings are fused by reciprocal rank.

A `Ranker` gives (piece id, score) for a question. Today there is one; a semantic one joins by being listed.
"""

from collections.abc import Sequence
from typing import Protocol

from ..simulator import changelog, installed
from . import words
from .index import Index, Piece

FUSION_CONSTANT = 60
"""Reciprocal rank fusion's k (Cormack, Clarke and Büttcher 2009)."""
CANDIDATES = 80
NEWEST = "version-" + installed.version().split(".")[0] + "-"
"""Changelog entries of the installed major version say what is true now."""
_HISTORY_WORDS = """
    replaced replacement instead gone old newer changed change changes changelog removed renamed deprecated
    version migrate migration breaking
"""
HISTORY = frozenset(_HISTORY_WORDS.split())


class Ranker(Protocol):
    """Orders pieces by how well they answer a question."""

    def rank(self, index: Index, question: str, limit: int) -> list[tuple[int, float]]:
        """(piece id, score), best first."""
        ...


class FullText:
    """BM25, then structure: a piece whose own label is asked for comes first; few of the words is worth less."""

    def rank(self, index: Index, question: str, limit: int) -> list[tuple[int, float]]:
        """Score the best candidates again by what their structure says."""
        found = index.search(words.match(question), CANDIDATES)
        pieces = index.pieces([number for number, _ in found])
        asked = words.terms(question)
        history = bool({term.lower() for term in asked} & HISTORY)
        told = _changelog_lines(asked) if history else frozenset()
        scored = [(number, score * _structure(pieces[number], asked, history, told)) for number, score in found]
        return sorted(scored, key=lambda row: (-row[1], row[0]))[:limit]


def _changelog_lines(asked: list[str]) -> frozenset[int]:
    """First lines of the newest changelog entry that renames or removes each of the names asked for."""
    told = set()
    for term in asked:
        row = next((row for row in changelog.find(term) if row.weight(term) >= 2), None)
        if row is not None:
            told.add(row.lines[0])
    return frozenset(told)


def _structure(piece: Piece, asked: list[str], history: bool, told: frozenset[int] = frozenset()) -> float:
    """A factor around 1."""
    anchor = piece.anchor.lower()
    heading = f"{piece.title} {piece.anchor}".lower()
    text = piece.text.lower()
    factor = 1.0
    covered = sum(_stem(term) in text or _stem(term) in heading for term in asked) / max(1, len(asked))
    factor *= 0.4 + 0.6 * covered
    factor *= 1.0 + 0.25 * sum(_stem(term) in heading for term in asked) / max(1, len(asked))
    last = anchor.replace("_", "-").rsplit("-", 1)[-1]
    for term in asked:
        lowered = term.lower()
        if lowered == anchor:
            factor *= 1.8
        elif lowered == last and len(lowered) > 2:
            factor *= 1.25
    if piece.part == "changelog":
        factor *= 1.0 if history else 0.7
        factor *= 1.3 if anchor.startswith(NEWEST) else 1.0
        factor *= 2.5 if piece.first in told else 1.0
    if piece.part == "rules":
        factor *= 0.85
    if anchor.startswith("default-"):
        factor *= 0.6  # only points to the attribute's own entry
    return factor


def _stem(term: str) -> str:
    """The part of a word that its forms share, roughly; identifiers stay whole."""
    lowered = term.lower()
    if words.is_identifier(term) or len(lowered) < 5:
        return lowered
    for ending in ("ations", "ation", "ings", "ing", "ness", "ies", "ied", "ed", "es", "s", "e", "y"):
        if lowered.endswith(ending) and len(lowered) - len(ending) >= 4:
            return lowered[: -len(ending)]
    return lowered


def fuse(rankings: Sequence[list[tuple[int, float]]], limit: int) -> list[tuple[int, float]]:
    """One ranking as it is; several by reciprocal rank."""
    if len(rankings) == 1:
        return rankings[0][:limit]
    total: dict[int, float] = {}
    for ranking in rankings:
        for place, (number, _) in enumerate(ranking):
            total[number] = total.get(number, 0.0) + 1 / (FUSION_CONSTANT + place + 1)
    return sorted(total.items(), key=lambda row: (-row[1], row[0]))[:limit]
