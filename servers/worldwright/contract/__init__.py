"""contract: the four roles of a run, written once, and what makes each coding harness keep to them.

`roles` is the one source. `harnesses` turns it into each harness's own files (`worldwright contract sync`), `guard` is the
program that its hooks call before every tool use, and `lessons` reads what went wrong out of the journals.
"""
