"""Cross-check questions about a recording, and their answers."""
