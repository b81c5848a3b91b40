"""An author's own law makes momentum, energy, mass or volume out of nothing.

What it means: its points are pushed without pushing back (or push without being pushed), its steps are too coarse, or its stored
energy is not the one whose slope its forces are. What flows in or out of it belongs into the plan.

Formula: of each law, over its recorded instants: momentum of the points, less that at the start and what gravity gave, plus the
impulse given to bodies and to what stands fast, over all impulses exchanged; the largest rise of its energy plus its work on
bodies, over the range of either; the largest change of mass, and of volume where the law tells it, over that at the start.
Threshold: momentum 2 % warns, 10 % blocks; energy 5 % and 20 %; mass 1 % warns; volume 5 % warns.
Source: Newton's third law; the work-energy theorem; the sums are computed by worldkit from the points, the impulses and the work
are the engine's ledger.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.finding import AnomalySeverity
from ....model.recording.law_balances import LawBalance
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS318"
STAGING = True
NEEDS = ()
MOMENTUM, ENERGY = (0.02, 0.10), (0.05, 0.20)
MASS, VOLUME = 0.01, 0.05
GAMBLED_J = 1e-6
"""Less energy than this is nobody's."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each sum of a law that does not balance."""
    for law in trajectory.balances:
        window = (float(law.t[0]), float(law.t[-1]))
        body = law.bodies[0] if law.bodies else "world"

        def sign(share: float, threshold: float, blocks: float, message: str) -> Sign:
            severity: AnomalySeverity = "blocking" if share > blocks else "warn"
            said = f"the law {law.name}, the author's own, {message}"  # noqa: B023 (called at once)
            return Sign(body, window, share, threshold, "of what is exchanged", severity, said)  # noqa: B023

        if (share := law.from_nowhere) > MOMENTUM[0]:
            told = f"has momentum from nowhere: {share:.1%} of all impulses that it exchanges"
            yield sign(share, *MOMENTUM, told)
        if law.made_j > GAMBLED_J and (share := law.made_j / law.scale_j) > ENERGY[0]:
            yield sign(
                share, *ENERGY, f"makes {law.made_j:.3g} J from nothing, {share:.0%} of what it stores and gives"
            )
        if law.mass_change > MASS:
            yield sign(law.mass_change, MASS, np.inf, f"changes its mass by {law.mass_change:.1%}")
        if (share := law.volume_change or 0.0) > VOLUME:
            yield sign(share, VOLUME, np.inf, f"changes its volume by {share:.1%}")


def _spring(kept: float = 1.0, made: float = 0.0, mass: float = 0.0, volume: float = 0.0) -> Trajectory:
    """A mass on a spring between it and a body: `kept` is the share of its pull that the body feels."""
    t = np.linspace(0.0, 2.0, 201)
    momentum = np.outer(np.cos(3 * t), [1.0, 0.0, 0.0])
    given = kept * (momentum[0] - momentum)
    stored = 2.0 * np.cos(3 * t) ** 2
    law = LawBalance(
        name="spring",
        bodies=("body",),
        t=t,
        mass=1.0 + mass * t,
        momentum=momentum,
        energy=stored + made * t,
        volume=np.ones_like(t) + volume * t,
        given=given,
        work=2.0 - stored,
        exchanged=float(np.abs(np.diff(momentum[:, 0])).sum()),
        gravity=np.zeros(3),
    )
    return replace(analytic.resting(), balances=(law,))


GOOD = (
    lambda: Case("a mass on a spring, and what hangs on it", _spring()),
    lambda: Case("a world without a law of its own", analytic.resting()),
    lambda: Case("a spring that warms up", _spring(made=-0.3)),
)
BAD = (
    lambda: Case("a mass that pulls at nothing", _spring(kept=0.0), severity="blocking"),
    lambda: Case("a body that feels most of the pull", _spring(kept=0.9), severity="warn"),
    lambda: Case("a spring that winds itself up", _spring(made=0.3), severity="blocking"),
    lambda: Case("a spring that grows heavier", _spring(mass=0.1), severity="warn"),
    lambda: Case("a liquid that swells", _spring(volume=0.1), severity="warn"),
)
