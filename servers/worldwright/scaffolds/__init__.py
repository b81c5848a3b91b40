"""Scaffold a new entry of any shelf, with its code chosen and a case that fails until the entry is written."""
