"""The closed vocabulary of expectations: one measurable claim each, with its typed arguments and known answers.

A folder is a family. An expectation defines `CODE` (`WE…`), `Given` (its arguments, each with a description that says
its unit), `measure(trajectory, given)`, and the cases `GOOD` and `BAD`: pairs of a motion with a known answer (a
function that makes it) and arguments. `EVENT = True` marks a claim that comes true at a moment and is false before it, so
that it can be ordered and its cause tested.
"""
