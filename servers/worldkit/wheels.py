"""Versions of what is installed, read from the first lines that a distribution says about itself.

`importlib.metadata.version` parses a package's whole description, some milliseconds for each, and every process that builds,
steps or draws a world asks for several.
"""

import re
from importlib.metadata import Distribution, PackageNotFoundError, distribution

VERSION = re.compile(r"^Version: *(\S+)", re.MULTILINE)


def version(name: str) -> str:
    """The installed version of a distribution; empty where it is not installed."""
    try:
        return version_of(distribution(name))
    except PackageNotFoundError:
        return ""


def version_of(found: Distribution) -> str:
    """The version of a distribution that was found."""
    said = VERSION.search(found.read_text("METADATA") or "")
    return said[1] if said else found.version
