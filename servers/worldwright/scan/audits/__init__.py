"""The audits of truth: what acts and carries (`ledger`), what the time step decides (`refine`), what causes what (`causes`)."""
