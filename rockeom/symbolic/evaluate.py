"""Vectorised NumPy functions of a model, for notebooks and for checks of the generated code."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cached_property

import numpy as np
import sympy as sp

from rockeom.numbers.checks import InputError
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.mode import Transition
from rockeom.symbolic.reactions import reactions

Function = Callable[[Sequence], np.ndarray]
Table = tuple[tuple[str, ...], Function]
"""Names, and the function that gives their values."""


class _Opening:
    """Acceleration with which a rocking mode would open from closed and at rest."""

    def __init__(self, model: HybridModel, transition: Transition, given: list[sp.Symbol]) -> None:
        rotation, target = model.rotation, transition.target
        mode, equations = model.mode(target), model.equations(target)
        closed = {rotation.position: 0, rotation.velocity: 0}

        def still(m: sp.Matrix) -> sp.Matrix:
            return m.applyfunc(lambda e: model.in_mode(e, target).subs(closed))

        self._side = mode.side_of(target)
        self._row = [c.name for c in mode.coordinates].index(rotation.name)
        self._mass_matrix = array_function(given, still(equations.mass_matrix))
        self._forcing = array_function(given, still(equations.forcing))

    def __call__(self, values: Sequence) -> np.ndarray:
        found = _solved(self._mass_matrix(values), self._forcing(values))
        return self._side * found[self._row]


class NumpyMode:
    """One mode of a model as functions of arrays.

    Every method has the arguments ``y``, the states (N, ...) in the order of `states`, whose
    trailing shape is free; ``parameters``, values by name, all of the model's and no other, each a
    number or an array that broadcasts with a state: parameter studies need no loop; and ``ax`` and
    ``ay``, accelerations of the ground [m/s2], numbers or arrays that broadcast with a state. It
    raises ValueError for a wrong number of states and for missing or unknown parameters. Units are
    those of the model, SI. `coordinates` are the d free ones; those held still do not move.

    Parameters
    ----------
    model : HybridModel
        Model.
    name : str
        Name of the mode.

    Examples
    --------
    With states and parameters::

        mode = rk.derive("rigid_block").lambdify()["right"]
        mode.accelerations([theta, theta_dot], {"mass": 1.0, "half_width": 0.1, ...}, ax=1.2)
    """

    def __init__(self, model: HybridModel, name: str) -> None:
        mode = model.mode(name)
        self._model, self._mode = model, mode
        self.name = name
        self.states = model.states
        self.parameters = tuple(p.name for p in model.parameters)
        self.coordinates = tuple(c.name for c in mode.coordinates)
        self._rows = [model.states.index(name) for name in self.coordinates]

    # each made at its first use: printing the longer expressions takes a second

    @cached_property
    def _arguments(self) -> list[sp.Symbol]:
        q = [c.position for c in self._model.coordinates]
        qd = [c.velocity for c in self._model.coordinates]
        given = [p.symbol for p in self._model.parameters]
        return [*given, *self._model.constants, *q, *qd, *self._model.shaking]

    def _function(self, expressions: Iterable[sp.Expr], *more: sp.Symbol) -> Function:
        exact = (self._model.in_mode(e, self.name) for e in expressions)
        return array_function([*self._arguments, *more], exact)

    def _table(self, named: Mapping[str, sp.Expr], *more: sp.Symbol) -> Table:
        return tuple(named), self._function(named.values(), *more)

    @cached_property
    def _constants(self) -> Function:
        given = [p.symbol for p in self._model.parameters]
        return array_function(given, self._model.constants.values())

    @cached_property
    def _mass_matrix(self) -> Function:
        return self._function(self._mode.equations.mass_matrix)

    @cached_property
    def _forcing(self) -> Function:
        return self._function(self._mode.equations.forcing)

    @cached_property
    def _energies(self) -> Table:
        names = ("kinetic_energy", "gravitational_energy", "elastic_energy")
        return self._table({name: getattr(self._mode.equations, name) for name in names})

    @cached_property
    def _reactions(self) -> Table:
        found = reactions(self._model, self._mode) | self._mode.quantities_in("N")
        return self._table(found, *(c.acceleration for c in self._mode.coordinates))

    @cached_property
    def _positions(self) -> Table:
        mode = self._mode
        places = {body.name: body.position for body in mode.bodies}
        places |= {f"{name}_foot": foot.position for name, foot in mode.feet.items()}
        return self._table(
            {
                f"{name}.{i}": mode.approximated(place[i])
                for name, place in places.items()
                for i in range(len(place))
            }
        )

    @cached_property
    def _leaving(self) -> list[Transition]:
        return [t for t in self._model.transitions if t.source == self.name]

    @cached_property
    def _switches(self) -> Table:
        return self._table({t.target: t.guard for t in self._leaving if t.guard is not None})

    @cached_property
    def _uplifts(self) -> dict[str, _Opening]:
        return {
            t.target: _Opening(self._model, t, self._arguments)
            for t in self._leaving
            if t.kind == "uplift"
        }

    def mass_matrix(self, y, parameters: Mapping[str, float]) -> np.ndarray:
        """Mass matrix M of M q'' = f.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.

        Returns
        -------
        ndarray
            Matrix (d, d, ...).
        """
        found = self._mass_matrix(self._values(y, parameters))
        d = len(self.coordinates)
        return found.reshape(d, d, *found.shape[1:])

    def forcing(self, y, parameters: Mapping[str, float], ax=0.0, ay=0.0) -> np.ndarray:
        """Right side f of M q'' = f.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.
        ax : array_like, optional
            Horizontal acceleration of the ground [m/s2].
        ay : array_like, optional
            Vertical acceleration of the ground [m/s2].

        Returns
        -------
        ndarray
            Vector (d, ...).
        """
        return self._forcing(self._values(y, parameters, ax, ay))

    def accelerations(self, y, parameters: Mapping[str, float], ax=0.0, ay=0.0) -> np.ndarray:
        """Accelerations q'' of the free coordinates.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.
        ax : array_like, optional
            Horizontal acceleration of the ground [m/s2].
        ay : array_like, optional
            Vertical acceleration of the ground [m/s2].

        Returns
        -------
        ndarray
            Accelerations (d, ...).
        """
        values = self._values(y, parameters, ax, ay)
        return _solved(self._mass_matrix(values), self._forcing(values))

    def rates(self, y, parameters: Mapping[str, float], ax=0.0, ay=0.0) -> np.ndarray:
        """Rates of all states, as an integrator wants them; those held still are zero.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.
        ax : array_like, optional
            Horizontal acceleration of the ground [m/s2].
        ay : array_like, optional
            Vertical acceleration of the ground [m/s2].

        Returns
        -------
        ndarray
            Rates (N, ...).
        """
        y = np.asarray(y, dtype=float)
        found = self.accelerations(y, parameters, ax, ay)
        out = np.zeros((len(self.states), *found.shape[1:]))
        half = len(self.states) // 2
        for i, row in enumerate(self._rows):
            out[row] = y[half + row]
            out[half + row] = found[i]
        return out

    def energies(self, y, parameters: Mapping[str, float]) -> dict[str, np.ndarray]:
        """Kinetic, gravitational and elastic energy.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.

        Returns
        -------
        dict of str to ndarray
            Energies (...) by name [J].
        """
        return _named(self._energies, self._values(y, parameters))

    def reactions(
        self, y, parameters: Mapping[str, float], ax=0.0, ay=0.0
    ) -> dict[str, np.ndarray]:
        """Forces of the ground on the structure, as in ``symbolic.reactions``.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.
        ax : array_like, optional
            Horizontal acceleration of the ground [m/s2].
        ay : array_like, optional
            Vertical acceleration of the ground [m/s2].

        Returns
        -------
        dict of str to ndarray
            Forces (...) by name [N].
        """
        values = self._values(y, parameters, ax, ay)
        found = _solved(self._mass_matrix(values), self._forcing(values))
        return _named(self._reactions, [*values, *found])

    def positions(self, y, parameters: Mapping[str, float]) -> dict[str, np.ndarray]:
        """Places of every body's centroid and of the left_foot and right_foot.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.

        Returns
        -------
        dict of str to ndarray
            Places (2, ...) by name [m].
        """
        flat = _named(self._positions, self._values(y, parameters))
        names = dict.fromkeys(name.rpartition(".")[0] for name in flat)
        return {name: np.array([flat[f"{name}.0"], flat[f"{name}.1"]]) for name in names}

    def guards(self, y, parameters: Mapping[str, float], ax=0.0, ay=0.0) -> dict[str, np.ndarray]:
        """Guard of each transition out of this mode, positive inside.

        Parameters
        ----------
        y : array_like
            States (N, ...).
        parameters : dict of str to float
            Values by name.
        ax : array_like, optional
            Horizontal acceleration of the ground [m/s2].
        ay : array_like, optional
            Vertical acceleration of the ground [m/s2].

        Returns
        -------
        dict of str to ndarray
            Guards (...) by the name of the mode that follows.
        """
        values = self._values(y, parameters, ax, ay)
        lifts = {target: -opening(values) for target, opening in self._uplifts.items()}
        return _named(self._switches, values) | lifts

    def _values(self, y, parameters: Mapping[str, float], ax=0.0, ay=0.0) -> list[np.ndarray]:
        """All arguments of the functions in their order, of one common shape."""
        if len(y) != len(self.states):
            raise InputError("y").wrong(
                f"has {len(y)} rows, the states are {len(self.states)}: {', '.join(self.states)}"
            )
        missing = [name for name in self.parameters if name not in parameters]
        unknown = [name for name in parameters if name not in self.parameters]
        if missing or unknown:
            raise InputError("parameters").says(
                f"parameters missing: {', '.join(missing) or 'none'}; unknown: "
                f"{', '.join(unknown) or 'none'}; all are {', '.join(self.parameters)}"
            )
        chosen = [parameters[name] for name in self.parameters]
        chosen += list(self._constants(_common(chosen)))
        return _common([*chosen, *y, ax, ay])

    def __repr__(self) -> str:
        return f"<NumpyMode {self.name!r} of {', '.join(self.states)}>"


def numpy_functions(model: HybridModel) -> dict[str, NumpyMode]:
    """The functions of every mode, by its name ("left", "both", "right", ...)."""
    return {name: NumpyMode(model, name) for name in model.mode_names}


def array_function(arguments: Iterable[sp.Symbol], expressions: Iterable[sp.Expr]) -> Function:
    """values of the arguments, of one common shape (...) -> values of the expressions, (k, ...)."""
    # renamed, so that no name of a symbol becomes a part of the function's text: all at once,
    # where `dummify` would go through the expressions for each symbol again
    names = {symbol: sp.Symbol(f"a{i:04}") for i, symbol in enumerate(arguments)}
    numbered = [sp.sympify(e).xreplace(names) for e in expressions]
    compiled = sp.lambdify(
        list(names.values()), numbered, modules="numpy", cse=True, docstring_limit=0
    )

    def evaluate(values: Sequence) -> np.ndarray:
        found = compiled(*values)
        shape = np.shape(values[0])
        return np.array([np.broadcast_to(f, shape) for f in found]).reshape(len(found), *shape)

    return evaluate


def _common(values: Iterable) -> list[np.ndarray]:
    return list(np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in values)))


def _solved(mass_matrix: np.ndarray, forcing: np.ndarray) -> np.ndarray:
    """Solution (d, ...) of M q'' = f, from the entries of M (d * d, ...) and f (d, ...)."""
    d, *shape = forcing.shape
    matrices = np.moveaxis(mass_matrix.reshape(d, d, *shape), (0, 1), (-2, -1))
    right = np.moveaxis(forcing, 0, -1)[..., None]
    return np.moveaxis(np.linalg.solve(matrices, right)[..., 0], -1, 0)


def _named(table: Table, values: Sequence) -> dict[str, np.ndarray]:
    names, function = table
    return dict(zip(names, function(values), strict=True))
