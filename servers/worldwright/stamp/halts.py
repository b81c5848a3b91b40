"""How a step of a walk along a run ends it: something is wrong, somebody's turn has come, or the time is over."""


class WrongError(Exception):
    """A step says no; carries all that it found."""

    def __init__(self, *found: tuple[str, str]) -> None:
        super().__init__(found[0][0])
        self.found = found  # what, and the next move


class TurnError(Exception):
    """Somebody has to decide or to write something before the run goes on."""

    def __init__(self, what: str, next_move: str) -> None:
        super().__init__(what)
        self.next_move = next_move


class RunningError(Exception):
    """Something goes on by itself when this call's time is over."""
