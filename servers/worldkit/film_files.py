"""How the files are called in which an author's process hands over the description of a film."""

DESCRIPTION, ARRAYS = "film.json", "film.npz"
