"""Rigid assemblies: a body without a joint is part of the rigid body that carries it, however it was modelled.

A suitcase with its posts, runners and books, each a body of its own welded to the case, is one thing: it moves, is
pushed, rests and weighs as one. Each assembly is called by its head, the body that carries the others. What has no
joint up to the world is scenery: one assembly for each body that stands in the world itself.

Source: MuJoCo manual, kinematic tree ("a body without joints is welded to its parent").
"""

from collections.abc import Collection, Sequence

import numpy as np

Array = np.ndarray


def heads(parent: Array, jointed: Array, apart: Collection[int] = ()) -> Array:
    """(B,) index of the body that heads each one's assembly: the next at or above it with a joint, or in the world.

    Args:
        parent: (B,) index of each body's parent, -1 for the world; in any order.
        jointed: (B,) bool: has a joint of its own.
        apart: bodies that head what is welded on below them, joint or not.
    """
    stops = np.asarray(jointed, dtype=bool) | (np.asarray(parent) < 0)
    stops[list(apart)] = True
    found = np.arange(len(parent))
    for _ in range(len(parent)):
        up = np.where(stops[found], found, parent[found])
        if (up == found).all():
            break
        found = up
    return found


def any_member(head: Array, mark: Array) -> Array:
    """(B,) bool: whether `mark` (B,) is true of any body of the same assembly."""
    return np.isin(head, head[np.asarray(mark, dtype=bool)])


def loose(head: Array, parent: Array, joints: Sequence[Sequence[str]], dynamic: Array, bound: Array) -> Array:
    """(B,) bool: the assembly is one loose rigid body: a free joint, nothing jointed to it, and no tie to anything.

    Args:
        head: (B,) what `heads` found.
        parent: (B,) as there.
        joints: (B) the types of each body's joints.
        dynamic: (B,) bool: has a degree of freedom at or above it.
        bound: (B,) bool: an equality or a tendon holds it.
    """
    carries = np.zeros(len(head), dtype=bool)
    hung = np.flatnonzero((head == np.arange(len(head))) & (parent >= 0) & dynamic)
    carries[parent[hung]] = True
    free = np.array([list(joints[h]) == ["free"] for h in head], dtype=bool)
    return free & ~any_member(head, carries | bound)
