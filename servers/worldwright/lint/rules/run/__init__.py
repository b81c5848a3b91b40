"""Rules over what a plain program is seen to do when it runs: one module each."""
