"""What is seen: in the stills, and how large through their cameras."""
