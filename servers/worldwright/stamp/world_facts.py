"""The facts beside a world's file: they belong to it, and are checked against plan and program, which say the same.

`program.json` holds what `program.main` was called with (how long, how fine the film, who should move, what is drawn only,
how often `control` is asked), `inputs.json` the inputs that the plan declares. Whoever changes them drives or judges the same
world otherwise, and a stamp that is sealed anew vouches for the change; so what plan and program say is read again here.
"""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..model.evidence.run import sha256_file
from ..model.plan.plan_text import read_plan

PROGRAM, INPUTS = "program.json", "inputs.json"
LARGEST = 1 << 20
SAID = ("duration", "fps", "size", "movers", "visual_only", "seed", "control", "control_every", "latency")


def differ(world: Path, facts: Path, program: Path, plan: Path, *, older: bool = False) -> Iterator[str]:
    """How the facts differ from what program and plan say, one line each; a damaged file is one line.

    Args:
        world: the world's file.
        facts: the folder of `program.json` and `inputs.json`.
        program, plan: the accepted ones.
        older: the facts were written by another build, whose defaults may have been others: only what the program's text
            writes is compared with it.
    """
    from ..lint import tools as lint
    from ..stage import tools as stage

    read: dict[str, Any] = {}
    for name, kind in ((PROGRAM, dict), (INPUTS, list)):
        try:
            read[name] = _read(facts / name, kind)
        except ValueError as cause:
            yield f"{name} is damaged: {cause}"
            return
    found = read[PROGRAM]
    if found.get("world_sha256") != sha256_file(world):
        yield f"{PROGRAM} is about another world"
    stated = lint.stated_facts(program, defaults=not older)
    for name in SAID:
        if name in stated and _plain(found.get(name)) != _plain(stated[name]):
            yield f"{PROGRAM} says {name} {_short(found.get(name))}, the program {_short(stated[name])}"
    if read[INPUTS] != json.loads(json.dumps(stage.declared_inputs(plan))):
        yield f"{INPUTS} is not what the plan declares"
    planned = read_plan(plan).plan.simulation_parameters.simulation_duration
    if isinstance(planned, int | float) and not _about(found.get("duration"), planned):
        yield f"{PROGRAM} says duration {_short(found.get('duration'))} s, the plan {planned:g} s"


def _about(value: Any, planned: float) -> bool:
    from .repeats import SHARE

    return isinstance(value, int | float) and abs(value - planned) <= SHARE * planned


def _read(path: Path, kind: type) -> Any:
    """A JSON value of this type.

    Raises:
        ValueError: it is missing, too large, cut off, holds NaN, or is something else.
    """
    from ..stage import tools as stage

    content = stage.read_plain(path, LARGEST)
    if content is None:
        raise ValueError(f"it is no plain file of at most {LARGEST >> 20} MB")
    try:
        value = json.loads(content, parse_constant=_no_number)
    except RecursionError as cause:
        raise ValueError("it is nested too deeply") from cause
    if not isinstance(value, kind):
        raise ValueError(f"it holds no {'object' if kind is dict else 'list'}")
    return value


def _no_number(text: str) -> float:
    raise ValueError(f"it holds {text}")


def _plain(value: Any) -> Any:
    """A value as JSON has it: no name of a control is the empty one."""
    return list(map(_plain, value)) if isinstance(value, list | tuple) else value or None


def _short(value: Any) -> str:
    try:
        return json.dumps(value)[:80]
    except (TypeError, ValueError):
        return str(value)[:80]
