"""From a declaration to a structure: where derivation and simulation are joined."""
