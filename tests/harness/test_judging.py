"""The real harnesses as judges: the pictures reach the model, nothing of a project does, and what it says is the vote."""

import base64
import json
import re
import shutil
from pathlib import Path

import cv2
import numpy as np
import pytest
import wire_chat
import wire_messages
import wire_responses
from model_server import Model
from script import Say

from worldwright.judge.exhibit import Piece
from worldwright.judge.judges import SEAM, Question

ANSWER = '{"Objects": "Yes", "Event": "No", "Standard_1": "Yes"}'
CODE_MODE = "gpt-6.1-sol"
PIECES = tuple(
    Piece("image/jpeg", cv2.imencode(".jpg", np.full((48, 64, 3), level, np.uint8))[1].tobytes()) for level in (10, 200)
)


class Judging:
    """A model that gives the same answer to everything."""

    def next(self, request):
        return [Say(ANSWER)]


@pytest.fixture
def asked(clean, tmp_path, monkeypatch):
    """What the model is sent; this process stands in a clean environment, in the folder of a project."""
    bodies = []
    for wire in (wire_messages, wire_chat, wire_responses):
        read = wire.read
        monkeypatch.setattr(wire, "read", lambda body, read=read: bodies.append(body) or read(body))
    for name, value in clean.items():
        monkeypatch.setenv(name, value)
    (tmp_path / "here").mkdir()
    (tmp_path / "here/AGENTS.md").write_text("words-of-the-project")
    (tmp_path / "here/CLAUDE.md").write_text("words-of-the-project")
    monkeypatch.chdir(tmp_path / "here")
    return bodies


def judge(name, program, model):
    return SEAM.find(name).ask(Question("what is so? unlikely-words", PIECES, model, str(program), 300.0))


def check(bodies):
    """The request that asks; pictures and question are in it, and nothing of where this test stands."""
    (body,) = [one for one in bodies if "unlikely-words" in json.dumps(one) and "base64" in json.dumps(one)][:1]
    sent = json.dumps(body)
    assert all(base64.b64encode(piece.data).decode() in sent for piece in PIECES), "as they are, not drawn anew"
    assert "words-of-the-project" not in sent
    return body


def test_claude_code_judges(harnesses, asked, monkeypatch):
    with Model(Judging()) as model:
        monkeypatch.setenv("ANTHROPIC_BASE_URL", model.url)
        answer = judge("claude_headless", harnesses["claude"], "")
    assert answer.text == ANSWER and answer.tokens_out
    body = check(asked)
    assert not body.get("tools") and "You judge films." in json.dumps(body["system"])


def test_codex_judges(harnesses, asked, clean):
    with Model(Judging()) as model:
        home = Path(clean["HOME"]) / ".codex"
        home.mkdir()
        provider = f'[model_providers.scripted]\nname = "s"\nbase_url = "{model.url}/v1"\nwire_api = "responses"\n'
        more = 'env_key = "OPENAI_API_KEY"\nsupports_websockets = false\n'
        (home / "config.toml").write_text(f'model_provider = "scripted"\n{provider}{more}')
        answer = judge("codex_headless", harnesses["codex"], CODE_MODE)
    assert answer.text == ANSWER and answer.tokens_out is not None
    offered = re.findall(r"### `?(\w+)", json.dumps(check(asked)["input"]))
    assert "view_image" in offered and not {"exec_command", "shell", "write_stdin"} & set(offered), "no shell"


def test_opencode_judges(harnesses, asked, clean):
    if shutil.which("rg", path=clean["PATH"]) is None:
        pytest.fail("OpenCode needs ripgrep: run `bash .ci/system.sh suites`")
    with Model(Judging()) as model:
        folder = Path(clean["HOME"]) / ".config/opencode"
        folder.mkdir(parents=True)
        options = {"baseURL": f"{model.url}/v1", "apiKey": "dummy"}
        sees = {"modalities": {"input": ["text", "image"], "output": ["text"]}, "attachment": True, "tool_call": True}
        one = {"scripted": {"limit": {"context": 200000, "output": 8000}, **sees}}
        provider = {"scripted": {"npm": "@ai-sdk/openai-compatible", "options": options, "models": one}}
        (folder / "opencode.json").write_text(json.dumps({"provider": provider, "small_model": "scripted/scripted"}))
        answer = judge("opencode_headless", harnesses["opencode"], "scripted/scripted")
    assert answer.text == ANSWER
    assert not check(asked).get("tools")
