"""Results that last: through files, pickles and copies, and in another process."""

import copy
import dataclasses
import enum
import functools
import hashlib
import json
import multiprocessing
import os
import pickle
import time
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import rockeom as rk
from rockeom.exports import responses
from rockeom.files import TEMPORARY
from rockeom.simulation import extremes, saved
from rockeom.simulation.events import KINDS, EventColumns, Events
from rockeom.simulation.response import Response
from rockeom.simulation.steps import Steps
from rockeom.structures.classes import SHIPPED
from rockeom.structures.units import main_units
from rockeom.symbolic.model import Body, coordinate, parameter, turned
from rockeom.symbolic.rocking import rocking_structure
from tests.pipes import pipe
from tests.shipped import plain
from tests.typical import S1, column

BLOCK = rk.RigidBlock(half_width=0.095, half_height=0.45)
PULSE = rk.GroundMotion.single_sine(amplitude=2.8, period=0.5, duration=4.0)
LAW = rk.EnergyRatio(left=0.83, right=0.91)


def declared(share=1):
    """A hollow ring on a flat base, which no file of the package declares.

    share : of its mass that turns with it; the rest does not.
    """
    m = parameter("m", "mass", "kg", "mass")
    r = parameter("r", "radius", "m", "distance of the mass from the centroid")
    b = parameter("B", "half_width", "m", "half of the width of the base")
    g = parameter("g", "gravity", "m/s2", "acceleration of gravity")
    theta = coordinate("theta", "theta", "rad", "rotation, positive clockwise")

    def bodies(pivot):
        place = turned((0, r.symbol), pivot, theta.position)
        return [Body("ring", m.symbol, place, share * m.symbol * r.symbol**2, theta.position)]

    return rocking_structure(
        name="ring_of_a_user", title="Hollow ring", parameters=(m, r, b, g), coordinates=(theta,),
        bodies=bodies, half_width=b.symbol, gravity=g.symbol,
    )  # fmt: skip


@functools.cache
def ring() -> rk.Structure:
    return rk.structure(declared(), mass=3.0, radius=0.5, half_width=0.1)


def frame(support) -> rk.ShearFrame:
    return rk.ShearFrame(
        masses=[20e3, 15e3], heights=[3.0, 6.5], stiffnesses=[30e6, 20e6], dampings=[0.0, 1e4],
        half_width=1.5, base_mass=30e3, base_inertia=2e4, support=support,
    )  # fmt: skip


OTHERS = {
    "wall with an energy ratio in pieces": lambda: rk.ControlledWallOscillator.thesis(
        rk.EnergyRatioAtSpeed.equation_4_31(), held=False
    ),
    "structure on springs": lambda: rk.LumpedMassStructure(
        **S1, support=rk.TwoSprings(stiffness=550e3, damping=3e3)
    ),
    "frame": lambda: frame(None),
    "frame that slides": lambda: frame(rk.Sliding(friction=0.5, restitution=0.0)),
    "column whose feet are held": lambda: column().fixed_base(),
    "declared": ring,
}


def structure_of(name: str) -> rk.Structure:
    return OTHERS[name]() if name in OTHERS else SHIPPED[name](**plain(name))


def made_up(structure, samples=None) -> Response:
    """A response that nobody simulated, each number of which is another."""
    rng = np.random.default_rng(3)
    n, n_modes, k = len(structure.states), len(structure.module.MODES), 7
    powers = rng.standard_normal((k, 8, n))
    powers[0, 0, 0], powers[1, 1, 0] = -0.0, 5e-324
    span = np.column_stack([0.1 * np.arange(k), np.full(k, 0.1)])
    steps = Steps(span, rng.integers(0, n_modes, k), powers)
    kinds = rng.integers(0, (len(KINDS), n_modes, n_modes, 2), (3, 4))
    end, times = rng.standard_normal(n), rng.uniform(size=3)
    return Response(
        structure, PULSE, rk.GroundMotion.from_array([0.0, 1 / 3, -0.1], 0.01), LAW,
        rk.SolverOptions(max_step=0.5), rk.Outcome.STALLED, 0.7,
        {"steps": k, "method": "DOP853", "chosen": "named"}, steps,
        Events(structure, EventColumns(times, kinds, rng.standard_normal((3, 2, n)))), end,
    )  # fmt: skip


def bits(value) -> str:
    """All of a value, so that two that differ in a bit are told apart."""
    if isinstance(value, np.ndarray) and value.dtype.kind == "f":
        return bits((value.shape, value.tobytes()))
    if isinstance(value, float):
        return value.hex()
    if isinstance(value, enum.Enum):
        return value.name
    if isinstance(value, dict):
        return bits([*value.items()])
    if isinstance(value, list | tuple | np.ndarray):
        return str([bits(item) for item in value])
    if dataclasses.is_dataclass(value):
        return bits([type(value).__name__, dataclasses.astuple(value)])
    return repr(value)


def facts(run: Response) -> dict[str, str]:
    """All properties of a response and of its parts, and its methods that take no argument."""
    found: dict[str, Any] = {}
    for part in (run, run.support, run.impacts, run.places):
        for name in dir(part):
            if name.startswith("_"):
                continue
            value = getattr(part, name)
            value = value() if name in ASKED else value
            if not (callable(value) or name in ("support", "places")):
                found[f"{type(part).__name__}.{name}"] = value
    found |= {f"run[{name}]": run[name] for name in run.names}
    found |= {f"extremes of {name}": e for name, e in run.extremes_of(run.names).items()}
    found["at"] = run.at([0.0, 0.5, 1.0], names=run.names)
    found |= {"vector": run.structure.vector, "motion": run.motion.segments}
    found |= {"record": run.motion.samples, "name": run.motion.name, "options": run.options}
    found["impact"] = run.impact
    return {n: hashlib.sha256(bits(value).encode()).hexdigest() for n, value in found.items()}


ASKED = ("describe", "above", "impulses", "positions", "rotations", "summary")
"""Methods that want no argument."""


def stored(run: Response) -> str:
    """What a response is made of, to the last bit, without anything being evaluated."""
    structure = run.structure
    parameters = structure.parameters()
    fields = [getattr(run, f.name) for f in dataclasses.fields(run) if f.name != "structure"]
    hash_of = structure.module.SOURCE_HASH
    return bits([type(structure).__name__, hash_of, parameters, structure.vector, *fields])


@pytest.fixture(scope="module")
def pulsed():
    return rk.simulate(BLOCK, PULSE, impact=LAW, vertical=PULSE.scaled(0.5))


@pytest.fixture(scope="module")
def slid():
    block = rk.SlidingBlock(half_width=0.1, half_height=0.4, friction=0.6, restitution=0.0)
    return rk.simulate(block, PULSE, options=rk.SolverOptions(rtol=1e-8), duration=2.0)


# -- in this process


@pytest.mark.parametrize("name", [*SHIPPED, *OTHERS])
def test_every_structure_comes_back_to_the_last_bit(name, tmp_path):
    structure = structure_of(name)
    run = made_up(structure)
    expected = stored(run)
    given = declared() if name == "declared" else None
    run.save(tmp_path / "run.nc")
    for again in (
        rk.load(tmp_path / "run.nc", given),
        pickle.loads(pickle.dumps(run)),
        copy.copy(run),
        copy.deepcopy(run),
    ):
        assert again.structure == structure
        assert stored(again) == expected
        assert np.array_equal(again.y, run.y)


@pytest.mark.parametrize("which", ["pulsed", "slid"])
def test_what_was_asked_before_does_not_keep_a_response_from_travelling(which, request, tmp_path):
    """Modules and machine code are found by asking, and cannot be pickled."""
    run = request.getfixturevalue(which)
    expected = facts(run)
    run.save(tmp_path / "run.nc")
    ways = rk.load(tmp_path / "run.nc"), pickle.loads(pickle.dumps(run)), copy.deepcopy(run)
    for again in ways:
        assert facts(again) == expected


@pytest.mark.parametrize(
    "thing",
    [
        rk.Case(column(), PULSE, rk.Impulsive(), {"theta": 0.01}, 3.0, PULSE, "right"),
        rk.SolverOptions("Radau", rtol=1e-7),
        rk.EnergyRatio(0.9),
        rk.VelocityRatio(0.9),
        rk.AngularMomentum(),
        rk.EnergyRatioAtSpeed.equation_4_38(),
        rk.EnergyLossAtSpeed.equation_3_17(),
        rk.EnergyRatioByImpact([0.8, 0.7]),
        rk.RandomEnergyRatio.normal(0.85, 0.06, seed=4),
        rk.Winkler(stiffness=1e6, damping=1e3, springs=4),
        rk.GroundMotion.from_array([0.0, 0.1, -0.3], 0.02, name="mine"),
        rk.Outcome.OVERTURNED,
        rk.Extremes(0.0, 1.0, 2.0, 3.0),
    ],
    ids=lambda thing: type(thing).__name__,
)
def test_cases_laws_motions_and_options_travel(thing):
    if isinstance(thing, rk.Case):
        thing.problem()  # what is found of the structure is kept with it
    for again in (pickle.loads(pickle.dumps(thing)), copy.copy(thing), copy.deepcopy(thing)):
        assert again == thing
        assert bits(again) == bits(thing) or isinstance(thing, rk.GroundMotion | rk.Case)


def test_a_sweep_travels():
    sweep = rk.simulate_many(
        lambda a: rk.Case(BLOCK, PULSE.scaled(a)),
        {"a": [0.5, 1.0]},
        impact_times=2,
        sweep_options=rk.SweepOptions(lanes=False),
    )
    for again in (pickle.loads(pickle.dumps(sweep)), copy.copy(sweep), copy.deepcopy(sweep)):
        assert type(again) is rk.Sweep
        assert again.identical(sweep)


# -- in another process


def in_a_new_process(folder: Path) -> dict:
    run = rk.load(folder / "run.nc")
    with (folder / "all.pickle").open("rb") as file:
        hollow, case, travelled = pickle.load(file)
    again = pickle.dumps(hollow)
    return {
        "loaded": facts(run),
        "pickled": facts(travelled),
        "ring": bits([hollow.vector, hollow.module.SOURCE_HASH, hollow == pickle.loads(again)]),
        "case": bits(rk.simulate(case.structure, case.motion, impact=case.impact).y),
    }


def test_a_new_process_has_the_same_bits(pulsed, tmp_path):
    """A process that is spawned, as by joblib or dask: it knows nothing of this one."""
    pulsed.save(tmp_path / "run.nc")
    case = rk.Case(BLOCK, PULSE, LAW)
    (tmp_path / "all.pickle").write_bytes(pickle.dumps((ring(), case, pulsed)))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.apply(in_a_new_process, (tmp_path,))
    assert found["loaded"] == found["pickled"] == facts(pulsed)
    assert found["ring"] == bits([ring().vector, ring().module.SOURCE_HASH, True])
    assert found["case"] == bits(rk.simulate(BLOCK, PULSE, impact=LAW).y)


def test_a_loaded_motion_goes_on_where_it_ended(tmp_path):
    """Free rocking for four seconds, and for two and two."""
    start = {"theta": 0.1}
    still = rk.GroundMotion.none(2.0)
    whole = rk.simulate(BLOCK, rk.GroundMotion.none(4.0), impact=LAW, initial=start)
    first = rk.simulate(BLOCK, still, impact=LAW, initial=start, keep="samples")
    first.save(tmp_path / "first.nc")

    def second(run):
        return rk.simulate(
            run.structure, still, impact=run.impact, initial=run.final, mode=run.final_mode,
            options=run.options,
        )  # fmt: skip

    again = second(rk.load(tmp_path / "first.nc"))
    assert facts(again) == facts(second(first))
    assert len(first.impacts) + len(again.impacts) == len(whole.impacts) > 4
    assert again.final == pytest.approx(whole.final, abs=1e-9)


# -- files that are refused


@pytest.fixture(scope="module")
def written(tmp_path_factory) -> bytes:
    path = tmp_path_factory.mktemp("written") / "run.nc"
    made_up(BLOCK).save(path)
    return path.read_bytes()


@pytest.fixture
def file(written, tmp_path):
    path = tmp_path / "run.nc"
    path.write_bytes(written)
    return path


def refused(path, *words, **given):
    with pytest.raises(ValueError, match=path.name) as error:
        rk.load(path, **given)
    assert all(word in str(error.value) for word in words), str(error.value)


@pytest.fixture
def change(file, monkeypatch):
    """Lets the file hold something else, its checksum right: what another program may have written.

    definition : what becomes of what it says in JSON.
    """
    attrs, found = responses._read(file)

    def changed(definition=lambda said: said, arrays=None, **others):
        text = json.dumps(definition(json.loads(str(found.pop("definition")))))
        held = found | (arrays or {})
        checksum = {"checksum": saved.checksum(text, held)}
        held["definition"] = np.array(text)
        monkeypatch.setattr(responses, "_read", lambda path: (attrs | checksum | others, held))

    return changed


def test_a_file_that_was_cut_off_is_refused(file):
    whole = file.read_bytes()
    for share in (0.0, 0.1, 0.5, 0.9):
        file.write_bytes(whole[: int(share * len(whole))])
        refused(file, "cut off")
    file.write_bytes(whole[:-1])
    refused(file)


def test_a_file_that_changed_in_one_bit_is_refused(file):
    number = made_up(BLOCK).end.tobytes()
    whole = file.read_bytes()
    assert whole.count(number) == 1
    place = whole.index(number)
    file.write_bytes(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :])
    refused(file, "damaged")


def test_files_of_others_are_refused(file):
    xr.Dataset({"x": ("t", [1.0])}).to_netcdf(file, engine="h5netcdf")
    refused(file, "not written by")
    file.write_text("theta, t\n0, 0\n")
    refused(file, "no file of a response")
    file.write_bytes(pickle.dumps(print))
    refused(file, "no file of a response")
    with pytest.raises(FileNotFoundError, match="nowhere"):
        rk.load(file.with_name("nowhere.nc"))


def test_a_pipe_is_refused_at_once(tmp_path):
    with pipe(tmp_path / "run.nc") as path:
        refused(path, "a pipe")


def test_a_small_file_of_huge_arrays_is_refused_before_they_are_made(file):
    import h5py

    with h5py.File(file, "r+") as opened:  # no chunk is written: 8 GB of zeros in 8 kB
        opened.create_dataset("zeros", (1000, 1000, 1000), chunks=(100, 100, 100), dtype=float)
    tracemalloc.start()
    refused(file, "8000", "bytes of arrays")
    assert tracemalloc.get_traced_memory()[1] < 1e8
    tracemalloc.stop()


@pytest.mark.parametrize(
    "text", ["[" * 50_000 + "]" * 50_000, '{"of":' * 50_000 + "1" + "}" * 50_000]
)
def test_a_description_that_is_nested_deep_is_refused(file, monkeypatch, text):
    attrs, found = responses._read(file)
    del found["definition"]
    checksum = {"checksum": saved.checksum(text, found)}
    held = found | {"definition": np.array(text)}
    monkeypatch.setattr(responses, "_read", lambda path: (attrs | checksum, held))
    refused(file, "nested deeper")


@pytest.mark.parametrize("other", [saved.FORMAT - 1, saved.FORMAT + 1])
def test_a_file_of_another_format_is_refused(file, change, other):
    change(rockeom_format=other, rockeom_version="9.1")
    refused(file, f"a response in format {other}", "another version", "9.1", "simulate again")


@pytest.mark.parametrize("name", ["os.system", "eval", "Structure", "GroundMotion", "__class__"])
def test_a_file_makes_nothing_but_what_is_known(file, change, name):
    def foreign(definition):
        definition["structure"] = {"is": name, "of": {"command": "true"}}
        return definition

    change(foreign)
    refused(file, repr(name))


@pytest.mark.parametrize(
    "arrays",
    [
        {"step_mode": np.full(7, 3)},
        {"step_mode": np.full(7, -1)},
        {"event_kind": np.full((3, 4), 99)},
        {"step_powers": np.zeros((7, 8, 2), np.float32)},
        {"step_powers": np.zeros((6, 8, 2))},
        {"end": np.zeros(3)},
    ],
    ids=lambda arrays: next(iter(arrays)),
)
def test_numbers_that_compiled_code_would_stumble_over_are_refused(file, change, arrays):
    """Of modes that there are not, and of other sizes than the structure has."""
    change(arrays=arrays)
    refused(file, next(iter(arrays)))


def test_parameters_are_checked_as_by_the_constructor(file, change):
    def negative(definition):
        definition["structure"]["of"]["half_width"] = -1.0
        return definition

    change(negative)
    with pytest.raises(ValueError, match="half_width is -1") as error:
        rk.load(file)
    assert file.name in error.value.__notes__[0]


def test_other_equations_of_a_shipped_structure_are_told(file, change):
    def older(definition):
        return definition | {"source_hash": "0" * 16}

    change(older, rockeom_version="0.0.9")
    with pytest.warns(UserWarning, match=r"rigid_block .* 0\.0\.9") as told:
        assert rk.load(file).structure == BLOCK
    assert [warning.filename for warning in told] == [__file__]


def test_a_declared_structure_must_be_the_one_that_was_simulated(tmp_path):
    path = tmp_path / "ring.nc"
    run = made_up(ring())
    run.save(path)
    refused(path, "ring_of_a_user", "structure=")
    other = declared(share=2)
    refused(path, ring().module.SOURCE_HASH, "is given has", structure=other)
    refused(path, ring().module.SOURCE_HASH, structure=BLOCK)
    wider = rk.structure(declared(), mass=3.0, radius=0.5, half_width=0.2)
    refused(path, "half_width=0.1", "half_width=0.2", structure=wider)
    with pytest.raises(TypeError, match="structure is 'ring'"):
        rk.load(path, structure="ring")
    for given in (declared(), ring()):
        assert stored(rk.load(path, structure=given)) == stored(run)


def test_a_structure_that_the_file_has_not_is_refused(file):
    assert rk.load(file, structure=BLOCK).structure == BLOCK
    refused(file, "RigidBlock", structure=column())


# -- what cannot be saved


class Mine:
    """A law of impact of a user's own."""

    def resolve(self, velocity_ratio, has_impulsive, name):
        return 0, 0.9 * velocity_ratio


def test_a_law_of_ones_own_is_told_and_asked_for_again(tmp_path):
    run = rk.simulate(BLOCK, PULSE, impact=Mine())
    with pytest.warns(UserWarning, match="Mine") as told:
        run.save(tmp_path / "run.nc")
    assert [warning.filename for warning in told] == [__file__]
    again = rk.load(tmp_path / "run.nc")
    assert again.summary() == run.summary()
    with pytest.raises(ValueError, match=r"Mine.*impact="):
        rk.simulate(again.structure, PULSE, impact=again.impact)
    rk.simulate(again.structure, PULSE, impact=Mine())


def test_a_class_of_ones_own_is_not_saved_as_another(tmp_path):
    class Block(rk.RigidBlock):
        pass

    run = made_up(Block(half_width=0.1, half_height=0.4))
    with pytest.raises(TypeError, match=r"structure is .*of your own"):
        run.save(tmp_path / "run.nc")
    assert not os.listdir(tmp_path)


def test_all_laws_of_impact_can_be_saved():
    laws = {getattr(rk, name) for name in rk.__all__ if hasattr(getattr(rk, name), "resolve")}
    assert set(saved.LAWS.values()) == laws


@pytest.mark.parametrize("package", ["h5netcdf", "h5py"])
def test_without_the_extra_the_remedy_is_named(package, file, monkeypatch):
    find = saved.find_spec
    monkeypatch.setattr(saved, "find_spec", lambda name: None if name == package else find(name))
    for call in (lambda: rk.load(file), lambda: made_up(BLOCK).save(file)):
        with pytest.raises(ModuleNotFoundError, match=r"pip install -e \"\.\[files\]\""):
            call()


# -- whole or not at all


def test_a_write_that_fails_leaves_the_file_that_was_there(file, monkeypatch):
    before = file.read_bytes()

    def fails(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fails)
    with pytest.raises(OSError, match="No space"):
        made_up(column()).save(file)
    assert file.read_bytes() == before
    assert os.listdir(file.parent) == [file.name]


def test_a_file_is_replaced_through_a_link_and_by_another_response(file):
    link = file.with_name("link.nc")
    link.symlink_to(file.name)
    made_up(column()).save(link)
    assert link.is_symlink()
    assert rk.load(file).structure == column()


def test_what_a_killed_process_left_is_removed_in_time(file):
    left, new = (file.with_name(TEMPORARY.format(name)) for name in ("left", "new"))
    for path in (left, new):
        path.touch()
    os.utime(left, (0, time.time() - 2 * 86400))
    made_up(BLOCK).save(file)
    assert (left.exists(), new.exists()) == (False, True)


def test_a_folder_that_is_not_there_is_named(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"no folder .*missing"):
        made_up(BLOCK).save(tmp_path / "missing" / "run.nc")


# -- tables


def test_a_dataset_has_units_and_survives_a_file_of_its_own(pulsed, tmp_path):
    found = pulsed.to_xarray(pulsed.names)
    assert {n for n, v in found.items() if not v.attrs.get("long_name")} == set()
    unit = {n: v.attrs.get("units") for n, v in found.items()}
    assert (unit["theta"], unit["theta_dot"], unit["displacement"]) == ("rad", "rad/s", "m")
    assert (unit["left_reaction"], unit["total_energy"], unit["impact_time"]) == ("N", "J", "s")
    for name in pulsed.names:
        assert np.array_equal(found[name], pulsed[name])
    assert list(found.mode.values) == list(pulsed.mode)
    for i, impact in enumerate(pulsed.impacts):
        row = found.isel(impact=i)
        assert row.impact_time == impact.time
        assert (row.mode_before, row.mode_after) == (impact.mode_before, impact.mode_after)
        assert row.theta_dot_before == impact.before["theta_dot"]
        assert row.theta_dot_after == impact.after["theta_dot"]
    assert found.sizes["impact"] == len(pulsed.impacts) > 3
    found.to_netcdf(tmp_path / "table.nc", engine="h5netcdf")
    assert xr.load_dataset(tmp_path / "table.nc", engine="h5netcdf").equals(found)


def test_a_table_at_times_of_ones_own(pulsed):
    t = np.linspace(0.0, 4.0, 9)
    frame = pulsed.to_dataframe(["displacement", "left_uplift"], times=t)
    assert list(frame.columns) == ["displacement", "left_uplift", "mode"]
    assert np.array_equal(frame.index, t)
    assert np.array_equal(
        frame["displacement"], pulsed.at(t, names=["displacement"])["displacement"]
    )
    whole = pulsed.to_dataframe()
    assert len(whole) == len(pulsed.t)
    assert list(whole.columns) == ["theta", "theta_dot", "mode"]
    with pytest.raises(KeyError, match="there are theta"):
        pulsed.to_xarray(["drift"])
    with pytest.raises(ValueError, match="list of names"):
        pulsed.to_dataframe("theta")
    with pytest.raises(ValueError, match="the response from"):
        pulsed.to_xarray(times=[5.0])
    with pytest.raises(ValueError, match="one dimension"):
        pulsed.to_xarray(times=[[1.0]])


def test_landings_of_points_are_impacts_of_the_table(slid):
    found = slid.to_xarray()
    assert found.impact_contact.values.tolist() == [impact.contact for impact in slid.impacts]
    assert found.sizes["impact"] == len(slid.impacts) > 0


def test_quantities_without_dimension_say_so():
    block = rk.NondimensionalBlock(alpha=0.2)
    found = made_up(block).to_xarray(["x"])
    assert found.x.attrs["units"] == found.time.attrs["units"] == "1"


# -- what is kept


@functools.cache
def noise(samples: int) -> rk.GroundMotion:
    values = np.random.default_rng(2).standard_normal(samples // 20)
    return rk.GroundMotion.from_array(3.0 * np.repeat(values, 20), 0.01)


def shaken(samples=4000, half_width=1.0, **how):
    """A block that rocks under a record, whose steps end at its samples."""
    block = rk.RigidBlock(half_width=half_width, half_height=2.0)
    return rk.simulate(block, noise(samples), impact=rk.EnergyRatio(0.5), **how)


@pytest.fixture(scope="module")
def both():
    return shaken(), shaken(keep="samples")


def test_samples_are_those_of_the_whole_motion(both):
    whole, some = both
    assert whole.statistics["steps"] > 3000
    assert len(whole.impacts) > 10
    assert len(some.t) < 4002 + 2 * len(whole.events)
    assert some.statistics == whole.statistics
    assert bits([some.events, some.final, some.final_mode]) == bits(
        [whole.events, whole.final, whole.final_mode]
    )
    plain = ~np.isin(some.t, [event.time for event in some.events])
    expected = whole.at(some.t[plain], names=["theta", "displacement"])
    for name in expected:
        assert np.array_equal(some[name][plain], expected[name])
    assert np.diff(some.t).max() <= some.options.spacing(some.duration) * (1 + 1e-12)
    assert (some.t[0], some.t[-1]) == (whole.t[0], whole.t[-1])
    assert some.support.never_lifted == whole.support.never_lifted is False


def test_extremes_that_are_found_on_the_way_are_those_of_the_whole_motion(both):
    whole, some = both
    for name in main_units(whole.structure.module):
        assert bits(some.extremes(name)) == bits(whole.extremes(name))


def test_extremes_do_not_depend_on_how_many_steps_are_held(both, monkeypatch):
    """Where many may have one, as near a vibration's zeros of energy, some are settled first."""
    whole, _ = both
    names = [*main_units(whole.structure.module)]
    evaluate = whole._quantities.columns(names)
    for most, size in (("MOST_PIECES", 1), ("MOST_HELD", 5), ("CHUNK", 100)):
        monkeypatch.setattr(extremes, most, size)
    found = extremes.extremes(whole.steps, evaluate)
    assert bits(found) == bits([whole.extremes(name) for name in names])


def test_what_needs_the_steps_says_so_where_they_were_not_kept(both):
    _, some = both
    asked = {
        "at": lambda: some.at([1.0]),
        "steps": lambda: some.steps,
        "base_moment": lambda: some.support.base_moment,
        "friction_demand": lambda: some.support.friction_demand,
    }
    for what, ask in asked.items():
        with pytest.raises(ValueError, match=f'{what}.* needs every step .* keep="all"'):
            ask()
    assert "Only samples were kept" in some.summary()


def test_samples_of_a_motion_come_back_from_files_and_pickles(both, tmp_path):
    _, some = both
    some.save(tmp_path / "run.nc")
    for again in (rk.load(tmp_path / "run.nc"), pickle.loads(pickle.dumps(some))):
        assert stored(again) == stored(some)
        assert again.summary() == some.summary()
        assert all(again.extremes(name) == some.extremes(name) for name in some.record.extremes)


def test_output_step_of_infinity_keeps_events_and_ends():
    run = shaken(keep="samples", options=rk.SolverOptions(output_step=np.inf))
    assert len(run.t) == 2 * len(run.events) + 2


def test_long_search_for_extremes_tells_how_far_it_is(monkeypatch, capsys):
    monkeypatch.setattr("rockeom.simulation.recorder._MANY", 1000)
    shaken(keep="samples")
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("rockeom: keep='samples' has searched 1,0")


def test_keep_is_checked():
    with pytest.raises(ValueError, match="keep is 'everything': choose 'all' or 'samples'"):
        rk.simulate(BLOCK, PULSE, keep="everything")


@pytest.mark.parametrize(("keep", "most"), [("all", 1.3), ("samples", 0.2)])
def test_memory_grows_with_the_record_by_what_is_kept(keep, most):
    """In units of the steps' own arrays: none is there twice, and of samples there are as many."""

    def peak(samples):
        noise(samples)
        tracemalloc.start()
        try:
            run = shaken(samples, half_width=4.0, keep=keep)  # too wide to lift
            return run.statistics["steps"], tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    (few, less), (many, more) = peak(4000), peak(20_000)
    assert many >= few + 16_000
    assert more - less < most * 8 * (3 + 8 * 2) * (many - few)
