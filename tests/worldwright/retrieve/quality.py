"""How well search finds what the manual says, over questions whose answers are known as literal passages.

    python tests/worldwright/retrieve/quality.py [FILE] [--ranking auto|full_text|vectors|baseline] [--misses]

A question counts as answered at the first hit whose citation, opened by `read`, holds one of its golds: a file and a
literal piece of its text, whitespace aside. `baseline` is the yardstick: BM25 as SQLite brings it over the same files, cut
every thirty lines.
"""

import argparse
import re
import sqlite3
import statistics
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import NamedTuple

import yaml

from worldwright.retrieve import corpus, tools

QUESTIONS = Path(__file__).with_name("questions.yaml")
DEPTH = 10
NAIVE_LINES = 30
Finder = Callable[[str], Iterable[tuple[str, str]]]
"""A question to the (path, text) of its hits, best first; none is opened behind the first that answers."""


class Question(NamedTuple):
    """One row of the file."""

    text: str
    real: bool
    """Asked by somebody in public, in our shorter wording; otherwise thought up."""
    gold: tuple[tuple[str, str], ...]
    """(end of a file's path, literal text), any of which answers."""


class Quality(NamedTuple):
    """Shares of questions answered among the first 1, 5 and 10 hits."""

    top_1: float
    top_5: float
    top_10: float
    count: int

    def __str__(self) -> str:
        return f"top1 {self.top_1:.3f}  top5 {self.top_5:.3f}  top10 {self.top_10:.3f}  ({self.count} questions)"


def questions(file: Path = QUESTIONS) -> list[Question]:
    """The rows of a file."""
    rows = yaml.safe_load(file.read_text(encoding="utf-8"))
    return [
        Question(
            str(row["q"]), bool(row.get("real")), tuple((g["file"], squeezed(str(g["contains"]))) for g in row["gold"])
        )
        for row in rows
    ]


def squeezed(text: str) -> str:
    """A text with every run of whitespace as one space."""
    return re.sub(r"\s+", " ", text).strip()


def answers(question: Question, path: str, text: str) -> bool:
    """Whether a passage of a file holds a gold."""
    flat = squeezed(text)
    return any((path == file or path.endswith("/" + file)) and literal in flat for file, literal in question.gold)


def place(question: Question, found: Iterable[tuple[str, str]]) -> int:
    """Rank of the first answer, 1-based; 99 when none is there."""
    return next((rank for rank, (path, text) in enumerate(found, 1) if answers(question, path, text)), 99)


def searched(ranking: str) -> Finder:
    """The tool, each hit opened by its citation."""

    def find(text: str) -> Iterator[tuple[str, str]]:
        hits = tools.search(text, k=DEPTH, ranking=ranking).hits  # type: ignore[arg-type]
        return ((hit.path, tools.read(hit.citation).content) for hit in hits)

    return find


def baseline() -> Finder:
    """BM25 over the same documents, cut every thirty lines."""
    db = sqlite3.connect(":memory:")
    db.execute("CREATE VIRTUAL TABLE piece USING fts5(path UNINDEXED, text)")
    for document in corpus.documents():
        lines = document.read().splitlines()
        for start in range(0, len(lines), NAIVE_LINES):
            db.execute("INSERT INTO piece VALUES (?,?)", (document.path, "\n".join(lines[start : start + NAIVE_LINES])))

    def find(text: str) -> list[tuple[str, str]]:
        asked = " OR ".join(f'"{word}"' for word in dict.fromkeys(re.findall(r"\w+", text.lower())))
        return db.execute(
            "SELECT path, text FROM piece WHERE piece MATCH ? ORDER BY bm25(piece) LIMIT ?", (asked, DEPTH)
        ).fetchall()

    return find


def summed(ranks: list[int]) -> Quality:
    """The shares over ranks."""
    count = max(1, len(ranks))
    return Quality(*(sum(rank <= depth for rank in ranks) / count for depth in (1, 5, 10)), len(ranks))


def measure(rows: list[Question], find: Finder) -> tuple[list[int], list[Question]]:
    """The rank of each question's first answer, and the questions without one among the first five."""
    ranks = [place(row, find(row.text)) for row in rows]
    return ranks, [row for row, rank in zip(rows, ranks, strict=True) if rank > 5]


def warm_ms(rows: list[Question], ranking: str) -> float:
    """Median milliseconds of a question that was not asked before, in a process that has answered others."""
    taken = []
    for row in rows[:60]:
        began = time.perf_counter()
        tools.search(f"{row.text} ", k=8, ranking=ranking)  # type: ignore[arg-type]
        taken.append(time.perf_counter() - began)
    return 1000 * statistics.median(taken)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("file", type=Path, nargs="?", default=QUESTIONS)
    parser.add_argument("--ranking", action="append", help="auto, full_text, vectors, hybrid or baseline; repeatable")
    parser.add_argument("--misses", action="store_true")
    options = parser.parse_args()
    rows = questions(options.file)
    for ranking in options.ranking or ("baseline", "full_text", "hybrid"):
        ranks, missed = measure(rows, baseline() if ranking == "baseline" else searched(ranking))
        for name, chosen in (("all", (True, False)), ("real", (True,)), ("own", (False,))):
            part = [rank for row, rank in zip(rows, ranks, strict=True) if row.real in chosen]
            print(f"{ranking:10} {name:5} {summed(part)}")
        if ranking != "baseline":
            print(f"{ranking:10} {warm_ms(rows, ranking):.0f} ms warm, median")
        for row in missed if options.misses else ():
            print(f"    {row.text}")


if __name__ == "__main__":
    main()
