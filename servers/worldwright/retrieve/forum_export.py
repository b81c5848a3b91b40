"""`worldwright export-forum OWNER/REPO OUT.jsonl`: a repository's issues and discussions as one thread a line.

Runs on the user's machine, with the user's own token for what needs one (discussions, and more than 60 requests an hour).
The result is searched after `worldwright index --add OUT.jsonl`. Nothing is kept until all of it is there; a rate limit is
waited for, as the service asks.
"""

import json
import os
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import click

from worldkit.files import write_atomic

from ..cli import report_errors
from ..model.errors import WorldwrightError
from ..model.progress import Progress

API = "https://api.github.com"
PAGE = 100
PATIENCE_S = 3700.0
"""A rate limit lasts an hour at most."""
_DISCUSSIONS = """
query($owner: String!, $name: String!, $after: String) {
  repository(owner: $owner, name: $name) {
    discussions(first: 50, after: $after) {
      totalCount
      pageInfo { hasNextPage endCursor }
      nodes {
        number title url body author { login }
        comments(first: 50) { nodes { body isAnswer author { login } } }
      }
    }
  }
}
"""


class ForumError(WorldwrightError):
    """The service refused, or answered with something else than expected."""

    code = "forum"


class Forum:
    """One repository's threads, read page by page."""

    def __init__(self, repository: str, token: str = "", api: str = API) -> None:
        owner, _, name = repository.partition("/")
        if not owner or not name or "/" in name:
            raise ForumError(
                f"'{repository}' is no repository", next_move="name it OWNER/REPO, e.g. google-deepmind/mujoco"
            )
        self.owner, self.name, self.token, self.api = owner, name, token, api.rstrip("/")

    def issues(self, progress: Progress) -> Iterator[dict[str, Any]]:
        """Issues with their comments, pull requests left out."""
        path = f"/repos/{self.owner}/{self.name}"
        replies: dict[str, list[dict[str, Any]]] = {}
        for number, comment in enumerate(self._pages(f"{path}/issues/comments")):
            replies.setdefault(str(comment.get("issue_url", "")).rsplit("/", 1)[-1], []).append(_post(comment, "user"))
            progress(number, 0, "reading replies")
        for issue in self._pages(f"{path}/issues?state=all"):
            if "pull_request" not in issue:
                progress(int(issue["number"]), 0, "reading issues")
                yield _thread(issue, [_post(issue, "user"), *replies.get(str(issue["number"]), [])])

    def discussions(self, progress: Progress) -> Iterator[dict[str, Any]]:
        """Discussions with their replies; the marked answer is marked."""
        after = None
        while True:
            asked = {"query": _DISCUSSIONS, "variables": {"owner": self.owner, "name": self.name, "after": after}}
            answer = self._get("/graphql", asked)
            try:
                found = answer["data"]["repository"]["discussions"]
            except (KeyError, TypeError) as cause:
                reason = (
                    "; ".join(str(e.get("message")) for e in answer.get("errors", [])) or "no discussions in the answer"
                )
                raise ForumError(reason, place=f"{self.owner}/{self.name}", next_move="use --no-discussions") from cause
            for node in found["nodes"]:
                posts = [_post(node, "author"), *(_post(reply, "author") for reply in node["comments"]["nodes"])]
                yield _thread({**node, "html_url": node["url"]}, posts)
            progress(0, found.get("totalCount", 0), "reading discussions")
            if not found["pageInfo"]["hasNextPage"]:
                return
            after = found["pageInfo"]["endCursor"]

    def _pages(self, path: str) -> Iterator[dict[str, Any]]:
        page = 1
        while True:
            rows = self._get(f"{path}{'&' if '?' in path else '?'}per_page={PAGE}&page={page}")
            yield from rows
            if len(rows) < PAGE:
                return
            page += 1

    def _get(self, path: str, body: dict[str, Any] | None = None) -> Any:
        headers = {"Accept": "application/vnd.github+json", "User-Agent": "worldwright"}
        if self.token:
            headers["Authorization"] = f"Bearer {self.token}"
        data = json.dumps(body).encode() if body else None
        deadline = time.monotonic() + PATIENCE_S
        while True:
            request = urllib.request.Request(self.api + path, data=data, headers=headers)
            try:
                with urllib.request.urlopen(request, timeout=60) as answer:
                    return json.load(answer)
            except urllib.error.HTTPError as error:
                wait = _pause(error)
                if wait is None or time.monotonic() + wait > deadline:
                    raise ForumError(
                        f"the service answered {error.code} {error.reason}",
                        place=self.api + path,
                        next_move="check the repository's name, and give a token in GITHUB_TOKEN",
                    ) from error
                time.sleep(wait)
            except (urllib.error.URLError, TimeoutError, ValueError) as error:
                raise ForumError(
                    f"the service cannot be reached: {error}", place=self.api, next_move="check the network and --api"
                ) from error


def _pause(error: urllib.error.HTTPError) -> float | None:
    """Seconds the service asks us to wait, or None when waiting does not help."""
    after, left = error.headers.get("Retry-After"), error.headers.get("X-RateLimit-Remaining")
    if error.code in (403, 429) and after and after.isdigit():
        return float(after)
    if error.code in (403, 429) and left == "0":
        return max(1.0, float(error.headers.get("X-RateLimit-Reset", 0)) - time.time())
    return None


def _post(row: dict[str, Any], author: str) -> dict[str, Any]:
    post = {"author": (row.get(author) or {}).get("login", ""), "body": row.get("body") or ""}
    return {**post, "answer": True} if row.get("isAnswer") else post


def _thread(row: dict[str, Any], posts: list[dict[str, Any]]) -> dict[str, Any]:
    return {"number": row["number"], "title": row["title"], "url": row.get("html_url", ""), "posts": posts}


def export(forum: Forum, out: Path, progress: Progress, discussions: bool = True) -> int:
    """Write every thread; returns how many. The file appears whole or not at all."""
    threads = list(forum.issues(progress))
    if discussions:
        threads += forum.discussions(progress)
    write_atomic(out, "".join(json.dumps(thread, ensure_ascii=False) + "\n" for thread in threads))
    return len(threads)


@click.command("export-forum")
@click.argument("repository")
@click.argument("out", type=click.Path(path_type=Path))
@click.option("--discussions/--no-discussions", default=True, help="Discussions need a token in GITHUB_TOKEN.")
@click.option("--api", default=API, show_default=True, help="Another service with the same interface.")
def command(repository: str, out: Path, discussions: bool, api: str) -> None:
    """Write a repository's issues and discussions to OUT, one thread a line, for `worldwright index --add OUT`."""

    def run() -> int:
        from ..report.bar import bar

        with bar() as progress:
            forum = Forum(repository, os.environ.get("GITHUB_TOKEN", ""), api)
            return export(forum, out, progress, discussions)

    count = report_errors(run)
    click.echo(f"{count} threads written to {out}; search them with: worldwright index --add {out}")
