"""Whether a program builds the world that is kept: the same content, or elsewhere the same within a tolerance.

Both files are compiled and compared in the sandbox, since the author made them.
"""

import json
import sys
from collections.abc import Sequence
from pathlib import Path

from worldkit import closed_archive
from worldkit.portable import TOLERANCE

from ..model.errors import JobError

SAME = "the same content"
WALL_S, MEMORY_MB = 600.0, 8192
"""Of the comparison, which holds two worlds; a pass, which holds one, may take half the memory (`stage.launch`)."""
INSTEAD = {
    "timed_out": "call it again when the machine has less to do",
    "out_of_memory": f"let the world be smaller: comparing two of it takes more than {MEMORY_MB} MB",
    "refused": "see why no sandbox confines here: worldwright doctor",
}
OF_MACHINE = {"world_sha256", "rounded"}
"""Facts that depend on how a machine packs and rounds."""


class OtherWorldError(ValueError):
    """The program builds another world than the one that is kept; the text names what differs."""


def compare(kept: Path, built: Path, *, elsewhere: bool) -> str:
    """How alike a kept world's file and the one that its program builds now are, in a few words.

    Args:
        kept, built: the two files.
        elsewhere: this is not the environment or the processor that built the kept one: rounding is accepted.

    Raises:
        OtherWorldError: they differ, in the field of the compiled model, or the place in the file, that it names.
        JobError: the comparison itself came to no end.
    """
    try:
        before, now = closed_archive.packed(kept), closed_archive.packed(built)
    except ValueError as cause:
        raise OtherWorldError(f"it cannot be compared: {cause}") from cause
    if before == now:
        return SAME
    unlike = _first_difference(before, now)
    del before, now  # each may be as large as an archive may be
    apart, where = _apart(kept, built)
    said = f"{where} differs" + (f" by {apart:.2g} of its size" if apart < float("inf") else "")
    if apart > TOLERANCE:
        raise OtherWorldError(said)
    told = f"{said if apart else 'no number of its motion differs'}; {unlike}"
    if not elsewhere:
        raise OtherWorldError(told)
    return f"the same within {TOLERANCE:g}: {told}"


def same_facts(kept: Sequence[Path], built: Sequence[Path], *, elsewhere: bool) -> None:
    """Compare the files beside a kept world with those beside the one that is built now; elsewhere, what both know.

    Raises:
        OtherWorldError: they differ, in the fact that it names.
    """
    for one, other in zip(kept, built, strict=True):
        try:
            before, now = json.loads(one.read_bytes()), json.loads(other.read_bytes())
        except (OSError, ValueError, RecursionError) as cause:
            raise OtherWorldError(f"{one.name} cannot be read: {cause}") from cause
        if not (isinstance(before, dict) and isinstance(now, dict)):
            before, now = {one.stem: before}, {one.stem: now}
        named = before.keys() & now.keys() if elsewhere else before.keys() | now.keys()
        for name in sorted(named - OF_MACHINE):
            if before.get(name) != now.get(name):
                told = [json.dumps(facts.get(name))[:80] for facts in (before, now)]
                raise OtherWorldError("{} differs: {}, now {}".format(f"`{name}` of {one.name}", *told))


def _apart(kept: Path, built: Path) -> tuple[float, str]:
    """(largest relative difference, field) of the compiled models."""
    from ..stage import tools as stage

    call = [sys.executable, "-s", "-P", "-m", "worldkit.two_worlds", str(kept), str(built), "{out}/apart.json"]
    done = stage.run_confined(call, reads=(kept, built), wanted=("apart.json",), wall_s=WALL_S, memory_mb=MEMORY_MB)
    if done.status != "ended":
        raise JobError(
            f"the world that was built again could not be compared with the kept one: {done.status}",
            code=done.status,
            place=str(kept),
            next_move=INSTEAD.get(done.status, "call it again"),
        )
    try:
        told = json.loads(done.files["apart.json"])
        if "failure" in told:
            raise OtherWorldError(f"one of them does not compile: {told['failure'][:200]}")
        return (float("inf") if told["apart"] is None else float(told["apart"])), str(told["where"])[:80]
    except (KeyError, TypeError, json.JSONDecodeError) as cause:
        raise OtherWorldError(f"it cannot be compared: {done.log[-300:].strip() or cause}") from cause


def _first_difference(kept: dict[str, bytes], built: dict[str, bytes]) -> str:
    """Which file of an archive differs first, and in which line where that is the world's text."""
    name = next(name for name in sorted(kept.keys() | built.keys()) if kept.get(name) != built.get(name))
    if kept.get(closed_archive.XML) == built.get(closed_archive.XML):
        return f"seen in its {name}"
    lines = [files.get(closed_archive.XML, b"").splitlines() for files in (kept, built)]
    at = next((i for i, (a, b) in enumerate(zip(*lines, strict=False)) if a != b), min(map(len, lines)))
    told = (b"".join(part[at : at + 1]).decode(errors="replace").strip()[:120] for part in lines)
    return "seen in its {}, line {}: `{}`, now `{}`".format(closed_archive.XML, at + 1, *told)
