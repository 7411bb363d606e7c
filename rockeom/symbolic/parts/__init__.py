"""Parts of structures: superstructures on a base, and supports under it.

Any superstructure stands on any support: `superstructures` gives masses as a function of how the
base moves, `supports` gives that motion and what holds it.
"""
