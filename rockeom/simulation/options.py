"""Options of the integrator."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rockeom.integrator.methods.coefficients import PAIRS
from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, near, number, options_of, require, whole_number

METHODS = (*PAIRS, "Radau")
"""Explicit ones, and the implicit one of implicit.py."""


@explained.record(tol="rtol=", tolerance="rtol=", dt="output_step= or max_step=")
@dataclass(frozen=True)
class SolverOptions:
    """Choices of the integration; the defaults suit all shipped structures.

    Parameters
    ----------
    method : str, optional
        None, for one that suits the work; or "DOP853" (order 8) or "RK45" (order 5), explicit; or
        "Radau" (order 5), implicit, for springs so stiff and so heavily damped that stability
        bounds an explicit step, to some 7 over the fastest rate of decay.
    rtol : float, optional
        Relative tolerance of each state in a step.
    atol : float, optional
        Absolute tolerance of each state in a step, in the state's own unit.
    max_step : float, optional
        Largest step [s].
    steps_per_segment : int, optional
        0 for steps controlled by the tolerances; n > 0 for n equal steps in each segment of the
        ground's motion: between two samples of a record, or over a whole pulse or quiet time.
    rest_tolerance : float, optional
        Impacts that will all happen within this time, in units of the rocking motion's own time
        1/sqrt(acceleration), are completed at once by their closed-form sum. Where contacts open
        and close, the unit is sqrt(l/a), l the radius of gyration and a the acceleration of a
        contact point in free motion.
    max_impacts : int, optional
        Number of impacts at which a motion is given up, with an outcome that says so.
    max_steps : int, optional
        Number of steps at which a motion is given up, with an outcome that says so.
    output_step : float, optional
        Largest spacing of the samples of the response [s]; None for 1/4000 of the duration.

    Raises
    ------
    TypeError
        For values of the wrong kind.
    ValueError
        For an unknown method, and numbers out of their ranges.

    Notes
    -----
    A step of Radau costs about as much as one of DOP853, but their number goes with
    ``rtol**(-1/4)``: at the default a rocking block takes 1300 of them where DOP853 takes 50, a
    structure on springs of 1e9 N/m and 1e8 N s/m 5600 against 72 000. Vibrations that are not
    damped away it must follow, too, and gains nothing. On stiff springs let atol be far below their
    settlement, or contact chatters.

    The method None is DOP853 but for two kinds of work. It is Radau where stability would ask for
    more than 20 000 explicit steps, and for four times as many as accuracy asks of Radau: by the
    fastest decay and the fastest other motion of the structure, linearised at rest in each mode. It
    is RK45 where rtol is 1e-6 or more and the steps, which end at the samples of a record, are
    shorter than ``rtol**(1/5)`` over the fastest rate of motion. The choice and its reason are in
    the `statistics` of a response.

    With equal steps impacts are landed on all the same. Where the estimated error of such a step
    exceeds 1e-7 (1e-3 with Radau, whose estimate is of a much lower order than its error; or rtol,
    if that is more) it is refused, and the rest of that segment is integrated with steps controlled
    by the tolerances; ``statistics["refined"]`` of a response counts these segments. Behind the end
    of the motion steps are controlled.

    Where contacts open and close, flights lower than 1e-13 of the coordinates are lost among
    rounding errors: they are summed up to 1e-5 of the unit of `rest_tolerance`, or end at once.
    Events that follow one another without end at one instant, and slow landings that no mode may
    follow, are stepped over: a time step of Moreau, as long as a rest may be, without restitution.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
    >>> pulse = rk.GroundMotion.single_sine(amplitude=3.5, period=0.4, duration=4.0)  # m/s2, s
    >>> coarse = rk.SolverOptions(rtol=1e-6, atol=1e-8)
    >>> print(rk.simulate(block, pulse, options=coarse).outcome)
    completed
    """

    method: str | None = None
    rtol: float = 1e-10
    atol: float = 1e-12
    max_step: float = math.inf
    steps_per_segment: int = 0
    rest_tolerance: float = 1e-6
    max_impacts: int = 100_000
    max_steps: int = 20_000_000
    output_step: float | None = None

    def __post_init__(self) -> None:
        if self.method is not None and self.method not in METHODS:
            *others, last = map(repr, METHODS)
            hint = near(self.method, METHODS)
            raise InputError("method", self.method).wrong(
                f"is {self.method!r}{hint}: choose {', '.join(others)} or {last}"
            )
        # Compiled code knows a number by its type: kept are float and int, whatever was given.
        for name in ("rtol", "atol", "max_step", "rest_tolerance", "output_step"):
            if name == "output_step" and self.output_step is None:
                continue
            value = number(name, getattr(self, name), bounds="a positive number")
            require(value > 0, "", name, value, "it must be positive")
            object.__setattr__(self, name, value)
        for name, least in (("max_impacts", 1), ("max_steps", 1), ("steps_per_segment", 0)):
            object.__setattr__(self, name, whole_number(name, getattr(self, name), least))
        require(self.rtol >= 1e-15, "", "rtol", self.rtol, "below 1e-15 rounding errors rule")

    def spacing(self, duration: float) -> float:
        """Largest spacing of the samples of a response.

        Parameters
        ----------
        duration : float
            Duration of the response [s].

        Returns
        -------
        float
            Spacing [s].
        """
        return self.output_step or duration / 4000

    @classmethod
    def of(cls, options: SolverOptions | None) -> SolverOptions:
        """Options, or the defaults for None.

        Parameters
        ----------
        options : SolverOptions
            Options or None.

        Returns
        -------
        SolverOptions
            Options.

        Raises
        ------
        TypeError
            For anything else.
        """
        return options_of("options", options, cls, "rk.SolverOptions(rtol=1e-8)")
