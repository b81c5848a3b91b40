"""One `/generate`, told as what each agent does: a lint failure and its repair, a review that refuses once, a patch, a stamp."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from script import Call, Lazy, Say, Turn

RUN = "runs/ball"
TRIES = (
    "echo x > runs/ball/evidence/k/scan.json",
    "p=run; echo x > ${p}s/ball/evidence/k/new.json",
    "python3 -c \"open('r'+'uns/ball/journal.jsonl','a').write('x')\"",
    "rm -r ru*/ball/accepted/stamp.json",
    "mkdir -p runs/new/accepted",
    "echo raise >> servers/worldwright/contract/guard.py",
    "echo x > examples/x 2>/dev/null; echo x > notes.md; cat runs/ball/journal.jsonl",
)
"""Commands by which an agent would write evidence, acceptance, the journal or the suite; the last one only works elsewhere."""


def evidence(project: Path) -> dict[str, bytes]:
    """All that no shell may change, after it was made where it is missing."""
    for name in ("evidence/k/scan.json", "accepted/stamp.json", "journal.jsonl"):
        path = project / RUN / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            path.write_text("chained\n", encoding="utf-8")
    paths = [*(project / "runs").rglob("*"), *(project / "servers/worldwright/contract").rglob("*.py")]
    return {str(path): path.read_bytes() for path in paths if path.is_file()}


def story(
    project: Path,
    plan: str,
    write: Callable[[str, str], Call],
    tool: Callable[..., Call],
    spawn: Callable[[str], list[Turn | Lazy]],
) -> dict[str, list[Turn | Lazy]]:
    """The script; the callables say how a harness writes a file, calls a tool, and spawns an agent and waits for it."""

    def program(change: Callable[[str], str]) -> Lazy:
        def turn() -> Turn:
            text = (project / RUN / "simulation.py").read_text(encoding="utf-8")
            return [write(f"{RUN}/simulation.py", change(text))]

        return turn

    def stage(name: str) -> list[Turn | Lazy]:
        # A call returns within 45 s, and a drafted film with the plan's cameras takes longer on a busy machine.
        return [[tool("stage", "start", run=RUN, stage=name)], *[[tool("stage", "wait", run=RUN, timeout_s=40)]] * 4]

    lint = [tool("lint", "check_program", files=[f"{RUN}/simulation.py"], plan=f"{RUN}/plan.md")]
    describe = [
        [tool("stage", "frames", run=RUN)],
        [
            tool(
                "stamp", "describe", run=RUN,
                description={"author": "world-visual", "summary": "a red ball above a pale floor", "cameras": {"overview": "a ball", "side": "a ball", "film": "a ball"}, "objects": {"ball": "red"},
                             "named": [{"seen": "a red ball", "camera": "overview"}], "event": "it falls", "belief": 8,
                             "betrays": ["an empty floor", "a flat sky", "no dust"]},
            )
        ],
        [Say("described")],
    ]  # fmt: skip

    def verdict(outcome: str, met: bool, **more: Any) -> Call:
        return tool(
            "stamp", "review", run=RUN,
            verdict={
                "reviewer": "world-review", "outcome": outcome, "numeric": "clean, and it falls", "visual": "a red ball",
                "plan": "two objectives, both bound",
                "objectives": [
                    {"index": 0, "met": True, "evidence": ["expect:falls"]},
                    {"index": 1, "met": met, "evidence": ["visual:overview"]},
                ],
                "recognised": [
                    {"wanted": "ball", "seen_as": "a red ball", "same": True},
                    {"wanted": "event", "seen_as": "it falls", "same": True},
                ],
                "cross_checks": [{"claim": "it moves", "channel": "visual", "tested_in": "numeric", "confirmed": True}],
                **more,
            },
        )  # fmt: skip

    look = [[tool("scan", "scan", run=RUN)], [tool("scan", "expect", run=RUN)]]
    film = [*stage("stills"), *stage("video")]
    return {
        "main": [
            *spawn("plan"),
            [tool("stamp", "approve", run=RUN, by="the person")],
            *spawn("code"),
            *film,
            *spawn("visual"),
            *spawn("review"),
            *spawn("code"),
            *film,
            *spawn("visual"),
            *spawn("review"),
            [tool("stamp", "accept", run=RUN, timeout_s=40)],
            [tool("stamp", "status", run=RUN)],
            [Say("accepted")],
        ],
        "plan": [
            [write(f"{RUN}/prompt.md", "a ball is dropped\n")],
            [write(f"{RUN}/plan.md", plan)],
            [tool("place", "resolve", plan=f"{RUN}/plan.md")],
            [tool("lint", "check_plan", plan=f"{RUN}/plan.md")],
            [Say("planned")],
        ],
        "code": [
            [tool("stage", "draft", run=RUN)],
            program(lambda text: text.replace("def build(", "mujoco.mj_rayTrace\n\n\ndef build(", 1)),
            lint,
            [tool("retrieve", "symbol", name="mujoco.mj_rayTrace", run=RUN)],
            program(lambda text: text.replace("mujoco.mj_rayTrace\n\n\n", "", 1)),
            lint,
            *stage("physics"),
            [Say("the physics pass succeeded")],
            program(lambda text: text.replace("#b3261e", "#8c1d18")),
            lint,
            *stage("physics"),
            [Say("patched")],
        ],
        "visual": [*describe, *describe],
        "review": [
            *look,
            [verdict("repair", False, repair_target="visual_mismatch", repair="make the ball a deeper red")],
            [Say("one repair")],
            *look,
            [verdict("pass", True)],
            [Say("pass")],
        ],
    }
