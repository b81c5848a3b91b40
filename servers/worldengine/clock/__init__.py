"""The clock advances a world step by step."""
