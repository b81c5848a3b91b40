"""Principal values and directions of a symmetric 3 x 3 matrix, and how a left Cauchy-Green tensor grows, as compiled functions."""

import numpy as np

from .kernels import kernel

SWEEPS = 8
"""Jacobi's rotations converge quadratically: after three or four sweeps nothing is left."""


@kernel
def grown(b, c, dt, f, out):
    """Write F b F^T with F = I + dt c into out (3, 3); b (6,) is xx, yy, zz, xy, xz, yz; f (3, 3) is room."""
    for i in range(3):
        for j in range(3):
            f[i, j] = dt * c[i, j] + (1.0 if i == j else 0.0)
    for i in range(3):
        t0 = f[i, 0] * b[0] + f[i, 1] * b[3] + f[i, 2] * b[4]
        t1 = f[i, 0] * b[3] + f[i, 1] * b[1] + f[i, 2] * b[5]
        t2 = f[i, 0] * b[4] + f[i, 1] * b[5] + f[i, 2] * b[2]
        for j in range(3):
            out[i, j] = t0 * f[j, 0] + t1 * f[j, 1] + t2 * f[j, 2]


@kernel
def principal(a, q):
    """Turn a (3, 3), symmetric, into its diagonal, and write its directions as columns of q (3, 3): Jacobi's rotations.

    Source: Golub and Van Loan, Matrix Computations, section 8.5.
    """
    for i in range(3):
        for j in range(3):
            q[i, j] = 1.0 if i == j else 0.0
    for _ in range(SWEEPS):
        off = abs(a[0, 1]) + abs(a[0, 2]) + abs(a[1, 2])
        if off <= 1e-14 * (abs(a[0, 0]) + abs(a[1, 1]) + abs(a[2, 2])):
            return
        for p in range(2):
            for r in range(p + 1, 3):
                if a[p, r] == 0.0:
                    continue
                ratio = (a[r, r] - a[p, p]) / (2.0 * a[p, r])
                t = (1.0 if ratio >= 0.0 else -1.0) / (abs(ratio) + np.sqrt(ratio * ratio + 1.0))
                cosine = 1.0 / np.sqrt(t * t + 1.0)
                sine = t * cosine
                for k in range(3):
                    one, two = a[k, p], a[k, r]
                    a[k, p], a[k, r] = cosine * one - sine * two, sine * one + cosine * two
                for k in range(3):
                    one, two = a[p, k], a[r, k]
                    a[p, k], a[r, k] = cosine * one - sine * two, sine * one + cosine * two
                for k in range(3):
                    one, two = q[k, p], q[k, r]
                    q[k, p], q[k, r] = cosine * one - sine * two, sine * one + cosine * two


@kernel
def rebuilt(s0, s1, s2, q, out):
    """Write q diag(s) q^T into out (6,)."""
    out[0] = s0 * q[0, 0] ** 2 + s1 * q[0, 1] ** 2 + s2 * q[0, 2] ** 2
    out[1] = s0 * q[1, 0] ** 2 + s1 * q[1, 1] ** 2 + s2 * q[1, 2] ** 2
    out[2] = s0 * q[2, 0] ** 2 + s1 * q[2, 1] ** 2 + s2 * q[2, 2] ** 2
    out[3] = s0 * q[0, 0] * q[1, 0] + s1 * q[0, 1] * q[1, 1] + s2 * q[0, 2] * q[1, 2]
    out[4] = s0 * q[0, 0] * q[2, 0] + s1 * q[0, 1] * q[2, 1] + s2 * q[0, 2] * q[2, 2]
    out[5] = s0 * q[1, 0] * q[2, 0] + s1 * q[1, 1] * q[2, 1] + s2 * q[1, 2] * q[2, 2]
