"""A column of words as numbers into a list of them: thousands of rows name the same few bodies."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np


class Words:
    """Rows of words; `codes` (N,) are indices into `known`."""

    def __init__(self, codes: "np.ndarray", known: Sequence[str]) -> None:
        self.codes, self.known = codes, known

    @classmethod
    def of(cls, rows: Sequence[str]) -> "Words":
        """The rows of a list."""
        import numpy as np

        known = list(dict.fromkeys(rows))
        number = {word: n for n, word in enumerate(known)}
        return cls(np.array([number[word] for word in rows], np.int32), known)

    @classmethod
    def joined(cls, parts: "Sequence[Words]") -> "Words":
        """The rows of several, one after the other."""
        import numpy as np

        known = list(dict.fromkeys(word for part in parts for word in part.known))
        number = {word: n for n, word in enumerate(known)}
        codes = [np.array([number[word] for word in part.known], np.int32)[part.codes] for part in parts if len(part)]
        return cls(np.concatenate(codes) if codes else np.zeros(0, np.int32), known)

    def __len__(self) -> int:
        return len(self.codes)

    def __iter__(self) -> Iterator[str]:
        return (self.known[code] for code in self.codes.tolist())

    def taken(self, order: "np.ndarray") -> "Words":
        """The rows in this order."""
        return Words(self.codes[order], self.known)

    def counts(self) -> dict[str, int]:
        """How often each word stands there, those that do."""
        import numpy as np

        found = np.bincount(self.codes, minlength=len(self.known)).tolist()
        return {word: n for word, n in zip(self.known, found, strict=True) if n}

    def arrow(self) -> Any:
        """The rows as an Arrow array of strings, put together here: a cast would load pyarrow.compute, for some 40 ms."""
        import numpy as np
        import pyarrow as pa

        texts = [word.encode() for word in self.known]
        ends = np.zeros(len(self) + 1, np.int32)
        np.cumsum(np.array([len(text) for text in texts], np.int32)[self.codes], out=ends[1:])
        data = b"".join(map(texts.__getitem__, self.codes.tolist()))
        return pa.StringArray.from_buffers(len(self), pa.py_buffer(ends), pa.py_buffer(data))
