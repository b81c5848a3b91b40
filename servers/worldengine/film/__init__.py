"""The film of a recording: the passes that draw it, their encoding, a window on it."""
