"""Write the catalog: `python -m catalog.make [KEY…] [--out DIR] [--check] [--thumbnails]`."""

import argparse
import sys
from importlib import import_module
from pathlib import Path

from . import kit, package
from .sameness import same

HERE = Path(__file__).resolve().parent
TOOLS = {
    "__init__", "__main__", "surface", "shapes", "texture", "hulls", "recipe", "package", "sameness", "thumbnails", "kit", "stands",
}  # fmt: skip
RECIPES = tuple(sorted(path.stem for path in HERE.glob("*.py") if path.stem not in TOOLS))
KITS = tuple(sorted(path.stem for path in kit.KITS.glob("*.py") if path.stem != "__init__"))
KEYS = tuple(sorted((*RECIPES, *KITS)))


def main(argv: list[str] | None = None) -> int:
    """Write the named assets (default: those that lie in the catalog); with --check, only compare and exit 1 if a file is stale."""
    parser = argparse.ArgumentParser(prog="python -m catalog.make", description=__doc__)
    parser.add_argument("keys", nargs="*", metavar="KEY", help=f"one of: {', '.join(KEYS)}")
    parser.add_argument("--out", type=Path, default=HERE.parent, help="the catalog folder (default: this one)")
    parser.add_argument("--check", action="store_true", help="change nothing; name the files that would change")
    parser.add_argument("--thumbnails", action="store_true", help="render thumbnail.png too (needs OpenGL)")
    args = parser.parse_args(argv)
    if unknown := sorted(set(args.keys) - set(KEYS)):
        parser.error(f"no recipe for {', '.join(unknown)}; known: {', '.join(KEYS)}")
    stale = 0
    for key in args.keys or [*RECIPES, *(key for key in KITS if (HERE.parent / key).is_dir())]:
        if key in KITS and args.check:  # its code is compared, not what another processor makes of it
            stale += _stale(args.out / key)
            continue
        stale += _write(args.out / key, _made(key), check=args.check)
        if args.thumbnails and not args.check:
            from .thumbnails import draw

            (args.out / key / "thumbnail.png").write_bytes(draw(key, args.out))
    return 1 if args.check and stale else 0


def _stale(folder: Path) -> int:
    """Whether the asset of a kit was made of other code than there is now; said as `_write` does."""
    entry = folder / "asset.yaml"
    stale = not entry.is_file() or kit.source(folder.name) not in entry.read_text(encoding="utf-8")
    sys.stdout.write(f"{folder.name}: {'stale asset.yaml' if stale else 'unchanged'}\n")
    return int(stale)


def _made(key: str) -> dict[str, bytes]:
    if key in KITS:
        return kit.asset(key, import_module(f".kits.{key}", __package__).KIT)
    return package.files(import_module(f".{key}", __package__).make())


def _write(folder: Path, made: dict[str, bytes], *, check: bool) -> int:
    """Bring `folder` in line with `made`; returns how many files differed by more than another processor's rounding."""
    present = {str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file()} - {"thumbnail.png"}
    alike = same if folder.name in RECIPES else lambda _, written, new: written == new
    changed = sorted(n for n, data in made.items() if n not in present or not alike(n, (folder / n).read_bytes(), data))
    gone = sorted(present - set(made))
    verb = "stale" if check else "wrote"
    sys.stdout.write(f"{folder.name}: {verb if changed or gone else 'unchanged'} {', '.join(changed + gone)}\n")
    if not check:
        for name in changed:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(made[name])
        for name in gone:
            (folder / name).unlink()
    return len(changed) + len(gone)


if __name__ == "__main__":
    sys.exit(main())
