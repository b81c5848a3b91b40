"""The scan for implausible motion: its engine, what a check may ask, and the shelf of checks."""
