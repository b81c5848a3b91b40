"""Measure what a camera sees of each object, with rays on the exact collision shapes (runs in the pre-roll process).

A grid of rays covers the part of the picture's plane that an object's bounding boxes cover, also outside the picture. Rays cast
against the object alone give its whole outline; rays cast against everything give what is visible of it. So

    in_frame = rays of the outline inside the picture / all rays of the outline
    hidden   = 1 - visible rays inside the picture / rays of the outline inside the picture
    share    = visible rays inside the picture * area of a cell / area of the picture

Source: R. Hartley and A. Zisserman, Multiple View Geometry, section 6.1 (the pinhole camera).
"""

from typing import Any

RAYS = 128
"""The number of rays along each side of the grid."""
FAR = 3.0
"""The grid ends so many half pictures from the middle."""
ALONE, OTHERS = 1, 0
"""The geom groups by which rays tell objects apart."""


def add_cameras(spec: Any, cameras: list[dict[str, Any]]) -> None:
    """Add the cameras as a program does: with a pose, or by view and subjects."""
    from worldkit import cameras as kit

    for row in cameras:
        explicit = row["position"] is not None
        kit.add(
            spec,
            row["name"],
            view=None if explicit else row["view"],
            subjects=tuple(row["subjects"]),
            position=row["position"],
            target=row["target"] if explicit else None,
            fovy=row["fovy"],
        )


def seen(model: Any, data: Any, cameras: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Measure `camera`, `object`, `share`, `in_frame`, `hidden`, `length` (of the longer side of its box, over the picture's width)
    of what each camera shows (`measured`), and tell where the camera (`eye`) and the thing (`place`) are, m.
    """
    import numpy as np

    model.geom_matid[:], model.geom_rgba[:, 3] = -1, 1.0  # rays pass through geoms that are not drawn
    found = []
    for row in cameras:
        camera = model.camera(row["name"]).id
        eye, axes = data.cam_xpos[camera].copy(), data.cam_xmat[camera].reshape(3, 3)
        up = np.tan(np.radians(model.cam_fovy[camera]) / 2)
        scale = np.array([up * row["aspect"], up])
        for name in row["measured"]:
            body = model.body(name).id
            window = _window(model, data, body, eye, axes, scale)
            told = {"camera": row["name"], "object": name, "share": 0.0, "in_frame": 0.0, "hidden": 0.0, "length": 0.0}
            told |= {"eye": eye.tolist(), "place": data.subtree_com[body].tolist()}
            if window is not None:
                told["length"] = float(max((window[1] - window[0]) / (2.0, 2.0 * row["aspect"])))
                told |= _measured(model, data, body, eye, axes, scale, window)
            found.append(told)
    return found


def _measured(model: Any, data: Any, body: int, eye: Any, axes: Any, scale: Any, window: Any) -> dict[str, float]:
    """The three shares of one object."""
    import numpy as np

    low, high = window
    steps = (np.arange(RAYS) + 0.5) / RAYS
    u, v = np.meshgrid(low[0] + (high[0] - low[0]) * steps, low[1] + (high[1] - low[1]) * steps)
    inside = ((np.abs(u) < 1) & (np.abs(v) < 1)).ravel()
    local = np.stack([u * scale[0], v * scale[1], np.full_like(u, -1.0)], axis=-1).reshape(-1, 3)
    directions = (local / np.linalg.norm(local, axis=1, keepdims=True)) @ axes.T
    alone = _hit(model, data, eye, directions, body) >= 0
    outline, framed = int(alone.sum()), int((alone & inside).sum())
    if not framed:
        return {"in_frame": 0.0}
    first = _hit(model, data, eye, directions[alone & inside], None)
    visible = int(_belongs(model, body)[first].sum())
    cell = float(np.prod((high - low) / RAYS)) / 4.0
    return {"share": visible * cell, "in_frame": framed / outline, "hidden": 1 - visible / framed}


def _window(model: Any, data: Any, body: int, eye: Any, axes: Any, scale: Any) -> Any:
    """Lowest and highest (u, v) of an object's boxes, in half pictures from the middle; None behind the camera."""
    import numpy as np

    signs = np.array([(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    points = []
    for geom in np.flatnonzero(_belongs(model, body)):
        box = model.geom_aabb[geom]
        points.append((box[:3] + signs * box[3:]) @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])
    local = (np.concatenate(points) - eye) @ axes if points else np.zeros((0, 3))
    depth = -local[:, 2] if len(local) else np.zeros(0)
    if not (depth > 0).any():
        return None
    if (depth < 1e-6).any():  # a box partly behind the camera has no finite projection
        return np.full(2, -FAR), np.full(2, FAR)
    projected = local[:, :2] / depth[:, None] / scale
    low, high = np.clip(projected.min(axis=0), -FAR, FAR), np.clip(projected.max(axis=0), -FAR, FAR)
    return (low, high) if (high > low).all() else None


def _belongs(model: Any, body: int) -> Any:
    """(G,) bool: the geoms of an object, which stands on its own here, so that all below its body is part of it."""
    return model.body_rootid[model.geom_bodyid] == body


def _hit(model: Any, data: Any, eye: Any, directions: Any, body: int | None) -> Any:
    """The first geom that each ray meets, -1 for none; with `body`, only that body's geoms count."""
    import mujoco
    import numpy as np

    model.geom_group[:] = OTHERS
    if body is not None:
        model.geom_group[_belongs(model, body)] = ALONE
    groups = np.zeros(mujoco.mjNGROUP, dtype=np.uint8)
    groups[OTHERS if body is None else ALONE] = 1
    count = len(directions)
    geoms, distances = np.full(count, -1, dtype=np.int32), np.zeros(count)
    mujoco.mj_multiRay(
        model, data, eye, np.ascontiguousarray(directions).ravel(), groups, 1, -1, geoms, distances, None, count, 1e9
    )
    return geoms
