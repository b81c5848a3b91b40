"""Folders and exports of the user's are searched beside the manual; the exporter is driven against a local service."""

import json
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import parse_qs, urlparse

import pytest
from click.testing import CliRunner

from worldwright import cli
from worldwright.model.errors import NotFoundError
from worldwright.model.progress import silent
from worldwright.retrieve import corpus, forum_export, sources, tools


@pytest.fixture(autouse=True)
def no_sources(monkeypatch):
    monkeypatch.delenv("WORLDWRIGHT_SOURCES", raising=False)


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """A folder of the test's own for what the user adds, and for the index of all."""
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path / "cache"))


@pytest.fixture
def few(cache, monkeypatch):
    """Beside what the user adds, a few pages of the manual: the whole takes seconds to cut."""
    pages = corpus._installed()[:5]
    monkeypatch.setattr(corpus, "_installed", lambda: pages)
    monkeypatch.setattr(corpus, "_lately", lambda moment: ())
    corpus._fixed.cache_clear()
    yield
    corpus._fixed.cache_clear()


def checkout(tmp_path):
    folder = tmp_path / "engine checkout"
    (folder / "src").mkdir(parents=True)
    (folder / "build").mkdir()
    (folder / "src" / "ray.c").write_text(
        "// wobblefish distance of a ray\nint wobblefish_ray(int x) {\n  return x;\n}\n"
    )
    (folder / "build" / "skipped.c").write_text("int wobblefish_skipped(int x) {\n  return x;\n}\n")
    (folder / "broken.md").write_bytes(b"\xff\xfe\x00wobblefish")
    return folder


def test_a_named_folder_is_searched_and_cited(cache, tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_SOURCES", str(checkout(tmp_path)))
    hits = tools.search("wobblefish distance", part="sources").hits
    assert hits[0].citation == "engine-checkout-local/src/ray.c#wobblefish_ray:L1-L4"
    assert "wobblefish_ray" in tools.read(hits[0].citation).content
    assert not any("skipped" in hit.citation for hit in hits)


def test_sources_are_kept_and_forgotten(cache, tmp_path):
    folder = checkout(tmp_path)
    sources.add(folder)
    sources.add(folder)
    assert sources.roots() == [folder.resolve()]
    sources.remove(folder)
    assert sources.roots() == []
    for refused in (lambda: sources.remove(folder), lambda: sources.add(tmp_path / "nowhere")):
        with pytest.raises(NotFoundError) as caught:
            refused()
        assert caught.value.next_move


ISSUES = [
    {"number": n, "title": f"Issue {n}", "html_url": f"u/{n}", "body": f"text {n}", "user": {"login": "a"}}
    for n in range(1, 121)
]
ISSUES[3]["pull_request"] = {}
COMMENTS = [{"issue_url": "x/issues/7", "body": "wobblefish reply", "user": None}]
DISCUSSION = {
    "number": 900,
    "title": "Soft rope",
    "url": "u/900",
    "body": "how",
    "author": None,
    "comments": {"nodes": [{"body": "use wobbleflex", "isAnswer": True, "author": {"login": "b"}}]},
}


@pytest.fixture
def service():
    state = {"limited": 1, "requests": []}

    class Handler(BaseHTTPRequestHandler):
        def log_message(self, *args):
            pass

        def reply(self, value, code=200, headers=()):
            body = json.dumps(value).encode()
            self.send_response(code)
            for name, text in headers:
                self.send_header(name, text)
            self.end_headers()
            self.wfile.write(body)

        def do_GET(self):
            url = urlparse(self.path)
            state["requests"].append(self.path)
            page = int(parse_qs(url.query)["page"][0])
            if url.path.startswith("/repos/no/"):
                self.reply({}, 404)
            elif state["limited"]:
                state["limited"] -= 1
                self.reply({}, 429, [("Retry-After", "0")])
            else:
                rows = COMMENTS if url.path.endswith("comments") else ISSUES
                self.reply(rows[100 * (page - 1) : 100 * page])

        def do_POST(self):
            asked = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            if self.headers.get("Authorization") != "Bearer dummy":
                self.reply({"errors": [{"message": "needs a token"}]})
                return
            first = asked["variables"]["after"] is None
            nodes = [DISCUSSION] if first else [{**DISCUSSION, "number": 901}]
            page = {"hasNextPage": first, "endCursor": "c"}
            self.reply({"data": {"repository": {"discussions": {"totalCount": 2, "pageInfo": page, "nodes": nodes}}}})

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://127.0.0.1:{server.server_port}", state
    server.shutdown()


def test_a_forum_is_exported_indexed_and_found(few, service, tmp_path):
    out = tmp_path / "forum.jsonl"
    count = forum_export.export(forum_export.Forum("o/r", "dummy", service[0]), out, silent)
    threads = [json.loads(line) for line in out.read_text().splitlines()]
    assert count == len(threads) == 119 + 2  # one of the 120 is a pull request
    assert [p["body"] for p in next(t for t in threads if t["number"] == 7)["posts"]] == ["text 7", "wobblefish reply"]
    sources.add(out)
    hits = tools.search("wobbleflex rope", part="sources").hits
    assert hits[0].citation.startswith("forum-local/forum.jsonl#thread-900") and "accepted answer" in hits[0].text
    assert "wobbleflex" in tools.read(hits[0].citation).content


@pytest.mark.parametrize(
    ("repository", "token", "says"),
    [("o/r", "", "needs a token"), ("no/r", "dummy", "404"), ("nonsense", "", "OWNER/REPO")],
)
def test_a_refusal_leaves_no_file(service, tmp_path, repository, token, says):
    out = tmp_path / "forum.jsonl"
    result = CliRunner().invoke(
        cli.main, ["export-forum", repository, str(out), "--api", service[0]], env={"GITHUB_TOKEN": token}
    )
    assert result.exit_code == 2 and says in result.output and not out.exists()


def test_a_service_that_is_not_there_is_named(tmp_path):
    with pytest.raises(forum_export.ForumError, match="cannot be reached"):
        forum_export.export(forum_export.Forum("o/r", "", "http://127.0.0.1:9"), tmp_path / "x", silent)


def test_a_batch_answers_one_question_a_line(tmp_path, monkeypatch):
    monkeypatch.setattr("worldwright.retrieve.semantic.installed", lambda: False)
    lines = tmp_path / "questions.txt"
    lines.write_text("sliding friction of a geom\n\nmj_ray\n")
    result = CliRunner().invoke(cli.main, ["retrieve", "search", "--batch", str(lines), "-k", "3"])
    answers = [json.loads(line) for line in result.stdout.splitlines()]
    assert [a["question"] for a in answers] == ["sliding friction of a geom", "mj_ray"]
    assert all(len(a["hits"]) == 3 for a in answers) and result.exit_code == 0
    missing = CliRunner().invoke(cli.main, ["retrieve", "search", "--batch", str(tmp_path / "none")])
    assert missing.exit_code == 2 and "batch" in missing.output
    assert CliRunner().invoke(cli.main, ["retrieve", "search"]).exit_code == 2
