"""Evidence is stale when something that it depends on changed, and then only: shaders, renderers, assets, the clock."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from worldkit import assets
from worldwright.lint import tools as lint
from worldwright.model.errors import NotFoundError
from worldwright.model.evidence import assets_used, environment
from worldwright.model.evidence.run import Run
from worldwright.stage import gates, tools
from worldwright.stamp import by_measurement
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State

pytestmark = pytest.mark.gl
Copy = Callable[[Path], Path]
SERVERS = Path(environment.__file__).parents[3]


def film(folder: Path, stage: str):
    job = tools.start(str(folder), stage=stage)
    while not job.ended:
        job = tools.wait(str(folder), job=job.job, timeout_s=30)
    assert job.state == "succeeded", job.text()
    return job


def drawn_by(folder: Path, stage: str) -> dict:
    run = Run(folder)
    here = run.evidence(run.evidence_key(environment.current().sha256()))
    return json.loads((here / stage / "result.json").read_text())["summary"]["renderer"]


def done(folder: Path) -> set[str]:
    return set(tools.status(str(folder)).passed)


def test_the_pictures_of_one_renderer_are_no_answer_for_another(reviewed: Path, copy: Copy, monkeypatch) -> None:
    folder = copy(reviewed)
    assert drawn_by(folder, "stills")["name"] == "preview"
    assert tools.start(str(folder), stage="stills").cached, "nothing changed"
    assert State(Run(folder)).visual.value is not None

    monkeypatch.setenv("WORLDKIT_RENDERER", "classic")
    assert done(folder) == {"physics"}
    with pytest.raises(NotFoundError, match="another renderer"):
        tools.frames(str(folder))
    held = {step.name: step for step in stamp.status(str(folder)).steps}
    assert held["physics"].holds and held["scan"].holds and held["expect"].holds
    assert not any(held[name].holds for name in ("stills", "video", "describe", "review"))
    assert "not by classic (mujoco " in held["stills"].detail

    job = film(folder, "stills")
    assert not job.cached
    said = drawn_by(folder, "stills")
    assert said["name"] == "classic" and "instead_of" not in said
    assert said["version"].startswith("mujoco ") and "code " in said["version"]
    assert tools.start(str(folder), stage="stills").cached, "nothing changed"
    assert done(folder) == {"physics", "stills"}, "the film is still the other's"
    film(folder, "video")
    assert State(Run(folder)).visual.value is None, "it describes other pictures"
    stamp.describe(str(folder), by_measurement.describe(Run(folder)))
    stamp.review(str(folder), by_measurement.review(Run(folder)))
    assert stamp.accept(str(folder), timeout_s=60).ok
    made = json.loads((folder / "accepted" / "stamp.json").read_text())["predicate"]["environment"]["film"]
    assert made["renderer"] == "classic"


def test_a_renderer_that_is_not_there_is_named_with_those_that_are(reviewed: Path, copy: Copy, monkeypatch) -> None:
    folder = copy(reviewed)
    monkeypatch.setenv("WORLDKIT_RENDERER", "oil_on_canvas")
    with pytest.raises(NotFoundError, match="oil_on_canvas") as refused:
        tools.start(str(folder), stage="stills")
    assert "classic, preview" in refused.value.next_move
    assert tools.start(str(folder), stage="physics").cached, "no picture, no renderer"
    assert State(Run(folder)).key is not None


@pytest.fixture(scope="module")
def elsewhere(tmp_path_factory: pytest.TempPathFactory) -> Callable[[Path, str], set[str]]:
    """What holds for a run by a copy of the code with one line added to one file."""
    home = tmp_path_factory.mktemp("house")
    shutil.copytree(SERVERS, home / "servers", ignore=shutil.ignore_patterns("__pycache__"))
    (home / "catalog").symlink_to(assets.catalog_root())

    def elsewhere(folder: Path, file: str) -> set[str]:
        path = home / "servers" / (file or "worldkit/world.py")
        before = path.read_bytes()
        if file:
            path.write_bytes(before + (b"\n// edited\n" if path.suffix != ".py" else b"\n# edited\n"))
        try:
            code = "import sys; from worldwright.stage import tools; print(*tools.status(sys.argv[1]).passed)"
            variables = {**os.environ, "PYTHONPATH": str(home / "servers"), "WORLDWRIGHT_CACHE": str(home / "cache")}
            call = [sys.executable, "-c", code, str(folder)]
            done = subprocess.run(call, env=variables, capture_output=True, text=True, check=True)
            return set(done.stdout.split())
        finally:
            path.write_bytes(before)

    return elsewhere


ALL = {"physics", "stills", "video"}


@pytest.mark.parametrize(
    ("file", "valid"),
    [
        ("", ALL),
        ("worldengine/film/renderers/preview/shaders/sky.frag", {"physics"}),
        ("worldengine/film/renderers/preview/shadows.py", {"physics"}),
        ("worldengine/film/encode.py", {"physics"}),
        ("worldkit/filming/moods.py", {"physics"}),
        ("worldwright/report/text.py", ALL),
        ("worldengine/clock/simulate.py", set()),
        ("worldengine/inputs/ledger.py", set()),
        ("worldengine/recording/record.py", set()),
        ("worldkit/bodies.py", set()),
    ],
)
def test_editing_code_ends_the_evidence_that_it_made(reviewed: Path, elsewhere, file: str, valid: set[str]) -> None:
    assert elsewhere(reviewed, file) == valid


def test_editing_one_renderer_leaves_the_pictures_of_another(tmp_path: Path) -> None:
    from worldengine.film import identity, renderers

    class Edited(type(renderers.SEAM)):
        def files(self, name: str) -> tuple[Path, ...]:
            mine = super().files(name)
            return (*mine, edit) if name == "preview" else mine

    edit = tmp_path / "new.frag"
    edit.write_text("void main() {}")
    before = {name: identity.identity(name).sha256 for name in renderers.SEAM.names()}
    usual, renderers.SEAM = renderers.SEAM, Edited(renderers.__name__, renderers.Renderer, "renderer")
    try:
        after = {name: identity.identity(name).sha256 for name in renderers.SEAM.names()}
    finally:
        renderers.SEAM = usual
    assert before["classic"] == after["classic"] and before["preview"] != after["preview"]


MUG = '''
from worldkit import assets, cameras, program, scene


def build():
    """Something on the floor."""
    spec = scene.new("crockery", time_step=0.002)
    assets.add(spec, {key}, name="cup", height=0.1, pos=(0, 0, 0.05))
    cameras.add(spec, "overview", view="perspective", subjects=("cup",))
    return spec


program.main(build, duration=0.02)
'''


@pytest.fixture
def catalog(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A catalog of two assets that may be changed."""
    there = tmp_path / "catalog"
    for name in ("mug", "bowl"):
        shutil.copytree(assets.catalog_root() / name, there / name)
    monkeypatch.setenv("WORLDWRIGHT_CATALOG", str(there))
    return there


def test_an_asset_concerns_the_worlds_that_use_it(make, finish, catalog: Path) -> None:
    run = make(MUG.format(key='"mug"'))
    assert finish(run).state == "succeeded"
    assert finish(run).cached
    shutil.copytree(catalog / "bowl", catalog / "kettle")  # minted
    (catalog / "bowl" / "asset.yaml").write_text((catalog / "bowl" / "asset.yaml").read_text() + "\n# edited\n")
    assert finish(run).cached, "it uses neither"
    (catalog / "mug" / "asset.yaml").write_text((catalog / "mug" / "asset.yaml").read_text() + "\n# edited\n")
    assert gates.passed(run, run.evidence_key(environment.current().sha256()), "physics") is None


def test_an_asset_that_no_text_names_is_refused(make, finish, catalog: Path) -> None:
    run = make(MUG.format(key='"m" + "ug"'))
    job = finish(run)
    assert (job.state, job.code) == ("failed", "unnamed_asset"), job.text()
    assert "mug" in job.message and "whole word" in job.next_move
    named = make("# mug\n" + MUG.format(key='"m" + "ug"'), name="named")
    assert finish(named).state == "succeeded"


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('assets.add(spec, "mug")', ("mug",)),
        ("- filename: bowl\n", ("bowl",)),
        ("models.attach(x, folder='mug/arm')", ("mug",)),
        ("bowling, mugs and a smug look", ()),
    ],
)
def test_assets_are_found_as_whole_words(tmp_path: Path, catalog: Path, text: str, found: tuple[str, ...]) -> None:
    plan = tmp_path / "plan.md"
    plan.write_text(text)
    assert assets_used.named(plan, tmp_path / "simulation.py") == found
    assert bool(assets_used.sha256(plan, tmp_path / "simulation.py")) == bool(found)


def test_a_file_beside_the_program_names_assets_too(tmp_path: Path, catalog: Path) -> None:
    (tmp_path / "simulation.py").write_text("import parts\n")
    (tmp_path / "parts.py").write_text("KEY = 'bowl'\n")
    assert assets_used.named(tmp_path / "plan.md", tmp_path / "simulation.py") == ("bowl",)


def test_an_own_asset_counts_only_where_it_is_meant(tmp_path: Path, catalog: Path, monkeypatch) -> None:
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    shutil.copytree(catalog / "bowl", tmp_path / "own" / "ball")
    plan, program = tmp_path / "plan.md", tmp_path / "simulation.py"
    plan.write_text("a ball falls into the bowl\n")
    program.write_text("ball = 1\n")
    assert assets_used.named(plan, program) == ("bowl",)
    for text in ("- {name: toy, filename: ball}", '{"filename": "ball"}', "filename: 'ball'"):
        plan.write_text(text)
        assert assets_used.named(plan, program) == ("ball",)
    plan.write_text("")
    program.write_text('assets.add(spec, "ball", name="toy")\n')
    assert assets_used.named(plan, program) == ("ball",) == assets_used.named(plan, program)
    assert assets_used.unnamed(["ball"], plan, program) == () and assets_used.sha256(plan, program)


def test_what_lint_said_of_a_run_stands_whatever_draws_it(reviewed: Path, copy: Copy, monkeypatch) -> None:
    folder = copy(reviewed)
    monkeypatch.setenv("WORLDKIT_RENDERER", "classic")
    assert State(Run(folder)).lint.value is not None
    assert lint.check_program([folder / "simulation.py"]).ok
