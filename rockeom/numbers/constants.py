"""Constants of physics."""

STANDARD_GRAVITY = 9.81
"""1 g [m/s2] of records and structures, where none is given: so a record of 0.3 g is 0.3 times the
weight of the body that it shakes."""
