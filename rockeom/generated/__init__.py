"""The generated modules, one a structure: ``rockeom.generated.<name>``.

In a checkout they are in the top-level folder ``generated/``, where they are read, reviewed and
rewritten (``make generated``); an installed wheel carries them in this folder. This file only makes
both one package. The top-level folder must hold no ``__init__.py`` of its own, which would take
the place of this one when the wheel is built.
"""

from pathlib import Path

_checkout = Path(__file__).resolve().parents[2]

# Only beside pyproject.toml: a folder in site-packages that happens to be called so is not ours.
if (_checkout / "pyproject.toml").is_file() and (_checkout / "generated").is_dir():
    __path__.append(str(_checkout / "generated"))
