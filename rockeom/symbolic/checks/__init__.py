"""Checks of a declaration, of what follows from it, and of the values of its parameters."""
