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


def film_first(state: State) -> str:
    """The move once the claims hold and nothing is filmed yet: every shot is looked at before minutes go into a video pass."""
    write = "" if (state.run.folder / "film.py").is_file() else f"write {state.place}/film.py (skill `film`), then "
    look = f"`worldwright stage frames {state.place} --show shots --save FOLDER`"
    return f"{write}{look}; {JUDGE_NOW}; then `worldwright go {state.place}`"
