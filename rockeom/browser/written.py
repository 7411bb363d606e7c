"""Names of the text that a set-up writes, see `rockeom.browser.setup`."""

from rockeom.compiler.decorators import Floats, Floats2

MOST_P: int
N_NUMBERS: int
ROWS_X: int
ROWS_T: int
ROWS_Y: int
BODY: int
BOTH_MODE: int
LEFT_FOOT: int
RIGHT_FOOT: int
N_REACTIONS: int


def set_up(
    sliders: Floats, y: Floats, p: Floats, horizontal: Floats2, transverse: Floats2,
    vertical: Floats2, numbers: Floats,
) -> int: ...  # fmt: skip
