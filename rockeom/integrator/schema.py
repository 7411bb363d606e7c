"""The interface of a generated module, and functions that follow from it alone."""

from typing import Any, Protocol, TypeGuard

from rockeom.codes import CONTACT_LAWS, LANDING, NEWTON

PRELUDE = "rockeom.generated.prelude"
PROVIDED = "rockeom.integrator.provided"
"""The module that declares the names which are different ones in each program."""


class GeneratedModule(Protocol):
    """A structure's tables and functions, as the derivation writes them.

    Functions take the number of a mode, a state y (N,), and p, the parameters with the constants
    that `prepare` computes from them; ax, ay [m/s2] are accelerations of the ground. A structure in
    space has a table GROUND, and its functions take one acceleration more: ax, ay, az, the vertical
    one last. They fill `out`, in the order of the table that has their name, such as ENERGIES.
    Their arrays may hold duals and batches, in the module that
    `rockeom.numbers.functions.for_arrays` makes of this one.
    """

    __name__: str
    __doc__: str | None
    SOURCE_HASH: str

    NAME: str
    CLASS: str
    STATES: tuple[str, ...]
    STATE_UNITS: tuple[str, ...]
    PARAMETERS: tuple[str, ...]
    PARAMETER_UNITS: tuple[str, ...]
    PARAMETER_MEANINGS: tuple[str, ...]
    PARAMETER_SIGNS: tuple[str, ...]
    SIZES: tuple[tuple[str, bool, tuple[str, ...], str], ...]
    MODES: tuple[str, ...]
    TRANSITIONS: tuple[tuple[str, str, str], ...]
    ENERGIES: tuple[str, ...]
    REACTIONS: tuple[str, ...]
    KINEMATICS: tuple[str, ...]
    POSITIONS: tuple[str, ...]
    POSITION_KINDS: tuple[str, ...]
    CORNERS: tuple[str, ...]
    MEMBERS: tuple[str, ...]
    MEMBER_ENDS: tuple[str, ...]
    COPIES: tuple[str, ...]
    ELEMENT_NAMES: tuple[str, ...]

    N_STATES: int
    N_GUARDS: int
    N_PARTS: int
    ROTATION: int
    ROTATION_RATE: int
    N_FALLS: int
    SIDES: tuple[float, ...]
    GUARDS: tuple[int, ...]
    KINDS: tuple[tuple[int, ...], ...]
    TARGETS: tuple[tuple[int, ...], ...]
    REVERSE: tuple[tuple[int, ...], ...]
    PARTS: tuple[tuple[int, ...], ...]
    LOCALISED: bool
    HAS_IMPULSIVE: bool

    def __hash__(self) -> int: ...
    def prepare(self, parameters: Any, /) -> Any: ...
    def overturning(self, p: Any, /) -> Any: ...
    def velocity_ratio(self, p: Any, /) -> Any: ...
    def sizes(self, p: Any, out: Any, /) -> None: ...
    def shapes(self, p: Any, out: Any, /) -> None: ...
    def rates(self, mode: int, y: Any, p: Any, /, *shaking_and_dy: Any) -> None: ...
    def jump(
        self, mode: int, guard: int, law: int, ratio: float, y: Any, p: Any, out: Any, /
    ) -> int: ...
    def guards(self, mode: int, y: Any, p: Any, /, *shaking_and_g: Any) -> None: ...
    def reactions(self, mode: int, y: Any, p: Any, /, *shaking_and_out: Any) -> None: ...
    def energies(self, mode: int, y: Any, p: Any, out: Any, /) -> None: ...
    def kinematics(self, mode: int, y: Any, p: Any, out: Any, /) -> None: ...
    def momentum(self, mode: int, y: Any, p: Any, out: Any, /) -> None: ...
    def positions(self, mode: int, y: Any, p: Any, out: Any, /) -> None: ...
    def elements(self, mode: int, y: Any, p: Any, out: Any, /) -> None: ...
    def statics(self, mode: int, y: Any, p: Any, load: Any, out: Any, /) -> None: ...


class SearchedModes(GeneratedModule, Protocol):
    """One whose modes are those of its contact points and elements.

    The mode that follows an event is searched for. Each point has its friction and restitution.
    """

    POINTS: tuple[str, ...]
    POINT_STATES: tuple[tuple[int, ...], ...]
    ELEMENTS: tuple[str, ...]
    ELEMENT_STATES: tuple[tuple[int, ...], ...]
    SHARED: tuple[tuple[int, ...], ...]
    SUBJECTS: tuple[tuple[int, ...], ...]

    def points(self, y: Any, p: Any, out: Any, /) -> None: ...
    def point_laws(self, p: Any, out: Any, /) -> None: ...
    def free_motion(self, y: Any, p: Any, /, *shaking_mode_matrix_forces: Any) -> None: ...


def ground_axes(module: Any) -> tuple[str, ...]:
    """The components of the ground's acceleration in the order of the module's arguments.

    Those of a structure in space are "horizontal", "transverse" and "vertical".
    """
    return getattr(module, "GROUND", ("horizontal", "vertical"))


def in_space(module: Any) -> bool:
    """Whether a structure moves in space, and not in a plane."""
    return len(ground_axes(module)) == 3


def still_ground(module: Any) -> tuple[float, ...]:
    """The accelerations of ground that stands still."""
    return (0.0,) * len(ground_axes(module))


def is_by_code(module: Any) -> bool:
    """Whether the number of a mode has a digit for each point, and modes are solved as numbers."""
    return getattr(module, "BY_CODE", False)


def has_points(module: Any) -> TypeGuard[SearchedModes]:
    """Whether a structure's modes are searched for among those of its points and elements."""
    return hasattr(module, "POINT_STATES")


def impact_law(module: Any) -> int:
    """The impact law of the points of a structure: the number of one of `CONTACT_LAWS`."""
    return getattr(module, "IMPACT_LAW", NEWTON)


def name_of_law(module: Any) -> str:
    """The name of the impact law of the points of a structure; empty for Newton's."""
    law = impact_law(module)
    return "" if law == NEWTON else next(n for n, code in CONTACT_LAWS.items() if code == law)


def has_landings(module: GeneratedModule) -> TypeGuard[SearchedModes]:
    """Whether points land, each by its own impact law, and may slide."""
    return any(LANDING in kinds for kinds in module.KINDS)


def angles(module: GeneratedModule) -> tuple[float, ...]:
    """1 of each coordinate that is an angle, 0 of others."""
    units = module.STATE_UNITS[: module.N_STATES // 2]
    return tuple(1.0 if unit == "rad" else 0.0 for unit in units)
