"""Derived equations as text: pages, plain letters for LaTeX, and the display in notebooks."""
