"""The steps from a plan to an accepted world, in their order, each with its one name.

`worldwright go` takes them, `worldwright stamp status` shows which hold, the gates require them and the README draws
them; a test compares all four with this list.
"""

from typing import Literal, get_args

StepName = Literal[
    "check",
    "place",
    "approve",
    "draft",
    "lint",
    "physics",
    "scan",
    "expect",
    "causes",
    "stills",
    "video",
    "describe",
    "review",
    "accept",
]
STEPS: tuple[StepName, ...] = get_args(StepName)
