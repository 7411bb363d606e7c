"""What was derived, for other programs: the equations as C and MATLAB, models for OpenSees."""

from rockeom.exports.code import LANGUAGES, code

__all__ = ["LANGUAGES", "code"]
