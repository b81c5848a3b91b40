"""A joint's or tendon's stiffness or damping is assigned as one number.

What it does: finds `joint.stiffness = 5.0` and `joint.damping = 0.1` on `MjsJoint` and `MjsTendon`.

Why is this bad: since MuJoCo 3.7 these fields are polynomials with three coefficients; assigning a number raises a
TypeError. (The keyword of `add_joint` still takes a number.)

Use instead: `joint.stiffness[0] = 5.0`, the linear coefficient.
"""

import ast
from collections.abc import Iterator

from ...harm import Raises
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL142"
ABOUT = "signatures"
SEVERITY = "error"
SCOPE = "any"
HEAD = "import mujoco\nspec = mujoco.MjSpec()\nj = spec.worldbody.add_body().add_joint()\n"
GOOD = (
    HEAD + "j.stiffness[0] = 5.0\n",
    HEAD + "j.damping = [0.1, 0, 0]\n",
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_body().add_joint(stiffness=5.0)\n",
)
BAD = (
    HEAD + "j.stiffness = 5.0\n",
    HEAD + "C = 0.1\nj.damping = C * 2\n",
    "import mujoco\nt = mujoco.MjSpec().add_tendon()\nt.stiffness = 100\n",
)
FIXED = (
    HEAD + "j.stiffness[0] = 5.0\n",
    HEAD + "C = 0.1\nj.damping[0] = C * 2\n",
    "import mujoco\nt = mujoco.MjSpec().add_tendon()\nt.stiffness[0] = 100\n",
)
EVIDENCE = Raises(good=False)


def check(program: Program) -> Iterator[Problem]:
    """Check assignments of a known number."""
    for target, value, statement in program.stores():
        if not (isinstance(target, ast.Attribute) and target.attr in ("stiffness", "damping")):
            continue
        if program.type_of(target.value) in ("MjsJoint", "MjsTendon") and isinstance(program.value(value), int | float):
            edit = program.insertion_after(target, "[0]") if isinstance(statement, ast.Assign) else None
            fix = f"write .{target.attr}[0] = …, the linear coefficient"
            yield at(statement, f"`{target.attr}` holds three coefficients, not one number", fix, edit=edit)
