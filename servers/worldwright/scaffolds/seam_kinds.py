"""The seams for which an entry can be scaffolded: its place, what its module defines, and what to run afterwards.

An entry of a seam has no code, only the name of its file. Its module defines what a protocol names, and the tests of the
seam run on every entry, so a new one fails them until it is written.
"""

import importlib
from collections.abc import Iterator
from dataclasses import dataclass
from inspect import getdoc, getsource
from typing import Any


@dataclass(frozen=True)
class SeamKind:
    """One kind of entry of a seam."""

    protocol: str
    """Module and class of the protocol that an entry fulfils."""
    folder: str
    """Its folder below `servers`."""
    tests: str
    """The tests that run every entry."""
    pages: tuple[str, ...] = ()
    """The commands that rewrite the generated pages and files about it."""
    also: str = ""
    """Further work, in a sentence."""

    def members(self) -> Iterator[tuple[str, str]]:
        """(name, meaning) of what an entry defines, by the protocol's own words."""
        module, _, name = self.protocol.partition(":")
        protocol = getattr(importlib.import_module(module), name)
        for member in protocol.__annotations__:
            yield member, _doc_below(protocol, member)
        for member, value in vars(protocol).items():
            if not member.startswith("_") and callable(value):
                yield f"{member}()", (getdoc(value) or "").split("\n\n")[0].replace("\n", " ")


def _doc_below(protocol: Any, member: str) -> str:
    """The text below an attribute of a class."""
    import ast
    from itertools import pairwise
    from textwrap import dedent

    (whole,) = ast.parse(dedent(getsource(protocol))).body
    for row, below in pairwise(whole.body if isinstance(whole, ast.ClassDef) else ()):
        named = isinstance(row, ast.AnnAssign) and getattr(row.target, "id", "") == member
        if named and isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant):
            return " ".join(str(below.value.value).split())
    return ""


SEAMS = {
    "renderer": SeamKind(
        "worldengine.film.renderers:Renderer",
        "worldengine/film/renderers",
        "tests/worldengine/test_renderers.py",
        also="packages that it imports go into pyproject.toml; WORLDKIT_RENDERER chooses it",
    ),
    "solver": SeamKind(
        "worldengine.solvers:Solver",
        "worldengine/solvers",
        "tests/worldengine/test_solvers.py",
        pages=("python -m worldwright.lint.reference",),
        also="a plan that uses it goes into tests/worldwright/world",
    ),
    "source": SeamKind(
        "worldkit.assets.sources:Source",
        "worldkit/assets/sources",
        "tests/worldkit/test_asset_sources.py",
        also="its files lie below the catalog folder, where a confined program can read them",
    ),
    "harness": SeamKind(
        "worldwright.contract.harnesses:Harness",
        "worldwright/contract/harnesses",
        "tests/worldwright/contract/test_every_harness.py",
        pages=("worldwright contract sync",),
        also="drive the real program in tests/harness, and name it in README.md",
    ),
}
