"""Every equation decided, by its checks."""

import time
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from enum import Enum

import sympy as sp

from rockeom.thesis.catalogue import EQUATIONS, equation
from rockeom.thesis.checks import CHECKS, Check, Finding, Means
from rockeom.thesis.checks.check import Findings, derived
from rockeom.thesis.dimensions import DimensionError, check_dimensions
from rockeom.thesis.equation import Equation, Relations


class Verdict(Enum):
    """Verdict on an equation by its checks."""

    RIGHT = "right as printed"
    APPROXIMATE = "right to the stated order"
    LIMITED = "right in a limited domain"
    FITTED = "fitted, within a band"
    ASSUMED = "chosen or assumed by the text"
    ERRATUM = "wrong as printed"
    RESTORED = "not legible, restored"
    UNDETERMINED = "not determined by the text"
    UNCHECKED = "not checked"
    FAILED = "failed"

    @property
    def passes(self) -> bool:
        """Whether the equation was checked, and no check contradicts the verdict."""
        return self not in (Verdict.UNCHECKED, Verdict.FAILED)


@dataclass(frozen=True)
class Decision:
    """Equation, its verdict, and the checks that led to it.

    Parameters
    ----------
    equation : Equation
        Equation.
    verdict : Verdict
        Verdict.
    checks : tuple of Check
        Checks.
    findings : tuple of Finding
        Findings on the form that is right; all hold unless the verdict is `FAILED`.
    against : tuple of Finding
        Findings on the printed form of an erratum; at least one must not hold.
    seconds : float
        Time of the checks [s].
    """

    equation: Equation
    verdict: Verdict
    checks: tuple[Check, ...]
    findings: tuple[Finding, ...]
    against: tuple[Finding, ...]
    seconds: float

    @property
    def why(self) -> str:
        """The failure in words; "" without one."""
        if self.verdict is Verdict.UNCHECKED:
            return "no check decides it, other than by its numbers typed twice"
        if self.verdict is not Verdict.FAILED:
            return ""
        wrong = [f"{f.what}: {f.rest}" for f in self.findings if not f.holds]
        wrong += [f"as printed: {f.what}: {f.rest}" for f in self.against if not f.comparable]
        if wrong:
            return "; ".join(wrong)
        return "its checks find nothing wrong with the printed form, or find nothing at all"


@dataclass(frozen=True)
class Report:
    """Decisions, in the order of the thesis.

    Parameters
    ----------
    decisions : tuple of Decision
        Decisions.
    """

    decisions: tuple[Decision, ...]

    @property
    def passes(self) -> bool:
        """Whether all equations pass."""
        return all(d.verdict.passes for d in self.decisions)

    @property
    def counts(self) -> dict[Verdict, int]:
        """How many equations have each verdict; those that none has are left out."""
        counted = Counter(d.verdict for d in self.decisions)
        return {verdict: counted[verdict] for verdict in Verdict if counted[verdict]}


def claim(one: Equation) -> Verdict:
    """Verdict that `decide` gives if every check does its work; runs none.

    Parameters
    ----------
    one : Equation
        Equation.

    Returns
    -------
    Verdict
        Verdict.
    """
    checks = CHECKS.get(one.number, ())
    if not checks:
        return Verdict.UNCHECKED
    if one.undetermined:
        return Verdict.UNDETERMINED
    if one.assumption:
        return Verdict.ASSUMED
    if all(check.means is Means.TRANSCRIBED for check in checks):
        return Verdict.UNCHECKED  # numbers that are typed twice are no evidence
    if one.fitted:
        return Verdict.FITTED
    if one.is_erratum:
        return Verdict.LIMITED if one.domain else Verdict.ERRATUM
    if one.corrected is not None:
        return Verdict.RESTORED
    return Verdict.APPROXIMATE if any(check.error for check in checks) else Verdict.RIGHT


def decide(number: str) -> Decision:
    """Decision on one equation.

    Parameters
    ----------
    number : str
        Number of the equation.

    Returns
    -------
    Decision
        Decision.

    Raises
    ------
    ValueError
        For a number that there is none of.
    """
    one = equation(number)
    start = time.perf_counter()
    checks = CHECKS.get(one.number, ())
    findings = (*_findings(one, one.right, checks), *_domain(one))
    against = _findings(one, one.printed, checks) if one.is_erratum else ()
    verdict = claim(one)
    sound = len(findings) > 1 and all(f.holds for f in findings)  # more than the dimensions
    seen = not one.is_erratum or any(not f.holds for f in against)
    seen = seen and all(f.comparable for f in against)
    if checks and not (sound and seen):
        verdict = Verdict.FAILED
    return Decision(one, verdict, checks, findings, against, time.perf_counter() - start)


def verify(
    numbers: Iterable[str] = EQUATIONS, progress: Callable[[Decision], None] | None = None
) -> Report:
    """Decide equations.

    Parameters
    ----------
    numbers : iterable of str, optional
        Numbers of equations; all of them if none are given.
    progress : callable, optional
        Function that gets each decision.

    Returns
    -------
    Report
        Decisions.
    """
    decisions = []
    for number in numbers:
        decisions.append(decide(number))
        if progress is not None:
            progress(decisions[-1])
    return Report(tuple(decisions))


def _findings(
    one: Equation, relations: Relations, checks: tuple[Check, ...]
) -> tuple[Finding, ...]:
    findings: list[Finding] = []
    for check in (*checks, DIMENSIONS):
        try:
            findings += check.find(one, *relations)
        except Exception as error:  # one equation that cannot be compared must not hide the others
            message = f"{type(error).__name__}: {error}"
            findings.append(
                Finding(f"{check.route}: not comparable", message, False, comparable=False)
            )
    return tuple(findings)


def _same_dimensions(equation: Equation, *relations: sp.Eq) -> Findings:
    try:
        check_dimensions(equation, relations)
    except DimensionError as error:
        yield Finding("dimensions of its terms", str(error), False)
    else:
        yield Finding("dimensions of its terms", "alike", True)


DIMENSIONS = derived("units of its symbols and numbers", _same_dimensions)
"""A check of all equations, which decides none by itself."""


def _domain(one: Equation) -> Findings:
    """Check that printed minus right form vanishes in the domain, and only there."""
    if one.domain is None:
        return
    for where, cases in (("inside", one.domain.inside), ("outside", one.domain.outside)):
        for case in cases:
            rests = [sp.simplify(sp.refine(sp.sympify(e), case)) for e in one.excess]
            gone = all(rest == 0 for rest in rests)
            holds = gone is (where == "inside")
            yield Finding(f"excess {where} the domain, {case}", rests, holds)
