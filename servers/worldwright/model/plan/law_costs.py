"""What an author's law costs, in words: told before its physics is begun, and again while that is waited for."""

LONG_S = 60.0
"""A physics that takes longer is worth a cheaper choice."""
KNOWN = 30.0
"""Where a second of the whole costs more than so many of the first, hardly anything moves in these, and their cost says nothing."""
CHEAPER = "cheaper: fewer points (half of them, half the time), a shorter duration"


PASS_MB, HEAVY_MB = 4096, 1500
"""What a physics pass may hold where nobody gives it more, all of its processes together, and a law that leaves little of it, MiB: the
engine takes some 300, and a law of `worldkit.matter` of 20,000 points some 450.
"""


def heavy(memory_mb: float, *, ended: bool = False) -> str:
    """What is said of a law whose process holds so much, MiB, in its first steps, or is `ended` at that; empty below `HEAVY_MB`."""
    if memory_mb < HEAVY_MB and not ended:
        return ""
    what = f"more than {memory_mb:.0f} MB, and were ended there" if ended else f"{memory_mb:.0f} MB"
    return (
        f"its laws hold {what}, in their first steps: a physics pass ends at {PASS_MB} MB; hold less (fewer points, no history of "
        "steps), or give it more: `worldwright go --memory-mb`"
    )


def told(points: int, reached_s: float, wall_s: float, grows: float, lasting_s: float) -> str:
    """The cost of the first steps and of the whole, with the cheaper choice where it is long.

    Args:
        points: of all laws together; 0 where it is not known.
        reached_s: how far the first steps came, simulated s.
        wall_s: what they took, s.
        grows: how many times as much a second of the whole costs.
        lasting_s: simulated s of the whole.
    """
    many = f" ({points:,} points)" if points else ""
    if grows > KNOWN:
        return f"its laws{many}: hardly a point moves in the first {reached_s:.2g} s, so the cost of the whole is not known; {CHEAPER}"
    whole = wall_s * max(grows, 1.0) * lasting_s / reached_s
    said = f"its laws{many}: the first {reached_s:.2g} s take {wall_s:.1f} s, the whole {lasting_s:g} s about {_rounded(whole)} s"
    return f"{said}; {CHEAPER}" if whole > LONG_S else said


def _rounded(seconds: float) -> str:
    """Two digits, never as a power of ten."""
    return f"{float(f'{seconds:.2g}'):g}"
