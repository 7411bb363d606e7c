"""What a user declares either works or is an error that names the declaration, item and remedy."""

import ast
import copy
import functools
import types
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import sympy as sp

import rockeom as rk
from rockeom.codegen import module_text
from rockeom.structures.declared import class_of
from rockeom.symbolic import (
    SIDE,
    Body,
    Definition,
    Foot,
    Mode,
    NamedFunction,
    Parameter,
    RockingModel,
    Spring,
    Transition,
    coordinate,
    parameter,
    rocking_structure,
    turned,
)
from rockeom.symbolic.model import GROUND_X
from tests.refusals import refused

THETA = coordinate("theta", "theta", "rad", "rotation")
U = coordinate("u", "u", "m", "deformation")
M, H, B, K, G = PARAMETERS = tuple(
    parameter(symbol, name, unit, "what it is")
    for symbol, name, unit in (
        ("m", "mass", "kg"),
        ("h", "height", "m"),
        ("B", "half_width", "m"),
        ("k", "stiffness", "N/m"),
        ("g", "gravity", "m/s2"),
    )
)
m, h, b, k, g = (p.symbol for p in PARAMETERS)
theta, u = THETA.position, U.position
VALUES = {"mass": 3.0, "height": 2.0, "half_width": 0.5, "stiffness": 700.0}
STRANGE = sp.Symbol("q", positive=True)


def bodies(pivot):
    return [
        Body("top", m, turned((u, h), pivot, theta)),
        Body("base", m, turned((0, h / 9), pivot, theta)),
    ]


def tower(**changes) -> RockingModel:
    """An elastic column on a base that rocks."""
    declared = {
        "name": "tower",
        "title": "A tower",
        "parameters": PARAMETERS,
        "coordinates": (THETA, U),
        "bodies": bodies,
        "half_width": b,
        "gravity": g,
        "elastic_energy": k * u**2 / 2,
    }
    return rocking_structure(**(declared | changes))


TOWER = tower()
ROCKING, FULL = TOWER.modes
LEFT, RIGHT, *UPLIFTS = TOWER.transitions


def rocking(**changes) -> RockingModel:
    """The tower, its rocking mode changed."""
    return replace(TOWER, modes=(replace(ROCKING, **changes), FULL))


def modes(**changes) -> RockingModel:
    """The tower, both modes changed."""
    return replace(TOWER, modes=tuple(replace(p, **changes) for p in TOWER.modes))


def right(**changes) -> RockingModel:
    """The tower, its impact from the right changed."""
    return replace(TOWER, transitions=(LEFT, replace(RIGHT, **changes), *UPLIFTS))


def test_energy_with_the_sign_of_the_rotation_resists_uplift():
    """A preload gives the moment m g B/2 about either edge; the column bends by m a/k."""
    loaded = tower(elastic_energy=k * u**2 / 2 + m * g * b / 2 * SIDE * theta)
    weight = 3.0 * 9.81
    a = 2.5 * weight * 0.5 / (3.0 * (2.0 + 2.0 / 9) + weight * 3.0 / 700.0)
    structure = rk.structure(loaded, **VALUES, gravity=9.81)
    assert structure.uplift_acceleration == pytest.approx(a, rel=1e-9)


SPRINGS = rk.derive("two_spring_structure")
LEANS = tuple(c.position for c in SPRINGS.coordinates)


def switch(source: str, target: str, **changes) -> RockingModel:
    """The structure on two springs, one of its switches changed."""
    return replace(
        SPRINGS,
        transitions=tuple(
            replace(t, **changes) if (t.source, t.target) == (source, target) else t
            for t in SPRINGS.transitions
        ),
    )


def guard_of(source: str, target: str) -> sp.Expr:
    (found,) = (t.guard for t in SPRINGS.transitions if (t.source, t.target) == (source, target))
    return found


def on_feet(left: sp.Expr, right: sp.Expr) -> RockingModel:
    """A rigid block whose feet stand at -left and right of its centre; s picks the pivot."""

    def mode(pivot, contacts, free, angle):
        place = turned((0, h), pivot, angle)
        feet = {"left": (-left, sp.S.Zero), "right": (right, sp.S.Zero)}
        return Mode(
            contacts,
            free,
            (Body("block", m, place, m * h**2 / 3, angle),),
            g,
            feet={name: Foot(turned(foot, pivot, angle)) for name, foot in feet.items()},
            load_point=place,
        )

    return replace(
        TOWER,
        name="block",
        parameters=(*PARAMETERS, *(Parameter(x, str(x), "m", "") for x in (STRANGE,))),
        coordinates=(THETA,),
        modes=(
            mode((-left, sp.S.Zero), {"left": -1}, (THETA,), theta),
            mode((right, sp.S.Zero), {"right": 1}, (THETA,), theta),
            mode((sp.S.Zero, sp.S.Zero), {"both": 0}, (), sp.S.Zero),
        ),
    )


def flight() -> RockingModel:
    """A structure that lands on one foot out of flight."""
    return replace(
        SPRINGS,
        transitions=(
            *(t for t in SPRINGS.transitions if (t.source, t.target) != ("flight", "right")),
            Transition("flight", "right", "impact", SPRINGS.coordinates[1].position),
        ),
    )


def called(**names) -> RockingModel:
    """The tower with one parameter or coordinate called otherwise."""
    ((old, new),) = names.items()
    other = replace(U, name=new) if old == "u" else U
    return tower(
        parameters=[replace(p, name=new if p.name == old else p.name) for p in PARAMETERS],
        coordinates=(THETA, other),
    )


def with_flight_called(new: str) -> RockingModel:
    """The structure on two springs, its state of flight called otherwise."""
    put = {"flight": new}
    return replace(
        SPRINGS,
        modes=tuple(
            replace(p, sides={put.get(c, c): s for c, s in p.sides.items()}) for p in SPRINGS.modes
        ),
        transitions=tuple(
            replace(t, source=put.get(t.source, t.source), target=put.get(t.target, t.target))
            for t in SPRINGS.transitions
        ),
    )


def built(**values) -> rk.Structure:
    return rk.structure(TOWER, **(VALUES | values))


def without_symbol(p: Parameter, position: int) -> tuple[Parameter, ...]:
    return (*PARAMETERS[:position], p, *PARAMETERS[position + 1 :])


WRONG: dict[str, tuple[Callable, tuple[str, ...]]] = {
    # impacts
    "a mass off the middle": (
        lambda: tower(bodies=lambda pivot: [ECCENTRIC(pivot), bodies(pivot)[1]]),
        ("tower", "ratio", "'left' -> 'right'", "not equally far"),
    ),
    "flight to a foot": (flight, ("'flight' -> 'right'", "impact", "spring")),
    "a gap that is not the rotation": (
        lambda: right(guard=theta - u),
        ("tower", "'right' -> 'left'", "'theta'", "theta - u"),
    ),
    "an impact's guard of the wrong sign": (
        lambda: right(guard=-theta),
        ("tower", "'right' -> 'left'", "-theta", "positive"),
    ),
    "an impact without a guard": (lambda: right(guard=None), ("'right' -> 'left'", "theta")),
    "an impact that sets something": (
        lambda: right(sets={u: sp.S.Zero}),
        ("'right' -> 'left'", "`sets`"),
    ),
    "an impact with full contact as its target": (
        lambda: right(target="both", fallback=None),
        ("'right' -> 'both'", "`fallback`"),
    ),
    "an impact that falls back to the other foot": (
        lambda: right(fallback="left"),
        ("'right' -> 'left'", "fallback", "side 0"),
    ),
    "two impacts out of one state": (
        lambda: replace(TOWER, transitions=(*TOWER.transitions, RIGHT)),
        ("two impacts", "'right'"),
    ),
    "no impact": (
        lambda: replace(TOWER, transitions=(LEFT, *UPLIFTS)),
        ("tower", "no impact", "'right'", "Transition("),
    ),
    "no uplift": (
        lambda: replace(TOWER, transitions=(LEFT, RIGHT, UPLIFTS[0])),
        ("'both'", '"uplift"'),
    ),
    # guards and references
    "a switch without a guard": (
        lambda: switch("both", "left", guard=None),
        ("'both' -> 'left'", "guard", "positive"),
    ),
    "guards of one sign there and back": (
        lambda: switch("both", "left", guard=-guard_of("both", "left")),
        ("'both' -> 'left'", "'left' -> 'both'", "positive inside"),
    ),
    "a guard that is nowhere positive on its side": (
        lambda: switch("left", "flight", guard=SPRINGS.rotation.position),
        ("two_spring_structure", "'left' -> 'flight'", "positive"),
    ),
    "a guard of an uplift": (
        lambda: replace(TOWER, transitions=(LEFT, RIGHT, replace(UPLIFTS[0], guard=u), UPLIFTS[1])),
        ("'both' -> 'left'", "uplift", "derived"),
    ),
    "a guard that is the larger of three": (
        lambda: switch("left", "flight", guard=sp.Max(*LEANS, 1)),
        ("'left' -> 'flight'", "Max"),
    ),
    "a kind misspelt": (
        lambda: right(kind="impackt"),
        ("tower", "'impackt'", "did you mean impact"),
    ),
    "a target misspelt": (
        lambda: right(target="lefft"),
        ("tower", "target", "'lefft'", "did you mean left"),
    ),
    "a source misspelt": (lambda: right(source="rihgt"), ("source", "did you mean right")),
    "a fallback misspelt": (lambda: right(fallback="bth"), ("fallback", "did you mean both")),
    "a fallback of a switch": (
        lambda: switch("both", "left", fallback="flight"),
        ("'both' -> 'left'", "fallback"),
    ),
    "a switch that sets what is no coordinate": (
        lambda: switch("both", "left", sets={m: sp.S.Zero}),
        ("sets m", "coordinate"),
    ),
    # undeclared symbols
    "undeclared in a guard": (
        lambda: switch("both", "left", guard=STRANGE - theta),
        ("guard", "'both'", "q"),
    ),
    "undeclared in gravity": (lambda: tower(gravity=STRANGE), ("tower", "gravity", "symbols q")),
    "undeclared in the load point": (
        lambda: rocking(load_point=(STRANGE, h)),
        ("tower", "load point", "symbols q"),
    ),
    "undeclared in a quantity": (
        lambda: modes(quantities={"lean": ("m", STRANGE * u)}),
        ("tower", "'lean'", "symbols q"),
    ),
    "undeclared in overturning": (
        lambda: tower(overturning=STRANGE),
        ("tower", "overturning", "symbols q"),
    ),
    "undeclared in the half-width": (lambda: tower(half_width=STRANGE), ("tower", "symbols q")),
    "undeclared in a mass": (
        lambda: tower(bodies=lambda p: [Body("top", STRANGE, turned((u, h), p, theta))]),
        ("tower", "mass of body 'top'", "symbols q"),
    ),
    "undeclared in a force": (lambda: rocking(forces=(STRANGE, u)), ("force on 'theta'", "q")),
    "undeclared in a definition": (
        lambda: replace(TOWER, definitions=(Definition(sp.Symbol("d"), "d", "m", "", STRANGE),)),
        ("definition 'd'", "q"),
    ),
    "undeclared in a law": (
        lambda: replace(
            TOWER, functions=(NamedFunction(sp.Symbol("l"), "law", "m", "", STRANGE * u),)
        ),
        ("function 'law'", "q"),
    ),
    "an undeclared function": (
        lambda: tower(elastic_energy=sp.Function("os.system")(u)),
        ("elastic energy", "os.system"),
    ),
    "a symbol with other assumptions": (
        lambda: tower(gravity=sp.Symbol("g")),
        ("gravity", "assumptions", ".symbol"),
    ),
    "an acceleration in a guard": (
        lambda: switch("both", "left", guard=SPRINGS.rotation.acceleration),
        ("guard", "acceleration"),
    ),
    "an acceleration in a force": (
        lambda: rocking(forces=(m * U.acceleration, 0)),
        ("force on 'theta'", "acceleration"),
    ),
    "the ground in a force": (lambda: rocking(forces=(m * GROUND_X, 0)), ("force", "ground")),
    "a velocity in an elastic energy": (
        lambda: tower(elastic_energy=k * U.velocity**2),
        ("elastic energy", "velocity"),
    ),
    "a coordinate in gravity": (lambda: tower(gravity=g + u), ("gravity", "coordinate u")),
    # signs and sizes
    "a negative mass": (
        lambda: tower(bodies=lambda p: [Body("top", -m, turned((u, h), p, theta))]),
        ("'top'", "mass", "negative"),
    ),
    "a mass of -1": (lambda: Body("top", sp.Integer(-1), (u, h)), ("'top'", "mass is -1")),
    "a negative half-width": (lambda: tower(half_width=-b), ("tower", "half_width", "positive")),
    "a half-width of -1": (lambda: tower(half_width=-1), ("tower", "half_width is -1")),
    "a value of -1 of the half-width": (lambda: built(half_width=-1), ("half_width is -1",)),
    "a value of '0.1'": (lambda: built(half_width="0.1"), ("half_width is '0.1'", "number")),
    "a value of None": (lambda: built(half_width=None), ("half_width is None", "number")),
    "a value of NaN": (lambda: built(half_width=float("nan")), ("half_width is nan",)),
    "a negative value of a symbol of either sign": (
        lambda: rk.structure(
            tower(
                parameters=without_symbol(Parameter(sp.Symbol("w"), "half_width", "m", ""), 2),
                half_width=sp.Symbol("w"),
            ),
            **(VALUES | {"half_width": -0.5}),
        ),
        ("distance of the feet", "half_width = -0.5"),
    ),
    # what there must be
    "the rotation not first": (
        lambda: tower(coordinates=(U, THETA)),
        ("tower", "u, the first", "rotation first"),
    ),
    "a rotation to the other side": (
        lambda: tower(
            rotation_angle=-theta,
            bodies=lambda pivot: [Body("top", m, turned((u, h), pivot, -theta))],
        ),
        ("tower", "theta", "counterclockwise", "its other sign"),
    ),
    "no coordinate": (lambda: tower(coordinates=()), ("tower", "no coordinates")),
    "a rotation that is no coordinate": (
        lambda: replace(TOWER, coordinates=(U,)),
        ("tower", "'theta'", "`coordinates`"),
    ),
    "no bodies": (lambda: tower(bodies=lambda pivot: []), ("tower", "no bodies")),
    "a mode without bodies": (lambda: modes(bodies=()), ("tower", "no bodies")),
    "one contact": (
        lambda: replace(
            TOWER, modes=(replace(ROCKING, sides={"right": 1}),), transitions=(UPLIFTS[0],)
        ),
        ("tower", "modes are right", "two or more"),
    ),
    "no transitions": (lambda: replace(TOWER, transitions=()), ("tower", "transitions")),
    "no modes": (lambda: replace(TOWER, modes=()), ("tower", "none")),
    "an unknown load_on": (
        lambda: tower(load_on="tip"),
        ("tower", "load_on", "'tip'", "did you mean top"),
    ),
    "a coordinate without mass": (
        lambda: tower(bodies=lambda p: [Body("base", m, turned((0, h), p, theta))]),
        ("tower", "'u'", "mass", "singular"),
    ),
    "more coordinates than masses move": (
        lambda: tower(
            coordinates=(THETA, U, EXTRA),
            bodies=lambda p: [Body("top", m, turned((u + EXTRA.position, h), p, theta))],
            elastic_energy=k * (u**2 + EXTRA.position**2) / 2,
        ),
        ("tower", "singular", "w"),
    ),
    "a side that is no side": (
        lambda: rocking(sides={"left": -1, "right": 2}),
        ("'right'", "-1, 0 or 1"),
    ),
    "sides exchanged": (
        lambda: rocking(sides={"left": 1, "right": -1}),
        ("'left'", "negative"),
    ),
    "full contact of another name": (
        lambda: replace(
            TOWER,
            modes=(ROCKING, replace(FULL, sides={"full": 0})),
            transitions=tuple(
                replace(
                    t,
                    source="full" if t.source == "both" else t.source,
                    fallback="full" if t.fallback else None,
                )
                for t in TOWER.transitions
            ),
        ),
        ("'full'", "'both'"),
    ),
    "one foot": (lambda: rocking(feet={"left": ROCKING.feet["left"]}), ("feet", "right")),
    "the force on one foot": (
        lambda: rocking(feet=ROCKING.feet | {"left": Foot((b, h), m * g)}),
        ("foot", "both"),
    ),
    "a force too few": (lambda: rocking(forces=(u,)), ("1 forces for 2 coordinates",)),
    "a quantity in one mode": (
        lambda: rocking(quantities={"lean": ("m", u)}),
        ("tower", "quantities", "in each"),
    ),
    "a quantity in degrees": (
        lambda: modes(quantities={"lean": ("deg", u)}),
        ("'lean'", "'deg'", "'m' or 'N'"),
    ),
    "a mode declared twice": (
        lambda: replace(TOWER, modes=(ROCKING, FULL, FULL)),
        ("tower", "declared twice: both"),
    ),
    "two bodies of one name": (
        lambda: tower(bodies=lambda p: [bodies(p)[0], bodies(p)[0]]),
        ("two bodies", "'top'"),
    ),
    # energies
    "an odd elastic energy": (
        lambda: tower(elastic_energy=k * u**3),
        ("tower", "elastic energy", "'u'", "u**2/2"),
    ),
    "a force in place of an energy": (
        lambda: tower(elastic_energy=k * u),
        ("tower", "elastic energy", "'u'", "not a force"),
    ),
    "an energy of the rotation without its side": (
        lambda: tower(elastic_energy=k * u**2 / 2 + k * theta),
        ("elastic energy", "'theta'", "k*SIDE*theta with rockeom.symbolic.SIDE"),
    ),
    # names
    "one symbol twice": (
        lambda: tower(parameters=without_symbol(replace(H, symbol=m), 1)),
        ("tower", "symbol m", "twice"),
    ),
    "one symbol of a parameter and a coordinate": (
        lambda: tower(parameters=(*PARAMETERS, Parameter(u, "other", "m", ""))),
        ("symbol u",),
    ),
    "a coordinate with the symbol of the side": (
        lambda: replace(TOWER, coordinates=(THETA, U, SLIP)),
        ("tower", "symbol s", "side"),
    ),
    "a name twice": (lambda: called(mass="height"), ("tower", "twice: height")),
    "a parameter called like a rate": (lambda: called(mass="u_dot"), ("twice: u_dot",)),
    "a coordinate called like an energy": (
        lambda: called(u="elastic_energy"),
        ("tower", "elastic_energy", "another name"),
    ),
    "a coordinate called t": (lambda: called(u="t"), ("tower", "response", " t")),
    "a coordinate called like a foot's uplift": (lambda: called(u="left_uplift"), ("left_uplift",)),
    "a quantity called like a reaction": (
        lambda: modes(quantities={"left_reaction": ("N", m * g)}),
        ("left_reaction",),
    ),
    "a quantity called like a state": (
        lambda: modes(quantities={"u_dot": ("m", u)}),
        ("twice: u_dot",),
    ),
    "a parameter without a name": (lambda: called(mass=""), ("tower", "parameter m", "''")),
    "a parameter called by an expression": (
        lambda: called(mass="a + b"),
        ("parameter m", "'a + b'"),
    ),
    "a parameter that contains code": (
        lambda: called(mass="x = 1\nimport os"),
        ("tower", "parameter m", "letters"),
    ),
    "a coordinate called by a number": (lambda: called(u="1u"), ("tower", "coordinate u", "'1u'")),
    "a name that Python reads otherwise": (lambda: called(mass="ﬁ"), ("parameter m", "'fi'")),
    "a model without a name": (lambda: tower(name=""), ("model", "''", "letters")),
    "a model in another folder": (lambda: tower(name="../../tower"), ("'../../tower'", "letters")),
    "a model of two lines": (lambda: tower(name="a\nb"), ("model", "letters")),
    "a model called by 300 letters": (lambda: tower(name="a" * 300), ("100 letters",)),
    "a mode whose name contains code": (
        lambda: with_flight_called("flight = 1; import os"),
        ("two_spring_structure", "mode"),
    ),
    "a title that is no text": (lambda: tower(title=None), ("tower", "title", "text")),
    # texts in place of expressions, which SymPy would run
    "a mass as text": (lambda: Body("top", "mass", (0, h)), ("mass is 'mass'", ").symbol")),
    "a place as text": (lambda: Body("top", m, ("x", h)), ("'top'", "position", "'x'")),
    "a point turned as text": (lambda: turned(("x", 0), (b, 0), theta), ("x of point",)),
    "an energy as text": (
        lambda: tower(elastic_energy="k*u**2/2"),
        ("tower", "elastic_energy", "SymPy"),
    ),
    "a guard as text": (lambda: right(guard="theta"), ("'right' -> 'left'", "guard", "SymPy")),
    "gravity as text": (lambda: rocking(gravity="9.81"), ("gravity", "SymPy")),
    "a symbol as text": (lambda: Parameter("m", "mass", "kg", ""), ("'mass'", "symbol")),
    "overturning as text": (
        lambda: tower(overturning="__import__('os').getcwd()"),
        ("tower", "overturning", "SymPy"),
    ),
    "a source of no equation": (lambda: tower(sources={"w": "2-9"}), ("sources", "energy_ratio")),
    "a source that is TeX": (lambda: tower(sources={"u": "$x$"}), ("sources of u", "'$x$'")),
    "a small symbol as text": (lambda: rocking(small=("theta",)), ("small theta", "symbol")),
    "a state set by text": (
        lambda: switch("both", "left", sets={"theta": sp.S.Zero}),
        ("'both' -> 'left'", "theta"),
    ),
    "a function that Python lacks": (
        lambda: tower(elastic_energy=k * sp.besselj(0, u)),
        ("elastic energy", "besselj", "cannot be compiled"),
    ),
    "an energy with a kink, by its slope": (
        lambda: tower(elastic_energy=k * sp.Abs(sp.sin(THETA.position))),
        ("slope of elastic energy in mode left/right by theta", "sign(", "Max or tanh"),
    ),
    "an energy with a kink that can be compiled": (
        lambda: tower(elastic_energy=k * sp.Max(u, -u)),
        ("elastic energy in mode left/right has a kink where u is zero", "declare an element"),
    ),
    "an energy by a distance that is zero where the feet are closed": (
        lambda: tower(elastic_energy=k * sp.sqrt(2 - 2 * sp.cos(THETA.position))),
        ("elastic energy in mode left/right has a kink where theta is zero", "declare an element"),
    ),
    "an energy in pieces": (
        lambda: tower(elastic_energy=k * sp.Piecewise((u**2, u > 0), (0, True))),
        ("elastic energy in mode left/right contains Piecewise", "cannot be compiled"),
    ),
    "an element that steps": (
        lambda: tower(elements=[Spring("rope", u * sp.Heaviside(u), k)]),
        ("slope of deformation of element 'rope'", "DiracDelta"),
    ),
    "a mode whose name is a number": (
        lambda: rocking(sides={"left": -1, 1: 1}),
        ("mode 1", "text"),
    ),
    "a mass of NaN": (lambda: Body("top", float("nan"), (0, h)), ("'top'", "mass", "finite")),
}
EXTRA = coordinate("w", "w", "m", "another deformation")
ECCENTRIC = lambda pivot: Body("top", m, turned((u + h / 7, h), pivot, theta))  # noqa: E731
SLIP = coordinate("s", "slip", "m", "way of the feet")


@pytest.mark.parametrize("what", WRONG)
def test_wrong_declaration_is_an_error_that_names_it(what):
    declare, named = WRONG[what]
    with pytest.raises((ValueError, TypeError)) as caught:
        module_text(declare())
    message = str(caught.value)
    assert [word for word in named if word not in message] == [], message


def test_what_is_declared_rightly_is_accepted():
    assert "tower" in module_text(TOWER)
    assert class_of(module_of(TOWER))(**VALUES).velocity_ratio > 0
    assert refused(rk.structure, 42) == ("model", 42)


# --- what a user writes is data


def test_parameters_are_attributes_and_take_no_other_s_place():
    """One called `alpha` is no slenderness of a block, one called `states` no list of states."""
    called = {"half_width": "alpha", "stiffness": "states", "height": "vector"}
    names = [replace(p, name=called.get(p.name, p.name)) for p in TOWER.parameters]
    values = {called.get(name, name): value for name, value in VALUES.items()}
    made = class_of(module_of(replace(TOWER, parameters=tuple(names))))
    one = made(**values)
    assert (one.alpha, one.mass, one.gravity, one.slenderness) == (0.5, 3.0, 9.81, None)
    assert one.states == TOWER.states
    assert one.vector[:5].tolist() == [*one.parameters().values()]
    assert (one == made(**values), one == made(**values | {"mass": 4.0})) == (True, False)
    assert copy.copy(one) == one
    with pytest.raises(AttributeError, match="no attribute 'beta'"):
        _ = one.beta


def module_of(model: RockingModel, **globals_) -> types.ModuleType:
    """The generated module, executed by Python itself."""
    module = types.ModuleType(model.name)
    vars(module).update(globals_)
    exec(module_text(model), vars(module))
    return module


TEXTS = {
    "quotes that end the docstring": '"""\nran.append(1)\n"""',
    "quotes and a backslash": '\\"""\nran.append(1)\n#',
    "more quotes": '""""\nran.append(1)\n""""',
    "a single quote at the end": 'a "tower"',
    "a backslash at the end": "tower\\",
    "a string's end": '",)\nran.append(1)\nX = ("',
    "lines": "a\nran.append(1)\r\nran.append(2)\u2028ran.append(3)\x0cran.append(4)",
    "NUL and a lone surrogate": "a\x00b\ud800c",
    "braces and percent signs": "{digest} {} %s $x$ \\N{DASH} \\x41",
    "a marked function": "@inlined @fused math. np.",
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_texts_of_a_declaration_are_never_run(text):
    def odd(p):
        return replace(p, unit=text, meaning=text)

    model = block(text, odd)
    written = module_text(model)
    written.encode("utf-8")
    ran: list[int] = []
    module = module_of(model, ran=ran)
    assert ran == []
    assert set(module.PARAMETER_MEANINGS) == {text} == set(module.PARAMETER_UNITS)
    assert len(module.PARAMETERS) == len(PARAMETERS)
    assert module.STATE_UNITS[0] == text
    assert text.encode("utf-8", "backslashreplace").decode() in module.__doc__
    # the text apart, the module is the usual one
    assert functions(written) == usual_functions()


def block(text: str = "", odd: Callable = lambda item: item) -> RockingModel:
    """A rigid block that says `text` wherever it may."""
    return rocking_structure(
        name="block",
        title=text,
        reference=text,
        parameters=[odd(p) for p in PARAMETERS],
        coordinates=[odd(THETA)],
        bodies=lambda pivot: [Body(f"{text} top", m, turned((0, h), pivot, theta))],
        half_width=b,
        gravity=g,
    )


@functools.cache
def usual_functions() -> dict[str, str]:
    return functions(module_text(block()))


def functions(text: str) -> dict[str, str]:
    """What a module's functions do, by their names."""
    tree = ast.parse(text)
    return {f.name: ast.unparse(f) for f in tree.body if isinstance(f, ast.FunctionDef)}


def test_a_title_with_code_is_shown_by_a_compiled_structure(tmp_path):
    """As rk.structure loads it: through a file of the cache."""
    marker = tmp_path / "ran"
    title = f'"""\nopen({str(marker)!r}, "w").close()\n"""'
    structure = rk.structure(replace(block(), title=title), **VALUES)
    assert title in structure.module.__doc__
    assert not marker.exists()


# --- impacts of structures whose sides are declared apart


def test_sides_declared_in_modes_of_their_own_have_their_own_impact_maps():
    """Each with its pivot as a number: the map of one side is not that of the other."""

    def mode(side: int, name: str) -> Mode:
        return replace(
            ROCKING,
            sides={name: side},
            bodies=tuple(
                replace(body, position=tuple(e.subs(SIDE, side) for e in body.position))
                for body in ROCKING.bodies
            ),
            feet={
                name: Foot(tuple(sp.sympify(e).subs(SIDE, side) for e in foot.position))
                for name, foot in ROCKING.feet.items()
            },
            load_point=tuple(e.subs(SIDE, side) for e in ROCKING.load_point),
        )

    apart = replace(TOWER, modes=(mode(-1, "left"), mode(1, "right"), FULL))
    values = VALUES | {"gravity": 9.81}
    one = class_of(module_of(TOWER))(**values)
    other = class_of(module_of(apart))(**values)
    for side, foot in ((-1, "left"), (1, "right")):
        landing = {"u": 0.02, "theta_dot": -0.3 * side, "u_dot": 0.1}
        for law in (rk.Impulsive(), rk.AngularMomentum()):
            found = [s.after_impact(landing, foot, law) for s in (one, other)]
            assert found[0][1] == found[1][1]
            assert found[1][0] == pytest.approx(found[0][0], rel=1e-12, abs=1e-14)
        state = {"theta": 0.02 * side, **landing}
        assert other.accelerations(state) == pytest.approx(one.accelerations(state), rel=1e-12)


def test_one_mode_alone_rocks_from_foot_to_foot():
    """Without full contact; the number of modes is no matter of the text."""
    alone = replace(
        TOWER,
        modes=(ROCKING,),
        transitions=tuple(replace(t, fallback=None) for t in (LEFT, RIGHT)),
    )
    values = VALUES | {"gravity": 9.81}
    one = class_of(module_of(TOWER))(**values)
    other = class_of(module_of(alone))(**values)
    state = {"theta": -0.02, "u": 0.01}
    assert other.accelerations(state, mode="left") == one.accelerations(state, mode="left")


def test_an_impact_may_stand_behind_a_switch():
    """The order of transitions is no matter; an impact is the first guard of its state."""
    cart = rk.derive("two_spring_cart")
    behind = replace(cart, transitions=tuple(reversed(cart.transitions)))
    module = module_of(behind)
    usual = module_of(cart)
    for mode in usual.MODES:
        number = usual.MODES.index(mode)
        assert module.KINDS[number] == usual.KINDS[number]
        assert module.TARGETS[number] == usual.TARGETS[number]


def test_rotation_need_not_be_first_where_it_is_named():
    """In a RockingModel: the table of states says where it stands."""
    swapped = replace(
        TOWER,
        coordinates=(U, THETA),
        modes=(replace(ROCKING, coordinates=(U, THETA)), FULL),
    )
    values = VALUES | {"gravity": 9.81}
    one = class_of(module_of(TOWER))(**values)
    other = class_of(module_of(swapped))(**values)
    state = {"theta": 0.02, "u": 0.01, "theta_dot": -0.1}
    for found, expected in (
        (other.accelerations(state), one.accelerations(state)),
        (other.reactions(state), one.reactions(state)),
        (other.after_impact(state | {"theta": 0.0}, "right", rk.Impulsive())[0],
         one.after_impact(state | {"theta": 0.0}, "right", rk.Impulsive())[0]),
    ):  # fmt: skip
        assert found == pytest.approx(expected, rel=1e-11, abs=1e-13)
    np.testing.assert_allclose(other.pushover([0.01, 0.1]), one.pushover([0.01, 0.1]), rtol=1e-9)


def test_shipped_structure_is_derived_once_in_a_session():
    assert rk.derive("two_spring_cart") is rk.derive("two_spring_cart")


def test_a_rigid_body_whose_feet_are_not_equally_far_is_an_offset_block():
    left, right = 0.5, 0.3
    values = {"mass": 3.0, "height": 2.0, "stiffness": 1.0, "half_width": left, "q": right}
    unequal = rk.structure(on_feet(b, STRANGE), **values)
    half_width, offset = (left + right) / 2, (left - right) / 2
    block = rk.OffsetBlock(half_width=half_width, half_height=2.0, offset=offset, inertia=4.0 / 3)
    for mode, rate in (("left", 0.7), ("right", -0.7)):
        after, follows = block.after_impact({"theta_dot": rate}, mode)
        assert unequal.after_impact({"theta_dot": rate}, mode) == (pytest.approx(after), follows)


def test_elements_of_a_rocking_structure_may_depend_on_its_foot():
    """A preloaded tendon at the middle of the base lifts with it, about either foot."""

    def tendon(pivot):
        return [Spring("tendon", turned((0, 0), pivot, theta)[1], initial_force=k / 100)]

    lifts = class_of(module_of(tower(elements=tendon)))(**VALUES).uplift_acceleration
    weight, sways = 3.0 * 9.81, 3.0 / 700.0
    moment = 0.5 * (2.0 * weight + 7.0)
    assert lifts == pytest.approx(moment / (3.0 * (2.0 + 2.0 / 9.0) + weight * sways), rel=1e-6)
