"""retrieve: what do the installed simulator, its manual, our skills and our catalog say about this?

Nothing here rests on memory: the corpus is what is installed, cut along its own structure, and every hit carries a
citation that `read` opens. Full text (SQLite) answers always; with the `semantic` extra a ranking by meaning (vectors in
LanceDB) joins it by reciprocal rank, once its model is loaded.
"""

from .answers import Hit, SearchResult

__all__ = ["Hit", "SearchResult"]
