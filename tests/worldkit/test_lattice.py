"""Points in rows and columns are covered by triangles once, all of them turned alike."""

import numpy as np

from worldkit.forms.lattice import lattice


def test_it_covers_its_squares_once_and_faces_up():
    rows, columns = 3, 4
    y, x = np.mgrid[0:rows, 0:columns].astype(float)
    points = np.stack([x, y, 0 * x], -1).reshape(-1, 3)
    faces = lattice(rows, columns)
    a, b, c = (points[faces[:, k]] for k in range(3))
    assert np.allclose(np.cross(b - a, c - a), (0, 0, 1)), "each is half a square"
    assert len(faces) == 2 * (rows - 1) * (columns - 1) == len({tuple(sorted(face)) for face in faces.tolist()})
    assert faces[0].tolist() == [0, 1, 5] and faces[6].tolist() == [0, 5, 4], (
        "cut from the first corner to the opposite one"
    )
