"""Say what is wrong with the arguments of a tool's call, in the words of the tool and not of a validator."""

import errno
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from typing import Any

from pydantic import ValidationError

from .model.errors import WorldwrightError

KINDS = {
    "string": "a text", "integer": "a whole number", "number": "a number", "boolean": "true or false",
    "array": "a list", "object": "an object", "null": "null",
}  # fmt: skip
MOST_SHOWN = 60
"""So many characters of a wrong value are shown."""


class ArgumentError(WorldwrightError):
    """A tool was called with arguments that it does not take."""

    code = "arguments"


def check(tool: str, arguments: Mapping[str, Any], schemas: Mapping[str, Mapping[str, Any]]) -> None:
    """Refuse a call of an unknown tool, with an unknown argument, or with a text that no file or name can hold.

    Args:
        tool: the name that was called.
        arguments: the arguments as they came.
        schemas: JSON schema of each tool's arguments.

    Raises:
        ArgumentError: it names the fault and the known names.
    """
    schema = schemas.get(tool)
    if schema is None:
        near = get_close_matches(tool, schemas, n=1)
        hint = f"`{near[0]}`? There are " if near else "call one of "
        raise ArgumentError(f"there is no tool `{_short(tool)}`", next_move=hint + ", ".join(sorted(schemas)))
    wrong = [_unknown(name, schema) for name in arguments if name not in schema.get("properties", {})]
    wrong += [
        f"`{place}` holds a NUL character, which no name and no file can have" for place in _with_nul(arguments, "")
    ]
    if wrong:
        raise ArgumentError("; ".join(wrong), place=tool, next_move=f"{tool} takes {signature(schema)}")


def invalid(tool: str, error: ValidationError, schema: Mapping[str, Any]) -> ArgumentError:
    """The error for arguments that do not fit their types."""
    said: dict[str, str] = {}
    for problem in error.errors(include_url=False):
        name = str(problem["loc"][0]) if problem["loc"] else tool
        place = ".".join(str(part) for part in problem["loc"] if "[" not in str(part))
        if problem["type"] == "missing":
            said.setdefault(name, f"`{place}` is missing")
        elif name not in said:
            wanted = described(schema.get("properties", {}).get(name, {}))
            told = wanted if place == name and wanted else problem["msg"].replace("Input should be ", "")
            said[name] = f"`{place}` must be {told}, not {_short(repr(problem['input']))}"
    return ArgumentError("; ".join(said.values()), place=tool, next_move=f"{tool} takes {signature(schema)}")


def too_long(tool: str, error: OSError, arguments: Mapping[str, Any]) -> ArgumentError | None:
    """The error for a name that no file can have; None for any other failure of the operating system."""
    if error.errno != errno.ENAMETOOLONG:
        return None
    texts = {name: str(value) for name, value in arguments.items() if value is not None}
    name = max(texts, key=lambda key: len(texts[key]), default="a name")
    return ArgumentError(
        f"`{name}` has {len(texts.get(name, ''))} characters, which is too long for a file's name",
        place=tool,
        next_move="give the path of an existing file or folder",
    )


def signature(schema: Mapping[str, Any]) -> str:
    """The arguments of a tool, the needed ones first."""
    needed = set(schema.get("required", ()))
    rows = sorted(schema.get("properties", {}).items(), key=lambda row: row[0] not in needed)
    return ", ".join(f"{name} ({described(kind)}{'' if name in needed else ', optional'})" for name, kind in rows)


def described(schema: Mapping[str, Any]) -> str:
    """A JSON schema in words."""
    if "enum" in schema:
        return "one of " + ", ".join(map(str, schema["enum"]))
    if "anyOf" in schema:
        return " or ".join(dict.fromkeys(text for text in map(described, schema["anyOf"]) if text != "null"))
    return KINDS.get(str(schema.get("type")), "an object") + _bounds(schema)


def _bounds(schema: Mapping[str, Any]) -> str:
    """Between what a number of the schema must lie, in words."""
    words = {
        "minimum": "at least", "exclusiveMinimum": "above",
        "maximum": "at most", "exclusiveMaximum": "below",
    }  # fmt: skip
    told = [f"{word} {schema[key]:g}" for key, word in words.items() if key in schema]
    return f" {' and '.join(told)}" if told else ""


def _unknown(name: str, schema: Mapping[str, Any]) -> str:
    near = get_close_matches(name, schema.get("properties", {}), n=1)
    return f"there is no argument `{_short(name)}`" + (f" (is `{near[0]}` meant?)" if near else "")


def _with_nul(value: Any, place: str) -> Iterator[str]:
    if isinstance(value, str) and "\0" in value:
        yield place
    elif isinstance(value, Mapping):
        for key, inner in value.items():
            yield from _with_nul(inner, f"{place}.{key}" if place else str(key))
    elif isinstance(value, list | tuple):
        for inner in value:
            yield from _with_nul(inner, place)


def _short(text: str) -> str:
    return text if len(text) <= MOST_SHOWN else f"{text[:MOST_SHOWN]}... ({len(text)} characters)"
