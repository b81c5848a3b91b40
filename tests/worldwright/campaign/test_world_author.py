"""Worlds that a headless harness writes: what becomes of one that fails in any way. The harnesses here are small programs of ours.

`tests/harness/test_campaign.py` does the same with the real ones and a scripted model.
"""

import json
import multiprocessing as mp
import subprocess
import sys
import time
from pathlib import Path

import pytest

import stub_worlds
from worldwright.campaign import author_folder, author_watch, conducting, one_world, setting_out, world_author
from worldwright.campaign.author_talk import Talk
from worldwright.campaign.author_words import Author, Prices
from worldwright.campaign.campaign_file import Budget, CampaignError, parse
from worldwright.campaign.campaign_store import LONGEST_PROMPT, Store
from worldwright.campaign.campaign_table import flat
from worldwright.campaign.one_world import task
from worldwright.campaign.worker_processes import Ended
from worldwright.campaign.world_row import Row
from worldwright.contract import harnesses

RESULT = {
    "type": "result", "subtype": "success", "is_error": False, "result": "done", "total_cost_usd": 0.5,
    "modelUsage": {"a": {"inputTokens": 100, "cacheReadInputTokens": 50, "outputTokens": 20}},
}  # fmt: skip
STEP = {"type": "step_finish", "part": {"id": "a", "cost": 0, "tokens": {"input": 900, "output": 100}}}
TURN = {"type": "turn.completed", "usage": {"input_tokens": 1_000_000, "output_tokens": 1_000_000}}
ACTS = {
    "writes": f"write(); print(json.dumps({RESULT}))",
    "ends as codex": f"write(); print(json.dumps({TURN}))",
    "ends without a price": f"write(); print(json.dumps({ {name: RESULT[name] for name in RESULT if name != 'total_cost_usd'} }))",
    "leaves a child": "subprocess.Popen([sys.executable, '-c', \"import os, time, pathlib; "
    "pathlib.Path('../child').write_text(str(os.getpid())); time.sleep(60)\"], start_new_session=True)\n"
    f"while not pathlib.Path('../child').exists(): time.sleep(0.02)\nwrite(); print(json.dumps({RESULT}))",
    "links its jobs": f"write(); os.symlink('/tmp', 'runs/ball/jobs'); print(json.dumps({RESULT}))",
    "tells no price": f"print(json.dumps({STEP}), flush=True); time.sleep(60)",
    "ends without a plan": f"print(json.dumps({RESULT}))",
    "is killed": "os.kill(os.getpid(), 9)",
    "exits 137": "print('out of memory', file=sys.stderr); sys.exit(137)",
    "prints rubbish": "print('\\x00\\xff{{[', 7)",
    "prints nothing": "pass",
    "has no account": "print(json.dumps({'type': 'result', 'is_error': True, 'result': 'Not logged in'})); sys.exit(1)",
    "cannot go on": "print(json.dumps({'type': 'result', 'is_error': True, 'result': 'the model is overloaded'}))",
    "hangs": "subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)']); print('{}', flush=True); time.sleep(60)",
    "costs too much": "print(json.dumps({'type': 'result', 'total_cost_usd': 99}), flush=True); time.sleep(60)",
}
STUB = """#!{python}
import json, os, pathlib, subprocess, sys, time
prompt = " ".join(sys.argv).partition("--auto ")[2]
def write():
    run = pathlib.Path("runs/ball")
    run.mkdir()
    (run / "prompt.md").write_text("a ball falls")
    (run / "plan.md").write_text(pathlib.Path({plan!r}).read_text())
with open({calls!r}, "a") as calls:
    calls.write(prompt.partition(" --output-format")[0] + "\\n")
for name, act in {acts!r}.items():
    if prompt.startswith(name):
        exec(act)
"""


@pytest.fixture
def asked(tmp_path, small_plan):
    """Begins a campaign over prompts, whose author does what its prompt says."""
    program, plan = tmp_path / "harness", tmp_path / "some-plan.md"
    plan.write_text(small_plan, encoding="utf-8")
    calls = str(tmp_path / "calls")
    program.write_text(STUB.format(python=sys.executable, plan=str(plan), acts=ACTS, calls=calls))
    program.chmod(0o755)

    def ask(*prompts, author=None, **words) -> Store:
        file = tmp_path / "c.yaml"
        author = {"harness": "claude_code", "program": str(program), **(author or {})}
        said = {"prompts": prompts, "author": author, "hands": "processes", "report": False, "until": "place", **words}
        file.write_text(json.dumps(said))
        return setting_out.begun(setting_out.checked(file), file, tmp_path / "campaign", approved=False)

    return ask


@pytest.fixture
def here(monkeypatch):
    """Has so many worlds at once done in the test's own process."""

    def take(count) -> None:
        hands = stub_worlds.Here(count, one_world.perform)
        monkeypatch.setattr(conducting, "crew_of", lambda *_: hands)

    return take


def rows(store: Store) -> dict[str, Row]:
    """Every world done here; its row, by its prompt."""
    done = [one_world.perform(task(store, store.begun, n)) for n in range(store.begun.campaign.size)]
    return {store.begun.bases[row.number].source or row.prompt: row for row in done}


def test_an_author_is_paid_once_and_what_it_wrote_goes_through_the_gates(asked, tmp_path):
    store = asked("writes")
    row = rows(store)["writes"]
    assert row.outcome == "held", row.cause
    assert row.author == "claude_code" and row.usd == 0.5
    assert (row.tokens_read, row.tokens_written) == (150, 20) and row.prompt == "writes"
    assert row.author_seconds > 0 and row.minutes["author"] > 0
    assert json.loads((store.folder / row.transcript).read_text())["total_cost_usd"] == 0.5
    assert (store.folder / row.folder / "plan.md").is_file()
    assert flat(row)["usd"] == 0.5 and flat(row)["tokens_read"] == 150
    session = (store.folder / row.transcript).parent
    assert not (session / "project").exists(), "a copy of the contract for each world would fill the disk"
    store.forget(row)
    assert rows(store)["writes"].usd == 0.5
    assert (tmp_path / "calls").read_text() == "writes\n", "a session that came to its end is not paid again"


@pytest.mark.parametrize(
    ("act", "kind", "said"),
    [
        ("ends without a plan", "no_plan", "last words: done"),
        ("is killed", "harness_died", "was killed (signal 9), and said nothing"),
        ("exits 137", "harness_died", "was killed (signal 9): out of memory"),
        ("prints rubbish", "rubbish", "none of its events"),
        ("prints nothing", "rubbish", "printed nothing"),
        ("has no account", "not_logged_in", "Not logged in"),
        ("cannot go on", "harness_failed", "the model is overloaded"),
    ],
)
def test_each_way_to_fail_is_a_typed_row(asked, act, kind, said):
    row = rows(asked(act))[act]
    assert row.outcome == "failed" and row.cause.step == "author" and row.cause.kind == kind
    assert said in row.cause.said and row.cause.next_move and row.author == "claude_code"


@pytest.mark.parametrize(
    ("act", "limit", "kind", "usd"),
    [("hangs", {"seconds": 2}, "over_time", None), ("costs too much", {"usd": 1}, "over_usd", 99)],
)
def test_what_hangs_or_costs_too_much_is_ended_with_all_that_it_started(asked, act, limit, kind, usd):
    store = asked(act, per_world=limit)
    row = rows(store)[act]
    assert row.outcome == "gave_up" and row.cause.kind == kind and row.usd == usd
    assert_nothing_is_left(store)


def assert_nothing_is_left(store: Store) -> None:
    (session,) = (store.folder / "authors").glob("*/*/1")
    pid = (session / "process").read_text().split()[0]
    for _ in range(600):  # who was killed is gone when the kernel next comes to it
        group = subprocess.run(["pgrep", "-g", pid], capture_output=True, text=True).stdout.split()
        if not any(author_watch.since(int(each)) for each in group):
            return
        time.sleep(0.05)
    pytest.fail("an orphan of the author would go on being paid")


def test_what_left_the_session_of_a_harness_ends_with_it_too(asked):
    store = asked("leaves a child")
    assert rows(store)["leaves a child"].outcome == "held"
    (child,) = (store.folder / "authors").glob("*/*/1/child")
    assert not author_watch.since(int(child.read_text())), "it would go on being paid"


def test_a_harness_that_cannot_be_ended_afterwards_does_not_go_on(tmp_path):
    (tmp_path / author_watch.PROCESS).mkdir()  # what it runs as cannot be noted there
    alone = [
        sys.executable,
        "-c",
        f"import os, pathlib, time; pathlib.Path({str(tmp_path / 'pid')!r}).write_text(str(os.getpid())); time.sleep(60)",
    ]
    words = [sys.executable, "-P", "-m", author_watch.__name__, str(tmp_path), *alone]
    told = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=30)
    assert told.returncode == 127 and "cannot be noted" in told.stderr
    assert not (tmp_path / "pid").exists() or not author_watch.since(int((tmp_path / "pid").read_text()))


def test_a_linked_folder_of_jobs_fails_no_session_that_came_to_its_end(asked):
    row = rows(asked("links its jobs", until="check"))["links its jobs"]
    assert row.cause is None or row.cause.step != "author", row.cause


def test_passes_end_also_where_their_harness_is_gone(tmp_path, monkeypatch):
    ended = []
    monkeypatch.setattr(author_watch, "end_passes", ended.append)
    (tmp_path / "project/runs/ball").mkdir(parents=True)
    (tmp_path / author_watch.PROCESS).write_text("1 7")  # of this number another process lives
    assert not author_watch.stop(tmp_path)
    assert [run.folder.name for run in ended] == ["ball"]


def test_a_world_without_a_price_is_paid_once(asked, tmp_path):
    store = asked("ends without a price", budget={"usd": 5})
    row = rows(store)["ends without a price"]
    assert row.cause.kind == "no_prices"
    store.forget(row)
    assert rows(store)["ends without a price"].cause.kind == "no_prices"
    store.forget(row)
    priced = asked("ends without a price", author={"prices": {"read": 100, "written": 1000}}, budget={"usd": 5})
    row = rows(priced)["ends without a price"]
    assert row.outcome == "held" and row.usd == pytest.approx(0.035)
    assert (tmp_path / "calls").read_text().count("\n") == 1


def test_an_author_ends_with_its_worker_whoever_kills_that(asked):
    store = asked("hangs")
    worker = mp.get_context("spawn").Process(target=one_world.perform, args=(task(store, store.begun, 0),))
    worker.start()
    for _ in range(1200):
        if any((store.folder / "authors").glob("*/*/1/process")):
            break
        time.sleep(0.05)
    worker.kill()
    worker.join()
    assert_nothing_is_left(store)


def test_a_limit_of_money_that_could_never_end_an_author_ends_it_at_once(asked):
    store = asked("tells no price", author={"harness": "opencode"}, budget={"usd": 5})
    row = rows(store)["tells no price"]
    assert row.outcome == "failed" and row.cause.kind == "no_prices" and row.tokens_read == 900
    assert "tells 0 US dollars for 1,000 tokens" in row.cause.said and "author.prices" in row.cause.next_move


def test_a_program_is_named_relative_to_the_campaigns_file(asked, monkeypatch):
    monkeypatch.chdir("/")
    store = asked("writes", author={"program": "./harness"})
    assert rows(store)["writes"].outcome == "held"
    assert parse("prompts: [a]\nauthor: {harness: opencode, program: mine}").author.program == "mine"


def test_what_was_paid_before_a_worker_died_counts_at_once(asked, monkeypatch):
    class Dying(stub_worlds.Here):
        def ended(self, timeout_s):
            one = self.under.popleft()
            session = Store(one.folder).author(one.world) / "1"
            session.mkdir(parents=True)
            (session / "transcript.jsonl").write_text(json.dumps({"type": "result", "total_cost_usd": 3}))
            yield Ended(task=one, died="it was killed")

    monkeypatch.setattr(conducting, "crew_of", lambda *_: Dying(1))
    end = conducting.conduct(asked("writes", "writes more", budget={"usd": 2}))
    assert end.stopped == "the budget of 2 US dollars is used up" and end.usd == 3 and end.done == 0


def test_what_is_known_to_cost_too_much_only_at_its_end_is_over_its_limit_too(asked):
    author = {"harness": "codex", "trust": True, "prices": {"read": 1, "written": 1}}
    row = rows(asked("ends as codex", author=author, per_world={"usd": 1.5}))["ends as codex"]
    assert row.outcome == "gave_up" and row.cause.kind == "over_usd" and row.usd == 2


def test_bad_prompts_and_a_missing_harness_are_rows_and_the_others_go_on(asked, here, tmp_path):
    (tmp_path / "long.txt").write_text("x" * (1 << 20))
    odd = [" ", {"file": "long.txt"}, {"file": "none.txt"}, "writes\0", "x" * (LONGEST_PROMPT + 1), "writes"]
    store = asked(*odd)
    here(1)
    end = conducting.conduct(store)
    kinds = {row.number: row.cause.kind if row.cause else row.outcome for row in store.rows()}
    assert kinds == {
        0: "empty_prompt",
        1: "long_prompt",
        2: "not_found",
        3: "harness_missing",
        4: "long_prompt",
        5: "held",
    }
    assert end.done == 6 and end.usd == 0.5 and end.tokens == 170 and "0.50 US dollars" in end.text()


def test_a_harness_that_is_not_here_is_said_with_its_package(asked):
    row = rows(asked("writes", author={"program": "no-such-harness"}))["writes"]
    assert row.cause.kind == "harness_missing" and "no-such-harness" in row.cause.said
    assert "@anthropic-ai/claude-code" in row.cause.next_move


def test_money_is_kept_for_what_is_under_way(asked, here):
    here(2)
    end = conducting.conduct(asked(*["writes"] * 3, per_world={"usd": 0.6}, budget={"usd": 1}))
    assert end.done == 2 and end.usd == 1, "when the first ended, the second could still cost what was left"
    assert end.stopped == "the budget of 1 US dollars is used up"


def test_what_a_dead_worker_left_behind_is_ended_and_its_cost_stays_in_the_row(asked):
    store = asked("writes")
    one = task(store, store.begun, 0)
    session = store.author(one.world) / "1"
    session.mkdir(parents=True)
    (session / "transcript.jsonl").write_text(json.dumps({"type": "result", "total_cost_usd": 2}))
    orphan = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"], start_new_session=True)
    (session / "process").write_text(f"{orphan.pid} {author_watch.since(orphan.pid)}")
    (store.world(one.world)).mkdir(parents=True)
    (store.world(one.world) / "half").write_text("half a world")
    row = rows(store)["writes"]
    assert orphan.wait(10) < 0 and row.outcome == "held" and row.usd == 2.5
    assert (store.author(one.world) / "2/before/half").read_text() == "half a world"


def test_what_was_paid_stays_in_the_budget_when_its_rows_are_taken_back(asked, here):
    here(1)
    store = asked("writes", "cannot go on", "writes more", budget={"usd": 1}, until="check")
    assert conducting.conduct(store).usd == 1
    conducting.forget(store, "held")
    assert conducting.standing(store).usd == 1, "the dollars were paid"
    assert conducting.conduct(store).stopped == "the budget of 1 US dollars is used up"
    raised = store.begun
    campaign = raised.campaign.model_copy(update={"budget": Budget(usd=9)})
    store.change(raised, raised.model_copy(update={"campaign": campaign}))
    end = conducting.conduct(store)
    assert end.done == 3 and end.usd == conducting.counted(store).usd == 1, "and once"


def test_cancel_ends_an_author_whose_worker_was_killed(asked):
    store = asked("writes")
    session = store.author(task(store, store.begun, 0).world) / "1"
    session.mkdir(parents=True)
    orphan = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"], start_new_session=True)
    (session / "process").write_text(f"{orphan.pid} {author_watch.since(orphan.pid)}")
    try:
        assert "1 of its authors" in setting_out.cancelled(store)
        assert orphan.wait(10) < 0
    finally:
        orphan.kill()
        orphan.wait()
    assert setting_out.cancelled(store) == "it is not at work"


def test_another_process_of_the_same_number_is_left_alone(asked):
    store = asked("writes")
    one = task(store, store.begun, 0)
    session = store.author(one.world) / "1"
    session.mkdir(parents=True)
    other = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"], start_new_session=True)
    try:
        (session / "process").write_text(f"{other.pid} 1")
        world_author.stop(store, one.world)
        assert author_watch.since(other.pid), "it lives"
    finally:
        other.kill()
        other.wait()


def test_an_authors_folder_names_what_judges_it(tmp_path):
    from worldwright.contract import authors_judge
    from worldwright.contract.command import project

    place = tmp_path / "many/authors/ab/world/1/project"
    author_folder.make(place, "opencode", tmp_path / "many")
    kept = {project() / "servers", project() / "runs", project() / "examples", tmp_path / "many"}
    assert kept | {Path(sys.prefix).resolve()} <= authors_judge.outside(place)


@pytest.mark.parametrize(
    ("said", "why"),
    [
        ("prompts: [a]", "belong together"),
        ("plan: a\nauthor: {harness: claude_code}", "belong together"),
        ("prompts: [a]\nauthor: {harness: nobody}", "known: claude_code, codex, opencode"),
        ("prompts: [a]\nauthor: {harness: codex}", "`trust: true` is your word"),
        ("prompts: [{prompt: a, file: b}]\nauthor: {harness: opencode}", "say one of"),
        ("plan: a\nbudget: {usd: 3}", "without `author`"),
        (
            "prompts: [a]\nauthor: {harness: codex, trust: true}\nbudget: {usd: 3}",
            "would do nothing: Codex tells no money",
        ),
        (
            "prompts: [a]\nauthor: {harness: codex, trust: true}\nper_world: {usd: 3}",
            "would do nothing: Codex tells no money",
        ),
        ("plan: a\nper_world: {runs: 3}", "without `author`"),
    ],
)
def test_words_that_do_not_fit_together_are_refused(said, why):
    with pytest.raises(CampaignError, match=why):
        parse(said)


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("author: {harness: codex, trust: true, modell: x}", "program, model"),
        ("author: {harness: codex, trust: true, prices: {reed: 1}}", "read, cached, written"),
        ("author: {harness: claude_code}\nprompts: [{promt: a}]", "prompt, file, category"),
    ],
)
def test_an_unknown_word_of_an_author_is_answered_with_the_known_ones(text, known):
    with pytest.raises(CampaignError) as refused:
        parse(text)
    assert known in refused.value.next_move


def test_tokens_are_priced_where_the_harness_tells_no_money(tmp_path):
    path = tmp_path / "t"
    usage = {"input_tokens": 1_000_000, "cached_input_tokens": 400_000, "output_tokens": 100_000}
    path.write_text(json.dumps({"type": "turn.completed", "usage": usage}))
    author = Author(harness="codex", trust=True)
    assert Talk(path, author).read(whole=True).cost().usd is None
    priced = author.model_copy(update={"prices": Prices(read=1, cached=0.5, written=10)})
    assert Talk(path, priced).read(whole=True).cost().usd == pytest.approx(0.6 + 0.2 + 1)


@pytest.mark.parametrize("name", sorted(harnesses.known()))
@pytest.mark.parametrize("value", [None, True, "x", [], -1, 1e400, {"usage": [], "tokens": 3, "content": [1]}])
def test_no_event_whatever_it_holds_ends_in_anything_but_what_was_heard(name, value):
    harness = harnesses.find(name)
    for kind in (
        "assistant",
        "result",
        "turn.completed",
        "turn.failed",
        "error",
        "step_finish",
        "text",
        "item.completed",
    ):
        keys = ("message", "usage", "modelUsage", "total_cost_usd", "result", "subtype", "part", "item", "error")
        heard = harness.heard({"type": kind} | dict.fromkeys(keys, value))
        assert heard.read >= 0 and isinstance(heard.said, str)
