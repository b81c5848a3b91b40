"""What hangs together by its links, such as the separate surfaces of a mesh.

Not scipy's `connected_components`: its `scipy.sparse` takes a third of a second of processor time to import, which most processes
that draw a few pictures would pay for one call.
"""

import numpy as np


def pieces(links: np.ndarray, count: int) -> np.ndarray:
    """(count,) the number of the piece in which each thing is, counted by the first thing of each.

    Args:
        links: (N, 2) numbers of things that hang together.
        count: so many things there are.
    """
    root = np.arange(count)
    while len(links):
        ends = root[links]
        apart = ends[:, 0] != ends[:, 1]
        links, ends = links[apart], ends[apart]
        np.minimum.at(root, ends.max(axis=1), ends.min(axis=1))  # a root never goes up, so that there are no circles
        while not np.array_equal(further := root[root], root):
            root = further
    return np.unique(root, return_inverse=True)[1].reshape(-1)
