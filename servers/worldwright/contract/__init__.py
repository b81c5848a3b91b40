"""contract: the four roles of a run, written once, and the means by which each coding harness keeps to them.

`roles` is the one source. `generated` turns it into the harnesses' own files (`worldwright contract sync`),
with one module of `harnesses` for each; `guard` is the program that their hooks call before every tool use, `shell` starts
a command without the right to write to the runs, and `lessons` reads from the journals what went wrong.
"""
