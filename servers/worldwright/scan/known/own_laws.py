"""An author's own law whose sums are known: a mass on a spring between it and a body."""

import numpy as np

from ...model.recording.law_balances import LawBalance


def spring(
    kept: float = 1.0,
    made: float = 0.0,
    mass: float = 0.0,
    volume: float = 0.0,
    ballast: float = 0.0,
    lies: float = 1.0,
    rate: float = 3.0,
    felt: float = 1.0,
) -> LawBalance:
    """The sums of a mass on a spring.

    Args:
        kept: the share of its pull that the body feels.
        made: W that it makes from nothing.
        mass, volume: how fast they grow, as a share of those at the start, 1/s.
        ballast: kg besides, which are let down at once, to nobody's use.
        lies: the share of its weight that what stands fast carries; the rest only falls.
        rate: of its swinging, rad/s.
        felt: the share of the pull that the mass itself feels.
    """
    t = np.linspace(0.0, 2.0, 201)
    own = np.outer(np.cos(rate * t), [1.0, 0.0, 0.0])
    gravity = np.array([0.0, 0.0, -9.81]) if ballast else np.zeros(3)
    mass_at = 1.0 + ballast + mass * t
    pulled = np.concatenate([np.zeros((1, 3)), np.cumsum(mass_at[:-1, None] * gravity * np.diff(t)[:, None], axis=0)])
    let_down = -ballast * np.minimum(t, 0.1)
    stored = 2.0 * np.cos(rate * t) ** 2
    return LawBalance(
        name="spring",
        bodies=("body",),
        t=t,
        mass=mass_at,
        momentum=felt * own + (1.0 - lies) * pulled,
        energy=stored + made * t + let_down,
        weight=let_down,
        stored=stored,
        volume=np.ones_like(t) + volume * t,
        given=kept * (own[0] - own),
        held=lies * pulled,
        work=2.0 - stored,
        pushed=kept * float(np.abs(np.diff(own[:, 0])).sum()),
        gravity=gravity,
    )
