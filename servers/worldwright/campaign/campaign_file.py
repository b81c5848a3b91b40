"""The words of a campaign's file: strict, small, and refused as a whole before anything is paid.

A campaign names plans (`plans`), prompts and who writes their worlds (`prompts`, `author`), or one plan and numbers of it that
are swept (`plan`, `sweep`). Each field of a sweep is an
axis of the grid (`values`, or `from`, `to`, `steps`) or is drawn anew for each of `draws` (`uniform`, `log_uniform`,
`normal`, `integers`): the worlds are grid times draws.
"""

import json
import math
import os
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, ValidationError, model_validator

from ..contract import harnesses
from ..model.errors import WorldwrightError
from ..model.evidence.build_steps import StepName
from ..model.frozen import Frozen
from .author_words import Author, Prices, Prompted

MOST_BYTES = 1 << 20
"""A campaign's file is a page, not a list of its worlds."""
MOST_WORLDS = 1_000_000
MOST_WORKERS = 4096
MOST_WHOLE = 1 << 53
"""Up to here, a plan's numbers hold every whole one."""
FAR = 40
"""Standard deviations beyond which nothing is ever drawn."""
DRAWN = ("uniform", "log_uniform", "normal", "integers")


class CampaignError(WorldwrightError):
    """A campaign that cannot be run as it is written; the message names the field and what may stand there."""

    code = "campaign"


def _no_truth(value: Any) -> Any:
    if isinstance(value, bool):
        raise ValueError("true and false are no numbers")
    return value


Number = Annotated[float, BeforeValidator(_no_truth), Field(allow_inf_nan=False)]
Count = Annotated[int, BeforeValidator(_no_truth), Field(ge=-MOST_WHOLE, le=MOST_WHOLE)]
Pair = tuple[Number, Number]


class Axis(Frozen):
    """The values of one field: exactly one way of saying them."""

    values: Annotated[tuple[Number, ...], Field(min_length=1, max_length=MOST_WORLDS)] | None = None
    start: Number | None = Field(None, alias="from")
    to: Number | None = None
    steps: Annotated[Count, Field(ge=1)] | None = None
    """How many values from `from` to `to`, both among them."""
    spacing: Literal["linear", "log"] = "linear"
    uniform: Pair | None = None
    log_uniform: Pair | None = None
    normal: Pair | None = None
    """Mean and standard deviation."""
    within: Pair | None = None
    """A normal draw beyond these ends is drawn again."""
    integers: tuple[Count, Count] | None = None

    @model_validator(mode="after")
    def _one_way(self) -> "Axis":
        ends = (self.start, self.to, self.steps)
        said = ["values"] * (self.values is not None) + ["from, to, steps"] * any(end is not None for end in ends)
        said += [name for name in DRAWN if getattr(self, name) is not None]
        if len(said) != 1:
            raise ValueError(
                f"say its values in one way, not {len(said)} ({'; '.join(said) or 'none'}): "
                f"`values: […]`, or `from`, `to` and `steps`, or one of {', '.join(DRAWN)}"
            )
        if any(end is not None for end in ends) and None in ends:
            raise ValueError("a range has `from`, `to` and `steps`")
        if self.values is not None and len(set(self.values)) < len(self.values):
            raise ValueError("a value stands twice: its worlds would be equal")
        if self.steps and self.steps > 1 and self.start == self.to:
            raise ValueError("a range of several steps has two ends")
        for name in ("uniform", "log_uniform", "integers", "within"):
            low, high = getattr(self, name) or (0, 1)
            if low >= high:
                raise ValueError(f"`{name}` is [low, high] with low < high")
        laid = None if self.start is None or self.to is None else (self.start, self.to)
        for name, span in (("from, to", laid), ("uniform", self.uniform)):
            if span and math.isinf(span[1] - span[0]):
                raise ValueError(f"`{name}` is wider than a number can say: from {span[0]:g} to {span[1]:g}")
        if self.normal and math.isinf(abs(self.normal[0]) + FAR * self.normal[1]):
            raise ValueError(f"`normal` draws what is no number: mean {self.normal[0]:g}, deviation {self.normal[1]:g}")
        if self.spacing == "log" and self.start and self.to and not 0 < self.to / self.start < math.inf:
            raise ValueError(f"a logarithmic scale from {self.start:g} to {self.to:g} is wider than a number can say")
        if self.normal and self.normal[1] <= 0:
            raise ValueError("`normal` is [mean, standard deviation], the latter above 0")
        if self.within and not self.normal:
            raise ValueError("`within` belongs to `normal`")
        if self.normal and self.within:
            (mean, deviation), (low, high) = self.normal, self.within
            if low > mean + 4 * deviation or high < mean - 4 * deviation:
                raise ValueError(
                    "`within` lies more than four standard deviations from the mean: nothing would be drawn"
                )
        if (self.log_uniform and self.log_uniform[0] <= 0) or (
            self.spacing == "log" and (self.start is None or self.to is None or min(self.start, self.to) <= 0)
        ):
            raise ValueError("a logarithmic scale needs ends above 0")
        return self

    @property
    def drawn(self) -> bool:
        """Whether its values are drawn, and not an axis of the grid."""
        return any(getattr(self, name) is not None for name in DRAWN)

    @property
    def length(self) -> int:
        """Points along it; 1 for a drawn field."""
        return len(self.values) if self.values is not None else self.steps or 1


class Sweep(Frozen):
    """Numbers of one plan that differ from world to world."""

    fields: Annotated[dict[str, Axis], Field(min_length=1)]
    """By path, as `simulation_parameters.masses.ball`, `scene_objects.ball.size[2]`."""
    draws: Annotated[Count, Field(ge=1)] = 1
    """How often the drawn fields are drawn, at each point of the grid."""
    seed: Annotated[Count, Field(ge=0)] = 0

    @model_validator(mode="after")
    def _drawn_for_something(self) -> "Sweep":
        if self.draws > 1 and not any(axis.drawn for axis in self.fields.values()):
            raise ValueError(f"`draws: {self.draws}` would make equal worlds: no field is drawn ({', '.join(DRAWN)})")
        return self

    @property
    def size(self) -> int:
        """How many worlds, counted without making them."""
        size = self.draws
        for axis in self.fields.values():
            size *= axis.length
        return size


class Given(Frozen):
    """One of several plans."""

    plan: str
    """The file, or its run folder, relative to the campaign's file."""
    category: str = ""
    prompt: str | None = None
    """The sentence that it is built from, where no prompt.md lies beside it."""


class Budget(Frozen):
    """When no further world is begun; what is under way ends."""

    seconds: Annotated[Number, Field(gt=0)] | None = None
    """Of all workers together."""
    runs: Annotated[Count, Field(ge=1)] | None = None
    """Physics passes."""
    usd: Annotated[Number, Field(gt=0)] | None = None
    """US dollars of authors; what is under way counts with `per_world.usd`."""


class PerWorld(Frozen):
    """When one world is given up."""

    seconds: Annotated[Number, Field(gt=0)] = 900.0
    begun: Annotated[Count, Field(ge=1)] = 3
    """How often it is begun in all: a world that takes its worker along is not begun for ever."""
    runs: Annotated[Count, Field(ge=1)] | None = None
    """Physics passes of its author."""
    usd: Annotated[Number, Field(gt=0)] | None = None
    """US dollars of its author, each time that it is begun."""


class Campaign(Frozen):
    """A campaign as its file says it."""

    name: Annotated[str, Field(pattern=r"^[a-z0-9][a-z0-9-]{0,63}$")] | None = None
    """Lower-case letters, digits, hyphens; the file's own name without it."""
    plan: str | None = None
    plans: Annotated[tuple[str | Given, ...], Field(min_length=1, max_length=MOST_WORLDS)] | None = None
    prompts: Annotated[tuple[str | Prompted, ...], Field(min_length=1, max_length=MOST_WORLDS)] | None = None
    author: Author | None = None
    """Who makes a world of each prompt."""
    sweep: Sweep | None = None
    category: str = ""
    until: StepName = "expect"
    """The step after whose group a world is done; `accept` stamps it."""
    pictures: bool = False
    """Draw the storyboard of each world after its physics."""
    report: bool = True
    """Write each world's report.html."""
    refine: bool = False
    workers: Annotated[Count, Field(ge=1, le=MOST_WORKERS)] | None = None
    """Worlds at work at once; as many as processors without it."""
    hands: Literal["auto", "ray", "processes"] = "auto"
    """`auto`: Ray where it is installed, else our own worker processes."""
    address: str = ""
    """Of a Ray cluster, as `host:port`; empty: this machine."""
    dashboard: bool = False
    """Open Ray's own page on this machine, which asks nobody for a password."""
    budget: Budget = Budget()
    per_world: PerWorld = PerWorld()

    @model_validator(mode="after")
    def _one_source(self) -> "Campaign":
        if sum(source is not None for source in (self.plan, self.plans, self.prompts)) != 1:
            raise ValueError("name one `plan`, or several `plans`, or `prompts` and their `author`")
        if (self.prompts is None) != (self.author is None):
            raise ValueError("`prompts` and `author` belong together: what is asked, and who makes a world of it")
        if self.sweep is not None and self.plan is None:
            raise ValueError("a sweep is over one `plan`")
        if self.address and self.hands == "processes":
            raise ValueError("an `address` is Ray's: `hands: ray`")
        if self.author is None and (self.budget.usd or self.per_world.usd or self.per_world.runs):
            raise ValueError("money, and `per_world.runs`, are an author's: without `author` nothing is bought")
        return self

    @property
    def given(self) -> tuple[Given, ...]:
        """The plans, or prompts, that it names."""
        if self.prompts is not None:
            asked = (one if isinstance(one, Prompted) else Prompted(prompt=one) for one in self.prompts)
            return tuple(Given(plan=one.file or "", category=one.category, prompt=one.prompt) for one in asked)
        named = self.plans if self.plans is not None else (str(self.plan),)
        return tuple(one if isinstance(one, Given) else Given(plan=one) for one in named)

    @property
    def size(self) -> int:
        """How many worlds."""
        return self.sweep.size if self.sweep else len(self.given)


def read(path: Path) -> Campaign:
    """The campaign of a file, with its name.

    Raises:
        CampaignError: it cannot be read, or asks for what cannot be run; the first problem, with its place.
    """
    try:
        with path.open("rb") as stream:
            data = stream.read(MOST_BYTES + 1)
        if len(data) > MOST_BYTES:
            raise CampaignError(
                f"the file is larger than {MOST_BYTES >> 20} MB",
                place=str(path),
                next_move="plans and prompts are files",
            )
        text = data.decode()
    except (OSError, ValueError) as cause:
        raise CampaignError(
            f"the campaign cannot be read: {getattr(cause, 'strerror', None) or cause}",
            place=str(path),
            next_move="name a text file of YAML (skill `campaign`)",
        ) from cause
    campaign = parse(text, str(path))
    if campaign.name is None:
        name = "".join(c if c.isalnum() and c.isascii() else "-" for c in path.stem.lower()).strip("-")[:64]
        campaign = campaign.model_copy(update={"name": name or "campaign"})
    author = campaign.author
    if author and "/" in author.program:  # workers look from elsewhere; a bare name is one of the search path
        beside = Path(os.path.abspath(path.parent / author.program))  # noqa: PTH100 - a link keeps its name: it may be what is meant
        campaign = campaign.model_copy(update={"author": author.model_copy(update={"program": str(beside)})})
    return campaign


def parse(text: str, place: str = "") -> Campaign:
    """The campaign that a text says; see `read`."""
    if not text.strip():
        raise CampaignError(
            "the campaign is empty", place=place, next_move="write a `plan` and a `sweep`, `plans`, or `prompts`"
        )
    told = _yaml(text, place)
    if not isinstance(told, dict):
        raise CampaignError("a campaign is a mapping of words", place=place, next_move=_known(Campaign))
    try:
        campaign = Campaign.model_validate(told)
    except ValidationError as error:
        raise _refused(error, place) from None
    author = campaign.author
    if author and not author.tells_money and (campaign.budget.usd or campaign.per_world.usd):
        raise CampaignError(
            f"a limit of `usd` would do nothing: {harnesses.find(author.harness).NAME} tells no money",
            place=place,
            next_move="give `author.prices: {read, written}`, US dollars for a million tokens, or leave `usd` out",
        )
    if campaign.size > MOST_WORLDS:
        raise CampaignError(
            f"it asks for {_whole(campaign.size)} worlds; a campaign has at most {MOST_WORLDS:,}",
            place=place,
            next_move="take fewer values along an axis, or draw from a range (`uniform`, with `draws`)",
        )
    return campaign


def _yaml(text: str, place: str) -> Any:
    import yaml

    class Strict(yaml.SafeLoader):
        """Refuses what would be read otherwise than a person reads it: a key twice, an alias."""

        def compose_node(self, parent: Any, index: Any) -> Any:
            if self.check_event(yaml.AliasEvent):
                raise yaml.composer.ComposerError(None, None, "an alias; write it out", self.peek_event().start_mark)
            return super().compose_node(parent, index)

        def construct_mapping(self, node: Any, deep: bool = False) -> Any:
            keys = [self.construct_object(key, deep=True) for key, _ in node.value]
            for number, key in enumerate(keys):
                if key in keys[:number]:
                    raise yaml.constructor.ConstructorError(None, None, f"the key {key!r} twice", node.start_mark)
            return super().construct_mapping(node, deep)

    try:
        return yaml.load(text, Strict)
    except (yaml.YAMLError, ValueError, RecursionError, TypeError) as cause:
        mark = getattr(cause, "problem_mark", None)
        raise CampaignError(
            f"not YAML that can be read: {getattr(cause, 'problem', None) or cause}",
            place=f"{place}:{mark.line + 1}" if mark else place,
            next_move="correct that line",
        ) from None


def _refused(error: ValidationError, place: str) -> CampaignError:
    """The first problem, in the file's own words."""
    details = error.errors(include_url=False)
    telling = [d for kind in ("extra_forbidden", "value_error") for d in details if d["type"] == kind]
    first = (telling or details)[0]
    path = [part for part in first["loc"] if part not in ("str", "Given", "Prompted")]
    where = ".".join(map(str, path))
    if first["type"] == "extra_forbidden":
        owner: type[Frozen] = Campaign
        for name, kind in (
            ("fields", Axis),
            ("sweep", Sweep),
            ("plans", Given),
            ("prompts", Prompted),
            ("prices", Prices),
            ("author", Author),
            ("budget", Budget),
            ("per_world", PerWorld),
        ):
            if name in path[:-1]:
                owner = kind
                break
        return CampaignError(f"there is no word `{where}` in a campaign", place=place, next_move=_known(owner))
    message = str(first["msg"]).removeprefix("Value error, ")
    shown = "" if first["type"] in ("value_error", "missing") else f", got {_short(first['input'])}"
    return CampaignError(
        f"`{where}`: {message}{shown}" if where else message,
        place=place,
        next_move=f"correct `{where}` (skill `campaign`)" if where else "see the skill `campaign`",
    )


def _known(owner: type[Frozen]) -> str:
    return f"known words: {', '.join(field.alias or name for name, field in owner.model_fields.items())}"


def _whole(value: int) -> str:
    """A whole number, written out where a person would read it to its end; Python writes no number of thousands of digits."""
    if abs(value) <= MOST_WHOLE:
        return f"{value:,}"
    return f"about {'-' * (value < 0)}10^{math.log10(abs(value)):.0f}"


def _short(value: Any) -> str:
    if isinstance(value, int) and abs(value) > MOST_WHOLE:
        return _whole(value)
    try:
        text = json.dumps(value)
    except (TypeError, ValueError):
        text = type(value).__name__ if isinstance(value, (dict, list, tuple)) else str(value)
    return text if len(text) <= 60 else f"{text[:57]}…"
