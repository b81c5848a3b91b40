"""The energy is read, but nobody asked the engine to compute it.

What it does: finds `data.energy` in programs that make their model themselves, without the `energy` flag, and without
`mj_energyPos` or `mj_energyVel`.

Why is this bad: it is zero, always. A check that energy is conserved passes whatever happens.

Use instead: `<flag energy="enable"/>`, or `spec.option.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY`
(`worldkit.scene.new` does so).
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL147"
SEVERITY = "error"
SCOPE = "any"
BALL = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco>{0}<worldbody><body pos="0 0 3"><freejoint/>'
    '<geom size=".1"/></body></worldbody></mujoco>\')\ndata = mujoco.MjData(model)\nmujoco.mj_forward(model, data)\n'
    "energy = data.energy[0]\n"
)
GOOD = (
    BALL.format('<option><flag energy="enable"/></option>'),
    BALL.format("").replace("energy =", "mujoco.mj_energyPos(model, data)\nenergy ="),
    "import mujoco\ndef total(data: mujoco.MjData):\n    return data.energy.sum()\n",
)
BAD = (BALL.format(""),)
EVIDENCE = Measured("the energy is zero", lambda s: float(executed(s)["energy"]), 1.0, "J")


def check(program: Program) -> Iterator[Problem]:
    """Check reads of the field, when the whole model stands in the program."""
    makes = any(full in ("mujoco.MjModel.from_xml_string", "mujoco.MjSpec") for full in program.calls_by_name)
    if not makes or not program.whole_model:
        return
    asked = {n.attr for n in program.nodes(ast.Attribute)} & {"mjENBL_ENERGY", "enableflags", "energy_enable"}
    computed = any(full.startswith("mujoco.mj_energy") for full in program.calls_by_name)
    flagged = any(t.name == "flag" and t.attributes.get("energy") == "enable" for t in program.tags())
    if asked or computed or flagged:
        return
    for node in program.nodes(ast.Attribute):
        if node.attr == "energy" and isinstance(node.ctx, ast.Load) and program.type_of(node.value) == "MjData":
            yield at(node, "data.energy stays zero: the energy flag is off", "switch the energy flag on")
