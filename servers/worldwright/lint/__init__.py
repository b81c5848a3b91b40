"""lint: may this plan be committed; may this program run?

Rules live on four shelves, `rules/program` (WL…), `rules/model` (WM…), `rules/run` (WR…) and `rules/plan` (WP…): one small
module each, documented by its docstring, proven by its own GOOD and BAD cases, and by EVIDENCE that the harm is real. A
program is read here, never executed: in the sandbox of stage its world is compiled and comes back as numbers
(`compiled`), and a plain script is run under watch and comes back as events (`observed`).
"""

from ..model.evidence.reports import LintReport
from ..model.finding import Finding

__all__ = ["Finding", "LintReport"]
