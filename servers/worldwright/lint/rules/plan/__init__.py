"""Rules over plans: one module each."""
