"""The means by which expectations and questions measure: channels, curves, energy, immersion."""
