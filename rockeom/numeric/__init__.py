"""Simulation: compiled structures, one integrator, responses. Never imports SymPy."""
