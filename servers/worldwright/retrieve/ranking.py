"""From rankings to an answer: each is sharpened by structure, then they are fused by reciprocal rank.

A `Ranker` gives (piece id, score) for a question: full text always, vectors when the `semantic` extra is there.
"""

from collections.abc import Sequence
from typing import Protocol

from ..simulator import changelog, installed
from . import thesaurus, words
from .index import Index, Piece

FUSION_CONSTANT = 10
"""Reciprocal rank fusion's k (Cormack, Clarke and Büttcher 2009 use 60, for many rankings; two good ones want a steeper one)."""
PART_WEIGHT = {"rules": 0.7, "api": 0.6, "python": 0.55, "examples": 0.5, "catalog": 0.8, "sources": 0.9}
"""The manual explains what declarations and code only show."""
MEANING_WEIGHT = 0.5
"""Of the vectors' ranks beside full text's, chosen on the tuning half of the question set."""
CANDIDATES = 80
MEANT_WEIGHT = 0.7
"""Of the thesaurus' words beside the question's own."""
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
"""Pages about something else than the engine itself, and the words that ask for them."""
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
        found = dict(index.search(words.match(question), CANDIDATES))
        meant = " ".join(thesaurus.expand(question))
        for number, score in index.search(words.match(meant), CANDIDATES) if meant else ():
            found[number] = found.get(number, 0.0) + MEANT_WEIGHT * score
        return sharpen(index, f"{question} {meant}", list(found.items()))[:limit]


def sharpen(index: Index, question: str, found: list[tuple[int, float]]) -> list[tuple[int, float]]:
    """A ranking again, each score times what the piece's structure says of the question."""
    pieces = index.pieces([number for number, _ in found])
    asked = words.terms(question)
    history = bool({term.lower() for term in asked} & HISTORY)
    told = _changelog_lines(asked) if history else frozenset()
    scored = [(number, score * _structure(pieces[number], asked, history, told)) for number, score in found]
    return sorted(scored, key=lambda row: (-row[1], row[0]))


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
    factor *= PART_WEIGHT.get(piece.part, 1.0)
    for place, called in ASIDE.items():
        if piece.path.startswith(place) and not called & {term.lower() for term in asked}:
            factor *= 0.6
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


def fuse(
    rankings: Sequence[list[tuple[int, float]]], limit: int, weights: Sequence[float] = ()
) -> list[tuple[int, float]]:
    """One ranking as it is; several by weighted reciprocal rank."""
    if len(rankings) == 1:
        return rankings[0][:limit]
    total: dict[int, float] = {}
    for ranking, weight in zip(rankings, weights or [1.0] * len(rankings), strict=True):
        for place, (number, _) in enumerate(ranking):
            total[number] = total.get(number, 0.0) + weight / (FUSION_CONSTANT + place + 1)
    return sorted(total.items(), key=lambda row: (-row[1], row[0]))[:limit]


def collapse(ranked: list[tuple[int, float]], pieces: dict[int, Piece]) -> list[tuple[int, float]]:
    """Without the declaration of something that a better place has already answered."""
    seen: set[str] = set()
    kept = []
    for number, score in ranked:
        piece = pieces[number]
        if piece.part == "api" and piece.anchor in seen:
            continue
        seen.add(piece.anchor)
        kept.append((number, score))
    return kept
