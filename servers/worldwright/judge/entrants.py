"""Which film belongs to which scenario: a folder of films, of runs, a campaign, or a list.

| given | a film's scenario is |
|---|---|
| a folder of MP4 files | the file's name: `039.mp4`, or `039-2.mp4` as the benchmark names them |
| a campaign, or a folder of runs | the scenario whose prompt is the run's, letter for letter but for case, blanks and stops |
| a YAML or JSON file `{"039": path}` | its key; a path is a film or a run |

Of a run its accepted film stands: a world is judged only after it was accepted, and never before.
"""

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import yaml

from ..campaign.campaign_store import ABOUT, Store
from ..model.errors import NotFoundError, WorldwrightError
from ..model.evidence.run import Run, sha256_file
from .published_set import plain_id
from .staging_audit import stamped

LISTS = (".yaml", ".yml", ".json")
MOST_LIST = 4 << 20


class EntrantError(WorldwrightError):
    """Films cannot be told apart, or belong to nothing."""

    code = "entrants"


@dataclass(frozen=True)
class Entrant:
    """The film of one scenario."""

    film: Path
    run: Path | None = None


@dataclass(frozen=True)
class Entered:
    """All of them, and what does not stand."""

    entrants: dict[str, Entrant]
    left_out: tuple[str, ...] = ()
    """Runs that are not accepted, or films of no scenario, with why."""


def find(given: Path, prompts: Mapping[str, Iterable[str]], camera: str | None = None) -> Entered:
    """The films that are given.

    Args:
        prompts: by scenario, the sentences that its films are made from.
        camera: which film of a run; without it `film` where its author made one, else the first by name.

    Raises:
        NotFoundError: there is nothing there.
        EntrantError: two films of one scenario, or a list that is none.
    """
    if not given.exists():
        raise NotFoundError("there are no films", place=str(given), next_move="name a folder of films, or of runs")
    said = {_plain(prompt): id for id, all_of_them in prompts.items() for prompt in all_of_them}
    found: dict[str, Entrant] = {}
    left: list[str] = []
    for named, id, path in _named(given, said):
        try:
            entrant = _entrant(path, camera)
        except WorldwrightError as error:
            left.append(f"{named}: {error.cause}")
            continue
        if not id:
            left.append(f"{named}: its prompt is none of the set's")
        elif id in found:
            raise EntrantError(
                f"scenario {id} has two films: {found[id].film.name} and {entrant.film.name}", place=str(given),
                next_move="give one film a scenario; of several tries say which: a list {id: path}",
            )  # fmt: skip
        else:
            found[id] = entrant
    return Entered(dict(sorted(found.items())), tuple(left))


def _named(given: Path, said: Mapping[str, str]) -> Iterator[tuple[str, str, Path]]:
    """(what it is called, its scenario or nothing, film or run folder)."""
    if given.is_file() and given.suffix.lower() in LISTS:
        for id, name in _list(given).items():
            yield id, id, given.parent / name
    elif given.is_file():
        yield given.name, plain_id(given.stem), given
    elif (given / ABOUT).is_file():
        store = Store.find(given)
        for row in sorted(store.rows(), key=lambda row: row.number):
            folder = store.folder / row.folder if row.folder else given
            yield f"world {row.number}", said.get(_plain(row.prompt), ""), folder
    else:
        for path in sorted(given.iterdir()):
            if path.suffix.lower() == ".mp4":
                yield path.name, plain_id(path.stem), path
            elif (path / "plan.md").is_file():
                yield path.name, said.get(_plain(_prompt(path)), ""), path


def _entrant(path: Path, camera: str | None) -> Entrant:
    if path.is_file():
        return Entrant(path)
    if not (path / "plan.md").is_file():
        raise NotFoundError("it is neither a film nor a run", place=str(path))
    films = {one.stem: one for one in sorted((Run(path).accepted / "video").glob("*.mp4"))}
    film = films.get(camera or "film") or (None if camera else next(iter(films.values()), None))
    if film is None:
        why = f"no accepted film of the camera {camera}" if films else "it is not accepted with a film"
        raise NotFoundError(why, place=str(path))
    if sha256_file(film) != stamped(Run(path)).digest_of(f"video/{film.name}"):
        raise WorldwrightError(f"{film.name} is not the film that was stamped", place=str(path))
    return Entrant(film, path)


def _list(path: Path) -> dict[str, str]:
    try:
        if path.stat().st_size > MOST_LIST:
            raise ValueError(f"it is larger than {MOST_LIST >> 20} MB")
        told = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, yaml.YAMLError, RecursionError) as cause:
        raise _no_list(path, str(cause).splitlines()[0]) from cause
    if not isinstance(told, dict) or not all(isinstance(value, str) and value for value in told.values()):
        raise _no_list(path, "it is no object of paths by scenario")
    found = {plain_id(str(key)): value for key, value in told.items()}
    if len(found) != len(told):
        raise _no_list(path, "two of its keys are one scenario")
    return found


def _no_list(path: Path, why: str) -> EntrantError:
    return EntrantError(f"it is no list of films: {why}", place=str(path), next_move='write {"039": "films/ball.mp4"}')


def _prompt(run: Path) -> str:
    try:
        return Run(run).prompt.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""


def _plain(prompt: str) -> str:
    return re.sub(r"[\W_]+", " ", prompt).strip().lower()
