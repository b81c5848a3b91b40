"""The world cannot be built.

What it does: reports what the program, or the engine's compiler, said when the world was built in the sandbox; and a
program that takes too long or too much memory to build it. A plain script that needs a package which is not installed here
is at no fault: that is a remark, and its world is not looked at.

Why is this bad: there is no world to simulate.

Use instead: what the message names; `worldwright retrieve symbol NAME` tells what an element or a function takes.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Raises
from ...problem import Problem

CODE = "WM101"
UNBUILT = True
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    "<mujoco><worldbody><body><freejoint/><geom size='1'/></body></worldbody></mujoco>",
    "import mujoco\ndef build():\n    return mujoco.MjSpec()\n",
)
BAD = (
    "<mujoco><worldbody><body><freejoint/></body></worldbody></mujoco>",
    "<mujoco><worldbody><geom type='box' size='1'/></worldbody></mujoco>",
    "import mujoco\ndef build():\n    raise ValueError('no size')\n",
)
EVIDENCE = Raises()
TOLD = {
    "timed_out": ("the world was still being built after {wall:.0f} s", "look for a loop that never ends at import"),
    "out_of_memory": ("building the world took more than 2 GB of memory", "build less, or refer to files"),
    "too_large": (
        "the engine was still compiling the world after {wall:.0f} s",
        "nothing else was looked at: build less",
    ),
    "died": ("the process that built the world died: {message}", "run the program, and correct what ends it"),
}


def check(view: ModelView) -> Iterator[Problem]:
    """Check the outcome."""
    outcome = view.outcome
    if outcome.status in TOLD:
        message, fix = TOLD[outcome.status]
        said = message.format(wall=outcome.wall_s, message=outcome.message or "no word")
        yield Problem(said, fix, 1, severity="warning" if outcome.status == "too_large" else None)
    if outcome.status == "failed" and outcome.failure == "ModuleNotFoundError" and not _is_ours(view):
        said = f"the world was not looked at, for a package is not installed here: {outcome.message}"
        yield Problem(said, "install it to have the world checked", outcome.line or 1, severity="info")
    elif outcome.status == "failed":
        said = " ".join(outcome.message.split())[:400]
        line = outcome.line
        if line is None and "line " in said:  # the compiler names the line of the model text
            number = said.rsplit("line ", 1)[1].split()[0].strip(".,)'")
            program = view.program
            line = int(number) if number.isdigit() and program is not None and program.source.is_mjcf else None
        yield Problem(
            f"the world cannot be built: {outcome.failure}: {said}", "correct what the message names", line or 1
        )


def _is_ours(view: ModelView) -> bool:
    """Whether it is a program of ours, which must run here."""
    return view.program is not None and view.program.contract
