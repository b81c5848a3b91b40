"""Watch what a plain program does with the engine while it runs for a while in the sandbox."""
