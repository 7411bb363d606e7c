"""Parts of structures: superstructures on a base, supports under it, and bodies of SymPy.

Any superstructure stands on any support: `superstructures` gives masses as a function of how the
base moves, `supports` gives that motion and what holds it. `mechanics` makes parts of a model of
bodies of `sympy.physics.mechanics`.
"""
