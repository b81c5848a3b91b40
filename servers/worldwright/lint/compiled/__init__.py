"""A world as the engine compiled it: made in the sandbox (`compile_world`), fetched (`fetch`), looked at (`view`)."""
