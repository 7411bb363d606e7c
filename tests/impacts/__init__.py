"""Laws of impact on several points, written by hand from mechanics alone: none of the package.

mechanics : the impact as data, and the energy it takes. springs : linear springs at the contacts,
integrated in time. routh : one contact with friction, in closed form. simultaneous : Newton, Moreau
and Poisson by enumeration of what contacts may do. poisson_path : Poisson with friction at every
moment. pairwise : one contact after the other, and three balls. energy : where laws cannot gain,
and examples where they do. against, shipped : the package on the same impacts.
`python -m tests.impacts` counts gains of energy over random landings.
"""
