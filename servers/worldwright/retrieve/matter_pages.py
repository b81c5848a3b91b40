"""The reference page or worked case of a skill that is about a sentence's very matter: honey, snow, a balloon, a flag.

Nobody lists them: a page is known by its title and by the sentences of its skill that cite it, a case by its plan's. Of shared words
the rare ones count, so that `falls` or `runs` alone names no page.
"""

import math
import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from . import words
from .nearest_worlds import SKILLS, World

MOST = 2
RARE, WHOLE = 3.0, 6.0
"""Natural logarithms of rarity: what a page of the mechanism's skill shares with the sentence, and one of any other skill."""
CITED_WEIGHT = 0.7
"""Of a word that only the skill says of its page, beside one of the page's own title."""
_SENTENCES = re.compile(r"(?<=\.)\s+(?=[A-Z])|\n\s*\n|\n(?=[|-])")


@dataclass(frozen=True)
class Page:
    """A page or a case, by what it is called."""

    path: str
    """Beneath the checkout: `skills/media/references/honey.md`, or a folder."""
    skill: str
    title: str
    cited: str = ""
    """What its skill says of it."""


def about(sentence: str, skills: tuple[str, ...], known: list[World]) -> tuple[Page, ...]:
    """The pages about the matter of a sentence, the nearest first; none rather than one that shares only common words.

    Args:
        sentence: what should happen.
        skills: those of the sentence's mechanisms; a page of another skill has to share more.
        known: the worlds, of which the cases of skills are pages too; what all of them say tells which words are rare.
    """
    pages = list(_pages(known))
    texts = [_terms(" ".join(world.sentences())) for world in known] + [_terms(page.title) for page in pages]
    often, asked = Counter(term for text in texts for term in text), _terms(sentence)

    def rarity(term: str) -> float:
        return math.log(len(texts) / max(1, often[term]))

    found = []
    for page in pages:
        titled = asked & _terms(page.title)
        shared = sum(map(rarity, titled)) + CITED_WEIGHT * sum(map(rarity, asked & _terms(page.cited) - titled))
        if shared >= (RARE if page.skill in skills else WHOLE):
            # Rounded: in which order a set is summed must not say which of two pages alike comes first.
            found.append((-round(shared, 6), page.path, page))
    return tuple(page for *_, page in sorted(found, key=lambda one: one[:2])[:MOST])


def _pages(known: list[World]) -> Iterator[Page]:
    for path in sorted(SKILLS.glob("*/references/*.md")):
        yield _page(path, path.read_text(encoding="utf-8").partition("\n")[0].lstrip("# "))
    for world in known:
        if world.folder.is_relative_to(SKILLS):
            yield _page(world.folder, world.plan.title)


def _page(path: Path, title: str) -> Page:
    own = path.relative_to(SKILLS)
    place = f"skills/{own.as_posix()}"
    page = (SKILLS / own.parts[0] / "SKILL.md").read_text(encoding="utf-8")
    cited = [re.sub(r"`[^`]*`", "", said) for said in _SENTENCES.split(page) if place in said]
    return Page(place, own.parts[0], title, " ".join(cited))


def _terms(text: str) -> set[str]:
    return {form for word in words.terms(text) for form in words.forms(word)}
