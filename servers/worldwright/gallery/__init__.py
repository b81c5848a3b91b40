"""The gallery: the accepted worlds under `examples/`, kept small in version control and built completely on demand."""
