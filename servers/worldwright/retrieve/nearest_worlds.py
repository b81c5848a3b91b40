"""The accepted worlds and worked cases that are nearest to a sentence: by mechanism first, then by words and by meaning.

A world of the same mechanism teaches a plan what its words cannot: a tetherball shows a yo-yo its string, another toy does not.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from ..model.errors import WorldwrightError
from ..model.evidence.run import Run
from ..model.plan.committed import Plan
from ..model.plan.plan_text import read_plan
from . import lexical, mechanisms, semantic, thesaurus, words

if TYPE_CHECKING:
    import numpy as np

CHECKOUT = Path(__file__).resolve().parents[3]
SKILLS = CHECKOUT / "skills"
"""Of their pages, `references/NAME` with a plan and a film is a worked case, which tests run; it has no stamp."""
SHARED_WEIGHT = 1.0
"""Of the share of the sentence's mechanisms that a world has."""
WORD_WEIGHT = 0.06
"""Of BM25 over the worlds' texts."""
MEANT_WEIGHT = 0.3
"""Of the thesaurus' words beside the sentence's own."""
REST_WEIGHT = 0.5
"""Of the mean of a world's three nearest sentences beside its nearest one."""

LONG_WEIGHT = 0.015
"""Taken off for each thousand bytes of a plan: a long one is more to read, and more to change."""
SHORT = 4.0
"""Thousand bytes: a plan that is shorter than that is not nearer for it."""

APART = ("robot",)
"""Mechanisms that come with things of their own (a wheel's files): a world of one is no model for a sentence that names none."""
APART_WEIGHT = 1.0


@dataclass(frozen=True)
class World:
    """An accepted world or a worked case, as far as a new plan may begin with it."""

    folder: Path
    plan: Plan
    prompt: str

    @property
    def slug(self) -> str:
        """The name of its folder."""
        return self.folder.name

    @cached_property
    def mechanisms(self) -> tuple[str, ...]:
        """What makes it happen, by plan and prompt."""
        found = {*mechanisms.of_plan(self.plan), *mechanisms.of_sentence(self.prompt)}
        return tuple(row.name for row in mechanisms.table() if row.name in found)

    def sentences(self) -> list[str]:
        """What it is about: the prompt, the title, each claim that is measured."""
        return [self.prompt, self.plan.title, *(one.claim for one in self.plan.objectives if one.expect)]


@dataclass(frozen=True)
class Near:
    """A world and how near it is."""

    world: World
    score: float
    shared: tuple[str, ...]
    """Mechanisms that it has in common with the sentence."""


def worlds(runs: Path = Path("runs")) -> Iterator[World]:
    """The examples, the worked cases, then the user's runs that are accepted; one that cannot be read is passed over."""
    seen = set()
    for top, where in ((CHECKOUT / "examples", "*/plan.md"), (SKILLS, "*/references/*/film.py"), (runs, "*/plan.md")):
        for path in sorted(top.glob(where)):
            run = Run(path.parent)
            if run.name in seen or not (top == SKILLS or (run.stamped / "stamp.json").is_file()):
                continue
            try:
                plan = read_plan(run.plan).plan
            except WorldwrightError:
                continue
            seen.add(run.name)
            prompt = run.prompt.read_text(encoding="utf-8", errors="replace").strip() if run.prompt.is_file() else ""
            yield World(run.folder, plan, prompt or plan.title)


def nearest(sentence: str, known: list[World]) -> list[Near]:
    """Every world, the nearest first.

    Args:
        sentence: what should happen.
        known: the worlds to choose from.
    """
    if not known:
        return []
    asked = mechanisms.of_sentence(sentence)
    scores = WORD_WEIGHT * _spoken(sentence, known) + _meant(sentence, known)
    found = []
    for world, score in zip(known, scores, strict=True):
        shared = tuple(name for name in asked if name in world.mechanisms)
        length = max(SHORT, (world.folder / "plan.md").stat().st_size / 1000)
        common = SHARED_WEIGHT * len(shared) / max(1, len(asked))
        apart = sum(name in world.mechanisms for name in APART if name not in asked)
        found.append(Near(world, float(score) + common - LONG_WEIGHT * length - APART_WEIGHT * apart, shared))
    # Of worlds that are as near as each other, the one about the fewest other things is the easier to change.
    return sorted(found, key=lambda near: (-round(near.score, 2), len(near.world.mechanisms), near.world.slug))


def _spoken(sentence: str, known: list[World]) -> "np.ndarray":
    """(N,) BM25 of the worlds for the words of the sentence."""
    pieces: list[tuple[list[str], list[str], list[str]]] = [
        (words.counted(f"{one.plan.title} {one.prompt}"), [], words.counted(_text(one))) for one in known
    ]
    weights = words.asked(sentence)
    for meant in thesaurus.expand(sentence):
        for form in words.forms(meant):
            weights.setdefault(form, MEANT_WEIGHT)
    stored = {term: (numbers, shares) for term, numbers, shares in lexical.shares(pieces) if term in weights}
    return lexical.score(stored, weights, len(known))[1:]


def _text(world: World) -> str:
    """Claims, what measures them, and the names and roles of things."""
    plan = world.plan
    parts = [f"{one.claim} {' '.join(name for row in one.expect for name in row)}" for one in plan.objectives]
    parts += [f"{one.name} {one.role}" for one in plan.scene_objects] + [one.name for one in plan.assets]
    return " ".join(parts)


def _meant(sentence: str, known: list[World]) -> "np.ndarray":
    """(N,) nearness in meaning, 0 to 1.5; zeros where the model of meanings is not installed."""
    import numpy as np

    if not semantic.installed():
        return np.zeros(len(known), dtype=np.float32)
    from .semantic.model import encode_plainly

    said = [world.sentences() for world in known]
    texts = [text[:1000] for one in said for text in one]
    vectors = dict(_ENCODED)
    new = [text for text in dict.fromkeys(texts) if text not in vectors]
    if new:
        vectors |= zip(new, encode_plainly(new), strict=True)
    (asked,) = encode_plainly([sentence[:1000]])  # by itself: its vector is the same whatever was asked before
    _ENCODED.clear()
    _ENCODED.update((text, vectors[text]) for text in texts)
    near = np.stack([vectors[text] for text in texts]) @ asked
    found, first = [], 0
    for texts in said:
        mine = np.sort(near[first : first + len(texts)])[::-1]
        first += len(texts)
        found.append(mine[0] + REST_WEIGHT * mine[:3].mean())
    return np.array(found, dtype=np.float32)


_ENCODED: "dict[str, np.ndarray]" = {}
"""Vectors of what the worlds of the last question say, by text: seconds of a processor, and the same for every sentence."""
