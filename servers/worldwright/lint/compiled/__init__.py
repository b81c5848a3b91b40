"""A world as the engine compiled it, as plain data: made in the sandbox (`probe`), fetched (`fetch`), looked at (`view`)."""
