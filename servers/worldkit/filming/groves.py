"""Trees as things of a film: each differs from the others, stands where it is put, and sways in a breeze; drawn only."""

from collections.abc import Sequence

import numpy as np

from ..errors import ProgramError
from . import species, swaying_weights, trees
from .drawn_only import Surface, Thing, matt
from .ground import Height

KINDS = (*trees.KINDS, *species.NAMES)
MOST_TREES, TRIANGLES, FULL = 100, 600_000, 24_000
"""Of one call; of all its trees together; of one tree at most, however few they are."""
STILL = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)
TITLES = ("leaves, deep in the crown", "leaves", "leaves, where light falls")
Meshes = list[trees.Mesh]


def planted(
    name: str,
    kind: str,
    at: Sequence[tuple[float, float]],
    ground: Height,
    height: float,
    season: str,
    leaves: str | Surface,
    bark: str | Surface,
    seed: int,
) -> list[Thing]:
    """One thing for the wood of all of them, and one or three for their leaves.

    Raises:
        ProgramError: there is no such kind, height or season, no or too many places, or one of them is beside the ground.
    """
    if not 0 < height < np.inf:
        raise ProgramError(f"trees {name!r} are {height} m high", "film.py", "give them a height over 0, m")
    if kind not in KINDS or not 1 <= len(at) <= MOST_TREES:
        raise ProgramError(
            f"1 to {MOST_TREES} trees of {' or '.join(KINDS)}, got {len(at)} of {kind!r}", "film.py", "name one of them"
        )
    if season not in species.SEASONS:
        raise ProgramError(f"there is no season {season!r}", "film.py", f"use one of: {', '.join(species.SEASONS)}")
    places = np.asarray(at, dtype=float).reshape(-1, 2)
    levels = np.asarray(ground(places[:, 0], places[:, 1]), dtype=float)
    if not np.isfinite(levels).all():
        where = places[~np.isfinite(levels)][0].tolist()
        raise ProgramError(f"a tree of {name!r} at {where} stands beside its ground", "film.py", "move it")
    random = np.random.default_rng(seed)
    feet = np.column_stack([places, levels - 0.02])
    if kind in trees.KINDS:
        return _simple(name, kind, feet, height, leaves, bark, random)
    return _of_species(name, kind, feet, height, season, leaves, bark, random)


def _simple(
    name: str,
    kind: str,
    feet: np.ndarray,
    height: float,
    leaves: str | Surface,
    bark: str | Surface,
    random: np.random.Generator,
) -> list[Thing]:
    """By one rule, for woods that are far away: at most 6000 triangles a tree."""
    parts: list[Meshes] = [[], []]
    sways: list[list[np.ndarray]] = [[], []]
    for foot in feet:
        one = trees.tree(kind, height * random.uniform(0.8, 1.1), int(random.integers(1 << 30)))
        parts[0].append((one.wood + foot, one.wood_faces))
        parts[1].append((one.leaves + foot, one.leaf_faces))
        sways[0].append(swaying_weights.of_wood(one.wood, height))
        sways[1].append(swaying_weights.of_leaves(one.leaves, height))
    green = leaves or {"conifer": "#2f4a2c", "broadleaf": "foliage"}[kind]
    return [
        _thing(name, bark or "#5b4a3a", parts[0], sways[0]),
        _thing(f"{name} (leaves)", green, parts[1], sways[1]),
    ]


def _of_species(
    name: str, kind: str, feet: np.ndarray, height: float, season: str, leaves: str | Surface, bark: str | Surface,
    random: np.random.Generator,
) -> list[Thing]:  # fmt: skip
    """As it grows: the fewer there are, the finer; leaves in three hues unless one look is asked for."""
    each = min(FULL, TRIANGLES // len(feet))
    wood: Meshes = []
    bends: list[np.ndarray] = []
    crowns: list[Meshes] = [[] for _ in range(species.HUES)]
    flutters: list[list[np.ndarray]] = [[] for _ in range(species.HUES)]
    for foot in feet:
        tall = height * random.uniform(0.85, 1.1) if kind != "hedge" else height
        one = species.grown(kind, tall, season, int(random.integers(1 << 30)), each)
        turn = random.uniform(0, 2 * np.pi) if kind != "hedge" else 0.0
        about = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1.0]])
        wood.append((one.wood @ about.T + foot, one.wood_faces))
        bends.append(swaying_weights.of_wood(one.wood, tall))
        for hue, cards in enumerate(one.leaves):
            if len(cards):
                k = 4 * np.arange(len(cards))[:, None]
                faces = np.concatenate([k + np.array(pair) for pair in ((0, 1, 2), (0, 2, 3))])
                crowns[hue].append((cards.reshape(-1, 3) @ about.T + foot, faces))
                flutters[hue].append(swaying_weights.of_leaves(cards.reshape(-1, 3), tall))
    own_bark, hues = species.looks(kind, season)
    made = [_thing(name, bark or own_bark, wood, bends)]
    for hue, title in enumerate(TITLES):
        if crowns[hue]:
            made.append(_thing(f"{name} ({title})", leaves or hues[hue], crowns[hue], flutters[hue]))
    return made


def _thing(title: str, look: str | Surface, parts: Meshes, sways: list[np.ndarray]) -> Thing:
    points, faces = trees.joined(parts)
    return Thing(
        title, "mesh", (1, 1, 1), matt(look), *STILL, vertices=points, faces=faces, sways=np.concatenate(sways)
    )
