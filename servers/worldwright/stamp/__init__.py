"""Stamp: what has been proven so far, and is it enough?

Nothing here is stored state: what holds is derived from the files of the run folder at every call, and evidence
counts only for the exact program, plan and environment it was made with. A run ends accepted (a bundle that can be
proven again) or blocked (with its cause); there is no third ending.
"""
