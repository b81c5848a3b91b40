"""lint: may this plan be committed; may this program run?

Rules live on two shelves, `rules/program` (WL…) and `rules/plan` (WP…): one small module each, documented by its
docstring and proven by its own GOOD and BAD cases. A linted program is read, never executed.
"""

from ..model.evidence import LintReport
from ..model.finding import Finding

__all__ = ["Finding", "LintReport"]
