"""The installed simulator as data: its Python symbols, its MJCF schema, its changelog, its manual.

Nobody remembers the right version. Everything here is read from the build that is installed: names and signatures by
introspecting the package, elements and attributes from the manual's schema page, renames and removals from the shipped
changelog. Tables are built once per version and cached on disk; importing this package imports no simulator.
"""
