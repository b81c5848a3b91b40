"""What a rehearsal answers: which objectives would hold, all there is to mend, where the storyboard lies, what it cost."""

from typing import Literal

from ..model.evidence.build_steps import StepName
from ..model.evidence.reports import ObjectiveResult
from ..model.frozen import Frozen

HOLDS, FAILS, REMARK = "✓", "✗", "·"


Whose = Literal["drafted", "its author's", "none"]
"""Whose program was simulated."""


class Mend(Frozen):
    """One finding of a rehearsal."""

    step: StepName
    blocks: bool
    """It would stop the run; else it is a remark."""
    what: str
    next_move: str = ""


class Rehearsed(Frozen):
    """How a world would do whose plan is not approved yet; nothing of it is evidence."""

    run: str
    state: Literal["running", "stopped", "holds"]
    """`stopped`: something would block; `holds`: nothing would; `running`: call again."""
    program: Whose = "none"
    objectives: tuple[ObjectiveResult, ...] = ()
    """Each with its measurements: what was measured, what was expected, the signed margin."""
    findings: tuple[Mend, ...] = ()
    """All that was found, what to mend first in front."""
    storyboard: tuple[str, ...] = ()
    """Pictures to look at, one sheet a camera."""
    under_way: tuple[str, ...] = ()
    cpu_s: float = 0
    """Processor time of this call and of every pass that it rests on, s."""
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """Whether everything that was measured would hold."""
        return self.state == "holds"

    def text(self) -> str:
        """Objectives first, then what to mend, the pictures, the cost and the next move."""
        blocking = sum(found.blocks for found in self.findings)
        head = f"{self.run}: rehearsal {self.state}" + f", {blocking} to mend" * bool(blocking)
        lines = [f"{head} (program: {self.program}; {self.cpu_s:.1f} CPU s; nothing of it is evidence)"]
        for objective in self.objectives:
            mark = HOLDS if objective.status in ("proved", "visual_only") else FAILS
            lines.append(f"  {mark} {objective.index}. {objective.claim} ({objective.status.replace('_', ' ')})")
            for measured in objective.expectations:
                unit = "" if measured.unit == "1" else f" {measured.unit}"
                margin = f" (margin {measured.margin:+.3g}{unit})" if measured.margin is not None else ""
                lines.append(f"      {measured.status:<7} {measured.name}: {measured.message}{margin}")
        for found in self.findings:
            said = found.what.replace("\n", "\n      ")
            lines.append(f"  {FAILS if found.blocks else REMARK} {found.step:<8}{said}")
        lines += [f"  look: {path}" for path in self.storyboard]
        lines += [f"  … {said}" for said in self.under_way]
        return "\n".join(lines + ([f"  next: {self.next_move}"] if self.next_move else []))
