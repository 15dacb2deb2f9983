"""Machine profiles: keys that a specification need not repeat."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import ClassVar

from pydantic import Field, ValidationError

from sesame_cad.errors import InputError
from sesame_cad.specification.diagnosis import own_faults
from sesame_cad.specification.fault import Fault, shown_value
from sesame_cad.specification.machine import DEFAULT_PROFILE, MachineSection
from sesame_cad.specification.section import Section
from sesame_cad.specification.stitching import StitchingSection
from sesame_cad.specification.toml_file import read_toml

KEY = ("machine", "profile")

Data = dict[str, object]


class Profile(Section):
    """What a profile may hold: the keys of two sections of a specification."""

    NAMES: ClassVar[tuple[str, ...]] = ("machine", "stitching")

    machine: MachineSection = Field(default=MachineSection(), description="the machine")
    stitching: StitchingSection = Field(
        default=StitchingSection(), description="how it is best stitched with"
    )


def profile_names() -> tuple[str, ...]:
    """Names of the profiles that come with the program, in order."""
    return tuple(sorted(file.name.removesuffix(".toml") for file in _shipped()))


def profile_text(name: str) -> str:
    """Give a profile that comes with the program, to start one's own from.

    Raises
    ------
    InputError
        When there is none of that name; the nearest is named.
    """
    for file in _shipped():
        if file.name == f"{name}.toml":
            return file.read_text(encoding="utf-8")
    raise InputError(f"{shown_value(name)}: {_unknown(name)}")


def with_profile(data: Data, source: str, home: Path) -> Data:
    """Complete the keys of a specification by those of the profile that it names.

    A specification in which every key of the machine and of the stitching stands has no need of
    its profile, which is then not read.

    Parameters
    ----------
    data
        Sections of keys; what they hold is checked later.
    source
        Where they come from; a fault of the name begins with it.
    home
        The folder beside whose files a profile's path counts.

    Raises
    ------
    InputError
        When there is no such profile, or with every fault of the profile on a line of its own.
    """
    machine, stitching = data["machine"], data["stitching"]
    if not (isinstance(machine, Mapping) and isinstance(stitching, Mapping)):
        return data
    name = machine.get("profile", DEFAULT_PROFILE)
    if not isinstance(name, str) or _complete(machine, stitching) or name == DEFAULT_PROFILE:
        return data
    given = _checked(Path(home / name)) if name.endswith(".toml") else _named(name, source)
    return {
        **data,
        "machine": {**given.get("machine", {}), **machine},
        "stitching": {**given.get("stitching", {}), **stitching},
    }


def _complete(machine: Mapping[object, object], stitching: Mapping[object, object]) -> bool:
    return (
        machine.keys() >= MachineSection.model_fields.keys()
        and stitching.keys() >= StitchingSection.model_fields.keys()
    )


def _named(name: str, source: str) -> dict[str, Data]:
    if name not in profile_names():
        raise InputError(f"{source}: {Fault(KEY, _unknown(name), shown_value(name))}")
    shipped = next(file for file in _shipped() if file.name == f"{name}.toml")
    return _checked(Path(str(shipped)))


def _unknown(name: str) -> str:
    near = get_close_matches(name, profile_names(), 1)
    known = f"did you mean {near[0]}?" if near else f"known are {', '.join(profile_names())}"
    return f"no profile of this name; {known} A file's name ends in .toml"


def _checked(file: Path) -> dict[str, Data]:
    """Read a profile and check it key by key, like a specification."""
    data = read_toml(file)
    faults = [
        Fault((key,), "does not belong into a machine profile; [machine] and [stitching] do")
        for key in data
        if key not in Profile.NAMES
    ]
    known = {key: value for key, value in data.items() if key in Profile.NAMES}
    table = known.get("machine")
    if isinstance(table, Mapping) and "profile" in table:
        faults.append(Fault(KEY, "must be left out: a profile does not build on another one"))
    try:
        Profile.model_validate(known)
    except ValidationError as error:
        faults.extend(dict.fromkeys(own_faults(known, error)))
    if faults:
        raise InputError(*(f"{file.name}: {fault}" for fault in faults))
    return {key: dict(value) for key, value in known.items() if isinstance(value, Mapping)}


def _shipped() -> list[Traversable]:
    folder = files("sesame_cad").joinpath("machines")
    return [file for file in folder.iterdir() if file.name.endswith(".toml")]
