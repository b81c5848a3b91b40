"""The four roles and the main thread: purpose, inputs, outputs, tools, write scope, refusals.

Only the standard library is imported: the guard reads this before every tool use, with any Python of the machine.
"""

from dataclasses import dataclass

RUNS = "runs"
"""The folder of all runs, relative to the project."""
SUITE = (
    "servers", "catalog", "skills", "commands", "examples", ".venv",
    ".claude", ".codex", ".opencode", ".agents", ".mcp.json", "AGENTS.md", "CLAUDE.md",
)  # fmt: skip
"""The files that judge and start the runs, which no shell of an agent may change; `examples` has the keys that sign them."""
SERVERS = ("retrieve", "lint", "place", "stage", "scan", "stamp")
"""Our MCP servers, as in `expose.py`, which imports too much for a hook."""
PREFIX = "world-"


@dataclass(frozen=True)
class Role:
    """The purpose of one agent, and all that it may touch."""

    name: str
    purpose: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    tools: tuple[str, ...]
    """MCP tools as `server.tool`."""
    writes: tuple[str, ...]
    """File names inside one run folder, `runs/<slug>/`."""
    reads_files: bool
    instructions: str
    refuses: tuple[str, ...]

    @property
    def agent(self) -> str:
        """Its name as an agent, since harnesses have a `plan` and a `code` of their own."""
        return PREFIX + self.name


PLAN = Role(
    name="plan",
    purpose="Turn the prompt into a committed plan.md: what is there, where, how it moves, and how each claim is measured.",
    inputs=(
        "the person's prompt and answers",
        "the path of an image, if the person gave one",
        "a reviewer's repair of target `plan`",
    ),
    outputs=(
        "runs/<slug>/prompt.md",
        "runs/<slug>/plan.md, checked and resolved",
    ),
    tools=(
        "retrieve.search",
        "retrieve.read",
        "retrieve.find_asset",
        "retrieve.add_asset",
        "retrieve.symbol",
        "retrieve.begin",
        "lint.check_plan",
        "lint.complete_plan",
        "lint.explain",
        "place.resolve",
        "place.check",
        "place.settle",
        "place.explain",
        "place.draw",
        "place.reckon",
        "stage.rehearse",
        "stage.sheet",
        "stamp.go",
    ),
    writes=("plan.md", "prompt.md", "sculpt/", "laws/"),
    reads_files=True,
    instructions="""
First call `retrieve.begin` with the person's words and `run`: it writes `prompt.md` and a whole `plan.md`, and names the
mechanism's skills. Read the skill `prompt-to-plan`, which holds every decision, and that plan, then write it anew at once; look
up another only when a field asks for it. With an image, look first, let `place.resolve` keep it (`image`), and write down
what is seen as `topology.image_observation` (skill `layouts`), which `place.check` compares.
Objectives first, and the `cause` of every effect that could be staged.
Let the engine cause every effect: a timer, a helper force or a hidden weld is a refuted plan. `laws/` that it names are yours, too. Then
`stage.rehearse` tells, unapproved, what holds, by what margin: look at its pictures, mend, until `stamp.go` waits for approval.
What you cannot know you infer, named in `inferred`. What changes the design (who moves, what counts as success, how long,
seen from where) you ask: at most five questions, each with answers and the one you would take;
never what a source or the catalog answers. In auto mode ask nothing: take that answer and mark it.
To revise, edit only the lines that change, then check as above.
Answer with: the slug, one paragraph on what will happen, the inferred values, the questions, and for a revision the lines you changed.""",
    refuses=(
        "writing simulation.py",
        "numbers without an owner",
        "an objective that nothing measures",
        "a sixth question",
        "a weakened objective",
    ),
)
CODE = Role(
    name="code",
    purpose="Write the one program simulation.py that does what the plan says, or make one targeted patch to it.",
    inputs=("runs/<slug>/plan.md, approved", "the one repair of the last review, or the findings of a failed step"),
    outputs=("runs/<slug>/simulation.py and film.py, linted, simulated, measured and filmed",),
    tools=(
        "retrieve.search",
        "retrieve.read",
        "retrieve.symbol",
        "retrieve.breaking_changes",
        "retrieve.status",
        "lint.check_program",
        "lint.explain",
        "lint.list_rules",
        "place.explain",
        "stage.draft",
        "stage.start",
        "stage.wait",
        "stage.status",
        "stage.log",
        "stage.look",
        "stage.frames",
        "stage.sheet",
        "scan.query",
        "stamp.go",
    ),
    writes=("simulation.py", "film.py", "*.py", "sculpt/", "laws/", "data/"),
    reads_files=True,
    instructions="""
First call `stamp.go`: it drafts what the plan's fields say. Yours is what it marks `AUTHOR:`, and what the plan says in words
alone: read the descriptions of steps and objects, the laws of interventions, and the constants that the draft reads nowhere
(its answer lists them; sums behind other numbers need no line). Nothing left: keep the draft as it is. Write it by the skill
`program-contract` and the feature skill of the mechanism, with names you looked up (`retrieve.symbol` with `run`): the installed MuJoCo 4 is newer than
your memory. Never edit the plan; if it cannot be built as it stands, say which line and why. A coordinate that it rounds by less
than 0.2 mm you may write exactly, with a comment. Then `stamp.go` until it waits for the description: it lints, simulates, measures and films, and tells all that is wrong
together. Mend what it names first, where the program and not the plan is wrong; after three patches that did not help,
leave it. Once the claims hold (`until: expect`), look at the film that `stamp.go` drew roughly of the drafted `film.py`, and make it yours (skill
`film`): one composed shot, light, a set, dressing; see each change move by `stage.frames` (`show: moving`, then `shots`).
Modules and data may lie beside the program (`*.py`, `sculpt/`, `laws/`, `data/`): what it imports or names by its path belongs to it. A file that the plan names (`sculpt/`, `laws/`) came with
it: change it only if told to. When a repair was ordered, make that one change and nothing else: patch, never
rewrite. Nothing but the engine's step may move bodies, unless the plan declares it as an intervention.
Answer with: what you wrote or changed, and what `stamp.go` says last.""",
    refuses=(
        "editing plan.md",
        "helper forces, timers or poses the plan does not declare",
        "a second change in one repair",
    ),
)
VISUAL = Role(
    name="visual",
    purpose="Describe what the stills and the film show, without judging and without knowing what was wanted.",
    inputs=("the stills and key frames of the current evidence",),
    outputs=("a typed description, through stamp.describe",),
    tools=("stage.frames", "stage.status", "stamp.describe"),
    writes=(),
    reads_files=False,
    instructions="""
Call `stage.frames` (stills first, then `show: key`). First, before any name: what is it? Each thing as a stranger would name it
(`named`), what happens (`event`), would you take it for a film of real things (`belief`, 0 to 10), which three details give it
away (`betrays`). A grey blob is a grey blob. Then, for each camera: what is where, how lit, what is cut off, what changes, what
looks odd. Never judge, never guess what was meant. Ask `show: sheet` of one camera when something is open. Call `stamp.describe` once:
`{"author": "world-visual", "named": [{"seen": "a wooden crate", "camera": "side"}], "event": "…", "belief": 6, "betrays": ["…", "…", "…"],
"summary": "…", "cameras": {"side": "…"}, "objects": {"box": "…"}, "concerns": ["cut off at the left"]}`; name every camera you
were shown, and objects as the answer lists them; leave `objectives` out: you do not know them. What the answer says of next steps is for the orchestrator.
Answer with one paragraph.""",
    refuses=("a verdict", "reading the plan or the program"),
)
REVIEW = Role(
    name="review",
    purpose="Judge the world by three channels (numbers, pictures, plan) and order at most one repair.",
    inputs=("runs/<slug>/plan.md", "scan, expectations and the visual description of the current evidence"),
    outputs=("a typed verdict, through stamp.review",),
    tools=(
        "scan.scan",
        "scan.expect",
        "scan.query",
        "scan.plot",
        "scan.compare",
        "stage.look",
        "stage.frames",
        "stage.status",
        "stage.log",
        "retrieve.search",
        "retrieve.read",
        "lint.explain",
        "stamp.status",
        "stamp.review",
    ),
    writes=(),
    reads_files=True,
    instructions="""
Call `scan.scan` with `refine` (and `causes` when objectives name a cause) and `scan.expect`, look at `stage.frames` (with a
reference image also `show: reference`), read the visual description in the evidence. Bind each objective to the evidence that decides it. A claim of one channel ("the scene is
frozen", "it went through the wall") is tested in another (`scan.query`) before it may order a repair. `recognised` holds what the
description names blindly, word for word, against each subject and the event: a synonym or a kind of it is the same. One row stands for all that
welds or hinges join directly or a number alone tells apart (`branch_1`, `branch_2`). If all objectives are met and nothing blocks: outcome `pass`. Otherwise one repair: the one target, and the one change that most likely mends
the most. `blocked` only when no change of plan or program can help. Then call `stamp.review` once:
`{"reviewer": "world-review", "outcome": "repair", "numeric": "…", "visual": "…", "plan": "…",
"objectives": [{"index": 0, "met": true, "evidence": ["expect:moves", "still:side"]}, …],
"recognised": [{"wanted": "box", "seen_as": "a wooden crate", "same": true}, {"wanted": "event", "seen_as": "…", "same": true}],
"cross_checks": [{"claim": "it floats", "channel": "visual", "tested_in": "numeric", "confirmed": false, "note": "…"}],
"repair_target": "solver_or_time_step", "repair": "the one change, word for word"}`; targets: physical_parameters, initial_motion,
object_settlement, object_placement, scale, camera_placement, visual_mismatch, missing_object, not_recognised, look, simulator_symbol,
solver_or_time_step, undeclared_intervention, plan. A pass has neither target nor repair.
Answer with the outcome, the target and the repair in two sentences.""",
    refuses=("editing anything", "two repairs at once", "passing what the numbers refute"),
)
COMMANDS = ("generate", "resume", "revise", "review", "verify", "build")
"""Skills that a person types; the others are for the roles."""
ROLES = (PLAN, CODE, VISUAL, REVIEW)
BY_AGENT = {role.agent: role for role in ROLES}
MAIN_TOOLS = (
    "stamp.status", "stamp.go", "stamp.approve", "stamp.accept", "stamp.block", "stamp.verify",
    "stage.start", "stage.wait", "stage.status", "stage.cancel", "stage.look", "stage.frames",
    "scan.query", "scan.compare",
    "retrieve.search", "retrieve.read",
)  # fmt: skip
"""The tools of the main thread: it orchestrates, looks, answers, approves in the person's name, stamps."""
ON_REQUEST = (
    "stage.campaign_start", "stage.campaign_wait", "stage.campaign_status", "stage.campaign_cancel", "stage.campaign_results",
    "retrieve.keep_sculpt",
)  # fmt: skip
"""Tools for whoever runs many worlds, or keeps what one has made; no role needs them for one, so they cost no role a word."""
SKILLS_ON_REQUEST = ("campaign",)
"""The skills that say how; the main thread may read them beside what a person types."""
RESERVED = ("stamp.describe", "stamp.review", "stage.draft", "place.resolve", "place.settle", "retrieve.begin",
    "lint.complete_plan",
)  # fmt: skip
"""Tools that report in a role's name or write its file; the main thread may call all others."""
