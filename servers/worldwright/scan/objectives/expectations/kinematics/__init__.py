"""Kinematics: where bodies go, along which curve, how fast."""
