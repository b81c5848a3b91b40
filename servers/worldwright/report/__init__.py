"""Report: a run folder as one page for eyes, a Rerun recording, and progress bars.

`write(run)` makes the run's self-contained `report.html` from whatever files are there; `rerun.record(run)` writes a
recording for the Rerun viewer when the extra `view` is installed.
"""

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..model.evidence.run import Run


def write(run: "Run") -> Path:
    """Write the run's `report.html` and return its path; missing pieces are named in it, never fatal."""
    from .page import write as write_page

    return write_page(run)
