"""Drawings of structures, ground motions, responses and sweeps.

Their classes lie below and ask for a picture by name (`rockeom.numbers.pictures`); `shown` has
those. Whatever needs an analysis is in `rockeom.plots`, which has the public names of both.
"""
