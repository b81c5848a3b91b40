"""How what a stamp vouches for was proved, channel by channel, and what limits it: the words of the statement.

`exact`: it came out the same bit for bit. `law re-run`: what makes it (a program's `control`, a solver beside the engine)
was run again on the same states and gave the same. `tolerance`: it is compared within a stated one.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Literal

from .proof import Proved

Kind = Literal["exact", "law re-run", "tolerance"]
MOTION, INPUTS, PICTURES = "motion", "inputs", "pictures"
DRAWN = ("stills/", "video/")
FLAGS = {
    "sleep": "bodies may sleep: who sleeps is stored nowhere, so the motion repeats from its start only",
    "ipc": "barrier contact (ipc): its search may end elsewhere on another build or number of threads",
}
"""Options of the engine under which a motion cannot be taken up from a stored state, or depends on more than the bundle."""
PLUGIN = "engine plugins: their state is stored nowhere, so the motion repeats from its start only"
GPU = "computed on a GPU: sums in no fixed order, so the motion repeats within a tolerance only"


def channels(proved: Proved, names: Iterable[str]) -> dict[str, Kind]:
    """The kind of proof of each channel of a proof run; `names` are those of the files that are kept of it."""
    found: dict[str, Kind] = {MOTION: "exact"}
    if proved.inputs_sha256:
        found[INPUTS] = "law re-run"
    for row in _meta(proved).get("solvers") or ():
        found[f"solver {row['solver']['name']}"] = "law re-run"
    return found | ({PICTURES: "tolerance"} if any(name.startswith(DRAWN) for name in names) else {})


def marks(proved: Proved) -> tuple[str, ...]:
    """What limits the exactness of a proof run's motion; empty when it follows from its world and inputs alone."""
    return tuple(_marks(_meta(proved)))


def _marks(meta: Mapping[str, Any]) -> Iterator[str]:
    enabled = (meta.get("flags") or {}).get("enabled") or ()
    yield from (text for flag, text in FLAGS.items() if flag in enabled)
    if meta.get("has_plugin"):
        yield PLUGIN
    if meta.get("device", "cpu") != "cpu":
        yield GPU


def _meta(proved: Proved) -> Mapping[str, Any]:
    from worldengine.recording import stored

    return stored.open(proved.recording).meta
