"""A global simulator callback is installed.

What it does: finds `mujoco.set_mjcb_*` calls.

Why is this bad: the world runs in the engine's process, which never loads the program: a callback that is installed here is
called by nothing that counts. It is a remark, for whoever wonders why it has no effect.

Use instead: `control(model, data)`, which runs between the steps and is accounted for.
"""

from collections.abc import Iterator

from ...harm import Measured, executed, model_of
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL132"
SEVERITY = "info"
SCOPE = "contract"
GOOD = ("import mujoco\nfrom worldkit import program\nmujoco.get_mjcb_control()\n",)
BAD = (
    "import mujoco\nfrom worldkit import program\nmujoco.set_mjcb_passive(lambda m, d: None)\n",
    "from mujoco import set_mjcb_control as install\nfrom worldkit import program\ninstall(None)\n",
)
HOLDS = (
    "import mujoco\ndef hold(model, data):\n    data.qfrc_passive[2] = 9.81 * model.body_mass[1]\n"
    "mujoco.set_mjcb_passive(hold)\n"
)


def _elsewhere(source: str) -> float:
    """Height after 0.5 s of a ball in a world that the program knows nothing of, m."""
    import mujoco

    model = model_of("<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>")
    data = mujoco.MjData(model)
    try:
        executed(source)
        for _ in range(250):
            mujoco.mj_step(model, data)
        return float(data.qpos[2])
    finally:
        mujoco.set_mjcb_passive(None)


EVIDENCE = Measured(
    "an unrelated world does not fall any more", _elsewhere, 0.5, "m", bad=HOLDS, good="import mujoco\n"
)


def check(program: Program) -> Iterator[Problem]:
    """Check every installation of a callback."""
    for full, call in program.calls("mujoco."):
        if full.startswith("mujoco.set_mjcb_"):
            yield at(call, f"{full.removeprefix('mujoco.')} installs a global callback", "use control(model, data)")
