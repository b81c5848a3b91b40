"""Facts that `worldkit` keeps inside a compiled model: JSON in texts, writable numbers in numerics."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import mujoco


def read(model: mujoco.MjModel, name: str) -> dict[str, Any] | None:
    """The JSON object in the model's text `name`; None if there is none."""
    import mujoco

    index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, name)
    if index < 0:
        return None
    start, size = int(model.text_adr[index]), int(model.text_size[index])
    raw = model.text_data[start : start + size]
    try:
        value = json.loads(bytes(raw).rstrip(b"\0").decode())
    except (ValueError, UnicodeDecodeError):
        return None
    return value if isinstance(value, dict) else None


def numbers(model: mujoco.MjModel, name: str) -> np.ndarray | None:
    """The model's numeric `name` as a writable view; None if there is none."""
    import mujoco

    index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, name)
    if index < 0:
        return None
    start = int(model.numeric_adr[index])
    return model.numeric_data[start : start + int(model.numeric_size[index])]
