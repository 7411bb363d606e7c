"""The derived equations for other programs: as C and MATLAB, and models for OpenSees."""

from rockeom.exports.code import LANGUAGES, code, code_of_model

__all__ = ["LANGUAGES", "code", "code_of_model"]
