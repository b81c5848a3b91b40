"""The markdown of a plan: its title, its `## sections`, and the fenced blocks and bullets inside them.

Only what the plan format gives a meaning is looked at: level-one and level-two headings, fences, bullets and HTML
comments. Everything else is prose and is left alone. All offsets are positions in the document's text, so that an edit
can change exactly the characters it means.

Not markdown-it: it is as fast (0.4 ms a plan, here 0.6), but a fence left open takes the rest of the plan with it, so that
every section behind it would be reported missing; and it gives lines where an edit needs characters.
"""

import re
from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from difflib import get_close_matches

from ..finding import Finding
from .committed import SECTIONS

_LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|$)")
_FENCE = re.compile(r"^ {0,3}(?P<mark>`{3,}|~{3,})(?P<info>[^`]*)$")
_HEADING = re.compile(r"^ {0,3}(?P<level>#{1,2})[ \t]+(?P<text>.*?)[ \t]*$")
_BULLET = re.compile(r"^ {0,3}[-*+][ \t]+(?P<text>\S.*)$")
_COMMENT = re.compile(r"<!--.*?-->")


@dataclass(frozen=True)
class Line:
    """One line without its end: where it starts, and its text with HTML comments blanked out."""

    start: int
    text: str

    @property
    def end(self) -> int:
        """Offset behind its last character."""
        return self.start + len(self.text)


@dataclass(frozen=True)
class Fence:
    """One fenced block: where its content lies, and its language."""

    start: int
    end: int
    language: str
    opened: int
    """Offset of the opening fence."""
    closed: bool


@dataclass(frozen=True)
class Bullet:
    """One list item: where its text lies (continuation lines included), and that text on one line."""

    start: int
    end: int
    text: str


@dataclass
class Section:
    """One `## section`: its heading, its fenced blocks and its lines outside them."""

    name: str
    heading: int
    end: int = 0
    """Offset behind its last line: where the next heading starts."""
    fences: list[Fence] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)

    @property
    def blocks(self) -> list[Fence]:
        """The fenced YAML blocks."""
        return [fence for fence in self.fences if fence.language in ("yaml", "yml")]

    def prose(self) -> Iterator[Line]:
        """Lines that hold text, outside fences and comments."""
        return (line for line in self.lines if line.text.strip())

    def bullets(self) -> list[Bullet]:
        """The list items outside fences, in order."""
        found: list[Bullet] = []
        open_item = False
        for line in self.lines:
            if match := _BULLET.match(line.text):
                text = match["text"].rstrip()
                start = line.start + match.start("text")
                found.append(Bullet(start, start + len(text), text))
                open_item = True
            elif open_item and line.text.startswith(("  ", "\t")) and line.text.strip():
                last = found.pop()
                text = line.text.strip()
                end = line.start + len(line.text.rstrip())
                found.append(Bullet(last.start, end, f"{last.text} {text}"))
            else:
                open_item = False
        return found


class Lines:
    """Line and column of an offset; `\\r\\n`, `\\n` and `\\r` each end a line."""

    def __init__(self, text: str) -> None:
        self.starts = [match.start() for match in _LINE.finditer(text) if match.end() > match.start()] or [0]

    def at(self, offset: int) -> int:
        """1-based line of an offset."""
        return bisect_right(self.starts, offset)

    def column(self, offset: int) -> int:
        """1-based column of an offset."""
        return offset - self.starts[max(self.at(offset) - 1, 0)] + 1


def split(text: str, file: str, lines: Lines) -> tuple[str, dict[str, Section], list[Finding]]:
    """Split a plan into its title and sections.

    Returns:
        the title (empty when there is none), the sections by name in document order, and what is wrong with the
        outline: missing, duplicate and unknown sections, headings of the wrong level, fences left open.
    """
    outline = _Outline(text, file, lines)
    outline.read()
    outline.tell_missing()
    return outline.title, outline.sections, outline.findings


class _Outline:
    """Walks a document once, line by line."""

    def __init__(self, text: str, file: str, lines: Lines) -> None:
        self.text = text
        self.file = file
        self.positions = lines
        self.title = ""
        self.sections: dict[str, Section] = {}
        self.findings: list[Finding] = []
        self.current = Section("", 0)
        self.titled = False

    def read(self) -> None:
        """Collect the title, the sections and the findings."""
        opened: tuple[Line, str, str] | None = None  # the opening fence: its line, its mark, its language
        content = 0
        commented = False
        for match in _LINE.finditer(self.text):
            if match.end() == match.start():
                break
            line = Line(match.start(), match.group().rstrip("\r\n"))
            if line.start == 0 and line.text.startswith("\ufeff"):
                line = Line(1, line.text[1:])
            if opened is not None:
                if self._closes(line.text, opened[1]):
                    self._fence(opened, content, line.start, True)
                    opened = None
                elif self._is_section(line.text) and not self._closed_later(match.end(), opened[1]):
                    # an unclosed fence must not swallow the rest of the plan
                    self._fence(opened, content, line.start, False)
                    opened = None
                    self._heading(line)
                continue
            shown, commented = _blank_comments(line.text, commented)
            line = Line(line.start, shown)
            if fence := _FENCE.match(line.text):
                opened = (line, fence["mark"], fence["info"].strip().split(" ")[0].lower())
                content = match.end()
            elif not self._heading(line):
                self.current.lines.append(line)
        if opened is not None:
            self._fence(opened, content, len(self.text), False)
        self.current.end = len(self.text)

    @staticmethod
    def _closes(text: str, mark: str) -> bool:
        stripped = text.strip()
        return len(stripped) >= len(mark) and set(stripped) == {mark[0]} and len(text) - len(text.lstrip(" ")) <= 3

    def _closed_later(self, start: int, mark: str) -> bool:
        """Whether the next fence line closes the open block, rather than opening another."""
        for match in _LINE.finditer(self.text, start):
            text = match.group().rstrip("\r\n")
            if self._closes(text, mark):
                return True
            if match.end() == match.start() or _FENCE.match(text):
                return False
        return False

    @staticmethod
    def _is_section(text: str) -> bool:
        match = _HEADING.match(text)
        return bool(match and len(match["level"]) == 2 and section_name(match["text"]) in SECTIONS)

    def _fence(self, opened: tuple[Line, str, str], start: int, end: int, closed: bool) -> None:
        line, mark, language = opened
        self.current.fences.append(Fence(start, end, language, line.start, closed))
        if not closed:
            self.find(
                "WP005",
                "misplaced_block",
                line.start,
                f"the fenced block opened here with {mark} is never closed",
                f"put a line {mark} behind the block's last line",
                self.current.name,
            )

    def _heading(self, line: Line) -> bool:
        """Take a heading of level one or two; returns whether it was one."""
        match = _HEADING.match(line.text)
        if not match:
            return False
        if len(match["level"]) == 1:
            return self._title(line, match["text"])
        name = section_name(match["text"])
        self.current.end = line.start
        self.current = Section(name if name in SECTIONS else "", line.start)
        if name not in SECTIONS:
            near = get_close_matches(name, SECTIONS, n=1, cutoff=0.6)
            self.find(
                "WP004",
                "unknown_section",
                line.start,
                f"there is no section `{match['text']}` in the plan format",
                (f"did you mean `{near[0]}`? " if near else "move its text under a section, or use a level-3 heading; ")
                + f"the sections are {', '.join(SECTIONS)}",
            )
        elif name in self.sections:
            first = self.positions.at(self.sections[name].heading)
            self.find(
                "WP003",
                "duplicate_section",
                line.start,
                f"section `{name}` is already on line {first}",
                "merge the two: every number has one owner",
                name,
            )
        else:
            self.sections[name] = self.current
        return True

    def _title(self, line: Line, text: str) -> bool:
        name = section_name(text)
        if name in SECTIONS:
            self.find(
                "WP015",
                "stray_heading",
                line.start,
                f"section `{name}` has a level-one heading",
                f"write `## {name}`",
                name,
            )
        elif self.titled:
            self.find(
                "WP015",
                "stray_heading",
                line.start,
                f"a second title: `{text}`",
                "keep one `# title`; inside sections use level-3 headings",
                self.current.name,
            )
        else:
            self.title, self.titled = text, True
        return True

    def tell_missing(self) -> None:
        """One finding for each missing section, or one for all when most of the plan is not there."""
        missing = [name for name in SECTIONS if name not in self.sections]
        if len(missing) > 3:
            self.find(
                "WP002",
                "missing_section",
                None,
                f"{len(missing)} of the thirteen sections are missing: {', '.join(missing)}",
                "give each a heading, e.g. `## topology`; a section without content may be empty",
            )
            return
        for name in missing:
            self.find(
                "WP002",
                "missing_section",
                None,
                f"there is no section `{name}`",
                f"add a heading `## {name}`; it may be empty when there is nothing to say",
                name,
            )

    def find(self, code: str, name: str, offset: int | None, message: str, fix: str, section: str = "") -> None:
        """Note one problem of the outline."""
        self.findings.append(
            Finding(
                code=code,
                name=name,
                severity="error",
                message=message,
                fix=fix,
                file=self.file,
                line=None if offset is None else self.positions.at(offset),
                section=section or None,
            )
        )


def section_name(heading: str) -> str:
    """The section a heading means: `## 2. Simulation Parameters` is `simulation_parameters`."""
    text = re.sub(r"^\d+[.)]\s*", "", heading.strip().rstrip("#").strip().strip("`*_ "))
    return re.sub(r"[\s-]+", "_", text.strip().rstrip(":")).lower()


def _blank_comments(text: str, inside: bool) -> tuple[str, bool]:
    """Replace HTML comments by spaces; returns the line and whether a comment is still open behind it."""
    if inside:
        end = text.find("-->")
        if end < 0:
            return " " * len(text), True
        text = " " * (end + 3) + text[end + 3 :]
    text = _COMMENT.sub(lambda m: " " * len(m.group()), text)
    start = text.find("<!--")
    return (text, False) if start < 0 else (text[:start] + " " * (len(text) - start), True)
