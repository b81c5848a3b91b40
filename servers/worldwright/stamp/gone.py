"""How far a walk along a run came: what holds, all that is wrong, and the next move."""

from typing import Literal

from ..model.evidence.build_steps import StepName
from ..model.frozen import Frozen
from .status import MARKS


class Wrong(Frozen):
    """One thing to mend."""

    step: StepName
    what: str
    next_move: str = ""


class Gone(Frozen):
    """How far a run came."""

    run: str
    state: Literal["running", "stopped", "waiting", "accepted"]
    """`stopped`: something is wrong; `waiting`: for the word or the work of a role or a person; `running`: call again."""
    held: dict[StepName, str]
    """What holds, and what there is to say about it."""
    wrong: tuple[Wrong, ...] = ()
    """All that is wrong, what to mend first in front."""
    under_way: tuple[str, ...] = ()
    moving: str = ""
    """The folder of the film as it was drawn roughly: `moving.mp4`, and a sheet of it."""
    storyboard: str = ""
    """Folder of the sheets that show it, one a camera: to be looked at first."""
    proof: str = ""
    """What of acceptance is made beside: the repetitions that causes ask for, and the proof run of a long physics."""
    robust: str = ""
    """In how many worlds a little otherwise the claims hold, or that it is being found out beside, which nothing waits for."""
    traced: str = ""
    """Where the film is traced beside, for show, which nothing waits for."""
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """Nothing is wrong, and nothing is under way any more."""
        return self.state in ("waiting", "accepted")

    def text(self) -> str:
        """What holds, what does not, and the next move."""
        lines = [f"{self.run}: {self.state}" + f", {len(self.wrong)} to mend" * bool(self.wrong)]
        lines += [f"  {MARKS['holds']} {name:<8}{_indented(said)}" for name, said in self.held.items()]
        lines += [f"  {MARKS['fails']} {wrong.step:<8}{_indented(wrong.what)}" for wrong in self.wrong]
        lines += [f"  … {said}" for said in self.under_way]
        lines += [f"  look: stage.frames, show: storyboard ({self.storyboard})"] if self.storyboard else []
        lines += [f"  look: stage.frames, show: moving ({self.moving})"] if self.moving else []
        lines += [f"  · proof   {self.proof}"] if self.proof else []
        lines += [f"  · robust  {self.robust}"] if self.robust else []
        lines += [f"  · traced  {self.traced}"] if self.traced else []
        return "\n".join(lines + ([f"  next: {self.next_move}"] if self.next_move else []))


def _indented(said: str) -> str:
    return said.replace("\n", "\n            ")
