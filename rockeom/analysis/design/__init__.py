"""Procedures of design: from a motion or a spectrum to a rotation, a displacement, a base shear."""
