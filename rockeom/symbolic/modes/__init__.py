"""Modes out of contacts: which modes there are, and the mode of each.

A mode is a state of each point (open, sticking, slipping to either side) and of each
element (off, on; elastic, yielding). Where points are closed or stuck the accelerations follow from

    M q'' = f + J_N^T lambda_N + J_T^T lambda_T,    gap'' = 0,    slip'' = 0 where it sticks,
    lambda_T = -mu sigma lambda_N where it slips,   sigma = +1 or -1, the sign of the slip rate.

Dependent coordinates, one for each constraint, are eliminated: q_D' = T q_I'. The rest of the
forces of contact vanishes under L, L^T (J_N^T - mu sigma J_T^T) = 0:

    L^T M T q_I'' = L^T (f - M tau),    q'' = T q_I'' + tau,

which is not symmetric where a point slips. Mirror images are one mode, written with the side
s; so are the two signs of a slip, sigma, and the states of an element, chi.

A closed point is frictionless where its law says so: lambda_T = 0, and slip'' is not constrained.
A point with friction that smooth contacts keep from slipping, such as a foot of a block at a smooth
stop, is frictionless, too, or has all its friction: statics leaves open what is between.
"""
