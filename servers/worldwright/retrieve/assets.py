"""Catalog assets by what they are, and the looks that fit: a small match of word stems over names and descriptions."""

import re
from difflib import SequenceMatcher
from typing import Any

from . import words
from .answers import AssetHit, AssetList, LookHit

SAME = {
    "boulder": "stone",
    "metal": "steel",
    "pebble": "stone",
    "porcelain": "ceramic",
    "rock": "stone",
    "soccer": "football",
    "timber": "wood",
    "wooden": "wood",
}
"""Words that people use for a look, each with the word in the look's name."""
MOST_LOOKS = 4
TYPO = 0.8
"""Similarity from which on a word counts as an asset's name with a typing error."""


def find(query: str, limit: int) -> AssetList:
    """The assets whose words fit, best first; every key when none does."""
    known = _catalog()
    asked = _stems(" ".join(words.terms(query)))
    scored = sorted(((_score(asset, asked), key) for key, asset in known.items()), key=lambda row: (-row[0], row[1]))
    hits = tuple(_hit(known[key], score) for score, key in scored[:limit] if score > 0)
    return AssetList(query=query, assets=hits, known=() if hits else tuple(known), looks=_looks(asked))


def count() -> int:
    """How many assets the catalog has."""
    return len(_catalog())


def _catalog() -> dict[str, Any]:
    """Every readable asset by key, from whatever source; one broken entry must not hide the others."""
    from worldkit import assets

    found = {}
    for key in assets.keys():  # noqa: SIM118 - a function of the catalog, not a mapping
        try:
            found[key] = assets.find(key)
        except (assets.AssetError, OSError):
            continue
    return found


def _score(asset: Any, asked: list[str]) -> float:
    own, other = _stems(asset.key), _stems(f"{asset.category} {asset.description}")
    total = 0.0
    for term in asked:
        close = max((SequenceMatcher(None, term, word).ratio() for word in own), default=0.0)
        if close > TYPO:
            total += 3 * close
        elif term in other:
            total += 1.0
    spare = sum(word not in asked for word in own)  # of two tables the plain one comes first
    return round(max(total - 0.1 * spare, 0.0), 3)


def _looks(asked: list[str]) -> tuple[LookHit, ...]:
    """The looks whose name or description the words fit, best first."""
    from worldkit.materials import LOOKS

    wanted = {SAME.get(term, term) for term in asked} | set(asked)
    scored = []
    for place, (name, description) in enumerate(LOOKS.items()):
        score = 2 * len(wanted & {*_stems(name)}) + len(wanted & {*_stems(description)})
        if score:
            scored.append((-score, place, LookHit(name=name, description=description)))
    return tuple(hit for *_, hit in sorted(scored, key=lambda row: row[:2])[:MOST_LOOKS])


def _stems(text: str) -> list[str]:
    """The words of a text, identifiers in their parts, in the singular.

    >>> _stems("wooden boxes, berries and a pool_table of glass")
    ['wooden', 'box', 'berry', 'and', 'a', 'pool', 'table', 'of', 'glass']
    """
    return [_singular(part.lower()) for token in words.tokens(text) for part in words.parts(token)]


def _singular(word: str) -> str:
    if len(word) > 4 and word.endswith("ies"):
        return word[:-3] + "y"
    if re.search(r"(s|x|z|ch|sh)es$", word):
        return word[:-2]
    return word[:-1] if len(word) > 3 and word.endswith("s") and not word.endswith("ss") else word


def _hit(asset: Any, score: float) -> AssetHit:
    height = float(asset.metric_height)
    picture = asset.thumbnail if asset.thumbnail.is_file() else None
    return AssetHit(
        key=asset.key,
        category=asset.category,
        description=asset.description,
        extents_m=tuple(round(float(v), 4) for v in asset.extents(height)),
        height_m=height,
        mass_kg=round(float(asset.mass_at(height)), 4),
        thumbnail=f"catalog/{picture.parent.name}/{picture.name}" if picture else "",
        score=score,
    )
