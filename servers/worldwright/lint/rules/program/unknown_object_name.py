"""An object is looked up by a name that the model does not have.

What it does: compares the literal names in `model.body("x")`, `data.geom("x")`, `mj_name2id(…, "x")` with every name in
the program, when the whole model stands in it.

Why is this bad: the accessors raise a KeyError; `mj_name2id` returns -1, which as an index silently means the last
object.

Use instead: the name as it is declared.
"""

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from ...harm import Raises
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL151"
ABOUT = "signatures"
SEVERITY = "error"
SCOPE = "any"
HEAD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body name="ball"><freejoint name="j"/>'
    '<geom size=".1"/></body></worldbody></mujoco>\')\ndata = mujoco.MjData(model)\n'
)
GOOD = (
    HEAD + "data.body('ball').xpos\n",
    "import mujoco\nmodel = mujoco.MjModel.from_xml_path('scene.xml') if False else None\nmodel and model.body('x')\n",
)
BAD = (
    HEAD + "data.body('bal').xpos\n",
    HEAD + "model.joint('ball')\n".replace("'ball'", "'hinge'"),
    HEAD + "body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, 'bell')\n",
)
EVIDENCE = Raises("Invalid name", without=(2,))
ACCESSORS = (
    "body",
    "geom",
    "joint",
    "jnt",
    "site",
    "camera",
    "cam",
    "light",
    "tendon",
    "actuator",
    "sensor",
    "equality",
    "key",
    "keyframe",
    "mesh",
    "material",
    "texture",
)


def check(program: Program) -> Iterator[Problem]:
    """Check look-ups with a literal, against tags' names and all other literals."""
    made = any(full in ("mujoco.MjModel.from_xml_string", "mujoco.MjSpec") for full in program.calls_by_name)
    if not made or not program.whole_model:
        return
    asked: dict[ast.expr, object] = {}
    for call in program.method_calls(*ACCESSORS):
        owner = program.type_of(call.func.value)  # type: ignore[attr-defined]
        if owner in ("MjModel", "MjData") and call.args and isinstance(call.args[0], ast.Constant):
            asked[call.args[0]] = call.args[0].value
    for _, call in program.calls("mujoco.mj_name2id"):
        node = program.argument(call, "name", 2)
        if isinstance(node, ast.Constant):
            asked[node] = node.value
    known = {tag.attributes["name"] for tag in program.tags() if "name" in tag.attributes} | {"world"}
    others = {n.value for n in program.nodes(ast.Constant) if n not in asked and isinstance(n.value, str)}
    if any(
        isinstance(k.value, ast.JoinedStr | ast.BinOp | ast.Call | ast.Name)
        for k in program.nodes(ast.keyword)
        if k.arg == "name"
    ):
        return
    for place, name in asked.items():
        if isinstance(name, str) and name not in known | others:
            near = get_close_matches(name, sorted(known), n=3, cutoff=0.5)
            fix = "nearest: " + ", ".join(f"`{n}`" for n in near) if near else "known: " + ", ".join(sorted(known)[:20])
            yield at(place, f"the model has nothing called `{name}`", fix)
