"""All figures of the thesis in a folder, with contact sheets."""

from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure
from matplotlib.image import imread

from rockeom.numbers.checks import InputError
from rockeom.plots import style
from rockeom.thesis.figures import FIGURES

ROWS, COLUMNS = 4, 3
"""Figures on a contact sheet."""


def draw_all(folder: Path, say: Callable[[str], None]) -> list[str]:
    """Draw each figure into figure-NUMBER.png of a folder, and all on contact sheets.

    say : tells how far it is. Returns the numbers of figures whose records are not installed.
    Raises InputError where the folder is a file.
    """
    if folder.exists() and not folder.is_dir():
        raise InputError("out", folder).says(f"{folder} is a file: name a folder for all figures")
    folder.mkdir(parents=True, exist_ok=True)
    paths, missing = [], []
    for n, one in enumerate(FIGURES.values(), 1):
        say(f"drawing figure {one.number}, {n} of {len(FIGURES)} ...")
        try:
            figure = one()
        except InputError as error:
            say(f"figure {one.number} is not drawn: {error}")
            missing.append(one.number)
            continue
        paths.append(folder / f"figure-{one.number}.png")
        style.save_figure(figure, paths[-1], dpi=110)
    for n, first in enumerate(range(0, len(paths), ROWS * COLUMNS), 1):
        sheet = contact_sheet(paths[first : first + ROWS * COLUMNS])
        style.save_figure(sheet, folder / f"contact-sheet-{n}.png")
    say(f"wrote {len(paths)} figures and their contact sheets into {folder}")
    return missing


def contact_sheet(paths: list[Path]) -> Figure:
    """Pictures of figures in rows, each below its number."""
    figure = style.new_figure(13.0, 13.0)
    for place, path in enumerate(paths, 1):
        ax = figure.add_subplot(ROWS, COLUMNS, place)
        ax.imshow(imread(path))
        ax.axis("off")
        ax.set_title(path.stem.removeprefix("figure-"), fontsize=9)
    return figure
