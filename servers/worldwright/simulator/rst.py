"""Turn the manual's reStructuredText into plain text: roles, links and substitutions become what a reader sees."""

import re

_RULES = (
    (re.compile(r":commit:`[^`]*`,?\s*"), ""),
    (re.compile(r"\|(?:-|_|_2|_3|_4|\*|\?|!|@|L)\|"), ""),
    (re.compile(r"\s*\|br\|\s*"), "\n"),
    (re.compile(r":[\w:-]+:`([^`<]+?)\s*<[^>`]*>`"), r"\1"),
    (
        re.compile(r":(?:at|el|at-val|ref|doc|math|issue|github:user|el-prefix|attr|sup|sub|octicon)[\w-]*:`([^`]*)`"),
        r"\1",
    ),
    (re.compile(r"``([^`]+)``"), r"`\1`"),
    (re.compile(r"(?<!`)`([^`<]+?)\s*<[^>`]*>`__?"), r"\1"),
    (re.compile(r"\*\*([^*\n]+)\*\*"), r"\1"),
    (re.compile(r"^(\s*)\.\. admonition:: *", re.MULTILINE), r"\1"),
)
_NOISE = re.compile(
    r"^\s*(?:\.\. (?:image|figure|youtube|raw|container|role|include|mujoco-include|cssclass)::.*|:[\w-]+:(?:\s.*)?)$"
)


def plain(text: str) -> str:
    """The words of `text`; pictures, raw HTML and their options are left out, indentation is kept."""
    lines, hidden = [], -1
    for line in text.splitlines():
        indent = len(line) - len(line.lstrip())
        if hidden >= 0 and (not line.strip() or indent > hidden):
            continue
        hidden = -1
        if _NOISE.match(line):
            if ".. raw::" in line or ".. image::" in line or ".. figure::" in line or ".. youtube::" in line:
                hidden = indent
            continue
        lines.append(line)
    result = "\n".join(lines)
    for pattern, replacement in _RULES:
        result = pattern.sub(replacement, result)
    return re.sub(r"\n{3,}", "\n\n", result).strip("\n")
