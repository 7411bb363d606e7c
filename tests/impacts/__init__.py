"""Laws of impact on several points, written by hand from mechanics alone: none of the package.

mechanics : the impact as data, and the energy it takes. springs : linear springs at the contacts,
integrated in time. routh : one contact with friction, in closed form. simultaneous : Newton, Moreau
and Poisson by enumeration of what contacts may do. pairwise : one contact after the other, and
three balls. `python -m tests.impacts` counts gains of energy over random landings.
"""
