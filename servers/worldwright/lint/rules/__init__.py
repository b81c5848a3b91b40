"""The four shelves of lint rules: `program` (WL…), `model` (WM…), `run` (WR…) and `plan` (WP…)."""
