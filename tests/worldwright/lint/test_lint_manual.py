"""No false alarms: every Python and MJCF snippet of the shipped manual, linted; those that run must be clean.

The Python snippets are run one by one, each in a process of its own inside the sandbox, to know which of them run; the
names that the manual takes for granted (mujoco, np, a model, its data, a spec) are there.
"""

import json
import re
import sys
import textwrap
import warnings
from collections import Counter
from pathlib import Path

import pytest

from worldwright.lint import engine, source
from worldwright.lint.harm import outcome_of
from worldwright.lint.program_view import Program
from worldwright.simulator import installed
from worldwright.stage import sandbox
from worldwright.stage.confined import run

FENCE = re.compile(r"^(\s*)(?:\.\. code(?:-block)?:: (python|xml)|```(python|xml))\s*$", re.IGNORECASE)
RUNNER = """
import json, os, signal, sys
import mujoco, numpy
snippets, out, ran = json.load(open(sys.argv[1])), sys.argv[2], {}
XML = "<mujoco><worldbody><light pos='0 0 3'/><body name='body'><freejoint/><geom name='geom' size='.1'/></body></worldbody></mujoco>"
model = mujoco.MjModel.from_xml_string(XML)
context = {'mujoco': mujoco, 'mj': mujoco, 'np': numpy, 'numpy': numpy, 'model': model, 'm': model, 'XML': XML, 'xml': XML}
context |= {'data': mujoco.MjData(model), 'd': mujoco.MjData(model), 'spec': mujoco.MjSpec.from_string(XML)}
for place, text in snippets.items():
    child = os.fork()
    if child == 0:
        signal.alarm(4)
        os.chdir(out)
        sys.stdout = sys.stderr = open(os.devnull, 'w')
        try:
            exec(compile(text, place, 'exec'), {'__name__': '__main__', **context})
        except BaseException:
            os._exit(1)
        os._exit(0)
    ran[place] = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
json.dump(ran, open(out + '/ran.json', 'w'))
"""

JUSTIFIED = {
    ("XMLreference.rst", "WL100"): "an excerpt without its end",
    ("modeling.rst", "WL100"): "an excerpt of URDF with an ellipsis in it",
    ("mjx.rst", "WL101"): "mujoco.mjx is a distribution of its own, which is not installed",
    ("skills/accelerated/SKILL.md", "WL101"): "mujoco.mjx is a distribution of its own, which is not installed",
    ("XMLreference.rst", "WL108"): "a mistake of the manual's: a sensor names the site Alice, which is a geom",
    ("OpenUSD/importing.rst", "WM101"): "names a file that is not there",
    ("XMLreference.rst", "WM101"): "the same mistake: the engine says so too",
    ("XMLreference.rst", "WM102"): "the engine's own warning: the example's flex has no forces",
    ("modeling.rst", "WM101"): "shows defaults without sizes, and says that it does not compile",
    ("programming/extension.rst", "WM101"): "names a plugin of the engine's own tests",
}
"""Every finding there is, and why it is right."""


def snippets():
    folder = installed.manual_folder()
    for path in sorted([*folder.rglob("*.rst"), *folder.rglob("*.md")]):
        lines = path.read_text(encoding="utf-8").splitlines()
        index = 0
        while index < len(lines):
            match = FENCE.match(lines[index])
            index += 1
            if match is None:
                continue
            start, body = index, []
            while index < len(lines):
                line = lines[index]
                inside = not line.strip() or len(line) - len(line.lstrip()) > len(match[1])
                if line.strip().startswith("```") if match[3] else not inside:
                    break
                body.append(line)
                index += 1
            while body and (not body[0].strip() or body[0].strip().startswith(":")):
                body.pop(0)
            language = (match[2] or match[3]).lower()
            yield f"{path.relative_to(folder).as_posix()}:{start}", language, textwrap.dedent("\n".join(body))


def found(place, read):
    return [(place.rsplit(":", 1)[0], f.code, f.message) for f in engine.check_source(read)]


@pytest.fixture(scope="module")
def findings():
    """(number of snippets by language, documents, findings)."""
    count, documents, hits = Counter(), 0, []
    for place, language, text in snippets():
        count[language] += 1
        if language == "xml" and "<mujoco" not in text:
            continue
        read = source.parse(text, "snippet.xml" if language == "xml" else "snippet.py")
        assert read.problem is None, f"{place}: {read.problem}"
        hits += found(place, read)
        if language == "xml" and "</mujoco" in text:
            documents += 1
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                outcome = outcome_of(text)
            hits += [(place.rsplit(":", 1)[0], f.code, f.message) for f in engine.check_world(Program(read), outcome)]
    return count, documents, hits


def test_every_finding_on_the_manual_is_justified(findings):
    count, documents, hits = findings
    print(f"{count['python']} Python and {count['xml']} MJCF snippets, {documents} of them whole; {len(hits)} findings")
    assert count["python"] >= 120 and count["xml"] >= 30 and documents >= 12
    assert {(place, code) for place, code, _ in hits} == set(JUSTIFIED)
    assert all("mjx" in message for _, code, message in hits if code == "WL101")


@pytest.mark.skipif(sandbox.level() not in sandbox.CONFINING, reason="no level confines here")
def test_python_snippets_that_run_are_clean(tmp_path):
    python = {place: text for place, language, text in snippets() if language == "python"}
    given, runner = tmp_path / "snippets.json", tmp_path / "runner.py"
    given.write_text(json.dumps(python))
    runner.write_text(RUNNER)
    call = [sys.executable, "-s", str(runner), str(given), "{out}"]
    done = run(call, reads=[given, runner], wanted=["ran.json"], wall_s=200.0, memory_mb=4096)
    ran = [place for place, fine in json.loads(done.files["ran.json"]).items() if fine]
    print(f"{len(ran)} of {len(python)} Python snippets run as they stand")
    assert len(ran) >= 10
    for place in ran:
        assert found(place, source.parse(python[place])) == []


def test_models_of_the_installed_package_are_clean_or_explained():
    """The engine's own test models: reading finds nothing."""
    models = [path for path in installed.package_folder().rglob("*.xml") if isinstance(path, Path)]
    assert models
    assert [f.code for path in models for f in engine.check_source(source.read(path))] == []
