"""Structures that rock on declared modes: their class, and the two modes on pinned feet."""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, Self, TypedDict, Unpack

import sympy as sp

from rockeom.numbers import explained
from rockeom.numbers.checks import InputError, require_word
from rockeom.symbolic import valid
from rockeom.symbolic.algebra import SIDE, at_side
from rockeom.symbolic.checks.declaration import check
from rockeom.symbolic.checks.derived import check_derived
from rockeom.symbolic.checks.modes import check_turning
from rockeom.symbolic.checks.values import check_values
from rockeom.symbolic.elements import Spring
from rockeom.symbolic.evaluate import NumpyMode, numpy_functions
from rockeom.symbolic.hybrid import HybridModel
from rockeom.symbolic.impulse import ImpulseMap
from rockeom.symbolic.lagrange import Equations
from rockeom.symbolic.mode import Mode, Transition
from rockeom.symbolic.model import Body, Coordinate, Foot, Member, Parameter, Point, turned
from rockeom.symbolic.reading.comparison import Comparison, compared, compared_at_impact
from rockeom.symbolic.reading.forms import in_form
from rockeom.symbolic.reading.linearization import Linearization, linearized
from rockeom.symbolic.reading.symbols import Symbols
from rockeom.symbolic.text.page import to_text
from rockeom.symbolic.text.shown import TEXT_WIDTH
from rockeom.symbolic.write.typeset import (
    WrittenEquations,
    WrittenImpulseMap,
    content,
    latex_document,
    markdown_page,
    notebook_display,
)

_MEANT = {
    "restitution": "velocity_ratio, its square for energies",
    "coefficient_of_restitution": "velocity_ratio",
    "e": "velocity_ratio",
    "r": "velocity_ratio**2",
    "impact_map": 'impulse_map("right", "left")',
    "impact": 'impulse_map("right", "left")',
    "linearise": "linearize",
    "parameters_by_name": "symbols",
} | {
    name: f'equations("right").{meant}'
    for name, meant in {
        "mass_matrix": "mass_matrix",
        "M": "mass_matrix",
        "forcing": "forcing",
        "f": "forcing",
        "rhs": "rhs()",
        "eom": "residual",
        "equations_of_motion": "residual",
        "kinetic_energy": "kinetic_energy",
        "potential_energy": "gravitational_energy",
        "forces": "forcing",
        "mass_matrix_full": "mass_matrix_full",
        "forcing_full": "forcing_full",
        "q": "q",
        "u": "u",
    }.items()
} | {
    name: f'linearize("both").{letter}'
    for name, letter in {
        "stiffness_matrix": "K", "K": "K", "damping_matrix": "C", "C": "C", "A": "A", "B": "B",
    }.items()
}  # fmt: skip
"""Attributes that people try on a model, and where they find it."""


class Declared:
    """Methods of a declaration, whichever its kind: they act on the model that it lowers to."""

    @property
    def hybrid(self) -> HybridModel:
        """The model that is generated and simulated."""
        raise NotImplementedError

    def check_derived(self) -> None:
        """Check that the equations that follow from the declaration can be simulated.

        Raises
        ------
        ValueError
            Where they cannot.
        """
        check_derived(self.hybrid)

    def check_values(self, values: Mapping[str, float]) -> None:
        """Check that parameters give bodies and bases a size.

        Parameters
        ----------
        values : dict of str to float
            Values by name.

        Raises
        ------
        ValueError
            Where they do not.
        """
        check_values(self.hybrid, values)

    @property
    def symbols(self) -> Symbols:
        """Symbols by name and as attributes, such as `model.symbols.half_width`."""
        return Symbols.of(self.hybrid)

    def __str__(self) -> str:
        return to_text(content(self.hybrid, "width"), TEXT_WIDTH).rstrip("\n")

    def _repr_latex_(self) -> str:
        return notebook_display(self.hybrid)

    def latex(self, form: str = "width") -> str:
        """LaTeX document of the whole model.

        Parameters
        ----------
        form : str, optional
            "width" (B, H) or "polar" (R, alpha).

        Returns
        -------
        str
            Text of the document.
        """
        return latex_document(self.hybrid, form)

    def markdown(self) -> str:
        """Same equations as a Markdown page.

        Returns
        -------
        str
            Text of the page.
        """
        return markdown_page(self.hybrid)


@explained.attributes(**_MEANT)
@explained.calls()
@dataclass(frozen=True, repr=False)
class RockingModel(HybridModel, Declared):
    """Structure: parameters, coordinates, modes and the transitions between them.

    Parameters
    ----------
    name : str
        Name of the model, in small letters, which its generated module has.
    title : str
        Title, in words.
    parameters : tuple of Parameter
        Constants of the model, made by `parameter`.
    coordinates : tuple of Coordinate
        Generalised coordinates, made by `coordinate`.
    modes : tuple of Mode
        Modes.
    transitions : tuple of Transition
        Transitions between the modes.
    rotation : Coordinate
        Coordinate that overturns.
    overturning : sympy.Expr, optional
        Size of the rotation at which the structure has overturned.
    definitions : tuple of Definition, optional
        Symbols that stand for expressions of the parameters.
    rigid_velocity_ratio : sympy.Expr, optional
        Ratio of the angular velocities at an impact of the rigid structure; derived if not given.
    reference : str, optional
        Source of the equations.
    functions : tuple of NamedFunction, optional
        Named functions in the equations.
    members : tuple of Member, optional
        Lines of a sketch between bodies.
    falls : dict of Coordinate to sympy.Expr, optional
        Further coordinates, each with the size at which the structure has overturned, as it has
        where the rotation reaches `overturning`.
    sources : dict of str to str, optional
        Sources of single equations, such as "thesis 2-9": of an equation of motion under the name
        of its coordinate, of others under "energy_ratio", "impact" and the names of reactions.
    search : Search, optional
        Search of the mode that follows an event; None for transitions that are declared.

    Raises
    ------
    ValueError
        For a declaration that cannot be meant; the message names the item and the remedy.
    """

    def __post_init__(self) -> None:
        check(self)

    @property
    def reduced(self) -> Self:
        """Itself, as a `Model` on pinned feet has it."""
        return self

    def equations(self, name: str, form: str = "width") -> Equations:
        """Equations of motion of a mode, its side and its switches put in as numbers.

        Parameters
        ----------
        name : str
            Name of the mode.
        form : str, optional
            "width", in half-widths and heights; "polar", in R and alpha; "small", of first order in
            coordinates and velocities; "slender", of first order in alpha and the horizontal
            acceleration of the ground as well; "nondimensional", of a block, in x = theta/alpha and
            time p t, the ground's acceleration in units of g (thesis 2-13).

        Returns
        -------
        Equations
            Mass matrix, forces and other parts of the equations.

        Raises
        ------
        KeyError
            If there is no mode of that name.
        ValueError
            For another form, and where a model has not this one.
        """
        derived = super().equations(name) if form == "width" else in_form(self, name, form)
        if form == "nondimensional":
            return derived
        return WrittenEquations.of(derived, self.mode(name), self)

    def impulse_map(self, source: str, target: str) -> ImpulseMap:
        derived = super().impulse_map(source, target)
        return WrittenImpulseMap.of(derived, self.mode(target), self)

    def linearize(
        self, mode: str, op_point: Mapping[str | sp.Symbol, sp.Expr | float] | None = None
    ) -> Linearization:
        """Equations of a mode to first order about a state.

        Parameters
        ----------
        mode : str
            Name of the mode.
        op_point : dict, optional
            Values of coordinates, velocities and accelerations in the state, by name or symbol,
            such as ``{"theta": 0.1}``: numbers or expressions of SymPy. Those not named are zero.

        Returns
        -------
        Linearization
            Matrices M, C, K, F and the constant vector f0; A and B of the state space.

        Raises
        ------
        KeyError
            If there is no mode of that name.
        InputError
            For names that are no coordinate, velocity or acceleration.

        Examples
        --------
        >>> import rockeom as rk
        >>> about_the_right_foot = rk.derive("rigid_block").linearize("right")
        >>> about_the_right_foot.K, about_the_right_foot.f0
        (Matrix([[-H*g*m]]), Matrix([[B*g*m]]))
        """
        return linearized(self, mode, op_point)

    def compare(
        self,
        equation: sp.Expr | sp.Eq,
        mode: str | None = None,
        impact: tuple[str, str] | None = None,
        ground: Collection[str] = ("a_x", "a_y"),
        values: Mapping[str, sp.Expr | float] | None = None,
    ) -> Comparison:
        """An equation typed by a reader, a paper's or a student's, against the derived ones.

        Parameters
        ----------
        equation : sympy.Expr or sympy.Eq
            Equation; an expression is zero. Symbols are matched by name whatever their
            assumptions: letters such as B, names such as half_width, theta_dot and theta_ddot,
            `dynamicsymbols` and their derivatives, theta_dot_after behind an impact, e and r for
            the ratios of velocities and energies; alpha, R, I_o and p of a block, too.
        mode : str, optional
            Mode, to compare with its equations of motion.
        impact : tuple of (str, str), optional
            Modes before and after an impact, to compare with its momenta and ratios.
        ground : collection of str, optional
            Accelerations of the ground that act; () for free motion, ("a_x",) for an equation
            without vertical ones.
        values : dict of str to sympy.Expr or float, optional
            Values of parameters in both equations, such as ``{"inertia": m*(B**2 + H**2)/3}`` of a
            uniform block, with symbols by name, too.

        Returns
        -------
        Comparison
            Whether they are equal, up to a factor; and the difference by physical term.

        Raises
        ------
        InputError
            For symbols that the model has not, and an equation that always holds.
        KeyError
            If there is no mode of that name.

        Examples
        --------
        >>> import rockeom as rk
        >>> from sympy import Eq, cos, sin, symbols
        >>> p, alpha, theta, theta_ddot = symbols("p alpha theta theta_ddot")
        >>> housner = Eq(theta_ddot, -p**2 * sin(alpha - theta))
        >>> bool(rk.derive("rigid_block").compare(housner, mode="right", ground=()))
        True
        """
        if (mode is None) == (impact is None) or not isinstance(impact, tuple | list | None):
            raise InputError("mode", of="compare").says(
                'give the mode of an equation of motion, mode="right", or the modes before and '
                'after an impact, impact=("right", "left")'
            )
        if impact is not None:
            return compared_at_impact(self, equation, *impact, values or {})
        return compared(self, equation, str(mode), ground, values or {})

    def lambdify(self) -> dict[str, NumpyMode]:
        """NumPy functions of arrays for every mode, for notebooks and checks of other programs.

        Returns
        -------
        dict of str to NumpyMode
            Functions by the name of the mode.

        Notes
        -----
        A simulation never calls them: its machine code comes from the text that `rockeom generate`
        prints. Tests hold both, and numba's compilation of the text, equal at random states.

        Examples
        --------
        >>> import rockeom as rk
        >>> block = rk.RigidBlock(half_width=0.1, half_height=0.4)  # m
        >>> right = rk.derive(block).lambdify()["right"]
        >>> right.accelerations([0.05, 0.0], block.parameters(), ax=1.0).round(3)  # rad/s2
        array([-5.242])
        """
        return numpy_functions(self)


class Description(TypedDict, total=False):
    """Further fields of a `RockingModel`."""

    overturning: sp.Expr
    reference: str
    sources: Mapping[str, str]
    members: Iterable[Member]
    falls: Mapping[Coordinate, sp.Expr]


class Rocking(Description, total=False):
    """Further fields of a `RockingModel` and of its `Mode`."""

    elastic_energy: sp.Expr
    dissipation: sp.Expr
    beside_feet: Point
    small: tuple[sp.Symbol, ...]
    elements: Iterable[Spring] | Callable[[Point], Iterable[Spring]]


@explained.calls()
def rocking_structure(
    *,
    name: str,
    title: str,
    parameters: Iterable[Parameter],
    coordinates: Iterable[Coordinate],
    bodies: Callable[[Point], Iterable[Body]],
    half_width: sp.Expr,
    gravity: sp.Expr,
    rotation_angle: sp.Expr | None = None,
    load_on: str | None = None,
    **declared: Unpack[Rocking],
) -> RockingModel:
    """Structure that rocks about the two edges of its base on rigid ground.

    Parameters
    ----------
    name : str
        Name of the model, in small letters, which its generated module has.
    title : str
        Title, in words.
    parameters : iterable of Parameter
        Constants of the model, made by `parameter`.
    coordinates : iterable of Coordinate
        Generalised coordinates; the first one is the rotation, positive clockwise, about the right
        edge.
    bodies : callable
        Function that gives the bodies when the structure turns about a pivot (x, y).
    half_width : sympy.Expr
        Half of the distance of the edges.
    gravity : sympy.Expr
        Symbol or value of the acceleration of gravity.
    rotation_angle : sympy.Expr, optional
        Angle of the rotation; the first coordinate if not given.
    load_on : str, optional
        Name of the body that carries the load of a pushover.
    **declared : object
        `elastic_energy`, `dissipation`, `beside_feet`, `small` and `elements` as in `Mode`,
        `elements` also a function of the pivot, as `bodies`; `overturning`, `reference`,
        `sources`, `members` and `falls` as in `RockingModel`.

    Returns
    -------
    RockingModel
        Model. Full contact is the same structure with the rotation held at zero.

    Raises
    ------
    ValueError
        For a declaration that cannot be meant; the message names the item and the remedy.

    Notes
    -----
    A `Model` on `Pinned()` feet becomes the same by `on_pinned_feet`. It cannot replace this one:
    bodies here depend on the foot, and may have places that no free coordinates give. Examples are
    a beam on the corners opposite the pressed feet, which changes them; a frame that the ground
    carries next to a wall, whose place no foot moves; and positions of first order.
    """
    coordinates = tuple(coordinates)
    if not coordinates:
        raise ValueError(f"{name}: it has no coordinates: declare the rotation, first")
    angle = coordinates[0].position if rotation_angle is None else rotation_angle
    described: Any = dict(declared)
    of_mode = Rocking.__annotations__.keys() - Description.__annotations__.keys()
    acting: Any = {k: described.pop(k) for k in of_mode & described.keys()}
    energies = {k: acting[k] for k in ("elastic_energy", "dissipation") if k in acting}
    valid.expressions(
        str(name), half_width=half_width, gravity=gravity, rotation_angle=angle, **energies
    )
    valid.points(str(name), beside_feet=acting.get("beside_feet", (0, 0)))
    if sp.sympify(half_width).is_nonpositive:
        raise InputError("half_width", half_width, name).hold("it must be positive")
    pivot = (SIDE * half_width, sp.Integer(0))
    turning = tuple(bodies(pivot))
    if callable(acting.get("elements")):
        acting["elements"] = tuple(acting["elements"](pivot))
    if not turning:
        raise ValueError(f"{name}: it has no bodies: declare the masses")
    load = turning[0].name if load_on is None else load_on
    require_word("load_on", load, [b.name for b in turning], str(name))
    edges = {"left": (-half_width, sp.Integer(0)), "right": (half_width, sp.Integer(0))}
    rocking = Mode(
        dict(SIDES),
        coordinates,
        turning,
        gravity,
        feet={foot: Foot(turned(edge, pivot, angle)) for foot, edge in edges.items()},
        load_point=next(b.position for b in turning if b.name == load),
        **acting | {k: sp.sympify(e) for k, e in energies.items()},
    )
    return on_pinned_feet(
        rocking, coordinates[0], name=name, title=title, parameters=parameters, **described
    )


SIDES = {"left": -1, "right": 1}
"""The side of the foot about which a structure rocks, by its name."""


def on_pinned_feet(
    rocking: Mode,
    rotation: Coordinate,
    *,
    name: str,
    title: str,
    parameters: Iterable[Parameter],
    **described: Unpack[Description],
) -> RockingModel:
    """A structure on two feet that neither slip nor bounce, by its mode on one of them.

    rocking : about the foot of the side s; it has the places of both feet. As the structure leans
    to the side of that foot the other one rises, and where it comes upright both feet are on the
    ground: that is the impact. Full contact is the same mode, the rotation at zero, and either foot
    may lift from there.

    Raises ValueError where the feet do not rise and land so.
    """
    check_turning(name, rocking, rotation)
    several: Any = {"members": tuple(described.get("members", ()))}
    full = _upright(rocking, rotation)
    (both,) = full.names
    opposite = dict(zip(SIDES, reversed(SIDES), strict=True))
    return RockingModel(
        name,
        title,
        tuple(parameters),
        coordinates=rocking.coordinates,
        modes=(rocking, full),
        transitions=(
            *(
                Transition(foot, opposite[foot], "impact", side * rotation.position, both)
                for foot, side in SIDES.items()
            ),
            *(Transition(both, foot, "uplift") for foot in SIDES),
        ),
        rotation=rotation,
        **described | several,
    )


def _upright(rocking: Mode, rotation: Coordinate) -> Mode:
    """The mode on both feet: that on one of them, the rotation held at zero."""
    held = {rotation.position: 0}

    def hold(expr) -> sp.Expr:
        return at_side(sp.sympify(expr).subs(held), 1)

    def still(expr) -> sp.Expr:
        return sp.sympify(expr).subs({rotation.velocity: 0, **held})

    def point(place: tuple[sp.Expr, sp.Expr]) -> tuple[sp.Expr, sp.Expr]:
        return hold(place[0]), hold(place[1])

    load = rocking.load_point
    return Mode(
        {"both": 0},
        tuple(c for c in rocking.coordinates if c != rotation),
        tuple(
            replace(b, position=point(b.position), rotation=hold(b.rotation), polar=None)
            for b in rocking.bodies
        ),
        rocking.gravity,
        sp.sympify(rocking.elastic_energy).subs(held),
        still(rocking.dissipation),
        {name: Foot(point(foot.position)) for name, foot in rocking.feet.items()},
        None if load is None else point(load),
        rocking.small,
        beside_feet=(still(rocking.beside_feet[0]), still(rocking.beside_feet[1])),
        elements=tuple(e.changed(hold) for e in rocking.elements),
    )
