"""The recordings that a set of motions holds, and which components it has."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from rockeom.files import in_text
from rockeom.motion.components import channel, name_of, split
from rockeom.motion.ground_motion import GroundMotion
from rockeom.motion.recording import Recording, recording_from
from rockeom.motion.scaling import SCALE_IN_NAME
from rockeom.numbers.callers import warn_caller
from rockeom.numbers.checks import InputError, require_word

COMPONENTS = ("horizontal", "vertical", "all")
"""Components of records that a set may hold."""
_SHOWN = 5
_OF_SCALED = re.compile(f"({SCALE_IN_NAME.pattern.rstrip('$')})?( \\(\\d+\\))?$")


def recordings(motions: Sequence[GroundMotion], set_name: str) -> tuple[Recording, ...]:
    """See `MotionSet.recordings`; set_name : for records named by their component alone.

    Records of networks are grouped by the station and event of their headers, others by name.
    """
    groups: dict[str, list[GroundMotion]] = {}
    components = [split(motion.name) for motion in motions]
    sizes = Counter(name for name, _ in components)
    for motion, (name, component) in zip(motions, components, strict=True):
        # of more than three components those of one instrument belong together
        instrument = channel(component) if sizes[name] > 3 else ""
        stated = "" if motion.origin is None else motion.origin.recording
        recording = stated or ", ".join(filter(None, (name or set_name, instrument)))
        groups.setdefault(recording, []).append(motion)
    return tuple(recording_from(name, group) for name, group in groups.items())


def by_name(read: Mapping[Path, list[GroundMotion]]) -> dict[str, GroundMotion]:
    """Motions of files by their names; those of files with one stem also have ending or folder.

    Raises InputError where two files give one component of a recording: it would count twice.
    """
    files = [*read]
    stems = [name_of(file) for file in files]
    names = [in_text(file).name for file in files]
    folders = [str(in_text(file.parent / stem)) for file, stem in zip(files, stems, strict=True)]
    labels = stems, names, folders, [*map(str, files)]
    label = next((one for one in labels if len(set(one)) == len(files)), labels[-1])
    motions: dict[str, GroundMotion] = {}
    components: dict[tuple[str, str], Path] = {}
    for file, stem, called in zip(files, stems, label, strict=True):
        for one in read[file]:
            if (origin := one.origin) and origin.recording and origin.component:
                first = components.setdefault((origin.recording, origin.component), file)
                if first != file:
                    raise InputError("pattern").says(
                        f"{first.name} and {file.name} both give {origin.component} of "
                        f"{origin.recording}: take one of the files",
                        f'as pattern="*{file.suffix}" does',
                    )
            name = called + one.name.removeprefix(stem)
            motions[name] = one if name == one.name else replace(one, name=name)
    return motions


def recording_of(name: object) -> str:
    """The recording of a motion by its label in a sweep, where scaled ones may have many labels."""
    return split(_OF_SCALED.sub("", name))[0] if isinstance(name, str) else str(name)


def chosen(
    motions: Mapping[str, GroundMotion], components: str, where: str
) -> dict[str, GroundMotion]:
    """The motions of these components by their names; a warning names the vertical ones left out.

    where : what an error calls the set. Raises InputError where none is left, and for a word that
    is none of COMPONENTS.
    """
    require_word("components", components, COMPONENTS)
    if components == "all":
        return dict(motions)
    wanted = components == "vertical"
    kept = {name: motion for name, motion in motions.items() if motion.is_vertical == wanted}
    if not kept:
        other = "horizontal" if wanted else "vertical"
        raise InputError("components", "all").says(
            f'{where} holds {other} components only, {_shortened(motions)}: give components="'
            f'{other}" for them'
        )
    if not wanted and len(kept) < len(motions):
        warn_caller(
            f"{len(motions) - len(kept)} of {len(motions)} records of {where} are vertical "
            f"components and left out: {_shortened(motions.keys() - kept.keys())}; "
            'ask for the components "vertical" or "all" to have them',
        )
    return kept


def _shortened(names: Iterable[str]) -> str:
    listed = sorted(names)
    more = f" and {len(listed) - _SHOWN} more" if len(listed) > _SHOWN else ""
    return "; ".join(listed[:_SHOWN]) + more
