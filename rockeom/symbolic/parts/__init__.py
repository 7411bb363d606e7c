"""Parts of structures: what stands on a base, and what the base stands on.

Any superstructure stands on any support: `superstructures` gives masses as a function of how the
base moves, `supports` gives that motion and what holds it.
"""
