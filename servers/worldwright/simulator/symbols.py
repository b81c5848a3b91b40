"""The Python names of the installed simulator: what exists, with which members, parameters and results."""

import os
import subprocess
import sys
from difflib import get_close_matches
from functools import cache, cached_property
from pathlib import Path
from typing import Any

from ..model.errors import WorldwrightError
from . import installed
from .cache import cached_json

Entry = dict[str, Any]
"""It has a kind (function, class, enum, field, constant, module) and, where known, signature, parameters, returns, doc."""


class IntrospectionError(WorldwrightError):
    """The installed simulator could not be asked what it offers."""

    code = "introspection"


class Symbols:
    """Looks names up in the table that `inventory.py` prints."""

    def __init__(self, table: dict[str, Any]) -> None:
        self.version: str = table["version"]
        self.names: dict[str, Entry] = table["names"]
        self.submodules: dict[str, list[str] | None] = table["submodules"]
        self.schema_text: str = table["schema"]

    def top(self, name: str) -> Entry | None:
        """`mujoco.<name>`, public or a submodule."""
        entry = self.names.get(name)
        if entry is not None and not entry.get("private"):
            return entry
        if name in self.submodules:
            return {"kind": "module"}
        return None

    def class_name(self, type_text: str | None) -> str | None:
        """The class for which a result type stands, e.g. `MjsBody | None` -> `MjsBody`."""
        if not type_text:
            return None
        name = type_text.removesuffix(" | None").strip()
        for candidate in (name, f"_{name}"):
            if self.names.get(candidate, {}).get("kind") in ("class", "enum"):
                return candidate
        return None

    def member(self, owner: str, name: str) -> Entry | None:
        """A member of a class, or an enum's value."""
        entry = self.names.get(owner, {})
        if entry.get("kind") == "enum":
            value = entry["members"].get(name)
            return None if value is None else {"kind": "enum value", "value": value}
        return entry.get("members", {}).get(name)

    def in_submodule(self, module: str, name: str) -> bool | None:
        """Whether `mujoco.<module>.<name>` exists; None when the module cannot be read without importing it."""
        known = self.submodules.get(module)
        return None if known is None else name in known

    def nearest(self, name: str, owner: str | None = None) -> list[str]:
        """Up to three existing names that look like `name`, among a class's members or the package's names."""
        if owner is None:
            names = [n for n, e in self.names.items() if not n.startswith("_") and e["kind"] != "module"]
            names += [n for n in self.submodules if not n.startswith("_")]
        else:
            names = [n for n in self.names.get(owner, {}).get("members", {}) if not n.startswith("_")]
        lowered = {n.lower(): n for n in names}
        close = get_close_matches(name.lower(), lowered, n=3, cutoff=0.6)
        return [lowered[n] for n in close]

    @cached_property
    def enum_of_value(self) -> dict[str, str]:
        """The enum of each value name, e.g. `mjGEOM_BOX` -> `mjtGeom`."""
        return {v: name for name, e in self.names.items() if e["kind"] == "enum" for v in e["members"]}

    @cached_property
    def owners(self) -> dict[str, list[str]]:
        """The classes that have a member of a given name."""
        found: dict[str, list[str]] = {}
        for name, entry in self.names.items():
            if entry["kind"] == "class" and not name.startswith("_"):
                for member in entry["members"]:
                    found.setdefault(member, []).append(name)
        return found


@cache
def load() -> Symbols:
    """The table of the installed build, from the cache or made now in a process of its own (0.4 s, once)."""
    source = Path(__file__).with_name("inventory.py")
    made_by = source.read_text(encoding="utf-8")
    return Symbols(cached_json("symbols", installed.fingerprint() + made_by, lambda: _describe(source)))


def _describe(script: Path) -> dict[str, Any]:
    import json

    # A window system must neither decide which names exist nor, if broken, fail the import.
    environment = {k: v for k, v in os.environ.items() if k not in ("MUJOCO_GL", "PYTHONPATH")}
    command = [sys.executable, "-I", "-W", "ignore", str(script)]
    try:
        done = subprocess.run(command, capture_output=True, timeout=60, env=environment, check=True)
        return json.loads(done.stdout)
    except (OSError, subprocess.SubprocessError, ValueError) as cause:
        detail = getattr(cause, "stderr", b"") or b""
        raise IntrospectionError(
            f"the installed simulator could not be read: {cause} {detail.decode(errors='replace')[-500:]}".strip(),
            place="import mujoco",
            next_move="run `python -c 'import mujoco'`, and reinstall mujoco when that fails",
        ) from cause
