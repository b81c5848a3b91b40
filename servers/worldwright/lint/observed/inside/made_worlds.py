"""Report what is odd about a compiled world, on the line of the program that speaks of it."""

import re
from typing import Any

import numpy as np
from owners import ModelState, raw
from said import SAID

TEXT: list[str] = []
"""The program's lines."""


def line_with(pattern: str, otherwise: int) -> int:
    """The first line of the program where a pattern stands."""
    return next((n for n, line in enumerate(TEXT, 1) if re.search(pattern, line)), otherwise)


def look(state: ModelState, text: str) -> None:
    """Look at everything that is odd about a new model."""
    model = state.of
    for check in (_margins, _contact_times, _gains, _angles):
        check(model, state.made_line, text)
    state.made_line = state.made_line or 1


def _margins(model: Any, line: int, text: str) -> None:
    margin, gap = raw(model, "geom_margin"), raw(model, "geom_gap")
    if ((margin > 0) & (np.abs(margin - gap) < 1e-12)).any():
        SAID.event("margin_equals_gap", line_with(r"margin\s*=", line), margin=float(margin.max()))


def _contact_times(model: Any, line: int, text: str) -> None:
    for name in ("geom_solref", "jnt_solref", "eq_solref", "pair_solref"):
        found = np.asarray(raw(model, name)).reshape(-1, 2)
        long = found[:, 0] > 2.0
        if long.any():
            time, ratio = found[long][0]
            SAID.event("solref_sign", line_with(r"solref\s*=", line), time=float(time), ratio=float(ratio), name=name)
            return


def _gains(model: Any, line: int, text: str) -> None:
    bias, kind = np.asarray(raw(model, "actuator_biasprm")), np.asarray(raw(model, "actuator_biastype"))
    odd = (kind == 0) & np.abs(bias).any(axis=1)
    if odd.any():
        SAID.event("bias_not_used", line_with(r"biasprm|set_to_", line))


def _angles(model: Any, line: int, text: str) -> None:
    """Report angles that a program computes, all too small to be meant in degrees."""
    if not text or re.search(r'angle\s*=\s*["\']radian', text) or "euler" not in text:
        return
    computed = [n for n, text_line in enumerate(TEXT, 1) if re.search(r'euler=["\'][^"\'>]*\{', text_line)]
    if not computed:
        return
    values = [float(v) for group in re.findall(r'euler\s*=\s*["\']([^"\']*)["\']', text) for v in group.split()]
    some = [abs(v) for v in values if v]
    if some and max(some) < 1.6 and any(abs(v - round(v)) > 1e-9 for v in some):
        SAID.event("radians_in_text", computed[0], largest=max(some))


def text_of(line: int) -> str:
    """One line of the program."""
    return TEXT[line - 1] if 0 < line <= len(TEXT) else ""


def says(pattern: str) -> bool:
    """Whether a pattern stands anywhere in the program."""
    return any(re.search(pattern, line) for line in TEXT)


def com_jacobian(state: Any, everything: list[Any], line: int) -> None:
    """Report the Jacobian of a centre of mass in a program that speaks of body origins only."""
    body = int(everything[-1])
    apart = np.linalg.norm(raw(state.of, "xipos")[body] - raw(state.of, "xpos")[body])
    if apart > 1e-6 and says(r"\bxpos\b") and not says(r"\bx?ipos\b|subtree_com"):
        SAID.event("com_jacobian", line, apart=float(apart))


def first_step(state: Any, line: int) -> None:
    """Report deep overlaps before anything moved."""
    model = state.model.of
    radii = raw(model, "geom_rbound")
    bodies, size, kind = raw(model, "geom_bodyid"), raw(model, "geom_size"), raw(model, "geom_type")
    deepest = 0.0
    for contact in raw(state.of, "contact"):
        one, other = contact.geom1, contact.geom2
        if min(one, other) < 0 or contact.exclude or contact.efc_address < 0 or bodies[one] == bodies[other]:
            continue
        thin = [float(size[g][: 1 if kind[g] in (2, 3, 5) else 3].min()) for g in (one, other) if radii[g] > 0]
        if thin and kind[one] not in (1, 7) and kind[other] not in (1, 7):
            deepest = max(deepest, -contact.dist / max(min(thin), 1e-9))
    if deepest > 0.5:
        SAID.event("overlap_at_start", state.model.made_line, share=round(deepest, 2))


def fell_through(state: Any) -> None:
    """Report a free body far below a floor that its masks let it pass."""
    model = state.model.of
    data = state.of
    if (raw(model, "opt").disableflags if hasattr(raw(model, "opt"), "disableflags") else 0) & 1:
        return
    types, con, aff = raw(model, "geom_type"), raw(model, "geom_contype"), raw(model, "geom_conaffinity")
    bodies, tree = raw(model, "geom_bodyid"), raw(model, "body_treeid")
    pairs = {
        frozenset(p) for p in zip(raw(model, "pair_geom1").tolist(), raw(model, "pair_geom2").tolist(), strict=True)
    }
    floors = [g for g in range(model.ngeom) if types[g] == 0 and tree[bodies[g]] < 0 and (con[g] or aff[g])]
    for floor in floors:
        height = raw(data, "geom_xpos")[floor][2]
        for geom in range(model.ngeom):
            if tree[bodies[geom]] < 0 or not (con[geom] or aff[geom]) or frozenset((floor, geom)) in pairs:
                continue
            meet = (con[geom] & aff[floor]) or (con[floor] & aff[geom])
            if not meet and raw(data, "geom_xpos")[geom][2] < height - 2 * float(raw(model, "geom_rbound")[geom]) - 0.5:
                SAID.event("fell_through", line_with(r"<geom[^>]*(contype|conaffinity)=.\d", state.model.made_line))
                return
