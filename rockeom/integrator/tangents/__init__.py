"""Derivatives along a motion: the texts of the loop once more, printed for duals."""
