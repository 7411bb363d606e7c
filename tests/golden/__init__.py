"""Bits of motions compared between commits, on one machine."""
