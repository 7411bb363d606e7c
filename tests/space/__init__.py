"""Structures in space, against integrations in 40 digits that share nothing with the package."""
