"""Transitions between modes that are searched, not declared."""
