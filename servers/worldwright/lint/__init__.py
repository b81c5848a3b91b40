"""lint: may this plan be committed; may this program run?

Rules live on three shelves, `rules/program` (WL…), `rules/model` (WM…) and `rules/plan` (WP…): one small module each,
documented by its docstring, proven by its own GOOD and BAD cases, and by EVIDENCE that the harm is real. A program is
read here, never executed: its world is compiled in the sandbox of stage, and comes back as numbers (`compiled`).
"""

from ..model.evidence import LintReport
from ..model.finding import Finding

__all__ = ["Finding", "LintReport"]
