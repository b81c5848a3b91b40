"""The author's process of a sculpted file: `python -m worldkit.sculpt.made_ahead ROOT FILE OUT NAME…` makes those things and keeps
them.

ROOT is the run folder that FILE's path is relative to; an empty NAME is the last thing in the file. What fails is told by
whatever uses the file, with its line; here it leaves nothing. OUT gets the keys of what was made and kept: a paint that nobody
can take apart has none.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

from .. import kept_shapes
from ..files import write_json
from . import from_files


def main(argv: Sequence[str] | None = None) -> int:
    """Make all parts of some things in a file; returns the exit status."""
    root, file, out, *names = sys.argv[1:] if argv is None else argv
    sys.path.insert(0, root)
    keys = set()
    for of in names:
        with from_files.sculpted(file, of) as parts:
            keys |= {part.made().signature for part in parts}
    write_json(Path(out) / "keys.json", sorted(key for key in keys if kept_shapes.kept(key) is not None))
    return 0


if __name__ == "__main__":
    sys.exit(main())
