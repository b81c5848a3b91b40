"""What `accept` answers."""

from typing import Literal

from ..model.frozen import Frozen
from . import signing


class Accepted(Frozen):
    """The answer of `accept`."""

    state: Literal["accepted", "proving"]
    """`proving`: the proof run needs longer than this call may take; it goes on by itself."""
    run: str
    folder: str = ""
    stamp_sha256: str = ""
    signature: signing.Signature | None = None
    """The signature on the stamp, and whose key made it."""
    trajectory_sha256: str = ""
    stripped_lines: int = 0
    files: tuple[str, ...] = ()
    not_looked_at: tuple[int, ...] = ()
    """Indices of objectives that only a picture can show, and whose pictures nobody has looked at."""
    already: bool = False
    """This exact program and plan had been accepted before: nothing was proved by this call."""
    proof_earlier: bool = False
    """The proof run is an earlier call's; this one simulated nothing anew."""
    proof_began: str = ""
    """When the proof run began, ISO 8601, UTC; of older stamps it is not known."""
    proof_key: str = ""
    """The evidence key of the proof run."""
    under_way: str = ""
    """While it is proved: how far that is, about how long it still takes, and what is at work beside it."""
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """Whether the world is stamped."""
        return self.state == "accepted"

    def text(self) -> str:
        """The answer as a person reads it."""
        if not self.ok:
            far = f": {self.under_way}" if self.under_way else ""
            return f"{self.run}: the proof run goes on{far}\n  next: {self.next_move}"
        stripped = f", {self.stripped_lines} lines of instrumentation taken out" if self.stripped_lines else ""
        unseen = ", ".join(map(str, self.not_looked_at))
        blind = f"  NOT LOOKED AT      objective {unseen}: claimed for the eye, counted only\n" if unseen else ""
        return (
            f"{self.run}: {'already ' * self.already}accepted in {self.folder} ({len(self.files)} files{stripped})\n"
            f"  stamp sha256       {self.stamp_sha256}\n"
            f"  {self.signature.text() if self.signature else 'unsigned'}\n"
            f"  trajectory sha256  {self.trajectory_sha256}\n"
            f"  proof run          {self._proof_run()}\n"
            f"{blind}  next: {self.next_move}"
        )

    def _proof_run(self) -> str:
        when = f"begun {self.proof_began}" if self.proof_began else "begun nobody knows when"
        key = f", evidence key {self.proof_key}" if self.proof_key else ""
        return f"{when}{key}" + (": an earlier call's, nothing was simulated by this one" if self.proof_earlier else "")
