"""The program acts on the state in a way the plan does not declare.

What it does: finds forces (`xfrc_applied`, `qfrc_applied`), controls (`ctrl`), switched constraints (`eq_active`) and
edits of model parameters in code that runs every step, and compares their kind with
`simulation_parameters.interventions`.

Why is this bad: an undeclared push is how outcomes are staged: a hidden torque keeps a figure upright, friction jumps
at the moment of contact. The ledger records it, and acceptance refuses it.

Use instead: declare the law, its bodies, its trigger and the source of its constants in the plan, or take it out.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Argued
from ...problem import Problem, at
from ...program_view import Program
from ._written import CONTROL, FORCE, SWITCH, writes

CODE = "WL126"
SEVERITY = "error"
SCOPE = "plan"
MAIN = "from worldkit import program\ndef build():\n    return None\n"
END = "\nprogram.main(build, control, duration=3.0)\n"
WIND = {"kind": "force", "bodies": ["crate"], "law": "F = 0.5 rho c A v^2", "source": "drag of a cube, c = 1.05"}
GOOD = (
    Case(
        MAIN + "def control(model, data):\n    data.body('crate').xfrc_applied[0] = 2.0\n" + END,
        {"simulation_parameters": {"interventions": [WIND]}},
    ),
    MAIN + "def control(model, data):\n    height = data.qpos[2]\n" + END,
)
BAD = (
    MAIN + "def control(model, data):\n    data.xfrc_applied[1, 2] = 5.0\n" + END,
    MAIN + "def control(model, data):\n    data.ctrl[0] = 1.0\n" + END,
    MAIN + "def control(model, data):\n    model.geom_friction[3] = (5, 0, 0)\n" + END,
    MAIN + "def control(model, data):\n    data.eq_active[0] = data.time < 3.0\n" + END,
    MAIN + "def control(model, data):\n    model.opt.gravity[2] = 0\n" + END,
    MAIN + "def control(model, data):\n    push = data.body('crate').xfrc_applied\n    push[2] = 1\n" + END,
)
EVIDENCE = Argued("the engine does what is written; whether it was declared, only the plan tells")
KINDS = ({"force", "torque"}, FORCE), ({"control"}, CONTROL), ({"constraint"}, SWITCH)


def check(program: Program) -> Iterator[Problem]:
    """Check pushes, controls, switches and parameter edits, by kind."""
    if program.plan is None:
        return
    declared = {item.kind for item in program.plan.simulation_parameters.interventions}
    for write in writes(program):
        if not program.runs_every_step(write.node):
            continue
        if write.owner == "MjModel":
            wanted, shown = {"parameter"}, f"model.{write.field}"
        else:
            wanted = next((kinds for kinds, fields in KINDS if write.field in fields), set())
            shown = f"data.{write.field}"
        if wanted and not wanted & declared:
            kind = " or ".join(sorted(wanted))
            fix = f"declare an intervention of kind `{kind}` with its law and source, or take it out"
            yield at(write.node, f"{shown} is written while running, and the plan declares no {kind}", fix)
