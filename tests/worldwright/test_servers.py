"""Every tool of every server, called by a real client over stdio against a world that was really built."""

import json
import os
import shutil
import sys
from pathlib import Path

import anyio
import mcp
import pytest
from mcp import StdioServerParameters

from worldwright import expose
from worldwright.report import write as write_report
from worldwright.stamp import by_measurement


@pytest.fixture(scope="module")
def world(accepted, tmp_path_factory) -> Path:
    """An accepted world that these tests may add to."""
    return Path(shutil.copytree(accepted, tmp_path_factory.mktemp("servers") / accepted.name))


def calls(server: str, world: Path, copy: Path) -> dict[str, dict]:
    """Arguments for every tool of a server; `copy` is a run that may be changed."""
    from worldwright.model.evidence import environment
    from worldwright.model.evidence.run import Run

    run, plan = str(world), str(world / "plan.md")
    key = Run(world).evidence_key(environment.current().sha256()).key
    copied = Run(copy)
    planned = Path(f"{copy}-planned")
    planned.mkdir()
    (planned / "plan.md").write_text((copy / "plan.md").read_text(encoding="utf-8") + "\n", encoding="utf-8")
    (copy / "pebble.py").write_text("from worldkit import sculpt\n\npebble = sculpt.sphere(0.05)\n", encoding="utf-8")
    (copy / "block.obj").write_text(BLOCK, encoding="utf-8")
    (planned / "sweep.yaml").write_text(SWEEP, encoding="utf-8")
    campaign = str(planned / "campaign")
    return {
        "retrieve": {
            "search": {"question": "how does restitution follow from solref", "k": 3},
            "read": {"citation": None},
            "symbol": {"name": "mujoco.mj_step"},
            "breaking_changes": {"name": "composite"},
            "find_asset": {"query": "mug"},
            "add_asset": {"file": str(copy / "block.obj"), "height": 0.2, "material": "wood"},
            "keep_sculpt": {"run": str(copy.parent / "sculpted"), "name": "bowl", "key": "turned_bowl"},
            "begin": {"sentence": "a ball falls beside a block", "run": f"{copy}-begun"},
            "status": {},
        },
        "lint": {
            "check_plan": {"plan": plan},
            "check_program": {"files": [str(world / "simulation.py")], "plan": plan},
            "complete_plan": {"run": str(copy)},
            "explain": {"code": "WL101"},
            "list_rules": {},
        },
        "place": {
            "resolve": {"plan": plan, "write": False},
            "check": {"plan": plan},
            "settle": {"plan": plan},
            "explain": {"plan": plan, "object": "ball"},
            "draw": {"plan": plan},
            "reckon": {"expressions": ["v = fall_speed(0.3)"], "plan": plan},
        },
        "stage": {
            "draft": {"run": run},
            "start": {"run": run, "stage": "physics"},
            "wait": {"run": run},
            "status": {"run": run},
            "look": {"run": run, "at": 0.1},
            "frames": {"run": run, "count": 2},
            "sheet": {"thing": str(copied.folder / "pebble.py")},
            "log": {"run": run},
            "cancel": {"run": run},
            "rehearse": {"run": str(planned), "timeout_s": 1},
            "campaign_start": {"file": str(planned / "sweep.yaml"), "folder": campaign},
            "campaign_wait": {"campaign": campaign, "timeout_s": 20},
            "campaign_status": {"campaign": campaign},
            "campaign_cancel": {"campaign": campaign},
            "campaign_results": {"campaign": campaign},
        },
        "scan": {
            "scan": {"run": run},
            "expect": {"run": run},
            "query": {"run": run, "body": "ball", "window": "0:0.5"},
            "plot": {"run": run, "quantity": "height"},
            "compare": {"run": run, "first": key, "second": key},
        },
        "stamp": {
            "status": {"run": str(copy)},
            "go": {"run": str(copy), "timeout_s": 1},
            "approve": {"run": str(copy)},
            "describe": {"run": str(copy), "description": by_measurement.describe(copied).model_dump(mode="json")},
            "review": {"run": str(copy), "verdict": by_measurement.review(copied).model_dump(mode="json")},
            "accept": {"run": str(copy)},
            "verify": {"run": run},
            "block": {"run": f"{copy}-other", "cause": "a test of the other ending"},
        },
    }[server]


BLOCK = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + "".join(
    f"f {row}\n" for row in ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")
)
"""A cube as a mesh file."""
POT = "from worldkit.sculpt import crisp\n\nPOT = crisp.pipe(0.2, 0.18, 0.09) | crisp.cylinder(0.19, 0.01)\n"
"""What a run sculpts."""
SWEEP = """\
plan: plan.md
hands: processes
workers: 1
report: false
sweep: {fields: {simulation_parameters.masses.ball: {values: [-1]}}}
"""
"""A campaign of one world, which the plan's check refuses."""


def serve(server: str) -> StdioServerParameters:
    """How a client starts a server that has the tests' own key, cache and assets, since a client passes on next to nothing."""
    return StdioServerParameters(
        command=sys.executable, args=["-m", "worldwright.cli", "serve", server], env=dict(os.environ)
    )


async def talk(server: str, table: dict[str, dict]) -> dict:
    """Call every tool of the table in its order; returns the results by name."""
    results = {}
    async with mcp.Client(serve(server)) as client:
        listed = {tool.name: tool for tool in (await client.list_tools()).tools}
        assert set(listed) == set(table)
        for tool in listed.values():
            assert tool.description
            assert len(tool.description.split()) < 120
        for name, arguments in table.items():
            if name == "read":
                hits = results["search"].structured_content["hits"]
                arguments = {"citation": hits[0]["citation"]}
            results[name] = await client.call_tool(name, arguments)
        wrong = await client.call_tool(next(iter(table)), {"no_such_argument": 1})
        assert wrong.is_error or set(table[next(iter(table))]) == set()
        assert (await client.list_tools()).tools  # and it goes on serving
    return results


@pytest.mark.parametrize("server", expose.SERVERS)
def test_every_tool_answers(server, world, tmp_path, monkeypatch, sculpted_plan):
    (tmp_path / "sculpted/sculpt").mkdir(parents=True)
    (tmp_path / "sculpted/plan.md").write_text(sculpted_plan, encoding="utf-8")
    (tmp_path / "sculpted/sculpt/bowl.py").write_text(POT, encoding="utf-8")
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    copy = tmp_path / "copy"
    shutil.copytree(world, copy, symlinks=True)
    shutil.rmtree(copy / "accepted")
    shutil.copytree(copy, f"{copy}-other", symlinks=True)  # for the other ending
    results = anyio.run(talk, server, calls(server, world, copy))
    for name, result in results.items():
        text = "".join(part.text for part in result.content if part.type == "text")
        assert not result.is_error, f"{server} {name}: {text}"
        assert len(text) < 20_000, f"{server} {name} answers {len(text)} characters"
        if any(part.type == "image" for part in result.content):
            assert result.structured_content is None
            assert sum(len(part.data) for part in result.content if part.type == "image") < 1_000_000
        else:
            assert json.loads(json.dumps(result.structured_content)) == result.structured_content


def test_a_broken_run_is_an_answer_not_an_end(tmp_path):
    plan = tmp_path / "plan.md"
    plan.write_bytes(b"\xff\xfe\x00 not a plan")

    async def ask():
        async with mcp.Client(serve("stamp")) as client:
            first = await client.call_tool("approve", {"run": str(tmp_path)})
            second = await client.call_tool("status", {"run": str(tmp_path / "nowhere")})
            third = await client.call_tool("status", {"run": str(tmp_path)})
            return first, second, third

    refused, unknown, status = anyio.run(ask)
    assert refused.is_error
    assert unknown.is_error
    assert json.loads(unknown.content[0].text)["next"]
    assert not status.is_error


def test_the_report_is_one_file_and_asks_the_network_for_nothing(world):
    from worldwright.model.evidence.run import Run

    page = write_report(Run(world)).read_text(encoding="utf-8")
    assert "data:video/mp4;base64," in page
    assert 'src="http' not in page
    assert "url(http" not in page
    assert "A dropped ball" in page
