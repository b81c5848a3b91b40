"""An author's own law makes momentum, energy, mass or volume out of nothing.

What it means: its points are pushed without pushing back (or push without being pushed), its steps are too coarse, or its stored
energy is not the one whose slope its forces are. What flows in or out of it belongs into the plan. Of a law that derives from the
suite's own (`worldkit.matter`, `worldkit.skins`) the forces are not the author's to mend: a shorter `step`, then a smaller `spacing`.

Formula: of each law, over its recorded instants: momentum of the points, less that at the start and what gravity gave, plus the
impulse given to bodies and to what stands fast, over all impulses exchanged, mere weight not counted: the largest that it ever is,
or all its changes from one instant to the next, where they are more; the largest rise of its energy plus its work on bodies, over
the range of either, energy by weight not counted; the largest change of mass, and of volume where the law tells it, over that at
the start.
In its first 0.2 s, which lint steps, a gain of energy is a share of no less than what lifts all the matter of a grid by one cell.
A recording with a law and fewer than two instants of its sums shows nothing of it, and blocks.
Threshold: momentum 2 % warns, 10 % blocks; energy 5 % and 20 %; mass 1 % warns, 10 %
blocks; volume 5 % warns.
Source: Newton's third law; the work-energy theorem; the sums are computed by worldkit from the points, the impulses and the work
are the engine's ledger.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.finding import AnomalySeverity
from ....model.recording.law_balances import LawBalance
from ....model.recording.trajectory import Trajectory
from ...known import analytic, own_laws
from ..sign import Case, Context, Sign

CODE = "WS318"
STAGING = True
NEEDS = ()
MOMENTUM, ENERGY = (0.02, 0.10), (0.05, 0.20)
MASS, VOLUME = (0.01, 0.10), 0.05
GAMBLED_J, SLOW_J_KG, EARLY = 1e-6, 1e-3, 0.02
"""Less energy than this is nobody's; of what weighs less than a gram, less than that of 4.5 cm/s."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each sum of a law that does not balance, and laws of which nothing can be said."""
    if (rows := trajectory.meta.get("laws")) and len(trajectory.balances) < len(rows):
        whole = (float(trajectory.t[0]), float(trajectory.t[-1]))
        said = "the sums of the author's own laws were recorded less than twice, so that nothing tells what they give and take"
        yield Sign("world", whole, 0.0, 2.0, "instants", "blocking", said)
    for law in trajectory.balances:
        yield from of_law(law, min(GAMBLED_J, SLOW_J_KG * float(np.abs(law.mass).max())))


def early(balances: tuple[LawBalance, ...]) -> list[str]:
    """What does not balance in a law's first moments, when what lies still has hardly exchanged anything: energy counts there only as
    a share of all that is stored, and beside what lifts the matter of a grid by a cell."""
    least = [max(GAMBLED_J, EARLY * float(np.abs(law.stored).max())) for law in balances]
    return [sign.message for law, j in zip(balances, least, strict=True) for sign in of_law(law, j, law.cell_j)]


def of_law(law: LawBalance, least_j: float = GAMBLED_J, beside_j: float = 0.0) -> Iterator[Sign]:
    """Yield each sum of one law that does not balance; less energy than `least_j` is none, and it is a share of `beside_j` at least."""
    window = (float(law.t[0]), float(law.t[-1]))
    body = law.bodies[0] if law.bodies else "world"

    def sign(share: float, threshold: float, blocks: float, message: str) -> Sign:
        severity: AnomalySeverity = "blocking" if share > blocks else "warn"
        said = f"the law {law.name}, the author's own, {message}"
        return Sign(body, window, share, threshold, "of what is exchanged", severity, said)

    if (share := law.from_nowhere) > MOMENTUM[0]:
        told = f"has momentum from nowhere: {share:.1%} of all impulses that it exchanges"
        yield sign(share, *MOMENTUM, told)
    if law.made_j > least_j and (share := law.made_j / max(law.scale_j, beside_j)) > ENERGY[0]:
        yield sign(share, *ENERGY, f"makes {law.made_j:.3g} J from nothing, {share:.0%} of what it stores and gives")
    if law.mass_change > MASS[0]:
        yield sign(law.mass_change, *MASS, f"changes its mass by {law.mass_change:.1%}")
    if (share := law.volume_change or 0.0) > VOLUME:
        yield sign(share, VOLUME, np.inf, f"changes its volume by {share:.1%}")


def _spring(**wrong: float) -> Trajectory:
    return replace(analytic.resting(), balances=(own_laws.spring(**wrong),))


def _unsummed() -> Trajectory:
    return replace(
        analytic.resting(), meta={"laws": [{"bodies": ["body"], "law": {"name": "spring", "shown_by": "net"}}]}
    )


GOOD = (
    lambda: Case("a mass on a spring, and what hangs on it", _spring()),
    lambda: Case("a mass on a stiff spring", _spring(rate=100.0)),
    lambda: Case("a world without a law of its own", analytic.resting()),
    lambda: Case("a spring beside ballast", _spring(ballast=1e4)),
    lambda: Case("a spring that warms up", _spring(made=-0.3)),
    lambda: Case("a millionth of a gram on a spring", _spring(weighs=1e-9)),
)
BAD = (
    lambda: Case("a mass that pulls at nothing", _spring(kept=0.0), severity="blocking"),
    lambda: Case("a mass that often pulls at nothing", _spring(kept=0.0, rate=100.0), severity="blocking"),
    lambda: Case("a body that is shaken by nothing", _spring(felt=0.0, rate=100.0), severity="blocking"),
    lambda: Case("a body that feels most of the pull", _spring(kept=0.9), severity="warn"),
    lambda: Case("a body that feels most of a quick pull", _spring(kept=0.9, rate=100.0), severity="warn"),
    lambda: Case("a spring that winds itself up", _spring(made=0.3), severity="blocking"),
    lambda: Case("a millionth of a gram that winds itself up", _spring(made=0.3, weighs=1e-9), severity="blocking"),
    lambda: Case("a spring that grows heavier", _spring(mass=0.04), severity="warn"),
    lambda: Case("a spring that grows half as heavy again", _spring(mass=0.25), severity="blocking"),
    lambda: Case("a pull at nothing beside ballast", _spring(kept=0.0, ballast=1e4), severity="blocking"),
    lambda: Case("a pull at nothing beside what falls", _spring(kept=0.0, ballast=1e4, lies=0.0), severity="blocking"),
    lambda: Case("a spring that winds itself up beside ballast", _spring(made=0.3, ballast=1e4), severity="blocking"),
    lambda: Case("a law without sums", _unsummed(), severity="blocking"),
    lambda: Case("a liquid that swells", _spring(volume=0.1), severity="warn"),
)
