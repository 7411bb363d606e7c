"""Bodies, points and frames of `sympy.physics.mechanics` as the items of a declaration.

Positions come from points, rotations from frames, both by their orientation and not by velocities
that were set: generalised speeds play no part. Nothing of `sympy.physics` is imported here, since
whoever has such bodies has imported it.
"""

from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from rockeom.symbolic import model, valid
from rockeom.symbolic.algebra import SIDE, tidy
from rockeom.symbolic.checks.common import ModelError
from rockeom.symbolic.contacts import Contact

Words = tuple[str, str, str]
"""(name, unit, meaning) of a coordinate or a parameter."""


class Writer:
    """Expressions in the symbols of coordinates, and places in the plane x, y of a frame.

    symbols : those of all expressions so far, but for coordinates and their derivatives.
    """

    def __init__(
        self, name: str, coordinates: Mapping[sp.Expr, Words], frame: Any, origin: Any
    ) -> None:
        _check_ground(frame, origin)
        self.name, self.frame, self.origin = name, frame, origin
        self.coordinates = _coordinates(coordinates)
        self.symbols: set[sp.Symbol] = set()
        self._time = next(iter(coordinates)).args[0]
        self._put: dict[sp.Expr, sp.Expr] = {}
        for q, c in self.coordinates.items():
            first, second = q.diff(self._time), q.diff(self._time, 2)
            self._put |= {second: c.acceleration, first: c.velocity, q: c.position}

    def declaration(
        self,
        bodies: Iterable[Any],
        parameters: Mapping[sp.Symbol, Words],
        contacts: Any,
        outlines: Mapping[Any, model.Outline],
        declared: dict[str, Any],
    ) -> dict[str, Any]:
        """Arguments of `Model`, see `Model.from_mechanics`."""
        bodies = _items("bodies", bodies)
        self._check_bodies(bodies, outlines)
        _check_mapping("parameters", parameters, '{m: ("mass", "kg", "mass")}')
        rotation = declared.pop("rotation")
        if rotation not in self.coordinates:
            names = ", ".join(map(str, self.coordinates))
            raise ModelError(f"rotation is {rotation!r}: name one of `coordinates`, {names}")
        gravity = self.expression("gravity", declared["gravity"])
        potential = sum(self.potential_energy(b, gravity) for b in bodies)
        declared["elastic_energy"] = declared.get("elastic_energy", sp.S.Zero) + potential
        moving = tuple(self.body(b, outlines.get(b, ())) for b in bodies)
        self._check_coordinates(moving)
        result = {
            "coordinates": tuple(self.coordinates.values()),
            "bodies": moving,
            "contacts": self.contacts(contacts),
            "parameters": tuple(
                model.Parameter(symbol, *_words(symbol, words))
                for symbol, words in parameters.items()
            ),
            "rotation": self.coordinates[rotation],
            **{item: self.written(item, value) for item, value in declared.items()},
        }
        internal = {z.symbol for z in declared.get("rates", ())}
        missing = self.symbols - {*parameters, *internal, SIDE, model.GROUND_X, model.GROUND_Y}
        if missing:
            raise ModelError(
                f"parameters lacks {', '.join(sorted(map(str, missing)))}: give each symbol its "
                'name, unit and meaning, such as {m: ("mass", "kg", "mass of the block")}',
            )
        return result

    def _check_bodies(self, bodies: tuple[Any, ...], outlines: Mapping[Any, model.Outline]) -> None:
        for b in bodies:
            if not hasattr(b, "masscenter"):
                raise ModelError(f"bodies holds {b!r}: give objects of RigidBody or Particle")
            if getattr(b, "frame", None) == self.frame:
                raise ModelError(
                    f"frame is {self.frame}, which is that of body {b.name!r}: give the inertial "
                    "frame, and each RigidBody one of its own; what never turns is a Particle",
                )
        if unknown := [str(b) for b in outlines if b not in bodies]:
            raise ModelError(f"outlines holds {', '.join(unknown)}: name objects of `bodies`")

    def _check_coordinates(self, bodies: tuple[model.Body, ...]) -> None:
        there: set[sp.Basic] = set()
        there = there.union(*(e.free_symbols for b in bodies for e in (*b.position, b.rotation)))
        idle = [str(q) for q, c in self.coordinates.items() if c.position not in there]
        if idle:
            raise ModelError(
                f"coordinates holds {', '.join(idle)}, which no point and no frame of a body "
                "contains: leave it out, as a generalised speed is; only coordinates move bodies",
            )

    def body(self, body: Any, outline: model.Outline) -> model.Body:
        what = f"body {body.name!r}"
        rotation = inertia = sp.S.Zero
        if hasattr(body, "frame"):
            rotation = self._angle(what, body.frame)
            inertia = tidy(self.frame.z.dot(body.central_inertia).dot(self.frame.z))
        return model.Body(
            body.name,
            self.expression(f"mass of {what}", body.mass),
            self.place(f"position of {what}", body.masscenter),
            self.expression(f"inertia of {what}", inertia),
            rotation,
            outline=self.written(f"outline of {what}", outline),
        )

    def expression(self, what: str, expr: Any) -> sp.Expr:
        """It in the symbols of the coordinates, where no other function of time is left."""
        valid.expressions(self.name, **{what: expr})
        expr = sp.sympify(expr).doit().xreplace(self._put)
        if others := sorted(map(str, expr.atoms(AppliedUndef))):
            raise ModelError(
                f"{what} contains {', '.join(others)}, none of `coordinates`: add what is a "
                "coordinate, and write a generalised speed as the derivative that it is, q.diff()",
            )
        if self._time in expr.free_symbols:
            raise ModelError(
                f"{what} changes with the time {self._time}: write it from a point and a frame "
                "that rest on the ground, whose acceleration is given to `simulate`",
            )
        self.symbols |= expr.free_symbols - {*self._put.values()}
        return expr

    def place(self, what: str, point: Any) -> model.Point:
        """(x, y) of a point."""
        try:
            vector = point.pos_from(self.origin).to_matrix(self.frame)
        except ValueError as error:
            raise ModelError(f"{what}: {error}: give it by `set_pos` or `locatenew`") from error
        x, y, z = (tidy(self.expression(what, e)) for e in vector)
        if z.free_symbols & {c.position for c in self.coordinates.values()}:
            raise ModelError(f"{what} leaves the plane: along {self.frame}.z it is {z}")
        return x, y

    def _angle(self, what: str, frame: Any) -> sp.Expr:
        """Clockwise angle of a frame from where it is at zero coordinates."""
        try:
            matrix = self.frame.dcm(frame)
        except ValueError as error:
            raise ModelError(f"{what}: {error}: orient its frame by `orient_axis`") from error
        what = f"orientation of {what}"
        matrix = matrix.applyfunc(lambda e: sp.expand_trig(self.expression(what, e)))
        if tidy(matrix[2, 2]) != 1:
            raise ModelError(
                f"{what} is not in the plane: turn {frame} about {self.frame}.z alone",
            )
        cosine, sine = matrix[0, 0], matrix[1, 0]
        angle = sp.S.Zero
        for q in (c.position for c in self.coordinates.values()):
            by_q = tidy(cosine * sp.diff(sine, q) - sine * sp.diff(cosine, q))
            angle -= by_q * q
            if by_q.free_symbols & {c.position for c in self.coordinates.values()}:
                raise ModelError(f"{what} is not linear in {q}: use the angle as a coordinate")
        return angle

    def contacts(self, contacts: Any) -> tuple[Contact, ...]:
        """Points above level ground by their laws, or contacts as they are declared."""
        if not isinstance(contacts, Mapping):
            return tuple(self.written("contacts", _items("contacts", contacts)))
        found = []
        for name, pair in contacts.items():
            if not (isinstance(pair, tuple) and len(pair) == 2 and hasattr(pair[0], "pos_from")):
                raise ModelError(f"contact {name!r} is {pair!r}: give (Point, law)")
            slip, gap = self.place(f"position of contact {name!r}", pair[0])
            found.append(Contact(name, gap, slip, self.written(f"law of {name!r}", pair[1])))
        return tuple(found)

    def potential_energy(self, body: Any, gravity: sp.Expr) -> sp.Expr:
        """Energy of springs; the weight is given by `gravity`."""
        energy = sp.sympify(body.potential_energy)
        twice = energy.free_symbols & (sp.sympify(body.mass).free_symbols | gravity.free_symbols)
        if twice:
            raise ModelError(
                f"the potential energy of body {body.name!r} contains "
                f"{', '.join(sorted(map(str, twice)))}: leave its weight out, `gravity` gives it",
            )
        return self.expression(f"potential energy of body {body.name!r}", energy)

    def written(self, what: str, value: Any) -> Any:
        """A value of `Model` in the symbols of the coordinates, items within it as well."""
        if isinstance(value, model.Coordinate):
            return value
        if hasattr(value, "pos_from"):
            return self.place(what, value)
        if isinstance(value, sp.Expr):
            return self.expression(what, value)
        if isinstance(value, list | tuple):
            return tuple(self.written(what, x) for x in value)
        if isinstance(value, Mapping):
            return {self.coordinates.get(k, k): self.written(what, v) for k, v in value.items()}
        if is_dataclass(value) and not isinstance(value, type):
            of = f" of {value.name!r}" if hasattr(value, "name") else f" in {what}"
            items = {f.name: getattr(value, f.name) for f in fields(value) if f.init}
            return type(value)(**{k: self.written(k + of, v) for k, v in items.items()})
        return value


def _check_ground(frame: Any, origin: Any) -> None:
    if not hasattr(frame, "dcm"):
        raise ModelError(f"frame is {frame!r}: give the ReferenceFrame that rests on the ground")
    if not hasattr(origin, "pos_from"):
        raise ModelError(f"origin is {origin!r}: give the Point from which positions are measured")
    try:
        velocity = origin.vel(frame)
    except ValueError:  # none was set
        return
    if velocity != 0:
        raise ModelError(
            f"origin is {origin}, which moves by {velocity}: give a point of the ground"
        )


def _coordinates(given: Mapping[sp.Expr, Words]) -> dict[sp.Expr, model.Coordinate]:
    example = '{theta: ("theta", "rad", "rotation, positive clockwise")}'
    _check_mapping("coordinates", given, example)
    for q in given:
        if not isinstance(q, AppliedUndef) or len(q.args) != 1:
            raise ModelError(
                f"coordinates holds {q!r}: give what `dynamicsymbols` returns, and no derivative",
            )
    return {q: model.coordinate(str(q.func), *_words(q, words)) for q, words in given.items()}


def _check_mapping(what: str, given: Any, example: str) -> None:
    if not isinstance(given, Mapping) or not given:
        raise ModelError(f"{what} is {given!r}: give a mapping, such as {example}")


def _items(what: str, given: Any) -> tuple[Any, ...]:
    if not isinstance(given, Iterable) or isinstance(given, str):
        raise ModelError(f"{what} is {given!r}: give a list, [...]")
    return tuple(given)


def _words(symbol: sp.Expr, words: Words) -> Words:
    if not isinstance(words, tuple) or len(words) != 3:
        raise ModelError(f"{symbol} is described by {words!r}: give (name, unit, meaning)")
    return words
