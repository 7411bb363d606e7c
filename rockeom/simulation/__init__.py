"""One motion of a structure: case, options, response."""
