"""Recordings: their columns, how they are written and read, what they tell about their world, how they are shown again."""
