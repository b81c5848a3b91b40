"""The same world with one thing changed: a finer step, a cause taken away, a cause made weaker, a number a little otherwise."""
