"""The eighty prompts of the reference's set: two of each of forty subcategories, in eight categories of ten."""

from functools import cache
from importlib.resources import files

from worldkit import quick_yaml

from ..model.frozen import Frozen

FILE = "eighty_prompts.yaml"


class Prompt(Frozen):
    """One of them: the physics-level sentence that a world is built from."""

    id: str
    category: str
    subcategory: str
    prompt: str


@cache
def prompts() -> tuple[Prompt, ...]:
    """All of them, in the order of the set."""
    rows = quick_yaml.read(files(__package__).joinpath(FILE).read_text(encoding="utf-8"))
    return tuple(Prompt(**row) for row in rows)
