"""The published data set's own JSON files, read from a folder that the user names, whatever their nesting.

As it is published (`prompts-with-standard-and-index.json` of g-jing/phy-world-bench): an object of categories, of subcategories,
of lists of records

    {"Prompt": "…", "Physics": "…", "Detailed": "…", "Prompt_index": "039-1", "Physics_index": "039-2",
     "Basic_Standards": {"Objects": ["…"], "Event": "…"}, "Key_Standards": ["…"]}

What is tolerated, since criteria are also written by hand: any nesting, one record a file, or a list; other cases of letters
and `-` or a blank for `_` in the names; a single text in place of a list; `id` or `index` in place of the `*_index`, or the
file's own name where it holds one record; `category` and `subcategory` in the record. A file without any record (a list of
prompts, say) is passed over. What is not tolerated is named, one error a file: no JSON, a record that lacks objects, event or
standards, two records of one scenario that differ.
"""

import json
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..model.errors import NotFoundError
from ..model.frozen import Frozen
from .criteria import Criteria, CriteriaError, Scenario

MOST_BYTES, MOST_FILES = 16 << 20, 5000
LONGEST, MOST_STANDARDS = 2000, 40
"""Characters of one criterion; standards of one scenario."""
PROMPTS = ("prompt", "physics", "detailed", "physics_prompt", "detailed_prompt")
WAY_ON = "write it as the published set does: Basic_Standards {Objects, Event} and Key_Standards in each record"


class Published(Frozen):
    """What a folder holds."""

    scenarios: dict[str, Scenario]
    """By id, sorted."""
    passed_over: tuple[str, ...] = ()
    """Files of JSON without any criteria."""


def read(folder: Path) -> tuple[Published, tuple[CriteriaError, ...]]:
    """All scenarios below a folder (or of one file), and one error for each file that cannot be used.

    Raises:
        NotFoundError: there is no such folder, or nothing in it has criteria.
    """
    if not folder.exists():
        raise NotFoundError(
            "there is no such folder of criteria", place=str(folder), next_move="name the published data set's folder"
        )
    found: dict[str, Scenario] = {}
    errors: list[CriteriaError] = []
    over: list[str] = []
    for path in _files(folder):
        try:
            scenarios = list(_scenarios(path))
            for one in scenarios:
                before = found.get(one.id)
                if before is not None and before.criteria != one.criteria:
                    raise _wrong(path, f"scenario {one.id} has other criteria in a file before", "twice")
            found.update({one.id: one for one in scenarios})
            over += [] if scenarios else [path.name]
        except CriteriaError as error:
            errors.append(error)
    if not found and not errors:
        raise NotFoundError("no JSON file here has criteria", place=str(folder), next_move=WAY_ON)
    return Published(scenarios=dict(sorted(found.items())), passed_over=tuple(over)), tuple(errors)


def _files(folder: Path) -> list[Path]:
    if folder.is_file():
        return [folder]
    named = []
    for at, folders, names in os.walk(folder):
        folders.sort()
        named += [Path(at) / name for name in sorted(names) if name.lower().endswith(".json")]
        if len(named) > MOST_FILES:
            raise _wrong(folder, f"more than {MOST_FILES} files of JSON lie below it", "too_large")
    return named


def _scenarios(path: Path) -> Iterator[Scenario]:
    try:
        if not path.is_file():
            raise _wrong(path, "it is no plain file", "unreadable")
        with path.open("rb") as stream:
            content = stream.read(MOST_BYTES + 1)
    except OSError as cause:
        raise _wrong(path, f"it cannot be read: {cause.strerror or cause}", "unreadable") from cause
    if len(content) > MOST_BYTES:
        raise _wrong(path, f"it is larger than {MOST_BYTES >> 20} MB", "too_large")
    try:
        value = json.loads(content)
        records = list(_records(value, ()))
    except (ValueError, RecursionError) as cause:
        said = "it is nested too deeply" if isinstance(cause, RecursionError) else f"it is no JSON: {cause}"
        raise _wrong(path, said, "not_json") from cause
    for number, (names, record) in enumerate(records, 1):
        alone = path.stem if len(records) == 1 else ""
        yield _scenario(names, record, alone, f"{path.name}, record {number}" if len(records) > 1 else path.name)


def _records(value: Any, names: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], dict[str, Any]]]:
    """Every object that has criteria, with the names of the objects around it."""
    if isinstance(value, list):
        for one in value:
            yield from _records(one, names)
    elif isinstance(value, dict):
        known = {_plain(key): one for key, one in value.items()}
        if {"basic_standards", "key_standards"} & known.keys():
            yield names, known
            return
        for key, one in value.items():
            yield from _records(one, (*names, key))


def _scenario(names: tuple[str, ...], record: dict[str, Any], alone: str, place: str) -> Scenario:
    basic = record.get("basic_standards")
    basic = {_plain(key): one for key, one in basic.items()} if isinstance(basic, dict) else {}
    objects = _texts(basic.get("objects", basic.get("object")), "Basic_Standards.Objects", place)
    event = _texts(basic.get("event", basic.get("events")), "Basic_Standards.Event", place)
    standards = _texts(record.get("key_standards"), "Key_Standards", place)
    if len(standards) > MOST_STANDARDS:
        raise _wrong(place, f"it has {len(standards)} key standards, more than {MOST_STANDARDS}", "too_large")
    category, subcategory = (*names, "", "")[:2]
    return Scenario(
        id=_id(record, alone, place),
        category=_text(record.get("category")) or category,
        subcategory=_text(record.get("subcategory")) or subcategory,
        prompts=tuple(dict.fromkeys(text for word in PROMPTS if (text := _text(record.get(word))))),
        criteria=Criteria(objects=objects, event="; ".join(event), standards=standards),
    )


def _id(record: dict[str, Any], alone: str, place: str) -> str:
    for key in ("prompt_index", "physics_index", "detailed_index", "index", "id"):
        if isinstance(given := record.get(key), int | str) and str(given).strip():
            return plain_id(str(given))
    if alone:
        return plain_id(alone)
    raise _wrong(place, "the record has no index and no id", "incomplete")


def plain_id(given: str) -> str:
    """A scenario's number as it is printed: `39`, `039-2` and `039` are one scenario, whose id is `039`."""
    number = re.fullmatch(r"\s*(\d{1,6})(?:[-_]\d+)?\s*", given)
    return number[1].zfill(3) if number else given.strip()


def _texts(value: Any, name: str, place: str) -> tuple[str, ...]:
    """A list of texts, or one text as a list of one; an object's values where they are numbered by name."""
    rows = [value] if isinstance(value, str) else list(value.values()) if isinstance(value, dict) else value
    if not isinstance(rows, list) or not rows or not all(isinstance(one, str) and one.strip() for one in rows):
        raise _wrong(place, f"{name} is missing, empty, or no text", "incomplete")
    if any("\ud800" <= c <= "\udfff" for one in rows for c in one):
        raise _wrong(place, f"{name} has half of a character, which cannot be sent", "incomplete")
    if (longest := max(map(len, rows))) > LONGEST:
        raise _wrong(place, f"{name} has a text of {longest} characters, more than {LONGEST}", "too_large")
    return tuple(" ".join(one.split()) for one in rows)


def _text(value: Any) -> str:
    return " ".join(value.split()) if isinstance(value, str) else ""


def _plain(key: str) -> str:
    return re.sub(r"[\s\-]+", "_", key.strip().lower())


def _wrong(place: Path | str, cause: str, code: str) -> CriteriaError:
    return CriteriaError(cause, code=code, place=str(place), next_move=WAY_ON)
