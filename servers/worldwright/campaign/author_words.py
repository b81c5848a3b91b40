"""The words by which a campaign says who writes its worlds: a coding harness without a person, and the prompts that it gets."""

from typing import Annotated

from pydantic import Field, model_validator

from ..contract import harnesses
from ..contract.heard import Heard
from ..model.frozen import Frozen

Price = Annotated[float, Field(ge=0, lt=1e6, allow_inf_nan=False)]


class Prices(Frozen):
    """US dollars for a million tokens, of a harness that tells no money."""

    read: Price
    cached: Price | None = None
    """Of those read from its cache; as `read` without it."""
    written: Price

    def of(self, heard: Heard) -> float:
        """What so many tokens cost, US dollars."""
        cached = self.read if self.cached is None else self.cached
        return ((heard.read - heard.cached) * self.read + heard.cached * cached + heard.written * self.written) / 1e6


class Author(Frozen):
    """Who writes the worlds."""

    harness: str
    """The name of its file in `contract/harnesses`: `claude_code`, `codex`, `opencode`."""
    program: str = ""
    """Its program, by name or by path, relative to the campaign's file; the harness's own command without it."""
    model: Annotated[str, Field(max_length=200)] = ""
    """By the harness's name of it; its own choice without it."""
    options: tuple[Annotated[str, Field(max_length=4000)], ...] = ()
    """More words on its command line, before ours."""
    trust: bool = False
    """A person's word for the hooks in each world's folder, which the campaign itself writes; some harnesses run none without it."""
    prices: Prices | None = None

    @property
    def uncounted(self) -> str:
        """What its figures leave out, as a sentence; empty where they are of all."""
        harness = harnesses.find(self.harness)
        said = (
            f"{harness.NAME} tells of its main thread only: what {harness.UNCOUNTED} took comes on top, and no `usd` limit sees it"
            if harness.UNCOUNTED
            else ""
        )
        late = f"{harness.NAME}: known when it has ended" if harness.TELLS_AT_END else ""
        return "; ".join(filter(None, (said, late)))

    @property
    def tells_money(self) -> bool:
        """Whether a limit of US dollars has anything to compare."""
        return self.prices is not None or harnesses.find(self.harness).TELLS_MONEY

    @model_validator(mode="after")
    def _known(self) -> "Author":
        known = harnesses.known()
        if self.harness not in known:
            raise ValueError(f"there is no harness `{self.harness}`; known: {', '.join(known)}")
        if (why := known[self.harness].TRUST) and not self.trust:
            raise ValueError(f"{why}: `trust: true` is your word for the folders that this campaign makes")
        return self


class Prompted(Frozen):
    """One of several prompts: its words, or a file of them."""

    prompt: str | None = None
    file: str | None = None
    """Relative to the campaign's file."""
    category: str = ""

    @model_validator(mode="after")
    def _one(self) -> "Prompted":
        if (self.prompt is None) == (self.file is None):
            raise ValueError("say one of `prompt` and `file`")
        return self
