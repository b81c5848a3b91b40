"""Assets of every source by what they are: by words, then by meaning, and by size; and the looks that fit."""

import os
import re
from collections import defaultdict
from contextlib import suppress
from difflib import SequenceMatcher
from functools import lru_cache
from math import log10
from time import monotonic
from typing import TYPE_CHECKING, Any

from worldkit.robots import packaged

from . import words
from .answers import AssetHit, AssetList, LookHit

if TYPE_CHECKING:
    import numpy as np

    from ..intake.libraries import Offer

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
MEANT, LIKELY, AHEAD = 0.5, 0.35, 0.1
"""Cosine from which on a text means an asset; or, where no word fits, from which on the first does that is so far ahead."""
LEAST_OF_MEANING = 0.01
"""The score of what fits by meaning alone is its cosine times this, so that any word comes first."""
LATER, LAST = 0.5, 4.0
"""Words that an offer of a library is put behind an asset that is there: one that was looked at and chosen, and any other."""
FRESH_S = 1.0
"""So long the texts of known assets are not looked at for changes: of ten thousand that is half of what a question costs."""
MOST_KNOWN = 200
"""Keys that are told when nothing fits, and assets that are told by meaning."""


def find(query: str, limit: int, height_m: float | None = None) -> AssetList:
    """The assets that fit, best first, before all the one that is called so; every key when none does.

    Args:
        query: what the thing is, in words.
        limit: how many.
        height_m: about how high it is to stand; of two that fit alike, the one nearer to it comes first.
    """
    known = _known()
    asked = _stems(" ".join(words.terms(query)))
    scores = known.by_words(asked)
    exact = known.named(query)
    for number in exact:
        scores[number] = max(scores.get(number, 0.0), 1.0)
    for number, near in known.by_meaning(query, bool(scores)):
        scores.setdefault(number, LEAST_OF_MEANING * near)
    if height_m:
        for number in scores:
            apart = abs(log10(known.rows[number].height_m / height_m))
            scores[number] = scores[number] / (1 + apart)
    order = sorted(scores, key=lambda number: (number not in exact, -scores[number], known.rows[number].key))[:limit]
    hits = tuple(known.rows[number].model_copy(update={"score": round(scores[number], 4)}) for number in order)
    everything = () if hits else tuple(sorted(row.key for row in known.rows if row.taken_in))[:MOST_KNOWN]
    way = "" if hits else _otherwise()
    return AssetList(query=query, assets=hits, known=everything, looks=_looks(asked), next_move=way)


def _otherwise() -> str:
    """How to come by a thing that is in no source: of a picture where a server is named, else by code; the plan says which."""
    from ..intake import minters

    ready = [name for name in minters.SEAM.names() if minters.SEAM.find(name).TERMS.ready()]
    minted = f"ask the person to type `worldwright asset mint PICTURE HEIGHT --server {ready[0]}`; or " if ready else ""
    alone = "" if ready else " (no server that makes meshes is named here)"
    return f"{minted}sculpt it (skill sculpting) or build it of primitives{alone}, and list under `inferred` what stands for it"


def count() -> int:
    """How many assets all sources have, those that libraries offer left out."""
    return sum(row.taken_in for row in _known().rows)


class _Known:
    """Every readable asset of every source and every offer of a library, by number, with the words that each is found by."""

    def __init__(self, sources: dict[str, str], offers: "dict[str, Offer]") -> None:
        from worldkit import assets

        robots = packaged.found()
        self.wanted = (tuple(sources.items()), tuple(offers), tuple(robots))
        held = list(assets.entries())
        self._paths = tuple((f"{asset.folder}/asset.yaml", f"{asset.folder}/{asset.key}.yaml") for asset in held)
        self.stamps, self._looked = self._stamps(), monotonic()
        self.rows: list[AssetHit] = []
        self.texts: list[str] = []
        self._own: dict[str, set[int]] = defaultdict(set)
        self._other: dict[str, set[int]] = defaultdict(set)
        self._names: list[tuple[str, ...]] = []
        for asset in held:
            self._add(_hit(asset, sources.get(asset.key, "")), asset.key, f"{asset.category} {asset.description}")
        for offer in offers.values():
            if offer.key not in sources:
                self._add(_offered(offer), offer.name, f"{offer.category} {offer.words}")
        for robot in packaged.ROBOTS.values():
            if robot.key not in sources:
                kind, _, other = robot.words.partition(", ")
                self._add(_robot(robot, robot.key in robots), f"{robot.key} {kind}", other)
        self._near = lru_cache(maxsize=4096)(self._nearly)

    def _add(self, row: AssetHit, name: str, other: str) -> None:
        number = len(self.rows)
        self.rows.append(row)
        self.texts.append(f"{name.replace('_', ' ')}: {row.description}, {row.category}")
        self._names.append(tuple(_stems(name)))
        for word in self._names[-1]:
            self._own[word].add(number)
        for word in _stems(other):
            self._other[word].add(number)

    def stands(self, sources: dict[str, str], offers: "dict[str, Offer]") -> bool:
        """Whether nothing was added or removed since it was read, nor, as of at most `FRESH_S` ago, written anew."""
        now = (tuple(sources.items()), tuple(offers), tuple(packaged.found()))
        if self.wanted != now:
            return False
        if monotonic() - self._looked < FRESH_S:
            return True
        kept = self.stamps == self._stamps()
        self._looked = monotonic()
        return kept

    def _stamps(self) -> tuple[int, ...]:
        """When the text that describes each asset was written last; 0 where it is gone."""
        return tuple(_changed(*paths) for paths in self._paths)

    def by_words(self, asked: list[str]) -> dict[int, float]:
        """Scores, above 0, of the assets whose name or description has a word of these."""
        totals: dict[int, float] = defaultdict(float)
        for term in asked:
            close: dict[int, float] = {}
            for word, ratio in self._near(term):
                for number in self._own[word]:
                    close[number] = max(close.get(number, 0.0), ratio)
            for number, ratio in close.items():
                totals[number] += 3 * ratio
            for number in self._other.get(term, ()):
                if number not in close:
                    totals[number] += 1.0
        found = {}
        for number, total in totals.items():
            spare = sum(word not in asked for word in self._names[number])  # of two tables the plain one comes first
            later = 0.0 if self.rows[number].taken_in else LATER if self.rows[number].chosen else LAST
            if (score := round(total - 0.1 * (spare + later), 3)) > 0:
                found[number] = score
        return found

    def named(self, query: str) -> set[int]:
        """The assets that are called just so, in however common words."""
        wanted = tuple(_stems(query))
        return {number for number, name in enumerate(self._names) if name == wanted}

    def _nearly(self, term: str) -> tuple[tuple[str, float], ...]:
        """Words of names that a term is, or is but for a typing error, each with the likeness."""
        if term in self._own:
            return ((term, 1.0),)
        alike = [word for word in self._own if abs(len(word) - len(term)) <= 2]
        rated = [(word, SequenceMatcher(None, term, word).ratio()) for word in alike]
        return tuple((word, ratio) for word, ratio in rated if ratio > TYPO)

    def by_meaning(self, query: str, named: bool) -> list[tuple[int, float]]:
        """Assets that a text means, each with its cosine; none where the model of meaning is not installed."""
        from . import semantic

        if not self.rows or not query.strip() or not semantic.installed():
            return []
        from .semantic.model import encode_plainly

        near = _vectors(tuple(self.texts)) @ encode_plainly([query])[0]
        order = near.argsort()[::-1][:MOST_KNOWN]
        found = [(int(number), float(near[number])) for number in order if near[number] >= MEANT]
        if not found and not named:
            here = [
                number for number in order if self.rows[number].taken_in
            ]  # what is only offered is no rival, and comes second
            for first in (*here[:1], order[0]):
                second = next((float(near[number]) for number in here if number != first), 0.0)
                if near[first] >= LIKELY and near[first] - second >= AHEAD:
                    return [(int(first), float(near[first]))]
        return found


_HELD: list[_Known] = []


def _known() -> _Known:
    from worldkit.assets import catalog

    from ..intake import libraries

    sources, offers = catalog.sources(), libraries.offers()
    if not (_HELD and _HELD[0].stands(sources, offers)):
        _HELD[:] = [_Known(sources, offers)]
    return _HELD[0]


def _changed(*paths: str) -> int:
    for path in paths:
        try:
            return os.stat(path).st_mtime_ns  # noqa: PTH116 (ten thousand of them at each question)
        except OSError:
            continue
    return 0


@lru_cache(maxsize=2)
def _vectors(texts: tuple[str, ...]) -> "np.ndarray":
    """The vectors (N, 384) of texts; what was embedded once, by whichever process, is not embedded again."""
    import hashlib
    import sqlite3

    import numpy as np

    from .semantic import store
    from .semantic.model import encode_plainly

    digests = [hashlib.sha256(f"asset {text}".encode()).hexdigest() for text in texts]
    names, kept = store.everything()
    row = {name: number for number, name in enumerate(names)}
    missing = [number for number, digest in enumerate(digests) if digest not in row]
    fresh = encode_plainly([texts[number] for number in missing]) if missing else np.zeros((0, 384), dtype=np.float32)
    if missing:
        with suppress(OSError, sqlite3.Error):  # where nothing can be kept they are made anew each time
            store.append([digests[number] for number in missing], fresh)
    found = np.zeros((len(texts), 384), dtype=np.float32)
    for place, number in enumerate(missing):
        found[number] = fresh[place]
    for number, digest in enumerate(digests):
        if digest in row:
            found[number] = kept[row[digest]]
    return found


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


def _hit(asset: Any, source: str) -> AssetHit:
    height = float(asset.metric_height)
    picture = asset.thumbnail if asset.thumbnail.is_file() else None
    place = "catalog" if source == "recipes" else str(asset.folder.parent)
    return AssetHit(
        key=asset.key,
        category=asset.category,
        description=asset.description,
        extents_m=tuple(round(float(v), 4) for v in asset.extents(height)),
        height_m=height,
        mass_kg=round(float(asset.mass_at(height)), 4),
        thumbnail=f"{place}/{picture.parent.name}/{picture.name}" if picture else "",
        source=source,
        licence=asset.licence,
        creator=asset.creator,
    )


def _robot(robot: packaged.Robot, here: bool) -> AssetHit:
    """A robot of a wheel, installed or not; no tool lays it out, and a confined agent's shell may not."""
    typed = f"worldwright asset robot {robot.key} runs/NAME/{robot.key}"
    return AssetHit(
        key=robot.key,
        category="robot",
        description=robot.words,
        extents_m=robot.extents,
        height_m=robot.extents[2],
        source=f"wheel {robot.wheel}",
        licence=packaged.licence(robot) if here else robot.licence,
        creator=robot.creator,
        taken_in=False,
        chosen=here,
        next_move=f"ask the person to type `{typed if here else robot.installing}`",
    )


def _offered(offer: "Offer") -> AssetHit:
    return AssetHit(
        key=offer.key,
        category=offer.category,
        description=offer.described(),
        extents_m=tuple(round(side, 4) for side in offer.extents),
        height_m=round(offer.extents[2], 4),
        source=offer.library,
        licence=offer.licence,
        creator=offer.creator,
        taken_in=False,
        chosen=offer.chosen,
        next_move=f"worldwright asset add {offer.key}",
    )
