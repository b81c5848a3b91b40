"""The closed vocabulary of expectations: one measurable claim each, with its typed arguments and known answers.

An expectation defines `CODE` (`WE1xx`), `NEEDS` (channels, dotted), `Arguments`, `measure(trajectory, arguments)`, and
the cases `GOOD` and `BAD`: functions that make a `Claim` with the textbook's answer.
"""
