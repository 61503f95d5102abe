"""The options that several sub-commands share, and the parts of a case they make."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection
from dataclasses import dataclass, fields
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, get_type_hints

import typer

from stonepass.errors import BadInput

if TYPE_CHECKING:
    from stonepass.materials.protocol import Material
    from stonepass.model.case import Case, Load, Method, Ureter
    from stonepass.model.shape import Shape
    from stonepass.units import Length

__all__ = [
    "BEAM_OPTIONS",
    "CLOSURE_OPTIONS",
    "Cache",
    "Json",
    "NoCache",
    "Settings",
    "Workers",
    "cache_folder",
    "takes_settings",
]

Cache = Annotated[
    Path | None,
    typer.Option(
        "--cache", metavar="DIR", help="Remembered results.  [default: the user's cache folder]"
    ),
]
NoCache = Annotated[
    bool, typer.Option("--no-cache", help="Solve everything, and remember nothing.")
]
Workers = Annotated[
    int | None, typer.Option("--workers", min=1, help="Processes.  [default: all cores]")
]
Json = Annotated[bool, typer.Option("--json", help="JSON on stdout, and nothing else.")]

CLOSURE_OPTIONS = ("as_printed", "closure_start", "closure", "series_order", "pairs")
BEAM_OPTIONS = ("circumferential_modulus", "longitudinal_modulus", "secant_stretch")
_LOAD_OPTIONS = ("confining_pressure", "confinement", "prestretch")
_METHOD_OPTIONS = (
    "model",
    "seating",
    "seating_friction",
    "half_length",
    *CLOSURE_OPTIONS,
    "far_field_ground",
    "wetted",
    "accuracy",
    *BEAM_OPTIONS,
)


def cache_folder(cache: Path | None, no_cache: bool) -> Path | None:
    """The folder of remembered results that the options name; None for none."""
    from stonepass.studies.solution_cache import default_folder

    if no_cache and cache is not None:
        raise BadInput("combination of --cache and --no-cache", "ambiguous", "one of the two")
    return None if no_cache else (cache or default_folder())


@dataclass(frozen=True)
class Settings:
    """What the options say; None where one was not given, and then a case file may say it."""

    case_file: Annotated[
        Path | None,
        typer.Argument(metavar="[CASE.toml]", help="Case file; options given beside it win."),
    ] = None
    stone: Annotated[
        str | None, typer.Option("--stone", metavar="LENGTH", help="Stone diameter, e.g. 4.2mm.")
    ] = None
    inner: Annotated[
        str | None, typer.Option("--inner", metavar="LENGTH", help="Inner diameter of the ureter.")
    ] = None
    outer: Annotated[
        str | None, typer.Option("--outer", metavar="LENGTH", help="Outer diameter of the ureter.")
    ] = None
    xi: Annotated[
        float | None, typer.Option("--xi", help="Size ratio: stone over inner diameter.")
    ] = None
    eta: Annotated[
        float | None, typer.Option("--eta", help="Wall ratio: outer over inner diameter.")
    ] = None
    material: Annotated[
        str | None,
        typer.Option(
            "--material",
            metavar="NAME|FILE",
            help="Catalogue name, law.toml or file.py:function.  [default: ureter]",
        ),
    ] = None
    friction: Annotated[
        float | None,
        typer.Option("--friction", help="Coulomb friction coefficient.  [default: 0.5]"),
    ] = None
    friction_from: Annotated[
        Path | None,
        typer.Option(
            "--friction-from",
            metavar="FILE.json",
            help="Take it from the JSON of 'stonepass friction'.",
        ),
    ] = None
    aspect: Annotated[
        float | None,
        typer.Option("--aspect", help="Length of a spheroid over its diameter.  [default: 1]"),
    ] = None
    shape: Annotated[
        Path | None,
        typer.Option(
            "--shape",
            metavar="FILE.csv",
            help="Any convex shape: meridian points z, rho from pole to pole, z downstream.",
        ),
    ] = None
    seating: Annotated[
        str | None,
        typer.Option("--seating", help="pressed, frictionless or growing.  [default: pressed]"),
    ] = None
    seating_friction: Annotated[
        float | None,
        typer.Option(
            "--seating-friction", help="Friction while the stone is seated.  [default: --friction]"
        ),
    ] = None
    confining_pressure: Annotated[
        str | None,
        typer.Option(
            "--confining",
            metavar="PRESSURE",
            help="Confining pressure, e.g. 5.4kPa.  [default: 0kPa]",
        ),
    ] = None
    confinement: Annotated[
        str | None, typer.Option("--confinement", help="dead or hydrostatic.  [default: dead]")
    ] = None
    prestretch: Annotated[
        float | None, typer.Option("--prestretch", help="Axial pre-stretch.  [default: 1]")
    ] = None
    half_length: Annotated[
        float | None,
        typer.Option("--half-length", help="Half the tube's length in inner radii.  [default: 10]"),
    ] = None
    model: Annotated[
        str | None,
        typer.Option(
            "--model",
            help="paper; direct: the loaded push-through itself; or beam: a thin wall as a beam "
            "on springs.  [default: paper]",
        ),
    ] = None
    wetted: Annotated[
        bool | None,
        typer.Option(
            "--wetted/--dry",
            help="Direct model: urine takes friction off up to the seal.  [default: dry]",
        ),
    ] = None
    as_printed: Annotated[
        bool | None,
        typer.Option("--as-printed/--as-derived", help="Sign of Eq. 5.  [default: as derived]"),
    ] = None
    closure_start: Annotated[
        str | None,
        typer.Option(
            "--closure-start",
            help="Where Eq. 15 starts: inner-radius or lumen.  [default: inner-radius]",
        ),
    ] = None
    closure: Annotated[
        str | None,
        typer.Option(
            "--closure", help="linear: Eq. 15; or series: Eqs 13-14, fitted.  [default: linear]"
        ),
    ] = None
    series_order: Annotated[
        int | None, typer.Option("--series-order", help="Of the series, 1 to 8.  [default: 3]")
    ] = None
    pairs: Annotated[
        Path | None,
        typer.Option(
            "--pairs",
            metavar="FILE.csv",
            help="Fit the series to alpha_deg, radius_ratio.  [default: to direct states]",
        ),
    ] = None
    far_field_ground: Annotated[
        bool | None,
        typer.Option(
            "--far-field-ground/--far-field-fibres",
            help="Ground matrix in the far field too.  [default: fibres only, Eq. 22]",
        ),
    ] = None
    accuracy: Annotated[
        str | None,
        typer.Option(
            "--accuracy",
            help="fast, standard or reference: how finely to solve.  [default: standard]",
        ),
    ] = None

    circumferential_modulus: Annotated[
        str | None,
        typer.Option("--E1", metavar="MODULUS", help="Beam model: E1 round the tube, 0.465MPa."),
    ] = None
    longitudinal_modulus: Annotated[
        str | None,
        typer.Option("--E2", metavar="MODULUS", help="Beam model: E2 along the tube, 0.02MPa."),
    ] = None
    secant_stretch: Annotated[
        float | None,
        typer.Option(
            "--secant-stretch", help="Beam model: E1 and E2 as secants of the law at this stretch."
        ),
    ] = None

    def case(self) -> Case:
        """Build the whole case."""
        from stonepass.model.case import Case, Stone

        base = self._base
        diameter: str | Length | None
        if self.stone is not None and self.xi is not None:
            raise BadInput("combination of --stone and --xi", "ambiguous", "one of the two")
        if self.stone is None and self.xi is None:
            if base is None:
                raise BadInput("size of the stone", "missing", "given as --stone or --xi")
            diameter, size_ratio = base.stone.diameter, base.stone.size_ratio
        else:
            diameter, size_ratio = self.stone, self.xi
        stone = Stone(diameter, self.friction_value(), size_ratio, shape=self.shape_value())
        return Case(stone, self.ureter(), self.load(), self.method())

    def ureter(self) -> Ureter:
        """Build the ureter alone (critical size, curve)."""
        from stonepass.model.case import Ureter

        if self.outer is not None and self.eta is not None:
            raise BadInput("combination of --outer and --eta", "ambiguous", "one of the two")
        kept = None if self._base is None else self._base.ureter
        if kept is None:
            if self.inner is None and self.outer is None and self.eta is None:
                raise BadInput(
                    "size of the ureter", "missing", "given as --inner and --outer, or as --eta"
                )
            return Ureter(self.inner, self.outer, self.material_value(), self.eta)
        material = self.material_value()
        inner = kept.inner_diameter if self.inner is None else self.inner
        if self.eta is not None:
            return Ureter(inner, None, material, self.eta)
        outer = kept.outer_diameter if self.outer is None else self.outer
        return Ureter(inner, outer, material, kept.wall_ratio if outer is None else None)

    def friction_value(self) -> float:
        """Friction coefficient of the options, of the case file, or the default."""
        if self.friction is not None and self.friction_from is not None:
            allowed = "one of the two"
            raise BadInput("combination of --friction and --friction-from", "ambiguous", allowed)
        if self.friction_from is not None:
            from stonepass.inputs.friction_file import read_friction

            return read_friction(self.friction_from)
        if self.friction is not None:
            return self.friction
        return 0.5 if self._base is None else self._base.stone.friction

    def material_value(self) -> str | Material:
        """Material of the options, of the case file, or the default; a named file is loaded."""
        if self.material is not None:
            from stonepass.inputs.material_file import find_material

            return find_material(self.material)
        return "ureter" if self._base is None else self._base.ureter.material

    def shape_value(self) -> Shape:
        """Shape of the stone of the options, of the case file, or the default."""
        from stonepass.inputs.shape_file import read_shape
        from stonepass.model.shape import Shape

        if self.shape is not None and self.aspect is not None:
            raise BadInput("combination of --aspect and --shape", "ambiguous", "one of the two")
        if self.shape is not None:
            return read_shape(self.shape)
        if self.aspect is not None:
            return Shape(self.aspect)
        return Shape() if self._base is None else self._base.stone.shape

    def load(self) -> Load:
        """Build the load."""
        from stonepass.model.case import Load

        return Load(**self._merged(_LOAD_OPTIONS, "load"))

    def method(self) -> Method:
        """Build the method."""
        from stonepass.model.case import Method

        merged = self._merged(_METHOD_OPTIONS, "method", self._displaced())
        if self.pairs is not None:
            from stonepass.inputs.opening_curve_file import read_opening_curve

            merged["pairs"] = read_opening_curve(self.pairs)
        return Method(**merged)

    def _displaced(self) -> set[str]:
        """What a case file says of the method that goes where an option is given beside it."""
        moduli = {"circumferential_modulus", "longitudinal_modulus"}
        found: set[str] = set()
        if self.closure == "linear":
            found.add("pairs")  # they go with the series
        if self.seating == "frictionless":
            found.add("seating_friction")
        if self.secant_stretch is not None:
            found |= moduli
        if any(getattr(self, name) is not None for name in moduli):
            found.add("secant_stretch")
        if self.model not in (None, "beam"):
            found |= set(BEAM_OPTIONS)
        if self.model not in (None, "paper"):
            found |= {"closure", "pairs"}
        return found

    @property
    def _base(self) -> Case | None:
        return None if self.case_file is None else _read(self.case_file)

    def _merged(
        self, names: tuple[str, ...], section: str, displaced: Collection[str] = ()
    ) -> dict[str, Any]:
        """Options that were given, else the file's values, else nothing (the defaults)."""
        base = None if self._base is None else getattr(self._base, section)
        kept = {} if base is None else {n: getattr(base, n) for n in names if n not in displaced}
        given = {name: getattr(self, name) for name in names}
        return kept | {name: value for name, value in given.items() if value is not None}


@lru_cache(maxsize=1)
def _read(path: Path) -> Case:
    from stonepass.inputs.case_file import read_case

    return read_case(path)


def takes_settings(*left_out: str) -> Callable[[Callable[..., int]], Callable[..., int]]:
    """Turn ``function(settings, own options…)`` into a command with all options in its signature.

    `left_out` names fields of `Settings` that the command does not have.
    """
    hints = get_type_hints(Settings, include_extras=True)
    shared = [field.name for field in fields(Settings) if field.name not in left_out]

    def decorate(function: Callable[..., int]) -> Callable[..., int]:
        """Make the command of `function`."""
        own_hints = get_type_hints(function, include_extras=True)
        own = [p for p in inspect.signature(function).parameters.values() if p.name != "settings"]
        annotations = {name: hints[name] for name in shared}
        annotations |= {p.name: own_hints[p.name] for p in own}

        def command(**given: Any) -> int:
            settings = Settings(**{name: given.pop(name) for name in shared})
            return function(settings, **given)

        command.__doc__ = function.__doc__
        command.__annotations__ = annotations
        keyword = inspect.Parameter.KEYWORD_ONLY
        parameters = [
            *(inspect.Parameter(n, keyword, default=None, annotation=hints[n]) for n in shared),
            *(p.replace(kind=keyword, annotation=own_hints[p.name]) for p in own),
        ]
        command.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        return command

    return decorate
