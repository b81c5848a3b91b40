"""The compiler accepts the world, and warns of it.

What it does: passes on the warnings that the engine's compiler gives, which nobody sees in a sandboxed or batch run.

Why is this bad: what is warned of does not do what it is there for, e.g. a flex without any force that would hold it
together.

Use instead: what the warning names.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Warns
from ...problem import Problem

CODE = "WM102"
UNBUILT = True
SEVERITY = "warning"
SCOPE = "any"
HEAD = "<mujoco><worldbody><body name='b'><flexcomp name='f' type='grid' dim='2' count='4 4 1' spacing='.1 .1 .1'"
GOOD = (HEAD + " radius='.01'><edge equality='true'/></flexcomp></body></worldbody></mujoco>",)
BAD = (HEAD + " radius='.01'/></body></worldbody></mujoco>",)
FIXES = {
    "empty prefix": "split the name of the part between the two, e.g. prefix='clo' before a flex called 'th'; or build it in the "
    "world's own spec"
}
"""What to do, by words of the warning."""
EVIDENCE = Warns("no equality constraints or passive forces")


def check(view: ModelView) -> Iterator[Problem]:
    """Check every warning, once."""
    for said in dict.fromkeys(view.outcome.warnings):
        fix = next((fix for words, fix in FIXES.items() if words in said), "mend what the compiler warns of")
        yield Problem(" ".join(said.split()), fix, 1)
