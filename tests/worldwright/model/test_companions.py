"""What belongs to a program besides its file: found by reading, part of its key, and there in the sandbox."""

from pathlib import Path

import pytest

from worldwright.model import companions
from worldwright.model.evidence.run import Run


def lay(folder: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return folder / "simulation.py"


def test_modules_and_data_that_are_named_belong_and_nothing_else(tmp_path):
    program = lay(
        tmp_path,
        {
            "simulation.py": "import shapes\nfrom parts import wheel\nimport numpy\nTABLE = 'data/table.csv'\nF = 'meshes'\n",
            "shapes.py": "HULL = 'hull.obj'\n",
            "parts/__init__.py": "",
            "parts/wheel.py": "from . import rim\n",
            "parts/rim.py": "",
            "data/table.csv": "1,2",
            "data/other.csv": "3,4",
            "meshes/a.obj": "v",
            "meshes/deep/b.obj": "v",
            "hull.obj": "v",
            "description.json": "{}",
            "plan.md": "a plan",
            "unused.py": "",
        },
    )
    names = list(companions.of(program))
    assert names == [
        "data/table.csv", "hull.obj", "meshes/a.obj", "meshes/deep/b.obj", "parts/__init__.py", "parts/rim.py",
        "parts/wheel.py", "shapes.py",
    ]  # fmt: skip


def test_a_program_that_stands_alone_has_the_key_it_always_had(tmp_path):
    lay(tmp_path, {"simulation.py": "NAME = 'plan.md'\n", "plan.md": "a plan", "notes.txt": "mine"})
    run = Run(tmp_path)
    key = run.evidence_key("e")
    assert key.companions_sha256 == ""
    (tmp_path / "notes.txt").write_text("other")
    assert run.evidence_key("e").key == key.key
    (tmp_path / "simulation.py").write_text("NAME = 'notes.txt'\n")
    named = run.evidence_key("e")
    assert named.companions_sha256
    (tmp_path / "notes.txt").write_text("changed")
    assert run.evidence_key("e").key != named.key


def test_links_and_what_is_ours_are_no_companions(tmp_path):
    outside = tmp_path / "outside"
    outside.write_text("secret")
    folder = tmp_path / "run"
    program = lay(folder, {"simulation.py": "A = 'link'\nB = 'evidence'\nC = '../outside'\nD = 'journal.jsonl'\n"})
    lay(folder, {"evidence/x": "1", "journal.jsonl": "{}"})
    (folder / "link").symlink_to(outside)
    assert companions.of(program) == {}


def test_too_much_beside_a_program_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(companions, "MOST_FILES", 3)
    program = lay(tmp_path, {"simulation.py": "A = 'many'\n", **{f"many/{n}": "x" for n in range(5)}})
    with pytest.raises(companions.CompanionError, match="more than 3, or"):
        companions.of(program)
