"""Answers stay under 20 KB, nothing is lost over all pages, and what is not shown is said."""

import json
from pathlib import Path
from typing import Any

import anyio
import mcp
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from worldwright import expose
from worldwright.model.errors import NotFoundError
from worldwright.paging import LIMIT_BYTES, fit, lists, size

WORDS = st.text(max_size=400)
ANSWERS = st.fixed_dictionaries(
    {
        "findings": st.lists(st.fixed_dictionaries({"at": st.integers(), "text": WORDS}), max_size=120),
        "margins": st.lists(st.fixed_dictionaries({"gap": st.floats(allow_nan=False), "of": WORDS}), max_size=80),
        "ok": st.booleans(),
        "note": WORDS,
    }
)
CALM = settings(deadline=None, max_examples=60, suppress_health_check=[HealthCheck.too_slow])
FIELDS = ("findings", "margins")


@CALM
@given(ANSWERS)
def test_all_pages_together_are_the_answer(answer):
    found: dict[str, list[Any]] = {field: [] for field in FIELDS}
    page = 1
    while True:
        part = fit(answer, FIELDS, page)
        assert size(part) <= LIMIT_BYTES
        for field in FIELDS:
            found[field] += part[field]
        if f"page={page + 1}" not in part.get("shortened", ""):
            break
        page += 1
    assert found == {field: answer[field] for field in FIELDS}
    with pytest.raises(NotFoundError, match=f"no page {page + 1}"):
        fit(answer, FIELDS, page + 1)
    if page == 1:
        assert "shortened" not in part


@CALM
@given(st.recursive(st.text(max_size=3000), lambda inner: st.lists(inner, max_size=20) | st.dictionaries(WORDS, inner)))
def test_whatever_is_too_long_is_shortened_and_says_so(value):
    answer = {"deep": {"value": value}}
    part = fit(answer)
    assert (part == answer) == ("shortened" not in part)
    if size(answer) <= LIMIT_BYTES - 500:
        assert part == answer


def test_long_lists_and_long_text_are_cut_and_named():
    part = fit({"log": "x" * 90_000, "held": [f"object_{i}" for i in range(5000)], "ok": True})
    assert size(part) <= LIMIT_BYTES and part["ok"]
    assert "log cut to" in part["shortened"] and "held cut to" in part["shortened"]


def test_findings_come_first():
    tools = {function.__name__: function for function in expose.tools("place")}
    assert lists(expose.hints(tools["check"])["return"])[0] == "findings"


BALLS = [f"ball_{i:02}" for i in range(60)]


@pytest.fixture(scope="module")
def crowd(tmp_path_factory) -> Path:
    """The small world's plan with sixty more balls, all in one place: sixty poses, a finding for every pair."""
    text = (Path(__file__).parent / "world/dropped-ball.md").read_text(encoding="utf-8")
    thing = text[text.index("- name: ball") : text.index("```\n\n## assets")]
    rows = text[text.index("  - {subject: ball, predicate: HEIGHT") : text.index("```\n\n## visualization")]
    text = text.replace(thing, thing + "".join(thing.replace("name: ball", f"name: {name}") for name in BALLS))
    text = text.replace(rows, rows + "".join(rows.replace("subject: ball", f"subject: {name}") for name in BALLS))
    text = text.replace("  ball: 0.2\n", "  ball: 0.2\n" + "".join(f"  {name}: 0.2\n" for name in BALLS))
    path = tmp_path_factory.mktemp("crowd") / "plan.md"
    path.write_text(text, encoding="utf-8")
    return path


async def ask(server: str, tool: str, **arguments: Any) -> list[Any]:
    """Every page of one tool's answer, over the protocol."""
    found = []
    async with mcp.Client(expose.build_server(server)) as client:
        page = 1
        while True:
            result = await client.call_tool(tool, {**arguments, "page": page})
            assert not result.is_error, result.content
            text = result.content[0].text
            assert len(text.encode()) <= LIMIT_BYTES
            assert json.loads(text) == result.structured_content
            found.append(result.structured_content)
            if f"page={page + 1}" not in result.structured_content.get("shortened", ""):
                return found
            page += 1


def test_every_object_of_a_crowd_is_on_some_page(crowd):
    pages = anyio.run(lambda: ask("place", "resolve", plan=str(crowd), write=False))
    assert len(pages) > 1
    assert {"ball", *BALLS} <= {thing["name"] for page in pages for thing in page["objects"]}


def test_every_finding_of_a_crowd_is_on_some_page(crowd):
    text = crowd.read_text(encoding="utf-8")
    for i in range(200):
        text = text.replace(
            "- none", f"- TO_CLARIFY {i} what is the {'very ' * 12}right colour of this ball?\n- none", 1
        )
    crowd.write_text(text, encoding="utf-8")
    function = next(f for f in expose.tools("lint") if f.__name__ == "check_plan")
    whole = function(plan=crowd)
    pages = anyio.run(lambda: ask("lint", "check_plan", plan=str(crowd)))
    assert sum(len(page["findings"]) for page in pages) == len(whole.findings)


def test_the_list_of_rules_pages():
    pages = anyio.run(lambda: ask("lint", "list_rules"))
    function = next(f for f in expose.tools("lint") if f.__name__ == "list_rules")
    assert sum(len(page["rules"]) for page in pages) == len(function().rules)


def test_a_page_that_is_not_there_is_refused():
    async def call() -> Any:
        async with mcp.Client(expose.build_server("lint")) as client:
            return await client.call_tool("list_rules", {"page": 99})

    result = anyio.run(call)
    assert result.is_error and "page=1" in result.content[0].text
