"""All equations of the thesis, by number, in its order."""

from types import MappingProxyType

from rockeom.numbers.checks import InputError
from rockeom.thesis.appendix_b import APPENDIX_B
from rockeom.thesis.appendix_d import APPENDIX_D
from rockeom.thesis.chapter_2 import CHAPTER_2
from rockeom.thesis.chapter_3 import CHAPTER_3
from rockeom.thesis.chapter_4 import CHAPTER_4
from rockeom.thesis.chapter_5 import CHAPTER_5
from rockeom.thesis.equation import Equation, place_of
from rockeom.thesis.section_2_6 import SECTION_2_6

_TYPED = (*CHAPTER_2, *SECTION_2_6, *CHAPTER_3, *CHAPTER_4, *CHAPTER_5, *APPENDIX_B, *APPENDIX_D)
EQUATIONS = MappingProxyType({e.number: e for e in sorted(_TYPED, key=place_of)})


def equation(number: str) -> Equation:
    """The equation of a number such as "5-34".

    Raises ValueError, with the nearest numbers there are, for one that is not in the catalogue.
    """
    asked = number.strip().lower()
    match = next((e for n, e in EQUATIONS.items() if n.lower() == asked), None)
    if match is None:
        chapter = asked.partition("-")[0].upper()
        there = [n for n in EQUATIONS if n.startswith(f"{chapter}-")]
        hint = f"chapter {chapter} has {there[0]} to {there[-1]}" if there else _chapters()
        raise InputError("number", number).says(f"there is no equation {number!r}: {hint}")
    return match


def _chapters() -> str:
    return f"chapters are {', '.join(sorted({e.chapter for e in EQUATIONS.values()}))}"
