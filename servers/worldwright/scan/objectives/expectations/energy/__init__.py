"""Energy and momentum: what is conserved, lost, exchanged and turned from one form into another."""
