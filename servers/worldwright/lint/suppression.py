"""`# worldwright: ignore[WL123] reason`: somebody looked at a finding and answers for it; it stays visible as information.

A model file says `<!-- worldwright: ignore[WM112] reason -->`.
"""

import io
import re
import tokenize
from dataclasses import dataclass

from .problem import Problem
from .source import Source

PATTERN = re.compile(r"#\s*worldwright:\s*ignore\s*(?:\[([^\]]*)\])?\s*(.*)$")

IN_XML = re.compile(r"<!--\s*worldwright:\s*ignore\s*(?:\[([^\]]*)\])?\s*(.*?)\s*-->")


@dataclass(frozen=True)
class Suppression:
    """One comment."""

    line: int
    alone: bool
    """The comment has a line of its own, so it speaks for the next line."""
    codes: frozenset[str]
    reason: str

    def covers(self, code: str, problem: Problem) -> bool:
        """Whether it answers for a problem: it stands on one of the problem's lines, or on the line above."""
        if code not in self.codes or problem.line is None or not self.reason:
            return False
        place = self.line + 1 if self.alone else self.line
        return problem.line <= place <= (problem.end_line or problem.line)


def of(source: Source) -> tuple[Suppression, ...]:
    """Every suppression comment of a program or a model file."""
    if "worldwright:" not in source.text:
        return ()
    if source.is_mjcf:
        return _in_xml(source.text)
    return read(source.text) if source.tree is not None else ()


def _in_xml(text: str) -> tuple[Suppression, ...]:
    """Comments of XML that stand on one line."""
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        match = IN_XML.search(line)
        if match is not None:
            codes = frozenset(code.strip() for code in (match[1] or "").split(",") if code.strip())
            alone = not (line[: match.start()] + line[match.end() :]).strip()
            found.append(Suppression(number, alone, codes, match[2].strip(" -:")))
    return tuple(found)


def read(text: str) -> tuple[Suppression, ...]:
    """Every suppression comment of a program's text; the words inside strings do not count."""
    found = []
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            match = PATTERN.search(token.string) if token.type == tokenize.COMMENT else None
            if match is None:
                continue
            codes = frozenset(code.strip() for code in (match[1] or "").split(",") if code.strip())
            alone = not token.line[: token.start[1]].strip()
            found.append(Suppression(token.start[0], alone, codes, match[2].strip(" -:")))
    except (tokenize.TokenError, IndentationError, SyntaxError):
        pass  # the syntax rule reports what is wrong with the text
    return tuple(found)
