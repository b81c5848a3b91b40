"""Worldwright: a sentence in, a physically grounded, executable and re-provable world out."""

__version__ = "0.1.0"
