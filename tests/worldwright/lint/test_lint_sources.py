"""Broken, hostile and huge input: a finding in bounded time, and nothing is ever executed."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.lint import engine, source, tools
from worldwright.model.errors import NotFoundError

HOSTILE = {
    "empty": b"",
    "blank": b"\n \n\t\n",
    "binary": b"\x7fELF\x00\x01",
    "latin1": "x = 'é'".encode("latin-1"),
    "syntax": b"def f(:\n",
    "parens": b"(" * 100_000,
    "brackets": b"[" * 300 + b"]" * 300,
    "sum": b"x = 1" + b"+1" * 100_000,
    "minus": b"x = " + b"-" * 100_000 + b"1",
    "attributes": b"a" + b".a" * 100_000,
    "calls": b"a" + b"()" * 100_000,
    "elif": b"if a: pass\n" + b"elif a: pass\n" * 20_000,
    "large": b"x = 1\n" * 900_000,
    "quote": b"'" * 100_001,
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_give_one_finding(tmp_path, name):
    path = tmp_path / "simulation.py"
    path.write_bytes(HOSTILE[name])
    report = tools.check_program([path])
    assert not report.ok
    assert [f.code for f in report.findings] == ["WL100"]
    assert report.text()


@pytest.mark.parametrize(
    "text",
    [
        "while True:\n    pass\n",
        "raise SystemExit(3)\n",
        "import os\nos._exit(1)\n",
        "from worldkit import program\nx = 9 ** 9 ** 9 ** 9\ny = 'a' * 10 ** 12\nprogram.main(None, duration=x)\n",
        "x = x\ny = z\nz = y\nimport mujoco\nmujoco.MjModel.from_xml_string(x).opt\n",
        "a = a.b\na.c.d\n",
    ],
)
def test_programs_are_read_never_run(tmp_path, text):
    path = tmp_path / "simulation.py"
    path.write_text(text)
    tools.check_program([path], model=False)


@pytest.mark.parametrize(
    ("name", "data"),
    [
        ("empty", b""),
        ("binary", b"\x7fELF\x00\x01"),
        ("latin1", "<mujoco model='é'/>".encode("latin-1")),
        ("open", b"<mujoco><worldbody>"),
        ("large", b"<mujoco>" + b"<!-- x -->" * 600_000 + b"</mujoco>"),
        ("deep", b"<mujoco>" + b"<worldbody>" * 50_000),
        ("long", b"<mujoco model='" + b"x" * 400_000 + b"'><"),
        ("laughs", b"<!DOCTYPE m [<!ENTITY a 'aaaa'>]><mujoco model='&a;'/>"),
    ],
)
def test_hostile_models_give_one_finding_quickly(tmp_path, name, data):
    import time

    path = tmp_path / "model.xml"
    path.write_bytes(data)
    began = time.monotonic()
    report = tools.check_program([path])
    assert time.monotonic() - began < 60
    assert not report.ok and "WL100" in {f.code for f in report.findings}
    assert report.text() and report.sarif() and report.github()


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_plans_give_findings_or_typed_errors(tmp_path, name):
    from worldwright.model.errors import WorldwrightError

    path = tmp_path / "plan.md"
    path.write_bytes(HOSTILE[name])
    try:
        assert not tools.check_plan(path).ok
    except WorldwrightError as error:
        assert error.cause


def test_deep_xml_and_entities_are_refused():
    deep = "<mujoco>" + "<worldbody>" * 5000 + "</worldbody>" * 5000 + "</mujoco>"
    laughs = "<!DOCTYPE m [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;&a;'>]><mujoco model='&b;'/>"
    for text in (deep, laughs):
        found = engine.check_source(source.parse(text, "model.xml"))
        assert [f.code for f in found] == ["WL100"]


def test_a_missing_file_is_a_typed_error(tmp_path):
    with pytest.raises(NotFoundError):
        tools.check_program([tmp_path / "nothing.py"])
    with pytest.raises(NotFoundError):
        tools.check_program([tmp_path])
    with pytest.raises(NotFoundError):
        tools.check_plan(tmp_path / "plan.md")


SNIPPETS = st.lists(
    st.sampled_from(
        [
            "import mujoco as mj",
            "from worldkit import *",
            "data.qpos[0] = 1",
            "x, *y = f(**k)",
            "def control(model, data): data.ctrl[:] = model.opt.gravity",
            "spec = mj.MjSpec(); spec.worldbody.add_geom(**{'size': 1})",
            "XML = '<mujoco><worldbody><geom size=\"x\"/></worldbody></mujoco>'",
            "XML = f'<mujoco><worldbody>{x}</worldbody></mujoco>'",
            "class A:\n    def build(self): return self",
            "for i, (a, b) in enumerate(c): print(f'{a}_{b!r:>{i}}')",
            "program.main(build, control, duration=D, size=(1, 2))",
            "lambda q, /, *, w=1: (yield)",
            "[z := 3, z ** -2.5, 1 / 0, 'a' * 9, {1: 2}[1]]",
            "match x:\n    case {'a': [1, *r]}: pass",
            "async def f():\n    async with a as b: await b",
            "global G; G += 1",
            "quat = (0, 0, 0, 1); b.quat = quat; b.add_body(quat=quat)",
        ]
    ),
    max_size=8,
)


@settings(max_examples=120, deadline=None)
@given(SNIPPETS)
def test_no_program_makes_a_rule_fail(lines):
    from worldwright.lint.case import plan_with

    for plan in (None, plan_with({})):
        engine.check_source(source.parse("\n".join(lines) + "\n"), plan, contract=True)


@settings(max_examples=150, deadline=None)
@given(st.binary(max_size=200))
def test_any_bytes_are_answered(data):
    read = source.decode(data)
    assert (read.tree is None) == (read.problem is not None)
    engine.check_source(read)


def test_the_corpus_of_the_installed_package_gives_only_known_findings():
    """The simulator's own Python: what is found there is either a test of errors or a deliberate half turn."""
    from worldwright.simulator import installed

    found = []
    for path in sorted(installed.package_folder().rglob("*.py")):
        read = source.read(path)
        if read.tree is not None:
            found += [f for f in engine.check_source(read) if f.severity != "info"]
    assert [(Path(f.file).name, f.code) for f in found] == [("specs_test.py", "WL102")]
