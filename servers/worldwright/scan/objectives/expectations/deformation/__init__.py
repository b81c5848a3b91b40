"""Deformation: how chains, ropes, cloth, jellies, joints and tendons change their shape, and whether they regain it."""
