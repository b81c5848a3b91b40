"""Compare the point of a body that a Jacobian belongs to with the point that the program uses."""

from typing import Any

import numpy as np
from owners import DataState, raw
from said import SAID

ASKED: dict[int, tuple[DataState, int, str]] = {}
"""For each line: the state and body of its Jacobian, and the array of positions that it belongs to."""
TAKEN: dict[tuple[int, str], set[int]] = {}
"""For each state and array: objects whose position was read."""
POINTS = {"site_xpos": "site_bodyid", "geom_xpos": "geom_bodyid"}


def taken(owner: Any, field: str, at: Any) -> None:
    """Remember that a position was read."""
    if field in ("xpos", "xipos", "subtree_com", *POINTS) and at is not None and 0 < at.size <= 3:
        TAKEN.setdefault((id(owner), field), set()).add(int(np.ravel(at)[0]) // 3)


def asked(name: str, state: DataState, everything: list[Any], line: int) -> None:
    """Remember a call of mj_jacBody or mj_jacBodyCom; if the program uses another point, `at_end` reports it."""
    if len(everything) == 5 and everything[2] is not None:
        ASKED.setdefault(line, (state, int(everything[4]), "xpos" if name == "mj_jacBody" else "xipos"))


def applied(state: DataState, everything: list[Any], line: int) -> None:
    """Report a point far from the body on which it should lie: it is given in another frame."""
    point, body = everything[4:6]
    if not isinstance(point, np.ndarray) or point.size != 3 or not isinstance(body, int) or body <= 0 or state.dirty:
        return
    model = state.model.of
    own = np.flatnonzero(raw(model, "geom_bodyid") == body)
    if not len(own):
        return
    reach = float((np.linalg.norm(raw(model, "geom_pos")[own], axis=1) + raw(model, "geom_rbound")[own]).max())
    origin = raw(state.of, "xpos")[body]
    apart, far = float(np.linalg.norm(point - origin)), float(np.linalg.norm(origin))
    if apart > 3 * reach + 0.05 and float(np.linalg.norm(point)) <= 1.5 * reach and far > reach:
        SAID.event("local_point", line, apart=round(apart, 3))


def at_end() -> None:
    """Report the Jacobian of a body of which the program only reads the position of a geom or a site."""
    for line, (state, body, origin) in ASKED.items():
        if any(body in TAKEN.get((id(state), field), ()) for field in ("xpos", "xipos", "subtree_com")):
            continue
        model = state.model.of
        for field, carrier in POINTS.items():
            for place in TAKEN.get((id(state), field), ()):
                if int(raw(model, carrier)[place]) != body:
                    continue
                apart = float(np.linalg.norm(raw(state.of, field)[place] - raw(state.of, origin)[body]))
                if apart > 1e-3:
                    SAID.event("body_jacobian", line, apart=round(apart, 4), point=field.split("_")[0], origin=origin)
                    return
