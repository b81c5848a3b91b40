"""Compare the worlds of two files: `python -m worldkit.two_worlds ONE OTHER OUT`, in a process that may break on them.

OUT becomes `{"apart": A, "where": FIELD}` as `alike.compared` says it of the compiled models (null for infinite), or
`{"failure": TEXT}` where one of them does not compile.
"""

import json
import math
import sys
from pathlib import Path
from typing import Any


def compare(one: Path, other: Path) -> dict[str, Any]:
    """What is written into OUT."""
    from . import portable
    from .alike import compared

    try:
        apart, where = compared(portable.read(one), portable.read(other))
    except (ValueError, RuntimeError) as failure:
        return {"failure": str(failure)}
    return {"apart": apart if math.isfinite(apart) else None, "where": where}


if __name__ == "__main__":
    Path(sys.argv[3]).write_text(json.dumps(compare(Path(sys.argv[1]), Path(sys.argv[2]))), encoding="utf-8")
