"""Catalog assets by what they are: a small word match over key, category and description."""

from difflib import SequenceMatcher
from typing import Any

from . import words
from .answers import AssetHit, AssetList


def find(query: str, limit: int) -> AssetList:
    """The assets whose words fit, best first; every key when none does."""
    known = _catalog()
    asked = [term.lower() for term in words.terms(query)]
    scored = sorted(((_score(asset, asked), key) for key, asset in known.items()), key=lambda row: (-row[0], row[1]))
    hits = tuple(_hit(known[key], score) for score, key in scored[:limit] if score > 0)
    return AssetList(query=query, assets=hits, known=() if hits else tuple(known))


def count() -> int:
    """How many assets the catalog has."""
    return len(_catalog())


def _catalog() -> dict[str, Any]:
    """Every readable asset by key; one broken folder must not hide the others."""
    from worldkit import assets

    found = {}
    for key in assets.keys():  # noqa: SIM118 - a function of the catalog, not a mapping
        try:
            found[key] = assets.find(key)
        except (assets.AssetError, OSError):
            continue
    return found


def _score(asset: Any, asked: list[str]) -> float:
    own = words.tokens(f"{asset.key.replace('_', ' ')}".lower())
    other = words.tokens(f"{asset.category} {asset.description}".lower())
    total = 0.0
    for term in asked:
        close = max((SequenceMatcher(None, term, word).ratio() for word in own), default=0.0)
        if close > 0.8:
            total += 3 * close
        elif any(word == term or (len(term) > 3 and word.startswith(term[:-1])) for word in other):
            total += 1.0
    return round(total, 3)


def _hit(asset: Any, score: float) -> AssetHit:
    height = float(asset.metric_height)
    thumbnail = getattr(asset, "thumbnail", None)
    return AssetHit(
        key=asset.key,
        category=asset.category,
        description=asset.description,
        extents_m=tuple(round(float(v), 4) for v in asset.extents(height)),
        height_m=height,
        mass_kg=round(float(asset.mass_at(height)), 4),
        thumbnail=f"catalog/{asset.key}/{thumbnail.name}" if thumbnail else "",
        score=score,
    )
