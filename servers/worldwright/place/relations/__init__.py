"""Relation templates: named geometric contracts between a body and a reference, one module each."""
