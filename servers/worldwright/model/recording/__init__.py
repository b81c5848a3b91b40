"""A recorded motion as data: poses, contacts, loads, mechanics."""
