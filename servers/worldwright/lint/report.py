"""Lint results for a person to read: place, cause, the source line, and the fix."""

from pathlib import Path
from typing import TYPE_CHECKING

from ..model.evidence.reports import LintReport
from ..model.finding import Finding
from ..model.frozen import Frozen
from .problem import NOT_TRIED

if TYPE_CHECKING:
    from rich.text import Text

MAX_FINDINGS = 80
"""A tool's answer stays below 20 KB."""


class ShownReport(LintReport):
    """A lint report that can be printed with source excerpts."""

    files: int = 1
    """The number of files that were checked."""
    kept: str = ""
    """Where the report was stored as evidence, when the program belongs to a run."""
    worlds: tuple[str, ...] = ()
    """For each file whose world was wanted: how compiling it went."""
    fixed: tuple[str, ...] = ()
    """For each file: what `fix` changed."""

    def sarif(self) -> str:
        """The report as a SARIF 2.1 log."""
        from .formats import sarif

        return sarif(self.findings)

    def github(self) -> str:
        """The report as annotations of a GitHub workflow."""
        from .formats import github

        return github(self.findings)

    def rich(self) -> "Text":
        """The text in colours, for a terminal."""
        from rich.text import Text

        text = Text(self.text())
        text.highlight_regex(r"(?m)^.*?: (?=error|warning|info )", "bold")
        for word, style in (("error", "bold red"), ("warning", "bold yellow"), ("info", "cyan")):
            text.highlight_regex(rf"(?<=: ){word} W[LMPR][0-9]+ [a-z_]+", style)
        text.highlight_regex(r"(?m)^  > .*$", "bold")
        text.highlight_regex(r"(?m)^ +\| +\^$", "red")
        text.highlight_regex(r"(?m)^    fix: .*$", "green")
        return text

    def text(self) -> str:
        """The findings with excerpts, then one line of summary."""
        sources: dict[str, list[str]] = {}
        parts = [_shown(finding, sources) for finding in self.findings]
        errors = sum(f.severity == "error" for f in self.findings)
        warnings = sum(f.severity == "warning" for f in self.findings)
        files = f"{self.files} file{'s' * (self.files != 1)}"
        verdict = f"{errors} error{'s' * (errors != 1)}, {warnings} warning{'s' * (warnings != 1)}"
        untried = [line.partition(":")[0] for line in self.worlds if NOT_TRIED in line]
        clean = "clean" if not self.findings else verdict
        if untried:  # reading alone finds little of what may be wrong with it
            clean = f"{'nothing found' if not self.findings else verdict} by reading; NOT TRIED: {', '.join(untried)}"
        parts += [*self.fixed, *self.worlds]
        parts.append(f"{files}, {self.rules} rules: {clean}" + (f" (kept as {self.kept})" if self.kept else ""))
        return "\n".join(parts)


def capped(found: list[Finding]) -> tuple[Finding, ...]:
    """At most `MAX_FINDINGS`; errors are kept before all others, and the last finding says how many are left out."""
    if len(found) <= MAX_FINDINGS:
        return tuple(found)
    rank = {"error": 0, "warning": 1, "info": 2}
    chosen = sorted(sorted(range(len(found)), key=lambda i: rank[found[i].severity])[:MAX_FINDINGS])
    rest = len(found) - len(chosen)
    last = Finding(
        code="WL000",
        name="too_many_findings",
        severity="info",
        message=f"{rest} more findings are not shown",
        fix="mend these, then lint again",
    )
    return (*(found[i] for i in chosen), last)


class RuleSummary(Frozen):
    """One line of the rule list."""

    code: str
    name: str
    severity: str
    summary: str


class RuleList(Frozen):
    """Every rule, by code."""

    rules: tuple[RuleSummary, ...]

    def text(self) -> str:
        """The list, one rule per line."""
        return "\n".join(f"{r.code}  {r.severity:7}  {r.name:34}  {r.summary}" for r in self.rules)


class RuleDoc(RuleSummary):
    """A rule explained: what it does, why, what to write instead, and its cases."""

    documentation: str
    bad: tuple[str, ...] = ()
    """Cases the rule finds fault with."""
    good: tuple[str, ...] = ()
    """Cases that are clean."""

    def text(self) -> str:
        """The page."""
        parts = [f"{self.code} {self.name} ({self.severity})", "", self.documentation]
        for title, cases in (("Bad", self.bad), ("Good", self.good)):
            for case in cases:
                parts += ["", f"{title}:", *("    " + line for line in case.strip("\n").splitlines())]
        return "\n".join(parts)


def _shown(finding: Finding, sources: dict[str, list[str]]) -> str:
    place = ":".join(str(part) for part in (finding.file, finding.line, finding.column) if part)
    section = f" [{finding.section}]" if finding.section else ""
    lines = [f"{place}: {finding.severity} {finding.code} {finding.name}{section}", f"    {finding.message}"]
    lines += _excerpt(finding, sources)
    if finding.fix:
        lines.append(f"    fix: {finding.fix}")
    return "\n".join(lines) + "\n"


def _excerpt(finding: Finding, sources: dict[str, list[str]]) -> list[str]:
    """The line in question with a caret, and one line of context on each side."""
    if finding.line is None or not finding.file:
        return []
    if finding.file not in sources:
        try:
            sources[finding.file] = Path(finding.file).read_text(encoding="utf-8-sig").splitlines()
        except (OSError, UnicodeDecodeError):
            sources[finding.file] = []
    text = sources[finding.file]
    shown = []
    for number in range(max(1, finding.line - 1), min(len(text), finding.line + 1) + 1):
        mark = ">" if number == finding.line else " "
        line = text[number - 1].expandtabs(4)
        shown.append(f"  {mark} {number:4} | {line[:160]}{'…' * (len(line) > 160)}")
        if number == finding.line and finding.column is not None and finding.column <= 160:
            shown.append(f"         | {' ' * (finding.column - 1)}^")
    return shown
