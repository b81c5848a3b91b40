"""The two shelves of lint rules: `program` (WL…) and `plan` (WP…)."""
