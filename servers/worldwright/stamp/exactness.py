"""How what a stamp vouches for was proved, channel by channel, and what limits it: the words of the statement.

`exact`: it came out the same bit for bit. `law re-run`: what makes it (a program's `control`, a solver beside the engine)
was run again on the same states and gave the same. `tolerance`: it is compared within a stated one.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Literal

from ..model.recording import laws_told
from .proof import Proved

Kind = Literal["exact", "law re-run", "tolerance"]
MOTION, INPUTS, PICTURES = "motion", "inputs", "pictures"
MEDIUM = "medium by the author's law "
"""Begins the channel of what a law of the author's moves; its name follows."""
DRAWN = ("stills/", "video/")
LIMITS = {
    "sleep": "bodies may sleep: who sleeps is stored nowhere, so the motion repeats from its start only",
    "ipc": "barrier contact (ipc): its search may end elsewhere on another build or number of threads",
    "plugin": "engine plugins: their state is stored nowhere, so the motion repeats from its start only",
}
"""Under what a motion cannot be taken up from a stored state, or depends on more than the bundle; a stamp holds the words in front."""
WRITTEN = {"bodies may sleep": "sleep", "barrier contact": "ipc", "engine plugins": "plugin"}
"""How the sentences begin that earlier stamps hold instead."""


def channels(proved: Proved, names: Iterable[str]) -> dict[str, Kind]:
    """The kind of proof of each channel of a proof run; `names` are those of the files that are kept of it."""
    found: dict[str, Kind] = {MOTION: "exact"}
    if proved.inputs_sha256:
        found[INPUTS] = "law re-run"
    for row in _meta(proved).get("solvers") or ():
        found[f"solver {row['solver']['name']}"] = "law re-run"
    for law in laws_told.of(_meta(proved), str(proved.recording)):
        found[f"{MEDIUM}{law.name}"] = "law re-run"
    return found | ({PICTURES: "tolerance"} if any(name.startswith(DRAWN) for name in names) else {})


def told(found: Mapping[str, str], limits: Iterable[str], *, exact: bool, asked: bool) -> str:
    """What a verification has proved of each channel, and what limits it, in words.

    Args:
        found: the kinds of the channels (`channels`).
        limits: the `marks`.
        exact: the motion came out the same bit for bit.
        asked: the program was run, and asked again for its inputs.
    """
    here = {MOTION: found[MOTION] if exact else "tolerance", INPUTS: found.get(INPUTS) if asked else "as recorded"}
    here |= {} if asked else {channel: "as recorded" for channel in found if channel.startswith(MEDIUM)}
    kinds = ", ".join(f"{channel} {here.get(channel, kind)}" for channel, kind in found.items())
    return "; ".join((kinds, *(LIMITS[mark] for mark in limits)))


def coded(marks: Iterable[str]) -> tuple[str, ...]:
    """The marks of a stamp as they are written now."""
    return tuple(next((code for begun, code in WRITTEN.items() if mark.startswith(begun)), mark) for mark in marks)


def marks(proved: Proved) -> tuple[str, ...]:
    """What limits the exactness of a proof run's motion; empty when it follows from its world and inputs alone."""
    return tuple(_marks(_meta(proved)))


def _marks(meta: Mapping[str, Any]) -> Iterator[str]:
    enabled = (meta.get("flags") or {}).get("enabled") or ()
    yield from (name for name in LIMITS if name in enabled or (name == "plugin" and meta.get("has_plugin")))


def _meta(proved: Proved) -> Mapping[str, Any]:
    from worldengine.recording import stored

    return stored.open(proved.recording).meta
