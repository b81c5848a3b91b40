"""The next move when something is to be written: which file a repair changes, by its target; the film, before it is drawn."""

from ..model.belief import JUDGE_NOW
from ..model.evidence.verdict import RepairTarget
from .state import State

SHOWN: tuple[RepairTarget, ...] = ("look", "not_recognised", "visual_mismatch")
"""What is mended where a recording is shown: it is neither simulated nor measured again for that."""


def next_move(state: State, target: RepairTarget | None) -> str:
    """The one file to patch for a target, and what else may hold the line that has to change."""
    place = state.place
    if target == "plan":
        return f"correct {place}/plan.md, one patch, then `worldwright stamp approve {place}`"
    if target in SHOWN:
        word = "correct" if (state.run.folder / "film.py").is_file() else "write"
        return f"{word} {place}/film.py, one patch; or simulation.py, where the plan's cameras show it, too"
    if target == "camera_placement":
        return f"correct the cameras of {place}/plan.md, one patch, or the shots of film.py, where it is the film"
    return f"correct {place}/simulation.py, one patch"


def of_anomaly(state: State, code: str) -> str:
    """The file to patch for a blocking anomaly: the plan first where what it claims is wrong as often as what the world does."""
    from ..scan.tools import of_claim

    place = state.place
    if of_claim(code):
        return f"correct what {place}/plan.md claims, if that is wrong, and have it approved anew; or simulation.py"
    return f"correct {place}/simulation.py, one patch; or the plan, if it is wrong"


def film_first(state: State, moving: str = "") -> str:
    """The move once the claims hold and nothing is filmed yet: the film is looked at before minutes go into a video pass.

    `moving` is where it was drawn roughly.
    """
    from ..draft.writing import film_as_drafted

    film, go = f"{state.place}/film.py", f"`worldwright go {state.place}`"
    frames = f"`worldwright stage frames {state.place} --show"
    if not (state.run.folder / "film.py").is_file():
        return f"write {film} (skill `film`), then {frames} moving` and {frames} shots --save FOLDER`; {JUDGE_NOW}; then {go}"
    change = f"change what {film} marks CHANGE (skill `film`)" if film_as_drafted(state.run) else f"mend {film}"
    look = f"look at {moving}" if moving else f"{frames} moving`"
    return f"{look}; {JUDGE_NOW}; {change}, {frames} moving` or {frames} shots --save FOLDER` again; then {go}"
