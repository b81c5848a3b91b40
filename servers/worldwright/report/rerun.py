"""A run as a recording for the Rerun viewer: bodies over time, energies and speeds as plots (extra `view`).

Shapes come from the recording's geoms; bodies made from a catalog asset show its visual mesh. Geoms that are only known
by their bounding box (other meshes) are drawn as that box.
"""

from pathlib import Path
from typing import Any

from ..model.errors import NotFoundError, WorldwrightError
from ..model.evidence.run import Run
from ..model.plan.committed import Plan

RATE_HZ = 120.0
"""Poses a second of simulated time; the viewer interpolates nothing."""
PALETTE = ((47, 111, 222), (217, 98, 43), (18, 138, 107), (168, 68, 160), (173, 132, 0), (11, 143, 168), (204, 52, 80))
COLLISION_GROUP = 3
"""Geom group of collision hulls, which hide behind the visual ones."""


def record(run: Run) -> Path:
    """Write `recording.rrd` beside the run's plan, from the physics pass of the current key; returns its path."""
    from ..model.recording.trajectory_files import read_trajectory
    from ..stamp.state import State

    try:
        import rerun as rr
    except ImportError as cause:
        raise WorldwrightError(
            "rerun-sdk is not installed", place="extra `view`", next_move='pip install "worldwright[view]"'
        ) from cause
    state = State(run)
    folder = state.folder / "physics" / "trajectory"
    if not folder.is_dir():
        raise NotFoundError(
            "there is no recording of this program and plan",
            place=str(folder),
            next_move=f"worldwright stage start {state.place} --stage physics",
        )
    trajectory = read_trajectory(folder)
    target = run.folder / "recording.rrd"
    with rr.RecordingStream("worldwright", recording_id=trajectory.sha256[:16]) as stream:
        stream.save(str(target))
        stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
        _shapes(rr, stream, trajectory, state.plan)
        _poses(rr, stream, trajectory)
        _plots(rr, stream, trajectory)
        stream.flush()
    return target


def _rows(trajectory: Any) -> Any:
    """Rows to send: `RATE_HZ` of them a second, first and last included."""
    import numpy as np

    count = max(2, min(len(trajectory.t), int(trajectory.duration_s * RATE_HZ) + 1))
    return np.unique(np.linspace(0, len(trajectory.t) - 1, count).round().astype(int))


def _poses(rr: Any, stream: Any, trajectory: Any) -> None:
    """Every body's pose over time."""
    rows = _rows(trajectory)
    clock = [rr.TimeColumn("simulated", duration=trajectory.t[rows])]
    for i, name in enumerate(trajectory.names):
        pose = rr.Transform3D.columns(
            translation=trajectory.pos[rows, i], quaternion=trajectory.quat[rows, i][:, [1, 2, 3, 0]]
        )
        stream.send_columns(_path(name), clock, pose)


def _plots(rr: Any, stream: Any, trajectory: Any) -> None:
    """Energies of the system, heights and speeds of the bodies."""
    rows = _rows(trajectory)
    clock = [rr.TimeColumn("simulated", duration=trajectory.t[rows])]
    if trajectory.energy is not None:
        potential, kinetic = trajectory.energy[rows, 0], trajectory.energy[rows, 1]
        for name, values in (("potential", potential), ("kinetic", kinetic), ("total", potential + kinetic)):
            stream.send_columns(f"energy_j/{name}", clock, rr.Scalars.columns(scalars=values))
    for i, name in enumerate(trajectory.names):
        if trajectory.speed[:, i].max(initial=0.0) > 1e-6:
            entity = name.replace("/", "_")
            stream.send_columns(f"height_m/{entity}", clock, rr.Scalars.columns(scalars=trajectory.pos[rows, i, 2]))
            stream.send_columns(f"speed_m_s/{entity}", clock, rr.Scalars.columns(scalars=trajectory.speed[rows, i]))


def _shapes(rr: Any, stream: Any, trajectory: Any, plan: Plan | None) -> None:
    """What each body looks like, once: a catalog mesh, or the geoms of the recording."""
    meshes = _catalog_meshes(plan) if plan else {}
    for name, parts in meshes.items():
        if name in trajectory.names:
            for i, part in enumerate(parts):
                stream.log(f"{_path(name)}/mesh_{i}", rr.Mesh3D(**part), static=True)
    geoms = [g for g in trajectory.meta.get("geoms", ()) if isinstance(g, dict)]
    shown = {g.get("body") for g in geoms if g.get("group") != COLLISION_GROUP}
    for i, geom in enumerate(geoms):
        body = str(geom.get("body", "world"))
        hidden = geom.get("group") == COLLISION_GROUP and body in shown
        if body in meshes or hidden:
            continue
        shape = _shape(rr, geom, PALETTE[i % len(PALETTE)])
        if shape is None:
            continue
        entity = f"{_path(body) if body in trajectory.names else 'world/fixed'}/{geom.get('name') or f'geom_{i}'}"
        quat = geom.get("quat", (1, 0, 0, 0))
        pose = rr.Transform3D(translation=geom.get("pos", (0, 0, 0)), quaternion=[*quat[1:], quat[0]])
        stream.log(entity, pose, shape, static=True)


def _shape(rr: Any, geom: dict[str, Any], colour: tuple[int, int, int]) -> Any:
    """A geom as an archetype in its own frame; None for planes, which have no end."""
    kind, size = geom.get("type"), geom.get("size", (0, 0, 0))
    solid = {"colors": [colour], "fill_mode": "solid"}
    if kind == "box":
        return rr.Boxes3D(half_sizes=[size], **solid)
    if kind == "sphere":
        return rr.Ellipsoids3D(half_sizes=[[size[0]] * 3], **solid)
    if kind == "ellipsoid":
        return rr.Ellipsoids3D(half_sizes=[size], **solid)
    if kind == "cylinder":
        return rr.Cylinders3D(lengths=[2 * size[1]], radii=[size[0]], **solid)
    if kind == "capsule":  # Rerun's capsule starts at the centre of its lower cap
        return rr.Capsules3D(lengths=[2 * size[1]], radii=[size[0]], translations=[[0, 0, -size[1]]], **solid)
    aabb = geom.get("aabb", ())
    if kind == "plane" or len(aabb) != 6:
        return None
    return rr.Boxes3D(centers=[aabb[:3]], half_sizes=[aabb[3:]], colors=[colour], fill_mode="majorwireframe")


def _catalog_meshes(plan: Plan) -> dict[str, list[dict[str, Any]]]:
    """Mesh arguments by body name, for the plan's catalog objects."""
    import trimesh

    from worldkit import assets

    found: dict[str, list[dict[str, Any]]] = {}
    for row in plan.assets:
        try:
            asset = assets.find(row.filename)
            scale = asset.scale(plan.asset_dimensions.get(row.name, asset.metric_height))
            parts = []
            for path, material in asset.visual:
                mesh: Any = trimesh.load(path, force="mesh", process=False)
                look = asset.materials.get(material, {})
                part = {"vertex_positions": (mesh.vertices + asset.visual_pos) * scale, "triangle_indices": mesh.faces}
                parts.append({**part, "vertex_normals": _normals(mesh), **_look(mesh, look, asset.folder)})
        except (KeyError, OSError, ValueError):
            continue  # without its mesh the body is drawn from its geoms
        found |= dict.fromkeys(row.instances, parts)
    return found


def _normals(mesh: Any) -> Any:
    """Unit normals (V, 3), weighted by the area of the faces around each vertex (no SciPy needed)."""
    import numpy as np

    corners = np.asarray(mesh.vertices)[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    summed = np.zeros((len(mesh.vertices), 3))
    for corner in range(3):
        np.add.at(summed, mesh.faces[:, corner], across)
    return summed / np.maximum(np.linalg.norm(summed, axis=1, keepdims=True), 1e-12)


def _look(mesh: Any, look: Any, folder: Path) -> dict[str, Any]:
    """Texture and colour of a catalog material."""
    import cv2

    arguments: dict[str, Any] = {}
    uv = getattr(mesh.visual, "uv", None)
    texture = look.get("texture")
    image = cv2.imread(str(folder / texture)) if texture and uv is not None else None
    if image is not None and uv is not None:
        arguments |= {"vertex_texcoords": uv * (1, -1) + (0, 1), "albedo_texture": image[:, :, ::-1]}
    if look.get("rgba"):
        arguments["albedo_factor"] = [round(255 * float(c)) for c in look["rgba"]]
    return arguments


def _path(body: str) -> str:
    return f"world/{body.replace('/', '_')}"
