"""Derived equations as text: pages, LaTeX read into plain letters, and what a notebook shows."""
