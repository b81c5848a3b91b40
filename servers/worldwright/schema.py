"""Write tool schemas without what costs a reader tokens and tells it nothing.

pydantic names every field twice (`title`) and writes an optional argument as a union with null. A client that leaves such
an argument out means the same, so that is what the schema says; null is still taken.
"""

from typing import Any


def plain(schema: dict[str, Any], optional: bool = False) -> dict[str, Any]:
    """A JSON schema that takes the same objects, in fewer words.

    Args:
        schema: a schema by pydantic.
        optional: also write `X | None = None` as an optional X, which fits arguments; answers do hold nulls.
    """
    found: dict[str, Any] = {}
    for key, value in schema.items():
        if key == "title" and isinstance(value, str):
            continue
        if key in ("properties", "$defs") and isinstance(value, dict):
            found[key] = {name: plain(part, optional) for name, part in value.items()}
        elif isinstance(value, dict) and key in ("items", "additionalProperties"):
            found[key] = plain(value, optional)
        elif key in ("anyOf", "allOf", "oneOf", "prefixItems"):
            found[key] = [plain(part, optional) for part in value]
        else:
            found[key] = value
    if optional and found.get("default", ...) is None and {"type": "null"} in found.get("anyOf", ()):
        choices = [choice for choice in found.pop("anyOf") if choice != {"type": "null"}]
        found.pop("default")
        found = {**(choices[0] if len(choices) == 1 else {"anyOf": choices}), **found}
    return found
