"""What was derived, for other programs: the equations as C and MATLAB, models for OpenSees."""

from rockeom.exports.code import LANGUAGES, code, code_of_model

__all__ = ["LANGUAGES", "code", "code_of_model"]
