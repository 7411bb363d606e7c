"""The house itself: what an import costs, who loads SymPy, what is public, what a wheel carries."""

import ast
import importlib.metadata
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

import rockeom
from rockeom.structures.classes import SHIPPED
from tests import form

ROOT = Path(__file__).resolve().parents[1]


def run_python(*arguments: str, cwd: Path = ROOT) -> str:
    """Standard output of a fresh interpreter that sees the packages in `cwd` first."""
    environment = {**os.environ, "PYTHONPATH": str(cwd)}
    done = subprocess.run(
        [sys.executable, *arguments], cwd=cwd, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


def names_for_type_checkers() -> dict[str, str]:
    """Name -> home, as the TYPE_CHECKING block of the package imports them."""
    tree = ast.parse(Path(rockeom.__file__).read_text(encoding="utf-8"))
    (block,) = (node for node in tree.body if isinstance(node, ast.If))
    imports = [node for node in block.body if isinstance(node, ast.ImportFrom)]
    (whole,) = (node.module for node in imports if node.names[0].name == "*")
    classes = {c.__name__: whole for c in SHIPPED.values()}
    named = {a.asname: node.module for node in imports for a in node.names if a.name != "*"}
    return {"Structure": whole, **classes, **named}


# --- what an import costs


def test_import_is_fast_and_loads_no_heavy_library():
    code = """
import time
start = time.process_time()
import rockeom
seconds = time.process_time() - start
import sys
heavy = {"sympy", "llvmlite", "matplotlib", "scipy", "rockeom.thesis"} & set(sys.modules)
assert not heavy, f"import rockeom loads {sorted(heavy)}"
print(seconds)
"""
    assert float(run_python("-c", code)) < 0.2


def test_formulas_simulations_and_plots_load_what_they_need():
    """One after the other in a fresh process: each has been found wanting by itself."""
    code = """
import sys
import rockeom as rk

def loaded(*names):
    return sorted({*names} & set(sys.modules))

rk.analysis.formulas.quarter_period(0.5, 1.0)
assert not loaded("sympy", "llvmlite", "matplotlib"), "a formula"

block = rk.RigidBlock(half_width=0.095, half_height=0.45)
run = rk.simulate(block, rk.GroundMotion.none(1.0), initial={"theta": 0.1})
assert len(run.t) > 1
assert not loaded("sympy", "matplotlib", "xarray", "h5netcdf"), "a simulation"

from rockeom.cli import main
block = "simulate rigid_block --set half_width=0.095 half_height=0.45 --free --duration 1"
assert main(block.split()) == 0
assert not loaded("sympy"), "the command"

import rockeom.plots
assert loaded("matplotlib")
assert not loaded("sympy", "matplotlib.pyplot"), "plots"
print("all")
"""
    assert run_python("-c", code).endswith("all")


def test_a_wall_is_made_and_its_code_read_without_what_it_does_not_need():
    """Together they took as long to import as all the rest."""
    code = """
import numpy, llvmlite.binding
import sys
before = set(sys.modules)
import rockeom as rk
import rockeom.compiler.machine, rockeom.simulation.simulate
rk.ControlledWall.thesis().vector, rk.FlexibleControlledWall.thesis().vector
rk.GroundMotion.single_sine(amplitude=2.8, period=0.5, duration=2.0).segments
here = set(sys.modules) - before
of_analysis = {name.removeprefix("rockeom.analysis.") for name in here if ".analysis." in name}
print(sorted(of_analysis - {"arguments", "groups", "formulas", "formulas.controlled_wall"}))
print(sorted(here & {
    "csv", "difflib", "numpy.polynomial", "rockeom.motion.readers", "scipy", "subprocess",
}))
"""
    assert run_python("-c", code) == "[]\n[]"


def test_a_program_is_made_without_scipy_and_sympy():
    """SciPy alone takes as long to import as a program to compile."""
    code = """
import rockeom.generated.rigid_block as module
from rockeom.compiler.printer import Program
from rockeom.integrator.linking import linked
import sys
for method in ("DOP853", "RK45", "Radau"):
    roots, modules, _ = linked(module, method)
    assert Program(roots, modules).ir()
print(sorted({"scipy", "sympy"} & set(sys.modules)))
"""
    assert run_python("-c", code) == "[]"


# --- who calls whom


FACADE = ROOT / "rockeom" / "__init__.py"
"""Above all packages: the one place that may reach into any of them by name."""


def imports_by_string(path: Path) -> list[str | None]:
    """What a file imports otherwise than by a statement; None for what its text does not tell.

    What comes before the first value that is put into a text is told.
    """
    tree = ast.parse(path.read_text(encoding="utf-8"))
    words = {"import_module", "__import__", "spec_from_file_location", "run_module"}
    found: list[str | None] = []
    calls: set[ast.expr] = set()
    package = ".".join(path.relative_to(ROOT).with_suffix("").parts)
    package = package.removesuffix(".__init__")
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom | ast.Import):
            renamed = [alias for alias in node.names if alias.name in words and alias.asname]
            found += [None] * len(renamed)
        if not isinstance(node, ast.Call):
            continue
        if getattr(node.func, "attr", getattr(node.func, "id", None)) in words:
            calls.add(node.func)
            match node.args:
                case [ast.Constant(value=str(name)), *_]:
                    found.append(name)
                case [ast.JoinedStr(values=[ast.Constant(value=str(name)), *_]), *_]:
                    found.append(name)
                case [ast.JoinedStr(values=[ast.FormattedValue(value=ast.Name("__name__")), *_])]:
                    found.append(package)
                case _:
                    found.append(None)
    used = (node for node in ast.walk(tree) if isinstance(node, ast.Name | ast.Attribute))
    named = {node for node in used if getattr(node, "attr", getattr(node, "id", None)) in words}
    return found + [None] * len(named - calls)  # handed on under another name


def is_own_or_generated(path: Path, name: str) -> bool:
    package = ".".join(path.relative_to(ROOT).parts[:2]).removesuffix(".py")
    return f"{name}.".startswith(
        (f"{package}.", "rockeom.generated.")
    ) or not f"{name}.".startswith("rockeom.")


WALKS_ITS_FOLDER = ROOT / "rockeom" / "symbolic" / "registry.py"


def test_no_package_reaches_another_by_a_string():
    """Import contracts see statements alone; of the generated modules only the name is known."""
    paths = set((ROOT / "rockeom").rglob("*.py")) - {FACADE}
    found = {path: names for path in paths if (names := imports_by_string(path))}
    assert found.pop(WALKS_ITS_FOLDER) == [None]
    assert {
        str(path.relative_to(ROOT)): names
        for path, names in found.items()
        if not all(name is not None and is_own_or_generated(path, name) for name in names)
    } == {}


@pytest.mark.parametrize(
    "text",
    [
        'import importlib\nimportlib.import_module("rockeom.plots").plot_response(1)',
        'from importlib import import_module\nimport_module("rockeom.analysis")',
        'from importlib import import_module as load\nload("rockeom.analysis")',
        'import importlib\nload = importlib.import_module\nload("rockeom.analysis")',
        'import importlib\nimportlib.import_module(f"rockeom.plots.{__name__}")',
        'import importlib\nplace = "rockeom.plots"\nimportlib.import_module(place)',
        '__import__("rockeom.cli")',
    ],
)
def test_call_upwards_by_a_string_is_noticed(tmp_path, monkeypatch, text):
    monkeypatch.setattr(sys.modules[__name__], "ROOT", tmp_path)
    path = tmp_path / "rockeom" / "simulation" / "response.py"
    path.parent.mkdir(parents=True)
    path.write_text(text, encoding="utf-8")
    found = imports_by_string(path)
    assert any(name is None or not is_own_or_generated(path, name) for name in found), found


def test_a_method_finds_what_is_above_its_package_wherever_an_import_begins():
    """Of users who go straight into a package, too."""
    code = """
from rockeom.structures.classes import ControlledWall
print(ControlledWall.thesis(initial_force=111e3).initial_force)
"""
    assert run_python("-c", code) == "111000.0"


# --- what is public


@pytest.mark.parametrize("name", rockeom.__all__)
def test_public_name_resolves_and_has_a_docstring(name):
    assert getattr(rockeom, name).__doc__
    assert name in dir(rockeom)


def test_type_checkers_see_the_same_names_as_users():
    assert names_for_type_checkers() == rockeom._HOME_OF | rockeom._classes()


def test_unknown_name_is_an_attribute_error_that_names_it():
    with pytest.raises(AttributeError, match="'rockeom' has no attribute 'Simulate'"):
        _ = rockeom.Simulate


# --- where the generated modules are found


# --- what is released


@pytest.fixture(scope="module")
def released(tmp_path_factory) -> Path:
    """A folder with what the sdist of this checkout builds, installed without a network."""
    for needed in ("hatchling", "pip"):
        pytest.importorskip(needed)
    folder = tmp_path_factory.mktemp("released")
    run_python("-m", "hatchling", "build", "-t", "sdist", "-d", str(folder))
    (sdist,) = folder.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        archive.extractall(folder, filter="data")
    (source,) = (path for path in folder.iterdir() if path.is_dir())
    run_python("-m", "hatchling", "build", "-t", "wheel", "-d", str(folder), cwd=source)
    (wheel,) = folder.glob("*.whl")
    offline = "--no-deps", "--no-index", "--no-compile", "--disable-pip-version-check"
    run_python(
        "-m", "pip", "install", *offline, "--target", str(folder / "site"), str(wheel), cwd=folder
    )
    return folder


def run_released(folder: Path, *arguments: str) -> str:
    """Of an interpreter that starts elsewhere and finds what was installed, not this checkout."""
    (elsewhere := folder / "elsewhere").mkdir(exist_ok=True)
    environment = {**os.environ, "PYTHONPATH": str(folder / "site")}
    done = subprocess.run(
        [sys.executable, *arguments], cwd=elsewhere, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout.strip()


def test_wheel_carries_the_generated_modules_and_nothing_else(released):
    (wheel,) = released.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        carried = set(archive.namelist())
    generated = {f"rockeom/generated/{path.name}" for path in (ROOT / "generated").glob("*.py")}
    assert "rockeom/generated/rigid_block.py" in generated
    assert generated | {"rockeom/py.typed", "rockeom/generated/__init__.py"} <= carried
    files = (path for path in (ROOT / "rockeom").rglob("*.*") if path.suffix != ".pyc")
    sources = {str(path.relative_to(ROOT)) for path in files}
    assert "rockeom/thesis/data/table_2_1.csv" in sources
    assert sources <= carried
    tops = {name.partition("/")[0] for name in carried}
    assert tops == {"rockeom", f"rockeom-{rockeom.__version__}.dist-info"}
    assert not [name for name in carried if "__pycache__" in name]


def test_sdist_carries_what_the_repository_does_and_nothing_that_was_built(released):
    if not (ROOT / ".git").exists() or not shutil.which("git"):
        pytest.skip("not a clone")
    listed = "git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"
    kept = subprocess.run(listed, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    (sdist,) = released.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        carried = {name.partition("/")[2] for name in archive.getnames()}
    assert carried - {"PKG-INFO"} <= set(kept.split("\0"))
    assert {
        "README.md",
        "LICENSE",
        "CHANGELOG.md",
        "CITATION.cff",
        "tests/test_house.py",
    } <= carried


def test_what_is_released_simulates_where_it_is_installed(released):
    code = """
import rockeom as rk
block = rk.RigidBlock(half_width=0.095, half_height=0.45)
run = rk.simulate(block, rk.GroundMotion.none(10.0), initial={"theta": 0.1})
print(rk.__file__, block.module.__file__, run.outcome, sep="\\n")
"""
    package, module, outcome = run_released(released, "-c", code).splitlines()
    site = released / "site" / "rockeom"
    assert Path(package) == site / "__init__.py"
    assert Path(module) == site / "generated" / "rigid_block.py"
    assert outcome == "came to rest"


def test_what_is_released_brings_its_command(released):
    command = str(released / "site" / "bin" / "rockeom")
    assert run_released(released, command, "--version") == f"rockeom {rockeom.__version__}"
    listed = run_released(released, command, "models")
    assert all(f"\n{name} " in listed for name in SHIPPED)
    assert "0.9544" in run_released(released, command, "thesis", "tables", "2-1")


def test_what_is_released_says_what_it_is(released):
    (installed,) = importlib.metadata.distributions(name="rockeom", path=[str(released / "site")])
    told = installed.metadata
    assert told["Version"] == rockeom.__version__
    assert told["License-Expression"] == "BSD-3-Clause"
    carried = {file.name for file in installed.files or []}
    assert {"LICENSE", "stone_walls.csv", "dry_wall_envelopes.csv"} <= carried
    assert "stone_walls_LICENSE.txt" in carried  # that of these two
    assert told["Description"].startswith("# rockeom")
    least = told["Requires-Python"].removeprefix(">=")
    classifiers = told.get_all("Classifier")
    assert f"Programming Language :: Python :: {least}" in classifiers
    assert "Typing :: Typed" in classifiers


def test_generated_folder_stays_a_plain_folder():
    # An __init__.py there would take the place of the search-path shim in the wheel.
    assert not (ROOT / "generated" / "__init__.py").exists()


# --- extras


def test_extras_are_one_table_of_the_readme_and_all_has_them():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"][
        "optional-dependencies"
    ]
    (all_of,) = extras["all"]
    of_users = all_of.removeprefix("rockeom[").removesuffix("]").split(",")
    of_developers = {"test", "opensees", "crosscheck", "dev", "docs"}
    assert {*of_users, "notebooks", "all"} == extras.keys() - of_developers
    install = (ROOT / "README.md").read_text().split("## Install")[1].split("\n## ")[0]
    assert re.findall(r"^\| `(\w+)` \|", install, re.MULTILINE) == [
        *of_users,
        "notebooks",
        "all",
    ]


def test_commands_that_install_an_extra_work_in_a_clone_and_in_zsh():
    """The package is on no index, and zsh takes brackets without quotes for a pattern."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"][
        "optional-dependencies"
    ]
    texts = {
        path: path.read_text(encoding="utf-8")
        for folder, kind in (("rockeom", "*.py"), ("docs", "*.md"), (".", "*.md"))
        for path in (ROOT.glob(kind) if folder == "." else (ROOT / folder).rglob(kind))
    }
    for path, text in texts.items():
        for command, after in re.findall(r"(pip install[^\n`]*?)(\[[^\]]*\]\S?)", text):
            assert command.endswith('-e ".'), f"{path}: {command}{after}"
            assert after.endswith('"'), f"{path}: {command}{after}"
            named = after.strip('[]"').split(",")
            assert named == ["{extra}"] or {*named} <= extras.keys(), f"{path}: {command}{after}"


def test_a_circle_of_imports_is_found_and_a_chain_is_none():
    chain = {"a": {"b"}, "b": {"c"}, "c": set()}
    assert form.circles(chain) == []
    assert form.circles(chain | {"c": {"b"}}) == [{"b", "c"}]


def test_sizes_of_a_function_are_those_that_one_counts():
    tree = ast.parse('def f(a, *, b):\n    """Two\n    lines."""\n    return a if a and b else b\n')
    assert form.measured("f", tree.body[0]) == form.Function("f", 2, 2, 3)


def test_a_figure_beyond_its_bound_fails_the_check(monkeypatch, capsys):
    monkeypatch.setattr(form, "figures", lambda: [form.Figure("lines of a file", 901, 900)])
    assert form.main() == 1
    assert "lines of a file: 901 is more than the bound of 900" in capsys.readouterr().out
