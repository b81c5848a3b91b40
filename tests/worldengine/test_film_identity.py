"""Whatever of `worldkit` decides how pictures look belongs to the identity of a film."""

import ast
from pathlib import Path

import worldengine.film
import worldkit
from worldengine.film import identity

NOT_SEEN = {
    "alike.py", "channel.py", "errors.py", "files.py", "film_files.py", "listings.py", "lock.py", "naming.py", "portable.py",
    "program.py", "reporting.py", "scene.py", "seams.py", "wheels.py", "world.py", "__init__.py",
}  # fmt: skip
"""What films import of it that changes no picture: how files, errors, names and progress are told, which versions and
what processor are there, which files lie in a folder, and how a world, which is recorded as it is, is read."""


def imported(path: Path) -> set[str]:
    """The files of `worldkit` that a module imports, relative to it."""
    kit, found = Path(worldkit.__file__).parent, set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        names = []
        if (
            isinstance(node, ast.ImportFrom)
            and node.module
            and node.module.split(".")[0] == "worldkit"
            and not node.level
        ):
            names = [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
        elif isinstance(node, ast.Import):
            names = [alias.name for alias in node.names if alias.name.split(".")[0] == "worldkit"]
        for name in names:
            place = kit.joinpath(*name.split(".")[1:])
            found |= {str(p.relative_to(kit)) for p in (place.with_suffix(".py"), place / "__init__.py") if p.is_file()}
    return found


def test_all_that_films_import_of_worldkit_is_part_of_their_identity() -> None:
    kit, film = Path(worldkit.__file__).parent, Path(worldengine.film.__file__).parent
    covered = {str(path.relative_to(kit)) for pattern in identity.DRAWN_FROM for path in kit.glob(pattern)}
    used = {name for path in film.rglob("*.py") for name in imported(path)}
    assert {"lights.py", "settings.py", "materials/__init__.py"} <= used
    assert used - covered - NOT_SEEN == set()
    assert not NOT_SEEN & covered


def test_a_folder_whose_name_is_a_pattern_is_read_all_the_same(tmp_path, monkeypatch) -> None:
    servers, found = Path(worldengine.film.__file__).parents[2], set()
    for room in (tmp_path / "plain", tmp_path / "plain[2]"):
        room.mkdir()
        for name in ("worldengine", "worldkit"):
            (room / name).symlink_to(servers / name)
        monkeypatch.setattr(identity, "__file__", str(room / "worldengine" / "film" / "identity.py"))
        monkeypatch.setattr(worldkit, "__file__", str(room / "worldkit" / "__init__.py"))
        found.add(identity.identity("classic").sha256)
    assert len(found) == 1


def test_what_lays_the_laws_of_an_author_is_part_of_it() -> None:
    assert "inputs/declared_media.py" in identity.REPLAYED_BY
    engine = Path(worldengine.film.__file__).parents[1]
    assert all((engine / name).is_file() for name in identity.REPLAYED_BY)
