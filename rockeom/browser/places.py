"""Places in the numbers of a problem, which a set-up writes and the questions of a page read."""

NUMBERS = 10
(
    OF_MODE, OF_LAW, OF_RATIO, OF_FALLEN, OF_END, OF_QUIET, OF_ROWS_X, OF_ROWS_T, OF_ROWS_Y,
    OF_SIZE,
) = range(NUMBERS)  # fmt: skip
"""Places in the numbers of a problem: OF_ROWS_X and OF_ROWS_Y are the rows of the ground motions,
OF_SIZE the length of p."""
