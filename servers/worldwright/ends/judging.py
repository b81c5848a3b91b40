"""Judge an episode by the plan's objectives, with the house's own measurements, as far as that can be done while it runs.

An expectation is paid for when it holds, and what falls later is taken back:

    event     (`touches`, `reaches`, `comes_to_rest`: it comes true at a moment) when it first holds; measured again at the end
    lasting   (those of `FINAL`: `stays_upright`, `never_touches`) at the end; if it fails before, the episode is over, since
              no later motion can make it true of the whole
    rest      (`ends_at`, `carries_load`, `moves_straight`: a number of the whole) at the end

Not judged, and told with the reason: what the motion so far cannot answer (work done by inputs, other worlds' numbers,
pictures), and claims that only a picture shows. The return of an episode is the share of the judged expectations that held.
"""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..scan.objectives import expecting
from ..scan.objectives.claims import EXPECTATIONS
from .episode import Episode

if TYPE_CHECKING:
    from ..model.plan.committed import Plan
    from ..model.recording.trajectory import Trajectory

FEWEST_ROWS = 2
FINAL = {
    "never_faster_than", "never_touches", "no_penetration", "stays", "stays_contained", "stays_together", "stays_upright",
    "stays_within",
}  # fmt: skip
"""Expectations that hold of every beginning of a motion of which they hold: their failure is final."""


@dataclass
class Judged:
    """One expectation of one objective."""

    objective: int
    claim: str
    name: str
    arguments: dict[str, Any]
    how: str
    """`event`, `lasting`, `rest`."""
    status: str = "unknown"
    margin: float | None = None
    paid: bool = False

    def told(self) -> dict[str, Any]:
        """Plain words for `info`."""
        return {"objective": self.objective, "name": self.name, "judged": self.how, "status": self.status}


@dataclass
class Judge:
    """The expectations of a plan over one episode after another."""

    rows: list[Judged]
    duration_s: float
    left_out: dict[str, str] = field(default_factory=dict)
    """Expectations and claims that are not judged, with the reason."""

    @classmethod
    def of(cls, plan: "Plan", duration_s: float, motion: "Trajectory") -> "Judge":
        """The expectations that a motion like this one can answer.

        Args:
            plan: its objectives.
            duration_s: of a whole episode.
            motion: a whole episode of the same world, as it was accepted: what it cannot answer, none can.
        """
        found = cls([], duration_s)
        for number, objective in enumerate(plan.objectives):
            if not objective.expect:
                found.left_out[f"{number}: {objective.claim}"] = objective.visual_only or "nothing is expected of it"
            for name, given in ((name, given) for row in objective.expect for name, given in row.items()):
                arguments = expecting.named(given)
                result = expecting.measure(motion, name, arguments)
                if result.status == "unknown":
                    found.left_out[f"{number}: {name}"] = result.message
                    continue
                entry = EXPECTATIONS[name]
                how = "event" if entry.EVENT else "lasting" if name in FINAL else "rest"
                found.rows.append(Judged(number, objective.claim, name, arguments, how))
        return found

    def begin(self) -> None:
        """A new episode."""
        for row in self.rows:
            row.status, row.margin, row.paid = "unknown", None, False

    def judge(self, episode: Episode, at_end: bool) -> tuple[float, bool]:
        """(reward since the last time, whether a lasting expectation is broken).

        Where the episode ends, so or so, what was paid is measured again: an event that holds no more is taken back.

        Args:
            episode: its rows so far.
            at_end: nothing follows: what lasted is paid.
        """
        if len(episode) < FEWEST_ROWS or not self.rows:
            return 0.0, False
        motion = episode.motion()
        held, broken = 0, False
        for row in sorted(
            self.rows, key=lambda row: row.how != "lasting"
        ):  # a broken one ends the episode for the others
            if not at_end and (row.how == "rest" or (row.paid and not broken)):
                continue
            result = expecting.measured(motion, row.name, row.arguments, self.duration_s)
            row.status, row.margin = result.status, result.margin
            now = row.status == "holds" and (at_end or row.how == "event")
            held += now - row.paid
            row.paid = now
            broken |= row.how == "lasting" and row.status == "fails"
        return held / len(self.rows), broken
