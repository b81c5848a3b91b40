import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Annotated, Literal

import anyio
import cv2
import numpy as np
import pytest
from click.testing import CliRunner
from pydantic import Field

from worldwright import expose
from worldwright.cli import main, verb
from worldwright.model import call_time
from worldwright.model.errors import NotFoundError
from worldwright.model.frozen import Frozen
from worldwright.model.picture import Illustrated, Picture
from worldwright.model.progress import Progress, silent


class Answer(Frozen):
    words: list[str]
    ok: bool = True


class Item(Frozen):
    weight_kg: float


PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c6360f8cf50"
    "0f0003860180efd0e9540000000049454e44ae426082"
)


def echo(
    text: Annotated[str, Field(description="What to say.")],
    times: Annotated[int, Field(description="How often.")] = 1,
    voice: Annotated[Literal["loud", "soft"], Field(description="How.")] = "soft",
    progress: Progress = silent,
) -> Answer:
    """Say it again."""
    progress(1, times, "first")
    print("stray text that must never reach the wire")
    return Answer(words=[text.upper() if voice == "loud" else text] * times, ok=times > 0)


def weigh(items: Annotated[list[Path], Field(description="Files.")], first: Item) -> Answer:
    """Weigh things."""
    return Answer(words=[f"{path.name} {first.weight_kg}" for path in items])


def show() -> Illustrated:
    """Show a picture."""
    return Illustrated(Answer(words=["look"]), (Picture(PIXEL, "one pixel"),))


def fail() -> Answer:
    """Fail in a way the caller can mend."""
    raise NotFoundError("no such thing", place="here", next_move="ask for another")


def crash() -> Answer:
    """Fail in a way only we can mend."""
    raise ZeroDivisionError("ours")


def doze(progress: Progress = silent) -> Answer:
    """Say little for a while."""
    time.sleep(0.3)
    progress(1, 2, "half")
    time.sleep(0.3)
    return Answer(words=[f"{call_time.left_s():.0f}"])


@pytest.fixture
def server(monkeypatch):
    monkeypatch.setattr(expose, "tools", lambda name: (echo, show, fail, crash, doze))
    return expose.build_server("lint")


def talk(server, action):
    import mcp

    async def run():
        async with mcp.Client(server) as client:
            return await action(client)

    return anyio.run(run)


def test_one_function_is_one_tool_with_its_types(server):
    tools = {tool.name: tool for tool in talk(server, lambda client: client.list_tools()).tools}
    properties = tools["echo"].input_schema["properties"]
    assert set(properties) == {"text", "times", "voice"}
    assert properties["text"]["description"] == "What to say."
    assert properties["voice"]["enum"] == ["loud", "soft"]
    assert tools["echo"].output_schema["properties"].keys() == {"words", "ok", "shortened"}
    assert tools["show"].output_schema is None


def test_data_comes_back_structured_and_progress_is_reported(server):
    heard = []

    async def listener(done, total, message):
        heard.append((done, total, message))

    arguments = {"text": "hi", "times": 2}
    result = talk(server, lambda c: c.call_tool("echo", arguments, progress_callback=listener))
    assert result.structured_content == {"words": ["hi", "hi"], "ok": True}
    assert heard == [(1, 2, "first")]


def test_a_silent_call_is_heard_of_and_has_an_end(server, monkeypatch):
    monkeypatch.setattr(expose, "BEAT_S", 0.05)
    heard = []

    async def listener(done, total, message):
        heard.append((done, total, message))

    result = talk(server, lambda c: c.call_tool("doze", {}, progress_callback=listener))
    assert float(result.structured_content["words"][0]) <= call_time.CALL_S and call_time.left_s() > 1e9
    told = [done for done, _, _ in heard]
    half = heard.index((1, 2, "half"))
    assert 0 < half < len(heard) - 1 and told == sorted(set(told))
    assert "doze: at work for" in heard[0][2] and heard[-1][1] == 2


def test_pictures_come_back_as_text_and_image_without_structured_content(server):
    result = talk(server, lambda c: c.call_tool("show", {}))
    assert result.structured_content is None
    assert [part.type for part in result.content] == ["text", "text", "image"]
    assert json.loads(result.content[0].text) == {"words": ["look"]}


def test_errors_name_cause_place_and_next_move(server):
    result = talk(server, lambda c: c.call_tool("fail", {}))
    assert result.is_error
    error = json.loads(result.content[0].text)
    assert error == {"error": "not_found", "cause": "no such thing", "place": "here", "next": "ask for another"}
    assert result.structured_content == error
    crashed = talk(server, lambda c: c.call_tool("crash", {}))
    assert crashed.is_error
    assert "ZeroDivisionError" in crashed.content[0].text


def test_the_same_function_is_a_verb():
    done = CliRunner().invoke(verb(echo), ["hi", "--times", "2", "--voice", "loud", "--format", "json"])
    assert json.loads(done.output[done.output.index("{") :])["words"] == ["HI", "HI"]
    assert done.exit_code == 0
    assert CliRunner().invoke(verb(echo), ["hi", "--times", "0"]).exit_code == 1


def test_models_are_given_as_json_or_file(tmp_path):
    (tmp_path / "item.json").write_text('{"weight_kg": 2.5}')
    command = verb(weigh)
    # the list of files swallows every positional but the last
    done = CliRunner().invoke(command, ["a", "b", f"@{tmp_path}/item.json", "--format", "json"])
    assert json.loads(done.output)["words"] == ["a 2.5", "b 2.5"]
    assert "FIRST(JSON|@FILE)" in CliRunner().invoke(command, ["--help"]).output
    wrong = CliRunner().invoke(command, ["a", '{"weight": 1}'])
    assert wrong.exit_code == 2
    assert "weight" in wrong.output


def test_pictures_are_written_as_png_where_asked(tmp_path):
    def shot() -> Illustrated:
        """Show a JPEG."""
        data = cv2.imencode(".jpg", np.full((8, 8, 3), 200, np.uint8))[1].tobytes()
        return Illustrated(Answer(words=["look"]), (Picture(data, "grey", "jpeg"),))

    for word, name, begins in ((), "01-grey.jpg", b"\xff\xd8"), (("--png",), "01-grey.png", b"\x89PNG"):
        done = CliRunner().invoke(verb(shot), ["--save", str(tmp_path), *word])
        assert done.exit_code == 0 and (tmp_path / name).read_bytes().startswith(begins), done.output


def test_a_verb_that_fails_prints_the_next_move_and_exits_2():
    done = CliRunner().invoke(verb(fail), [])
    assert done.exit_code == 2
    assert "ask for another" in done.output


def test_help_names_every_server_without_importing_one():
    code = (
        "import sys; from worldwright.cli import main\n"
        "try: main(['--help'])\n"
        "except SystemExit: pass\n"
        "assert not [m for m in sys.modules if m.startswith('worldwright.') and m.endswith('.tools')]"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert all(name in done.stdout for name in expose.SERVERS)


def test_an_unknown_command_lists_the_known_ones():
    done = CliRunner().invoke(main, ["simulate"])
    assert done.exit_code == 2
    assert "retrieve" in done.output


def test_pictures_that_nobody_said_where_to_save_lie_in_the_runs_out(tmp_path):
    drawn = cv2.imencode(".jpg", np.full((8, 8, 3), 200, np.uint8))[1].tobytes()

    def shot(run: str) -> Illustrated:
        """Show a JPEG of a run."""
        return Illustrated(Answer(words=["look"]), (Picture(drawn, "grey", "jpeg"),))

    (tmp_path / "runs" / "fall").mkdir(parents=True)
    (tmp_path / "runs" / "fall" / "plan.md").write_text("")
    done = CliRunner().invoke(verb(shot), [str(tmp_path / "runs" / "fall")])
    (written,) = (tmp_path / "runs" / "fall" / "out").rglob("*.jpg")
    assert done.exit_code == 0 and str(written) in done.output and written.read_bytes() == drawn, done.output
