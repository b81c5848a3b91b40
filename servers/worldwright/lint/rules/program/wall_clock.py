"""The program asks what time it is.

What it does: finds `time.time`, `perf_counter`, `sleep`, `datetime.now` and the like.

Why is this bad: simulated time is `data.time`. Real time differs between runs and machines, so the trajectory would
too, and the run could never be proven again.

Use instead: `data.time` in `control`, and step counts.
"""

from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL114"
SEVERITY = "error"
SCOPE = "contract"
GOOD = ("from worldkit import program\ndef control(model, data):\n    phase = data.time * 2.0\n",)
BAD = (
    "import time\nfrom worldkit import program\ndef control(model, data):\n    data.ctrl[0] = time.time()\n",
    "from time import perf_counter as now\nfrom worldkit import program\nstart = now()\n",
    "import datetime\nfrom worldkit import program\ndatetime.datetime.now()\n",
)
EVIDENCE = Measured(
    "two runs differ", lambda s: executed(s)["start"] - executed(s)["start"], 1e-9, "s", bad=1, good="start = 0.0\n"
)


def check(program: Program) -> Iterator[Problem]:
    """Check every call into a clock."""
    for full, call in program.calls("time.", "datetime."):
        if full.startswith("time.") or full.rsplit(".", 1)[1] in ("now", "today", "utcnow"):
            yield at(call, f"the program asks the wall clock ({full})", "use data.time, the simulated seconds")
