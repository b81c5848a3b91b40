"""Rules over programs and MJCF: one module each."""
