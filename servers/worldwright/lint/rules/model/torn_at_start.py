"""A constraint does not hold where the world starts.

What it does: looks at the residual of every active equality at the start: more than 2 mm (or 0.002 rad).

Why is this bad: the solver closes the gap within a few steps and throws what it ties together.

Use instead: start poses that satisfy it, or a `relpose`/anchor that matches them; leave those to the compiler where
nothing else is meant.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, fastest
from ...problem import Problem

CODE = "WM125"
SEVERITY = "error"
SCOPE = "any"
TIED = (
    "<mujoco><option gravity='0 0 0'/><worldbody><body name='a'><freejoint/><geom size='.05'/><site name='s' pos='.1 0 0'/></body>"
    "<body name='b' pos='.3 0 0'><freejoint/><geom size='.05'/><site name='t' pos='{0} 0 0'/></body></worldbody>"
    "<equality><connect name='bond' site1='s' site2='t'/></equality></mujoco>"
)
GOOD = (TIED.format("-.2"), TIED.format("-.1").replace("<connect", "<connect active='false'"))
BAD = (TIED.format("-.1"),)
EVIDENCE = Measured("the bodies are thrown together", fastest, 0.5, "m/s")
MOST = 2e-3


def check(view: ModelView) -> Iterator[Problem]:
    """Check active connects, welds, joints and tendons; a flex's own edges are judged by their compiler."""
    for index, kind in enumerate(view.equality_kind):
        residual = float(view.equality_residual[index])
        if view.eq_active0[index] and not kind.startswith("flex") and residual > MOST:
            message = f"{view.name('equality', index)} ({kind}) starts with a gap of {residual:.3g}"
            yield view.at("equality", index, message, "start where it holds, or change what it asks for")
