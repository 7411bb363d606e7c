"""An explorer: a structure, its motion and sliders in one HTML file that integrates by itself."""

from __future__ import annotations

import base64
import gzip
import hashlib
import html
import itertools
import json
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from rockeom import files as whole
from rockeom.browser.code import script
from rockeom.browser.controls import Controls, Menu, Slider, check_mapping, controls_of
from rockeom.browser.lesson import COMPARED, FATES, OBJECTS, Motions, Question, ends_of, readings_of
from rockeom.browser.places import NUMBERS
from rockeom.browser.program import METHOD, Portable, portable
from rockeom.browser.setup import Setup, setup_of
from rockeom.browser.sizes import Sized, can_be_enlarged
from rockeom.browser.texts import with_texts
from rockeom.browser.traced import UntracedError
from rockeom.browser.webassembly import Module, module
from rockeom.browser.widget import widget_of
from rockeom.codes import OUTCOMES
from rockeom.compiler.modules import Text
from rockeom.compiler.types import Array
from rockeom.integrator.schema import in_space
from rockeom.numbers.checks import InputError, InputTypeError, require
from rockeom.simulation.case import Case
from rockeom.simulation.options import SolverOptions
from rockeom.simulation.simulate import simulated
from rockeom.structures.base import Structure
from rockeom.structures.positions import legs, size_of_place
from rockeom.structures.units import main_units
from rockeom.sweeps.case_numbers import OtherCase

ENTRIES = ("motion", "fate", "places", "corners", "energy_history")
MOTIONS = 8
"""Places of the sliders whose motions are compared with `rk.simulate`."""
MOST_AXES, COARSE = 5, 4
"""Sliders that may be axes of the first map, and values of each at which the fates are compared."""
_SCRIPTS = (
    "texts.js", "runtime.js", "views.js", "energy.js", "charts.js", "map.js", "sizes.js",
    "panel.js", "address.js", "plane.js", "lesson.js", "tools.js", "page.js",
)  # fmt: skip
_IN_PLANE = ("drawing.js", "phase.js", "verdict.js")
_IN_SPACE = ("surface.js", "orbit.js", "scene.js", "lean.js")
"""Scripts of pages of structures in the plane alone, and in space."""
_ALONG = (("ground",), ("ground_x", "ground_y"))
"""Names of the texts of the ground's horizontal components, in the plane and in space."""
_AZIMUTHS = ("azimuth", "azimuth_degrees")
_INTENSITIES = ("motion.scale", "amplitude", "pga", "scale")
MOST_VERTICES = 20000
"""The most vertices of a surface: the drawing of more takes too long."""
_ASSETS = files("rockeom").joinpath("browser", "assets")
_POLICY = (
    "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; base-uri 'none'; "
    "form-action 'none'; img-src data:; worker-src blob:; "
    "script-src 'sha256-{}' 'wasm-unsafe-eval'; style-src 'sha256-{}'\" />"
)
"""The Content-Security-Policy of a page: its own script and style by their hashes, no other."""


def explorer(
    case: Case | Callable[..., Case],
    sliders: Mapping[str, Slider | tuple[float, ...]],
    title: str = "",
    *,
    menus: Mapping[str, Mapping[str, Any]] | None = None,
    presets: Mapping[str, Mapping[str, Any]] | None = None,
    questions: Sequence[Question] = (),
    texts: Mapping[str, Any] | None = None,
) -> Explorer:
    """Page in which the motion of a case follows sliders, integrated in the browser.

    Parameters
    ----------
    case : Case or callable
        A case, whose numbers the sliders are by name, as in sweeps; or a function of the sliders
        that gives one.
    sliders : dict of str to Slider or tuple of float
        For each the lowest and the highest value, and the first one; if that is not given, the
        value of the case or the middle; or a `Slider`, which has a unit and words, too.
    title : str, optional
        Title of the page; the structure if not given.
    menus : dict of str to dict of str to object, optional
        Parts of the case to choose from, by the name of the part ("impact", "motion", "initial",
        "vertical", or an argument of the function) and a label of each.
    presets : dict of str to dict of str to object, optional
        Values of sliders and menus, by a name.
    questions : sequence of Question, optional
        Questions to predict, and then to see.
    texts : dict of str to object, optional
        Words of the page in place of its own, by their names in its table `TEXTS`, with the same
        places {0}; "names" are those of sliders, menus, states and presets.

    Returns
    -------
    Explorer
        Page, to save or to show in a notebook.

    Raises
    ------
    UntracedError
        Where a page could not repeat a line of the function, which the message names.
    ValueError
        For sliders without a range, for more than 12 controls and 24 combinations of menus, and for
        presets and questions outside of them.

    Notes
    -----
    All that happens between the sliders and the equations of motion is recorded, and compared with
    Python at 2048 places of the sliders before there is a page. Records that a page shows are a
    part of its file, with their licence.

    Examples
    --------
    >>> import rockeom as rk
    >>> block = rk.RigidBlock(half_width=0.1, half_height=0.6)  # m
    >>> pulse = rk.GroundMotion.half_sine(3.0, 0.8, duration=6.0)  # m/s2, s, s
    >>> sliders = {"half_width": (0.05, 0.4), "amplitude": (0.5, 8.0)}
    >>> page = rk.explorer(rk.Case(block, pulse), sliders)
    >>> page.save("block.html")  # doctest: +SKIP
    """
    if not (isinstance(case, Case) or callable(case)):
        raise InputTypeError("case", case).give("a case, or a function of the sliders")
    for name, given in (("sliders", sliders), ("menus", menus or {}), ("presets", presets or {})):
        check_mapping(name, given)
    if isinstance(questions, Question) or not all(isinstance(q, Question) for q in questions):
        raise InputTypeError("questions", questions).give("a list of rk.Question(...)")
    function, controls = controls_of(case, sliders, menus or {})
    return Explorer(
        function,
        controls,
        title,
        {**_objects(function, controls.of), **(presets or {})},
        tuple(questions),
        texts or {},
    )


def _objects(function: Callable[..., Case], controls: Mapping[str, Any]) -> dict[str, Any]:
    """Objects of every day that are in the range of the sliders, for a page of a block."""
    of_block = isinstance(function, OtherCase) and type(function.case.structure).__name__
    if of_block != "RigidBlock" or not {"half_width", "half_height"} <= controls.keys():
        return {}
    return {
        name: {"half_width": b, "half_height": h}
        for name, (b, h) in OBJECTS.items()
        if all(controls[n].low <= x <= controls[n].high
               for n, x in (("half_width", b), ("half_height", h)))
    }  # fmt: skip


@dataclass(frozen=True)
class Explorer:
    """Page with sliders; see `explorer`. It is made when it is first asked for.

    Parameters
    ----------
    case : callable
        Function of the sliders that gives a case.
    controls : Controls
        Sliders and menus.
    title : str, optional
        Title; the structure if not given.
    presets : dict of str to dict of str to object, optional
        Values of sliders and menus, by the name of the preset.
    questions : tuple of Question, optional
        Questions to predict.
    texts : dict of str to object, optional
        Words of the page in place of its own, by their names.
    """

    case: Callable[..., Case]
    controls: Controls
    title: str = ""
    presets: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    questions: tuple[Question, ...] = ()
    texts: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name, values in self.presets.items():
            self.controls.places(f"preset {name!r}", values)
        for question in self.questions:
            question.described(self.controls)
            if question.compare == "peak" and self._spatial:
                raise InputError("compare", "peak", f"question {question.text!r}").says(
                    "the structure moves in space, where pages compare no largest rotation: ask "
                    "whether it overturns, or of impacts"
                )
        if self.texts:
            _ = self._script

    def save(self, path: str | Path) -> Path:
        """Write the page into one HTML file, which needs no network.

        Parameters
        ----------
        path : path_like
            File.

        Returns
        -------
        path_like
            Path of the file.
        """
        whole.write(path, self.html)
        return Path(path)

    def widget(self) -> Any:
        """Page as a widget of a notebook, with the extra `widget` (anywidget).

        Returns
        -------
        anywidget.AnyWidget
            Widget. Its `values` are those of the sliders and menus by name: they follow the page,
            and the page follows them. Its `case` is the case at them.

        Raises
        ------
        ModuleNotFoundError
            Without anywidget.

        Examples
        --------
        With an explorer `page`::

            shown = page.widget()
            shown.values = {"half_width": 0.2}
            rk.simulate(shown.case)
        """
        return widget_of(self.heading, self.html, self.controls, self.case)

    def _repr_html_(self) -> str:
        """The page in a frame of its own, as Jupyter shows it."""
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" style="width:100%;height:84em;border:0" '
            'sandbox="allow-scripts allow-downloads"></iframe>'
        )

    @cached_property
    def html(self) -> str:
        """The page as text."""
        page = _asset("page.html")
        data = {"program": _packed(self.module.code), "of": self.description()}
        if self._spatial:
            data["surfaces"] = _packed(self._surfaces[1])
        style = _asset("page.css")
        parts = {
            "title": html.escape(self.heading),
            "policy": _POLICY.format(_digest(self._script), _digest(style)),
            "style": style,
            "data": json.dumps(data, separators=(",", ":")).replace("<", "\\u003c"),
            "script": self._script,
        }
        for name, text in parts.items():
            page = page.replace(f"<!-- {name} -->", text)
        return page

    @cached_property
    def _script(self) -> str:
        """The scripts of the page, with its texts."""
        own = _IN_SPACE if self._spatial else _IN_PLANE
        texts, *others = map(_asset, (*_SCRIPTS, *own))
        table = with_texts(texts, self.texts, self._words(), self._spatial)
        return "\n".join((table, *others))

    # --- what a page consists of

    @property
    def heading(self) -> str:
        """Title of the page."""
        title = self.title or type(self._structure).__name__
        # the name of a file may have bytes that are no text
        return title.encode("utf-8", "surrogateescape").decode("utf-8", "replace")

    @cached_property
    def _first(self) -> Case:
        return self.case(**self.controls.named(self.controls.start))

    @property
    def _structure(self) -> Structure:
        return self._first.structure

    @cached_property
    def _sized(self) -> Sized | None:
        """The case with a factor of size, where the structure can be enlarged."""
        return Sized(self.case) if can_be_enlarged(self._structure) else None

    @cached_property
    def setup(self) -> Setup:
        """The set-up of the case, compared with Python."""
        if self._sized is None:
            return setup_of(self.case, self.controls)
        size = {self._sized.name: Slider(1.0, 4.0, 1.0)}
        return setup_of(self._sized, Controls({**self.controls.of, **size}))

    @cached_property
    def program(self) -> Portable:
        """The program of the page."""
        return portable(self._structure.module, METHOD, self._questions, self._written())

    @cached_property
    def _native(self) -> Motions:
        """The motions of the page by machine code."""
        readings, native = np.zeros(len(COMPARED)), self.program.native(self._structure.module)
        motion = native.fate.bound(self.setup.controls.start, 0.0, readings)

        def of_motion(place: np.ndarray, end: float = 0.0) -> tuple[str, list[float]]:
            motion["sliders"], motion["end"] = place, end
            return OUTCOMES.get(int(motion()), "unknown"), readings.tolist()

        return of_motion

    @cached_property
    def _ends(self) -> list[list[float]]:
        """The times until which the motions of each question go on."""
        setup = self.setup
        return [ends_of(q, setup.case, setup.controls, self._native) for q in self.questions]

    @cached_property
    def module(self) -> Module:
        """Program as WebAssembly, with the functions that a page calls.

        Its motions were compared with `rk.simulate`.
        """
        self._compare()
        ir = self.program.ir
        for name in self.program.entries:
            if name not in self.entries:
                ir = ir.replace(f"define void @{name}(ptr", f"define internal void @{name}(ptr")
        return module(ir, self.entries)

    @property
    def _questions(self) -> tuple[str, ...]:
        """The modules whose entries a page calls."""
        more = "space" if self._spatial else "balance"
        modules = (
            ["questions", more] + ["verdict"] * self._has_statics + ["forces"] * self._draws_forces
        )
        return tuple(f"rockeom.browser.{name}" for name in modules)

    @property
    def _spatial(self) -> bool:
        return in_space(self._structure.module)

    @property
    def _has_statics(self) -> bool:
        """Whether a page tells the acceleration that lifts a foot: in the plane, with feet."""
        return self._structure.rocks_on_rigid_ground and not self._spatial

    @property
    def _body(self) -> int:
        """The place of the body whose lean a page shows: the last one, a column below a slab."""
        kinds = enumerate(self._structure.module.POSITION_KINDS)
        return max((i for i, kind in kinds if kind == "body"), default=0)

    @property
    def _draws_forces(self) -> bool:
        """Whether it draws elements by their forces."""
        return bool({"tendon", "push"} & {*self._structure.module.POSITION_KINDS})

    def _written(self) -> tuple[Text, ...]:
        """The texts that questions take from the set-up and from the structure."""
        names = "MOST_P, N_NUMBERS, ROWS_X, ROWS_T, ROWS_Y, BODY"
        sizes = f"{names} = {', '.join(map(str, (*self.setup.sizes, self._body)))}\n"
        if self._has_statics:
            m = self._structure.module
            left, right = (m.REACTIONS.index(f"{side}_reaction") for side in ("left", "right"))
            sizes += f"BOTH_MODE, N_REACTIONS = {m.MODES.index('both')}, {len(m.REACTIONS)}\n"
            sizes += f"LEFT_FOOT, RIGHT_FOOT = {left}, {right}\n"
        return self.setup.text, Text("sizes of the set-up", sizes)

    @property
    def entries(self) -> tuple[str, ...]:
        """The functions that a page calls: of its texts, statics of feet, forces that it draws."""
        feet = self._has_statics
        own = "leans" if self._spatial else "balance"
        return (*ENTRIES, own, *["uplift_and_friction"] * feet, *["forces"] * self._draws_forces)

    def description(self) -> dict[str, Any]:
        """Names, units and sizes that a page needs besides its program.

        Returns
        -------
        dict of str to object
            Data of the page.
        """
        structure = self._structure
        m = structure.module
        # a round base that lies flat has no state
        y = self._first.problem().y0 if self._spatial else structure.state({})
        named = isinstance(self.case, OtherCase)  # whose names are those of parameters
        meanings = dict(zip(m.PARAMETERS, m.PARAMETER_MEANINGS, strict=True)) if named else {}
        return {
            "title": self.heading,
            "structure": type(structure).__name__,
            "dataEnd": self.module.data_end,
            "entries": {name: _entry(self.program, name) for name in self.entries},
            "sliders": [
                {
                    "name": name, "low": one.low, "high": one.high, "start": one.start,
                    "unit": one.unit, "meaning": meanings.get(name, ""),
                }
                for name, one in self.controls.of.items() if isinstance(one, Slider)
            ],
            **self._choices(),
            "numbers": self.setup.sizes[1],
            "start": self.setup.controls.start.tolist(),
            "states": m.STATES, "stateUnits": m.STATE_UNITS,
            "energyUnit": main_units(m)["total_energy"],
            "groundUnit": main_units(m)["ground_acceleration"],
            "ground": (*_ALONG[self._spatial], "vertical"),
            "place": size_of_place(m),
            **({"space": self._in_space()} if self._spatial else {}),
            "rotation": m.ROTATION, "positions": m.POSITIONS, "kinds": m.POSITION_KINDS,
            "corners": m.CORNERS, "members": m.MEMBERS, "memberEnds": m.MEMBER_ENDS,
            "elements": m.ELEMENT_NAMES, "copies": m.COPIES, "mostP": self.setup.sizes[0],
            "legs": legs(structure, structure.mode_number(y), y),
            "weight": self._assumed_weight(), "axes": self._axes(),
            "outcomes": [OUTCOMES[i] for i in sorted(OUTCOMES)],
        }  # fmt: skip

    def _in_space(self) -> dict[str, Any]:
        """The body, the feet and the surfaces of a structure in space, which its page draws."""
        m = self._structure.module
        points = getattr(m, "POINTS", ())
        feet = points or [n for n, k in zip(m.POSITIONS, m.POSITION_KINDS, strict=True)
                          if k == "massless"]  # fmt: skip
        return {
            "body": self._body, "feet": [m.POSITIONS.index(name) for name in feet],
            "digits": bool(points), "round": len(feet) < 3, "solids": self._surfaces[0],
        }  # fmt: skip

    @cached_property
    def _surfaces(self) -> tuple[list[dict[str, int]], bytes]:
        """The surfaces of bodies: sizes, and vertices that stay, behind them the faces.

        at : the place in the numbers of a motion of vertices that do not stay, -1 of others.
        """
        rows, floats, wholes, at = [], b"", b"", NUMBERS
        for name, solid in self._structure.solids.items():
            (n, _), (m, k) = solid.vertices.shape, solid.faces.shape
            require(
                n <= MOST_VERTICES,
                "explorer",
                "mesh",
                n,
                f"simplify it to {MOST_VERTICES} vertices",
            )
            varied = name in self.setup.varied
            place = self._structure.module.POSITIONS.index(name)
            rows.append(
                {
                    "place": place,
                    "vertices": n,
                    "faces": m,
                    "corners": k,
                    "at": at if varied else -1,
                }
            )
            at += 3 * n * varied
            floats += b"" if varied else solid.vertices.astype("<f4").tobytes()
            wholes += solid.faces.astype("<u2").tobytes()
        return rows, floats + wholes

    def _assumed_weight(self) -> list[int] | None:
        """Places of the first mass and of gravity in the parameters, where masses are defaults."""
        m, values = self._structure.module, self._structure.parameters()
        defaults, names = type(self._structure).defaults(), m.PARAMETERS
        masses = [n for n, unit in zip(names, m.PARAMETER_UNITS, strict=True) if unit == "kg"]
        if not masses or any(values[n] != defaults.get(n) or n in self.controls.of for n in masses):
            return None
        return [names.index(masses[0]), names.index("gravity")]

    def _axes(self) -> tuple[int, ...]:
        """The sliders of the first map: azimuth and intensity, or those on which most depends."""
        names = [*self.controls.of]
        own = [n for n in (*_AZIMUTHS, *_INTENSITIES) if n in names]
        if own and own[0] in _AZIMUTHS and own[-1] in _INTENSITIES:
            return names.index(own[0]), names.index(own[-1])
        sliders = [i for i, one in enumerate(self.controls.of.values()) if isinstance(one, Slider)]
        pairs = [*itertools.combinations(sliders[:MOST_AXES], 2)]
        return max(pairs, key=self._dependence) if len(pairs) > 1 else (sliders[0], sliders[-1])

    def _dependence(self, pair: tuple[int, ...]) -> tuple[int, float]:
        """How often both fates meet along either of two sliders, and the share of the rarer one."""
        place, fates = self.setup.controls.start, np.zeros((COARSE, COARSE))
        ranges = [[*self.controls.of.values()][i] for i in pair]
        for at in np.ndindex(fates.shape):
            place[[*pair]] = [one.at(k / (COARSE - 1)) for one, k in zip(ranges, at, strict=True)]
            fates[at] = FATES.get(self._native(place)[0], 0.0)
        meetings = (np.sum(abs(np.diff(fates, axis=axis)) == 2.0) for axis in (0, 1))
        return min(meetings), min(np.mean(fates == fate) for fate in (-1.0, 1.0))

    def _words(self) -> dict[str, str]:
        """The words of names on the page, where no others are given."""
        names = (*self.controls.of, *self._structure.states, *self.presets)
        words = {name: name.replace("_", " ") for name in names}
        return words | {name: one.words for name, one in self.controls.of.items()
                        if isinstance(one, Slider) and one.words}  # fmt: skip

    def _choices(self) -> dict[str, Any]:
        """Menus, presets and questions, and code that simulates the same."""
        controls = self.controls
        choices: dict[str, Any] = {
            "menus": [
                {"name": name, "options": one.labels}
                for name, one in controls.of.items()
                if isinstance(one, Menu)
            ],
            "presets": [
                {"name": name, "values": controls.places("presets", values)}
                for name, values in self.presets.items()
            ],
            "questions": [
                {**question.described(controls), "ends": ends}
                for question, ends in zip(self.questions, self._ends, strict=True)
            ],
            "code": script(self.case, controls),
        }
        return choices if self._sized is None else {**choices, "size": len(controls.of)}

    # --- the comparison of motions

    def _compare(self) -> None:
        """Raise UntracedError where too many motions of the page are not those of `rk.simulate`."""
        differ = [place for place, same in self._motions() if not same]
        if len(differ) > MOTIONS // 4:
            raise UntracedError(
                f"{len(differ)} of {MOTIONS} motions of the page end otherwise than those of "
                f"`rk.simulate`, such as at {differ[0]}: they are too sensitive for a page"
            )

    def _motions(self) -> Iterator[tuple[dict[str, float], bool]]:
        """Places of the sliders, and whether the motions there end alike and reach as far."""
        setup = self.setup
        for place in itertools.islice(setup.controls.spread(MOTIONS), 2, None):
            named = setup.controls.named(place)
            try:
                case = setup.case(**named)
                run = simulated(case, case.problem(), SolverOptions(method=METHOD))
            except ValueError:
                continue
            outcome, (_, peak, *_) = self._native(place)
            wanted = readings_of(run)[1]
            near = abs(peak - wanted) <= 1e-6 * max(wanted, 1e-9)
            yield named, outcome == str(run.outcome) and near


def _asset(name: str) -> str:
    """A file of the page without comments and indents, a third of it: the source is for readers."""
    text = _ASSETS.joinpath(name).read_text("utf-8")
    comments = r"^ *//[^\n]*\n|(?<=;) //[^\n]*|/\*\*.*?\*/ ?"
    text = re.sub(comments, "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"^\s+", "", text, flags=re.MULTILINE)


def _digest(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _packed(code: bytes) -> str:
    return base64.b64encode(gzip.compress(code, 9, mtime=0)).decode()


def _entry(made: Portable, name: str) -> list[list[Any]]:
    """Name, type and number of dimensions of each argument."""
    return [
        [argument, type_.element, type_.dimensions] if isinstance(type_, Array) else
        [argument, type_, 0]
        for argument, type_ in made.entries[name].arguments
    ]  # fmt: skip
