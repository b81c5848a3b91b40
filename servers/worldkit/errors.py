"""Failures of the runtime that a user can act on: each names its cause, its place and the next move."""


class WorldkitError(Exception):
    """A failure of the runtime; `code` is stable, `next_move` is what to do about it."""

    code = "error"

    def __init__(self, cause: str, place: str = "", next_move: str = "", line: int | None = None) -> None:
        super().__init__(cause)
        self.cause = cause
        self.place = place
        self.next_move = next_move
        self.line = line
        """The line of the program to blame, where no frame of the traceback lies in it."""

    def __str__(self) -> str:
        text = f"{self.place}: {self.cause}" if self.place else self.cause
        return f"{text}\n  next: {self.next_move}" if self.next_move else text


class RecordingError(WorldkitError):
    """A recording cannot be read, written, or replayed on this model."""

    code = "recording"


class ProgramError(WorldkitError):
    """The program asks for something that cannot be simulated (a wrong world, duration, name, option)."""

    code = "program"


class DivergedError(WorldkitError):
    """The simulation blew up: a position, velocity or acceleration stopped being a sane number."""

    code = "diverged"


class SeamError(WorldkitError):
    """There is no such entry of a seam (a renderer, a solver, a source of assets), or it lacks what its protocol names."""

    code = "seam"


class IntakeError(WorldkitError):
    """A file cannot become an asset; its `code` says why (`truncated`, `zero_volume`, `too_many_faces`, …)."""

    def __init__(self, code: str, cause: str, place: str = "", next_move: str = "") -> None:
        super().__init__(cause, place, next_move)
        self.code = code
