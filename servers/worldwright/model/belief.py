"""How far pictures are to be believed, asked where they are first seen: the description is asked for it only after minutes of drawing."""

BELIEVED = 7
"""Of 10: below it, one repair of the look is due."""
JUDGE_NOW = f"judge belief now, 0 to 10: would I take this for a film of real things? Below {BELIEVED}, mend it before the video pass"
