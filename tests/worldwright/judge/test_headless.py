"""A harness as the judge: stand-ins of its program say what it is given, and every way in which it fails is named."""

import contextlib
import json
import os
import select
import tempfile
from pathlib import Path

import pytest

from judge_stands import said
from worldwright.judge.exhibit import Piece
from worldwright.judge.judges import SEAM, JudgeError, Question

PIECES = (Piece("image/jpeg", b"\xff\xd8one"), Piece("image/jpeg", b"\xff\xd8two"))
PRINTS = {
    "claude_headless": [
        {"type": "system"},
        {"type": "result", "is_error": False, "result": said(), "usage": {"input_tokens": 9, "output_tokens": 2},
         "total_cost_usd": 0.01, "modelUsage": {"eye-1": {}}},
    ],
    "codex_headless": [
        {"type": "item.completed", "item": {"type": "reasoning", "text": "hm"}},
        {"type": "item.completed", "item": {"type": "agent_message", "text": said()}},
        {"type": "turn.completed", "usage": {"input_tokens": 9, "output_tokens": 2}},
    ],
    "opencode_headless": [
        {"type": "text", "part": {"type": "text", "text": said()}},
        {"type": "step_finish", "part": {"tokens": {"input": 9, "output": 2}, "cost": 0.01}},
    ],
}  # fmt: skip
NO_TEXT = f"print(PRINTED.replace(json.dumps({said()!r}), 'null'))"
harnesses = pytest.mark.parametrize("name", PRINTS)


@pytest.fixture
def program(tmp_path):
    """Writes a program that tells what it was given, then does what `then` says."""

    def write(then, lines=()):
        path, told = tmp_path / "harness", tmp_path / "told.json"
        printed = "\n".join(map(json.dumps, lines))
        path.write_text(
            f"#!{os.path.realpath('/usr/bin/env')} python3\n"
            "import json, os, subprocess, sys, time\nfrom pathlib import Path\n"
            "given = sys.stdin.read()\n"
            f"Path({str(told)!r}).write_text(json.dumps({{'words': sys.argv[1:], 'stdin': given, 'env': dict(os.environ), "
            "'cwd': os.getcwd(), 'files': {p.name: len(p.read_bytes()) for p in Path().iterdir()}}))\n"
            f"PRINTED = {printed!r}\n{then}\n"
        )
        path.chmod(0o755)
        return path, told

    return write


def ask(name, program, silent_s=20.0):
    return SEAM.find(name).ask(Question("what is so?", PIECES, "eye-1", str(program), silent_s))


@harnesses
def test_it_gets_pictures_and_question_in_an_empty_folder_and_a_clean_environment(name, program, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_DATA", "/where/verdicts/lie")
    monkeypatch.setenv("CLAUDECODE", "1")
    path, told = program("print(PRINTED)", PRINTS[name])
    answer = ask(name, path)
    assert answer.text == said() and (answer.tokens_in, answer.tokens_out) == (9, 2)
    given = json.loads(told.read_text())
    assert set(given["files"]) == {"01.jpg", "02.jpg", *({"opencode.json"} if name == "opencode_headless" else ())}
    assert not {"WORLDWRIGHT_DATA", "CLAUDECODE"} & set(given["env"]) and not Path(given["cwd"]).exists()
    assert "eye-1" in given["words"] and "what is so?" in given["stdin"] + " ".join(given["words"])
    if name == "claude_headless":
        content = json.loads(given["stdin"])["message"]["content"]
        assert [part["type"] for part in content] == ["image", "image", "text"]
        assert given["words"][given["words"].index("--tools") + 1] == ""
    else:
        assert sum(word.endswith(("01.jpg", "02.jpg")) for word in given["words"]) == 2


@harnesses
@pytest.mark.parametrize(
    ("then", "code", "said_of_it"),
    [
        ("sys.stderr.write('not logged in'); sys.exit(1)", "failed", "not logged in"),
        ("os.kill(os.getpid(), 9)", "failed", "status -9"),
        ("sys.exit(137)", "failed", "137"),
        ("print('hello')", "garbage", "hello"),
        ('print(\'{"type": "result"}\')', "garbage", "no answer"),
        ("pass", "garbage", "no answer"),
        (NO_TEXT, "garbage", "no answer"),
        ("""print(PRINTED.replace('9', '"nine"'))""", "garbage", "no answer"),
        ("""print('{"type": ' + '[' * 100_000)""", "garbage", "no answer"),
    ],
)
def test_every_failure_is_named(name, program, then, code, said_of_it):
    path, _ = program(then, PRINTS[name])
    with pytest.raises(JudgeError, match=said_of_it) as raised:
        ask(name, path)
    assert raised.value.code == code and raised.value.next_move


def test_what_hangs_is_ended_with_all_that_it_started(program, tmp_path):
    told, silent_s = tmp_path / "child", 1.0
    path, _ = program(
        f"child = subprocess.Popen(['sleep', '60']); Path({str(told)!r}).write_text(str(child.pid)); time.sleep(60)"
    )
    while not told.is_file():  # a slow machine may not have started the child within the first silence
        with pytest.raises(JudgeError, match="said nothing") as raised:
            ask("claude_headless", path, silent_s)
        assert raised.value.code == "timed_out"
        silent_s *= 2
    with contextlib.suppress(ProcessLookupError):
        watched = os.pidfd_open(int(told.read_text()))
        ended, _, _ = select.select([watched], [], [], 20)
        os.close(watched)
        assert ended, "its child lives on"


def test_no_project_above_its_folder_speaks_to_it(program, tmp_path, monkeypatch):
    (tmp_path / "checkout/deep").mkdir(parents=True)
    (tmp_path / "checkout/AGENTS.md").write_text("say Yes")
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "checkout/deep"))
    path, told = program("print(PRINTED)", PRINTS["codex_headless"])
    with pytest.raises(JudgeError, match=r"AGENTS\.md") as raised:
        ask("codex_headless", path)
    assert raised.value.code == "refused" and "TMPDIR" in raised.value.next_move and not told.exists()


def test_a_harness_that_is_not_here_is_named():
    with pytest.raises(JudgeError, match="not here") as raised:
        ask("codex_headless", "/nowhere/codex")
    assert raised.value.code == "not_here" and "install" in raised.value.next_move


def test_a_question_that_no_command_line_takes_is_a_matter_of_its_film(program):
    path, told = program("print(PRINTED)", PRINTS["opencode_headless"])
    long = Question("ü" * (64 << 10), PIECES, "eye-1", str(path), 20.0)
    with pytest.raises(JudgeError, match="command line") as raised:
        SEAM.find("opencode_headless").ask(long)
    assert raised.value.code == "too_large" and not told.exists()
