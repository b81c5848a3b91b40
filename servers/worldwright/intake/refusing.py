"""Why a file cannot become an asset."""

from ..model.errors import WorldwrightError


class IntakeFailedError(WorldwrightError):
    """A file cannot become an asset; `code` says why, and nothing was registered."""

    code = "intake"

    def __init__(self, cause: str, *, code: str = "intake", place: str = "", next_move: str = "") -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code = code
