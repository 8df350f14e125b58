"""Machines by exact homogeneous matrices: the oracle of the linear rule, which it shares nothing with."""

import numpy as np


def _rotation(a, b, c):
    """Small rotations about X, Y, Z, exactly orthogonal: R = Rz(c)·Ry(b)·Rx(a)."""
    ca, sa, cb, sb, cc, sc = np.cos(a), np.sin(a), np.cos(b), np.sin(b), np.cos(c), np.sin(c)
    x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    y = np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    z = np.array([[cc, -sc, 0], [sc, cc, 0], [0, 0, 1]])
    return z @ y @ x


def _frame(rotation, translation):
    frame = np.eye(4)
    frame[:3, :3], frame[:3, 3] = rotation, translation
    return frame


def _joint(axis, q, errors):
    """A joint that moves by q along its axis, with its errors as measured at the carriage's origin."""
    moved = np.zeros(3)
    moved["XYZ".index(axis)] = q
    error = np.array([errors.get(f"E{d}{axis}", 0.0) for d in "XYZ"])
    turned = _rotation(*[errors.get(f"E{d}{axis}", 0.0) for d in "ABC"])
    return _frame(np.eye(3), moved) @ _frame(turned, error)


def exact_deviation(letters, position, tool, errors):
    """Δ of the tool relative to the workpiece, in workpiece coordinates, of a chain of rigid bodies.

    On the tool's side a carriage moves by +q from the bed outwards; on the workpiece's side it moves by −q,
    and its errors are those of the tool as the workpiece sees it: the inverse of a joint with these errors.
    The whole chain is then a plain product of joints from workpiece to tool, whichever is fixed to the bed.
    """
    found = np.eye(4)
    for axis in letters.replace("F", ""):
        found = found @ _joint(axis, position["XYZ".index(axis)], errors)
    actual = (found @ np.array([*tool, 1.0]))[:3]
    return actual - (np.asarray(position) + np.asarray(tool))
