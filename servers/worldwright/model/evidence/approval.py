"""Whether a run's plan is approved as it stands: its bytes, and those of the model files that it names.

An approval is a line of the journal (`action: approve`) with the plan's hash and, under `models`, the hash of each file
beside the plan that an mjcf or urdf row names: their text goes into the program, so a person who approved the plan
approved them too. Files of the catalog belong to the environment, whose hash is part of every evidence key.
"""

import hashlib
from collections.abc import Iterable, Mapping
from typing import Any

from ..errors import GateError
from . import rehearsed
from .run import Run, sha256_file

MODELS = "models"
NOBODY = "nobody: auto mode"
"""In place of a name, when nobody read the plan."""


def who(by: str, *, auto: bool) -> str:
    """The name that an approval gives, or that it was nobody's: lines and stamps of older versions name a user there."""
    return NOBODY if auto else by or "unknown"


def told(by: str, *, auto: bool) -> str:
    """The same as a clause: who typed a name is not known, only that it was given."""
    return f"by {NOBODY}" if auto else f"in the name of {by or 'nobody'}"


def model_hashes(run: Run) -> dict[str, str]:
    """SHA-256 of each model file beside the plan that the plan names, by path relative to it."""
    from ..plan import imported

    return {name: hashlib.sha256(content).hexdigest() for name, content in imported.beside(run.folder).items()}


def standing(
    entries: Iterable[Mapping[str, Any]], plan_sha256: str, models: Mapping[str, str]
) -> Mapping[str, Any] | None:
    """The latest approval of exactly this plan with exactly these model files; None when there is none."""
    found = [entry for entry in _of(entries, plan_sha256) if (entry.get(MODELS) or {}) == dict(models)]
    return found[-1] if plan_sha256 and found else None


def changed(entries: Iterable[Mapping[str, Any]], plan_sha256: str, models: Mapping[str, str]) -> tuple[str, ...]:
    """Model files that differ from those of this plan's latest approval, or were added or removed since; empty without one."""
    found = list(_of(entries, plan_sha256))
    before = dict(found[-1].get(MODELS) or {}) if found else dict(models)
    return tuple(sorted(name for name in {*before, *models} if before.get(name) != models.get(name)))


def require(run: Run, why: str) -> None:
    """Raise a `GateError` unless the plan is approved as it stands, or this is a rehearsal, of which nothing is accepted.

    `why` says what an approval is needed for.
    """
    entries, plan_sha256, models = list(run.entries()), sha256_file(run.plan), model_hashes(run)
    if rehearsed.is_one(entries) or standing(entries, plan_sha256, models) is not None:
        return
    move = f"worldwright stamp approve {run.folder}"
    if names := changed(entries, plan_sha256, models):
        raise GateError(
            f"{why}: {', '.join(names)}, which the plan names, changed since the plan was approved",
            place=str(run.folder / names[0]),
            next_move=f"look at it, then approve again: `{move}`",
        )
    raise GateError(
        f"{why}: the plan is not approved as it stands", place=str(run.plan), next_move=f"read it, then `{move}`"
    )


def _of(entries: Iterable[Mapping[str, Any]], plan_sha256: str) -> Iterable[Mapping[str, Any]]:
    return (e for e in entries if e.get("action") == "approve" and e.get("plan_sha256") == plan_sha256)
