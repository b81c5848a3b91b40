"""Beginning a plan: the run folder, the nearest world's plan adapted, and what to read for its mechanism."""

import re
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import GateError, NotFoundError
from ..model.evidence.run import Run
from ..model.plan import taken_along
from ..model.plan.begun import begun
from ..model.plan.plan_text import parse_plan
from ..model.storage import writing
from . import matter_pages, mechanisms, words
from .answers import Begun, NearWorld, PageToRead, SkillToRead
from .nearest_worlds import Near, World, nearest, worlds

SHOWN, MOST_SKILLS, LEAST_SKILLS = 3, 4, 2
RUNS = Path("runs")
OTHERWISE = "contacts-and-friction"
"""The skill of a sentence that names no mechanism: things touch in every world."""


def begin(sentence: str, like: str | None, run: str | None) -> Begun:
    """Make the folder and write prompt.md and plan.md; an existing plan is never overwritten.

    Raises:
        GateError: the folder holds a plan.
        NotFoundError: there is no accepted world of that name, or none at all, or the sentence has no words.
    """
    sentence = " ".join(sentence.split())
    folder = _folder(sentence, run)
    target = Run(folder)
    if target.plan.exists():
        raise GateError(
            "this folder has a plan, which is not overwritten",
            place=str(target.plan),
            next_move=f"go on with it (`worldwright go {folder}`), or name another run",
        )
    known = list(worlds())
    ranked = nearest(sentence, known)
    chosen = _named(like, known) if like else ranked[0].world if ranked else _named("", known)
    text = begun(
        (chosen.folder / "plan.md").read_text(encoding="utf-8"), sentence, chosen.slug, f"{chosen.slug}/plan.md"
    )
    with writing("the new plan", target.folder):
        target.folder.mkdir(parents=True, exist_ok=True)
        if not target.prompt.exists():
            write_atomic(target.prompt, f"{sentence}\n")
        for name, content in taken_along.of(chosen.folder).items():
            write_atomic(target.folder / name, content)
        write_atomic(target.plan, text)
    target.log("retrieve", "plan", like=chosen.slug)
    asked = mechanisms.of_sentence(sentence)
    pages = matter_pages.about(sentence, mechanisms.skills(asked), known)
    return Begun(
        run=str(folder),
        plan=str(folder / "plan.md"),
        like=chosen.slug,
        nearest=tuple(_shown(near, asked) for near in ranked[:SHOWN]),
        pages=tuple(PageToRead(path=page.path, title=page.title) for page in pages),
        skills=_skills(sentence, chosen),
        to_change=tuple(line for line in parse_plan(text).plan.copied if isinstance(line, int)),
        film=str(filmed) if (filmed := chosen.folder / "film.py").is_file() else "",
        next_move=f"change what the plan marks TO_CHANGE, remove the marks, then `worldwright go {folder}`",
    )


def slug(sentence: str) -> str:
    """A folder's name: the first words of a sentence that carry meaning.

    >>> slug("A yo-yo rises and falls on its string")
    'yo-yo-rises-falls-string'
    """
    spoken = [word for word in re.findall(r"[a-z0-9]+(?:-[a-z0-9]+)*", sentence.lower()) if word not in words.STOP]
    return "-".join(spoken[:4])[:60].strip("-")


def _folder(sentence: str, run: str | None) -> Path:
    """The folder that is meant; a bare name lies under runs/."""
    named = run or slug(sentence)
    if not named:
        raise NotFoundError("the sentence says nothing", next_move="say in words what should happen")
    path = Path(named)
    return RUNS / path if len(path.parts) == 1 else path


def _named(like: str, known: list[World]) -> World:
    """The world of a name, also given as its folder."""
    for world in known:
        if like and world.slug == Path(like).name:
            return world
    names = ", ".join(world.slug for world in known)
    raise NotFoundError(
        f"there is no accepted world '{like}'" if like else "there is no accepted world to begin from",
        place="examples, runs",
        next_move=f"name one of: {names}" if names else "write plan.md by hand (skill plan-format)",
    )


def _shown(near: Near, asked: tuple[str, ...]) -> NearWorld:
    """A world with what it has of the mechanisms, and what it has not."""
    missing = [name for name in asked if name not in near.shared]
    why = f"shares {', '.join(near.shared)}" if near.shared else "near in words and meaning alone"
    why += f"; has no {', '.join(missing)}" if missing else ""
    return NearWorld(slug=near.world.slug, title=near.world.plan.title, why=why, score=round(near.score, 2))


def _skills(sentence: str, world: World) -> tuple[SkillToRead, ...]:
    """The skills of the sentence's mechanisms; where these are few, those of the world begun from."""
    asked = mechanisms.of_sentence(sentence)
    found = list(mechanisms.skills(asked))[:MOST_SKILLS]
    for skill in (*mechanisms.skills(world.mechanisms), OTHERWISE, "materials"):
        if len(found) < LEAST_SKILLS and skill not in found:
            found.append(skill)
    return tuple(SkillToRead(name=name, why=", ".join(_why(name, asked, world))) for name in found)


def _why(skill: str, asked: tuple[str, ...], world: World) -> list[str]:
    own = [row.name for row in mechanisms.table() if row.skill == skill and row.name in asked]
    theirs = [row.name for row in mechanisms.table() if row.skill == skill and row.name in world.mechanisms]
    return own or [f"{name}, in {world.slug}" for name in theirs] or ["what touches"]
