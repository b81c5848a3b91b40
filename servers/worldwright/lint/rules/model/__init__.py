"""Rules over compiled worlds: one module each."""
