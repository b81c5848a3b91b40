"""How the newest job of a pass ended, for a person who asks what is missing."""

from pathlib import Path
from typing import Any

from ..model import json_object


def newest_failure(jobs: Path, stage: str, key: str) -> str:
    """`code: message` of the newest job of this pass and key when it did not succeed; empty otherwise."""
    newest: dict[str, Any] = {}
    try:
        folders = [] if jobs.is_symlink() else [folder for folder in jobs.iterdir() if not folder.is_symlink()]
    except OSError:
        return ""
    for folder in folders:
        spec, state = (json_object.read(folder / name) or {} for name in ("spec.json", "state.json"))
        if state.get("stage") == stage and state.get("key") == key:
            newest = max(newest, {**state, "_at": _number(spec.get("created"))}, key=lambda j: j.get("_at", -1.0))
    state = newest.get("state", "")
    if state in ("queued", "running"):
        return f"job {newest.get('job', '')} is {state}"
    if state not in ("failed", "cancelled", "lost"):
        return ""
    place = newest.get("place") or ""
    message = newest.get("message") or "it gave no message"
    return f"the last try ended with {newest.get('code') or state}{f' at {place}' if place else ''}: {message}"


def _number(value: Any) -> float:
    return float(value) if isinstance(value, int | float) else 0.0
