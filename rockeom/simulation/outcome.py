"""`Outcome`: how a motion ended."""

from enum import StrEnum
from typing import Self

from rockeom import codes
from rockeom.codes import OUTCOMES


class Outcome(StrEnum):
    """How a motion ended: the word that sweeps hold, and a `sentence` that explains it.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> run = rk.simulate(block, pulse)
    >>> run.outcome is rk.Outcome.COMPLETED
    True
    >>> run.outcome.sentence
    'The motion was followed to the end of the duration.'
    """

    sentence: str

    def __new__(cls, word: str, sentence: str = "") -> Self:
        outcome = str.__new__(cls, word)
        outcome._value_ = word
        outcome.sentence = sentence
        return outcome

    COMPLETED = OUTCOMES[codes.COMPLETED], "The motion was followed to the end of the duration."
    CAME_TO_REST = OUTCOMES[codes.CAME_TO_REST], "The structure stands at rest in full contact."
    OVERTURNED = OUTCOMES[codes.OVERTURNED], "The structure fell over."
    TOO_MANY_IMPACTS = OUTCOMES[codes.TOO_MANY_IMPACTS], "More impacts than max_impacts allows."
    STALLED = (
        OUTCOMES[codes.STALLED],
        "The step became too small or the steps too many: loosen rtol, or look for a stiff part.",
    )
    CHATTER = OUTCOMES[codes.CHATTER], "Modes followed one another without time going on."
    NOT_FINITE = (
        OUTCOMES[codes.NOT_FINITE],
        "The state became infinite or not a number: check the parameters.",
    )
    NO_SOLUTION = OUTCOMES[codes.NO_SOLUTION], "No mode fits the forces, or the impulses."
    SEVERAL_SOLUTIONS = (
        OUTCOMES[codes.SEVERAL_SOLUTIONS],
        "Several modes fit the forces, or the impulses, with different motions. Rounding errors "
        "hide which of two contacts carries where they are closer than 1e-7 of the structure's "
        "size.",
    )
    OUT_OF_BOUNDS = (
        OUTCOMES[codes.OUT_OF_BOUNDS],
        "It reached a bound of its declaration, beyond which the equations do not hold.",
    )
