"""Failures a user can act on: each names its cause, its place and the next move.

Failures that are a tool's answer (a lint finding, a failed pass) are data, not exceptions; these are for calls that
cannot be answered at all.
"""


class WorldwrightError(Exception):
    """A call that cannot be answered; `code` is stable, `next_move` is what to do about it."""

    code = "error"

    def __init__(self, cause: str, *, place: str = "", next_move: str = "") -> None:
        super().__init__(cause)
        self.cause = cause
        self.place = place
        self.next_move = next_move

    def __str__(self) -> str:
        text = f"{self.place}: {self.cause}" if self.place else self.cause
        return f"{text}\n  next: {self.next_move}" if self.next_move else text

    def to_dict(self) -> dict[str, str]:
        """The error as the JSON object that clients receive."""
        return {"error": self.code, "cause": self.cause, "place": self.place, "next": self.next_move}


class NotFoundError(WorldwrightError):
    """A named file, run, job, rule, body or asset does not exist; the message lists the ones that do."""

    code = "not_found"


class PlanError(WorldwrightError):
    """The plan cannot be read as a plan; `findings` holds every problem with its line."""

    code = "plan"

    def __init__(self, cause: str, *, findings: tuple = (), place: str = "", next_move: str = "") -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.findings = findings


class GateError(WorldwrightError):
    """A gate refused: something it needs has not been proven yet."""

    code = "gate"


class JobError(WorldwrightError):
    """A staged pass failed; `code` says how (crashed, timed_out, out_of_memory, too_much_output, …)."""

    code = "job"

    def __init__(self, cause: str, *, code: str = "job", place: str = "", next_move: str = "") -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code = code


class CallOverError(JobError):
    """A client's call ended before the work in it was done, which says nothing about the work: who asks again gets an answer."""

    def __init__(self, cause: str, *, place: str = "", next_move: str = "") -> None:
        super().__init__(cause, code="timed_out", place=place, next_move=next_move)


class RecordingError(WorldwrightError):
    """A recording cannot be read."""

    code = "recording"
