"""How well search finds what the manual says: recall@5, MRR and nDCG@10 over questions with known answers.

    python tests/worldwright/retrieve/quality.py [--split tune|test] [--misses]

Every other question of each kind tunes, the rest tests. A hit answers when its anchor is one of the question's.
"""

import argparse
import math
import re
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

import yaml

from worldwright.retrieve import tools

QUESTIONS = Path(__file__).with_name("questions.yaml")


class Question(NamedTuple):
    """One row of the file."""

    kind: str
    text: str
    gold: frozenset[str]


class Quality(NamedTuple):
    """Means over questions, each 0 to 1."""

    recall_at_5: float
    mrr: float
    ndcg_at_10: float

    def __str__(self) -> str:
        return f"recall@5 {self.recall_at_5:.3f}  MRR {self.mrr:.3f}  nDCG@10 {self.ndcg_at_10:.3f}"


def questions(split: str = "all") -> list[Question]:
    """The rows of one half (`tune`, `test`) or all."""
    rows = [Question(row[0], str(row[1]), frozenset(row[2:])) for row in yaml.safe_load(QUESTIONS.read_text())]
    if split == "all":
        return rows
    seen: dict[str, int] = defaultdict(int)
    chosen = []
    for row in rows:
        if (seen[row.kind] % 2 == 0) == (split == "tune"):
            chosen.append(row)
        seen[row.kind] += 1
    return chosen


def anchors(question: str, ranking: str, k: int = 10) -> list[str]:
    """Anchors of the hits, best first."""
    hits = tools.search(question, k=k, ranking=ranking).hits
    return [re.sub(r":L\d+-L\d+$", "", hit.citation.split("#", 1)[1]) for hit in hits]


def measure(rows: list[Question], ranking: str) -> tuple[Quality, list[Question]]:
    """The means, and the questions without an answer among the first five."""
    recall = reciprocal = gain = 0.0
    missed = []
    for row in rows:
        found = anchors(row.text, ranking)
        right = [place for place, anchor in enumerate(dict.fromkeys(found), 1) if anchor in row.gold]
        recall += bool(right) and right[0] <= 5
        reciprocal += 1 / right[0] if right else 0.0
        ideal = sum(1 / math.log2(place + 1) for place in range(1, min(len(row.gold), 10) + 1))
        gain += sum(1 / math.log2(place + 1) for place in right) / ideal
        if not right or right[0] > 5:
            missed.append(row)
    count = len(rows)
    return Quality(recall / count, reciprocal / count, gain / count), missed


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--split", choices=["tune", "test", "all"], default="tune")
    parser.add_argument("--misses", action="store_true")
    options = parser.parse_args()
    rows = questions(options.split)
    print(f"{len(rows)} questions ({options.split})")
    for ranking in ("full_text", "vectors", "hybrid"):
        quality, missed = measure(rows, ranking)
        print(f"{ranking:10} {quality}")
        if options.misses:
            for row in missed:
                print(f"    {row.text}  ->  {anchors(row.text, ranking, 5)}")


if __name__ == "__main__":
    main()
