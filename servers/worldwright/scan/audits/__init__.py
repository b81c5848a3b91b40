"""The audits: what acts and carries (`acting`), what the time step decides (`refine`), what causes what (`causes`)."""
