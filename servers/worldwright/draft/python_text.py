"""Write Python source as a formatter leaves it: literals, calls and their wrapping."""

from typing import Any

WIDTH = 120


class Raw(str):
    """Source text that is already an expression, such as a constant's name."""

    __slots__ = ()


def literal(value: Any) -> str:
    """A Python literal; floats keep the shortest text that reads back to the same number.

    >>> literal((0, 0.5, -0.0))
    '(0, 0.5, 0.0)'
    >>> literal("it's")
    '"it\\'s"'
    """
    if isinstance(value, Raw):
        return str(value)
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'
    if isinstance(value, float):
        return repr(round(value, 9) + 0.0)
    if isinstance(value, tuple | list):
        inner = ", ".join(literal(item) for item in value)
        return f"({inner},)" if len(value) == 1 else f"({inner})"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{literal(k)}: {literal(v)}" for k, v in value.items()) + "}"
    return repr(value)


def exact(value: Any) -> Raw:
    """A number, or a tuple of numbers, to all its digits, as a plan states it; `literal` rounds off what arithmetic leaves.

    >>> exact((6.6743e-11, 0.1))
    '(6.6743e-11, 0.1)'
    """
    if isinstance(value, tuple | list):
        inner = ", ".join(exact(item) for item in value)
        return Raw(f"({inner},)" if len(value) == 1 else f"({inner})")
    return Raw(repr(value))


def call(function: str, *positional: Any, indent: int = 4, tail: str = "", **keywords: Any) -> str:
    """A call statement with `tail` behind it, with one argument per line if one line is too short.

    >>> print(call("f", "a", size=(1.0, 2.0), indent=0))
    f("a", size=(1.0, 2.0))
    """
    parts = [literal(value) for value in positional]
    parts += [f"{name}={literal(value)}" for name, value in keywords.items()]
    pad = " " * indent
    line = f"{pad}{function}({', '.join(parts)}){tail}"
    if len(line) <= WIDTH:
        return line
    inner = pad + "    "
    joined = ", ".join(parts)
    if len(inner + joined) <= WIDTH:
        return f"{pad}{function}(\n{inner}{joined}\n{pad}){tail}"
    return f"{pad}{function}(\n" + "".join(f"{_folded(part, inner)},\n" for part in parts) + f"{pad}){tail}"


def _folded(argument: str, pad: str) -> str:
    """One argument on lines of its own, where a call or tuple that is too long is folded in turn.

    >>> print(_folded('movers=("' + "a" * 60 + '", "' + "b" * 60 + '")', "    ").replace("a" * 60, "a").replace("b" * 60, "b"))
        movers=(
            "a",
            "b",
        )
    """
    start = argument.find("(")
    if len(pad + argument) < WIDTH or start < 0 or not argument.endswith(")") or '"' in argument[:start]:
        return pad + argument
    items, inner = _items(argument[start + 1 : -1]), pad + "    "
    joined = ", ".join(items)
    called = start > 0 and (argument[start - 1].isalnum() or argument[start - 1] == "_")
    if (
        called and len(inner + joined) <= WIDTH
    ):  # a formatter keeps arguments together where it can, but not the items of a tuple
        return f"{pad}{argument[: start + 1]}\n{inner}{joined}\n{pad})"
    return f"{pad}{argument[: start + 1]}\n" + "".join(f"{_folded(item, inner)},\n" for item in items) + f"{pad})"


def _items(text: str) -> list[str]:
    """The items of a call or tuple: `text` cut at the commas outside of brackets and strings."""
    items, depth, quoted, last, previous = [], 0, False, 0, ""
    for at, char in enumerate(text):
        if char == '"' and previous != "\\":
            quoted = not quoted
        elif not quoted:
            depth += (char in "([{") - (char in ")]}")
            if char == "," and depth == 0:
                items.append(text[last:at].strip())
                last = at + 1
        previous = "" if previous == "\\" else char
    return [*items, rest] if (rest := text[last:].strip()) else items


def comment(text: str, indent: int = 4) -> str:
    """`text` as comment lines within the width."""
    import textwrap

    pad = " " * indent + "# "
    return "\n".join(textwrap.wrap(" ".join(text.split()), WIDTH, initial_indent=pad, subsequent_indent=pad))


def plain(text: str) -> str:
    """Text that is safe inside a docstring: one line, no backslash, no triple quote."""
    return " ".join(text.split()).replace("\\", "/").replace('"' * 3, "'")


def bullet(text: str) -> str:
    """`text` as a bullet of a docstring, within the width."""
    import textwrap

    return "\n".join(textwrap.wrap(plain(text), WIDTH, initial_indent="- ", subsequent_indent="  "))


def slug(text: str) -> str:
    """A short name of lower-case words joined by dashes.

    >>> slug("Two billiard balls collide!")
    'two-billiard-balls-collide'
    """
    return "-".join("".join(c if c.isalnum() else " " for c in text.lower()).split())[:60]


def constant_name(name: str) -> str:
    """A module constant's name for a plan name.

    >>> constant_name("ball-to-felt")
    'BALL_TO_FELT'
    """
    cleaned = "".join(c if c.isalnum() else "_" for c in name).upper().strip("_") or "SURFACE"
    return f"_{cleaned}" if cleaned[0].isdigit() else cleaned
