"""retrieve: what do the installed simulator, its manual, our skills and our catalog say about this?

Nothing here rests on memory: the corpus is what is installed, cut along its own structure, and every hit carries a
citation that `read` opens. Words (BM25 over headings, names and text) and meaning (vectors of a small packaged model, run
with numpy) are added up; before the vectors are made, words answer alone.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
# Before numpy is loaded: a question is too small for several threads, and on a loaded machine they wait for each other a
# hundred times longer than the product takes. Embedding many texts runs side by side instead.

from .answers import Hit, SearchResult

__all__ = ["Hit", "SearchResult"]
