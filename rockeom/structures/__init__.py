"""Structures as users name them, bound to generated modules. Never imports SymPy."""
