"""The subject is turned by an angle drawn from a range: the disorder of what nobody arranged.

    deg_z = min_deg + u (max_deg - min_deg), rounded to the nearest min_deg + k step_deg when `step_deg` is given

u in [0, 1) is the first 64 bits of BLAKE2b of "`seed`:name" over 2^64: the same on every machine, in every order of the
rows, and different for each subject. `min_deg` and `max_deg` bound the angle; `step_deg` must be above 0; `seed` omitted
is the plan's own.
Source: paper, predicate algebra, rotation-only (the excerpt is silent on parameters; these are ours).
"""

import math
from hashlib import blake2b

from ..anchors import TOLERANCE_DEG, Box, Derivation, shown, wrap
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "RANDOM-ROT"
FAMILY = "Orientation"
REFERENCE = "none"
PARAMS = {
    "min_deg": Parameter("number", "smallest yaw, degrees", required=True),
    "max_deg": Parameter("number", "largest yaw, degrees", required=True),
    "step_deg": Parameter("number", "only angles min_deg + k step_deg, degrees", 0.001),
    "seed": Parameter("number", "of the draw; omitted: simulation_parameters.seed"),
}
UNIT = "deg"
GOOD = (
    Case({"name": "rug", "size": (1, 1, 1)}, None, {"min_deg": 5.0, "max_deg": 5.0, "seed": 0.0}, {"yaw": 5.0}),
    Case(
        {"name": "crate", "size": (1, 1, 1)},
        None,
        {"min_deg": 0.0, "max_deg": 350.0, "step_deg": 90.0, "seed": 7.0},
        {"yaw": 180.0},
    ),
)
BAD = (Case({"size": (1, 1, 1), "yaw": 40.0}, None, {"min_deg": -10.0, "max_deg": 10.0, "seed": 0.0}),)


def refuse(params: dict) -> tuple[str, str] | None:
    """Refuse a range whose ends are in the wrong order."""
    if params["max_deg"] < params["min_deg"]:
        return ("`max_deg` is below `min_deg`", "swap them")
    return None


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the yaw."""
    return {"yaw": ()}


def _drawn(name: str, params: dict) -> float:
    low, high, step = params["min_deg"], params["max_deg"], params.get("step_deg")
    u = int.from_bytes(blake2b(f"{params['seed']:g}:{name}".encode(), digest_size=8).digest(), "big") / 2**64
    if step:
        return float(low + step * math.floor(u * (math.floor((high - low) / step) + 1)))
    return float(low + u * (high - low))


def resolve(dof: str, subject: Box, reference: Box | None, params: dict) -> Derivation:
    """Compute the drawn yaw."""
    value = wrap(_drawn(subject.name, params))
    low, high = shown(params["min_deg"]), shown(params["max_deg"])
    return Derivation(value, f"deg_z = drawn from {low} to {high}, seed {params['seed']:g} = {shown(value)}")


def holds(subject: Box, reference: Box | None, params: dict) -> float:
    """Return the tolerance minus the angle between the subject's front and the drawn heading, degrees."""
    return TOLERANCE_DEG - abs(wrap(subject.get("yaw") - _drawn(subject.name, params)))
