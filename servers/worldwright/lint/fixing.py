"""Safe fixes: the edits that rules propose, applied until none is left.

A fix is safe when it cannot change what a sound program does: another spelling of a name that does not exist, a copy of a
live array, the plan's own number. Everything else stays words.
"""

from pathlib import Path

from worldkit.files import write_atomic

from ..model.plan.committed import Plan
from . import engine, suppression
from . import source as sources
from .problem import Edit
from .program_view import Program

ROUNDS = 10
"""A fix may uncover another; a pair of rules that undo each other is stopped here."""
MARK = b"\xef\xbb\xbf"


def fix(path: Path, plan: Plan | None, contract: bool | None = None) -> tuple[str, ...]:
    """Apply every safe fix to a file and write it back; returns the codes of the rules, one for each edit.

    Nothing is written when the result could not be read as a program any more.
    """
    source = sources.read(path)
    if source.problem is not None:
        return ()
    data = path.read_bytes()
    text, codes = fixed(source, plan, contract)
    if codes:
        write_atomic(path, (MARK if data.startswith(MARK) else b"") + text.encode())
    return codes


def fixed(
    source: sources.Source, plan: Plan | None = None, contract: bool | None = None
) -> tuple[str, tuple[str, ...]]:
    """(text, codes) after all rounds."""
    codes: list[str] = []
    for _ in range(ROUNDS):
        edits = _edits(source, plan, contract)
        if not edits:
            break
        text = applied(source.text, [edit for _, edit in edits])
        again = sources.parse(text, source.path)
        if again.problem is not None or text == source.text:
            break
        source = again
        codes += [code for code, _ in edits]
    return source.text, tuple(codes)


def applied(text: str, edits: list[Edit]) -> str:
    """The text with edits made; they must not overlap."""
    lines = text.splitlines(keepends=True)
    for edit in sorted(edits, key=lambda e: (e.line, e.column), reverse=True):
        before, after = lines[edit.line - 1][: edit.column - 1], lines[edit.end_line - 1][edit.end_column - 1 :]
        lines[edit.line - 1 : edit.end_line] = [before + edit.text + after]
    return "".join(lines)


def _edits(source: sources.Source, plan: Plan | None, contract: bool | None) -> list[tuple[str, Edit]]:
    """The edits of all rules that apply; those that a comment answers for, or that overlap others, are left out."""
    program = Program(source, plan, contract)
    answered = suppression.of(source)
    found: list[tuple[str, Edit]] = []
    for rule in engine.program_rules():
        if engine.applies(rule, program):
            for problem in rule.check(program):
                if problem.edit is not None and not any(s.covers(rule.code, problem) for s in answered):
                    found.append((rule.code, problem.edit))
    kept: list[tuple[str, Edit]] = []
    end = (0, 0)
    for code, edit in sorted(found, key=lambda pair: (pair[1].line, pair[1].column)):
        if (edit.line, edit.column) >= end and (not kept or edit != kept[-1][1]):
            kept.append((code, edit))
            end = (edit.end_line, max(edit.end_column, edit.column + 1))
    return kept
