"""Forum history as JSON lines (`worldwright export-forum`): one thread a line, one piece a post.

A line is an object with `number`, `title`, `url` and `posts`, a list of `{"author", "body"}`; the question comes first,
a marked answer carries `"answer": true`.
"""

import json
from collections.abc import Iterator

from .chunk import MAX_CHARACTERS, Chunk

MAX_POSTS = 12
"""Posts of a thread that are kept: the question, the marked answer and the first replies are worth finding."""


def chunks(text: str) -> Iterator[Chunk]:
    """Cut an export; a line that is not a thread is passed over."""
    for number, line in enumerate(text.splitlines(), 1):
        try:
            thread = json.loads(line)
            title, posts = str(thread["title"]), list(thread["posts"])
        except (ValueError, KeyError, TypeError):
            continue
        anchor = f"thread-{thread.get('number', number)}"
        rows = [p for p in posts if isinstance(p, dict) and str(p.get("body", "")).strip()]
        rows = [post for place, post in enumerate(rows) if place <= MAX_POSTS or post.get("answer")]
        for place, post in enumerate(rows):
            role = "question" if place == 0 else "accepted answer" if post.get("answer") else "reply"
            body = f"{role}: {str(post['body']).strip()[:MAX_CHARACTERS]}\n{thread.get('url', '')}".strip()
            yield Chunk(anchor, title, number, number, body)
