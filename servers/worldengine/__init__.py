"""The engine owns a world while it runs: the clock, the inputs, the recording, variants, and the film."""
