"""The values a question is made of: stone, ureter, load, method, and the case that joins them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from numbers import Real
from typing import Any

from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.materials.catalogue import material as catalogued
from stonepass.materials.protocol import Material, names_a_file
from stonepass.model.closure import ORDER
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.shape import ASPECT, Shape
from stonepass.units import Length, Pressure, format_length, length, pressure

__all__ = ["Case", "Load", "Method", "Stone", "Ureter"]

SIZE_RATIO = (0.1, 3.0)
WALL_RATIO = (1.02, 10.0)
FRICTION = (0.0, 2.0)
DIAMETER = (1e-5, 1.0)
CONFINING = (0.0, 1e5)
PRESTRETCH = (0.8, 1.6)
HALF_LENGTH = (3.0, 100.0)
MODULUS = (1e2, 1e10)
MODULI = ("circumferential_modulus", "longitudinal_modulus")  # of the beam
SECANT_STRETCH = (1.001, 2.0)
_BY_RATIO = "give both diameters, or the ratio alone"


@dataclass(frozen=True, init=False)
class Stone:
    """A rigid stone, convex and of revolution, by its diameter or its size ratio ξ = R_s/R_a.

    Parameters
    ----------
    diameter : str or Length, optional
        The largest across the ureter. Text with a unit, e.g. ``"4.2 mm"``; in metres once read.
    friction : float
        Coulomb coefficient μ_f between stone and wall, 0 to 2.
    size_ratio : float, optional
        ξ, where no length is known; 0.1 to 3.
    aspect : float, optional
        Of a spheroid: length along the ureter over the diameter across it, 0.5 to 2; 1, the
        default, is a sphere.
    shape : Shape, optional
        Any other shape (`read_shape`, `shape_through`); not beside `aspect`.
    """

    diameter: Length | None
    friction: float
    size_ratio: float | None
    shape: Shape

    def __init__(
        self,
        diameter: str | Length | None = None,
        friction: float = 0.5,
        size_ratio: float | None = None,
        aspect: float | None = None,
        shape: Shape | None = None,
    ) -> None:
        _one_of("stone", diameter=diameter, size_ratio=size_ratio)
        _set(self, "diameter", _diameter(diameter, "stone diameter"))
        _set(self, "friction", _number(friction, "friction", *FRICTION))
        ratio = None if size_ratio is None else _number(size_ratio, "size_ratio", *SIZE_RATIO)
        _set(self, "size_ratio", ratio)
        if aspect is not None and shape is not None:
            raise BadInput("aspect", aspect, "left out beside a shape, which has its own")
        if shape is None:
            shape = Shape(_number(1.0 if aspect is None else aspect, "aspect", *ASPECT))
        require(isinstance(shape, Shape), "shape", shape, "a Shape, as read_shape gives it")
        _set(self, "shape", shape)

    @property
    def aspect(self) -> float:
        """Length of a spheroid along the ureter over its diameter across it (see `Shape`)."""
        return self.shape.aspect


@dataclass(frozen=True, init=False)
class Ureter:
    """A uniform tube without load, by its diameters or by its wall ratio η = R_b/R_a.

    Parameters
    ----------
    inner_diameter, outer_diameter : str or Length, optional
        Text with a unit, e.g. ``"3.5 mm"``; in metres once read.
    material : str or Material
        Catalogue name (human wall by default) or a `Material`; `load_material` reads one from a
        file.
    wall_ratio : float, optional
        η, where no lengths are known (also beside `inner_diameter` alone); 1.02 to 10.
    """

    inner_diameter: Length | None
    outer_diameter: Length | None
    material: Material
    wall_ratio: float

    def __init__(
        self,
        inner_diameter: str | Length | None = None,
        outer_diameter: str | Length | None = None,
        material: str | Material = "ureter",
        wall_ratio: float | None = None,
    ) -> None:
        inner = _diameter(inner_diameter, "inner diameter")
        outer = _diameter(outer_diameter, "outer diameter")
        if inner is not None and outer is not None:
            require(
                outer > inner,
                "outer diameter",
                format_length(outer),
                f"larger than the inner diameter, {format_length(inner)}",
            )
            ratio = outer / inner
            if wall_ratio is not None and not abs(wall_ratio - ratio) <= 1e-9 * ratio:
                raise BadInput("wall_ratio", wall_ratio, f"left out beside diameters ({ratio:.6g})")
        elif outer is not None:
            raise BadInput("inner diameter", "missing", "given with the outer one", _BY_RATIO)
        elif wall_ratio is None:
            what = "outer diameter" if inner is not None else "size of the ureter"
            raise BadInput(what, "missing", "given", _BY_RATIO)
        else:
            ratio = wall_ratio
        _set(self, "inner_diameter", inner)
        _set(self, "outer_diameter", outer)
        _set(self, "material", _material(material))
        _set(self, "wall_ratio", _number(ratio, "wall_ratio", *WALL_RATIO))


@dataclass(frozen=True, init=False)
class Load:
    """What acts on the tube besides stone and urine.

    Parameters
    ----------
    confining_pressure : str or Pressure
        P_out on the outer wall, 0 to 100 kPa.
    confinement : {"dead", "hydrostatic"}
        Whether the radial resultant of P_out is kept as the tube widens (paper, Eq. 10) or the
        pressure itself (a water bath).
    prestretch : float
        Axial stretch λ_z put on the tube before everything else; R_a, R_b are before it.
    """

    confining_pressure: Pressure
    confinement: str
    prestretch: float

    def __init__(
        self,
        confining_pressure: str | Pressure = Pressure(0.0),
        confinement: str = "dead",
        prestretch: float = 1.0,
    ) -> None:
        p = pressure(confining_pressure, "confining pressure")
        low, high = CONFINING
        require(low <= p <= high, "confining pressure", confining_pressure, "0 kPa to 100 kPa")
        _choice("confinement", confinement, ("dead", "hydrostatic"))
        _set(self, "confining_pressure", p)
        _set(self, "confinement", confinement)
        _set(self, "prestretch", _number(prestretch, "prestretch", *PRESTRETCH))

    @property
    def hydrostatic(self) -> bool:
        """Whether the confining pressure follows the deformed wall."""
        return self.confinement == "hydrostatic"


@dataclass(frozen=True)
class Method:
    """How the question is answered.

    Parameters
    ----------
    model : {"paper", "direct", "beam"}
        Seated contact pressure cut off at the contact angle, with the closure of Eq. 15; the
        loaded push-through itself; or a thin wall as a beam on an elastic foundation.
    seating : {"pressed", "frictionless", "growing"}
        How the stone came to its place: its arc pressed radially into the wall as in the paper,
        without friction, or a sphere growing in place.
    seating_friction : float, optional
        Coulomb coefficient while the stone is seated, 0 to 2; by default the stone's.
    half_length : float
        L/R_a, half the length of the tube in inner radii, 3 to 100; its ends keep their place.
    as_printed : bool
        Take Eq. 5 with the sign printed in the paper (the wall behind the stone assists).
    closure_start : {"inner-radius", "lumen"}
        Where Eq. 15 starts: at R_a as in the paper, or at the lumen that load leaves open.
    closure : {"linear", "series"}
        Paper's model: Eq. 15; or the series of Eqs 13–14, fitted to `pairs` or to direct states of
        the case.
    series_order : int
        Of the series, 1 to 8.
    pairs : OpeningCurve, optional
        Opened angles and radii to fit the series to (`read_opening_curve`).
    far_field_ground : bool
        Whether the far field contains the ground matrix of the law (Eq. 22 does not).
    wetted : bool
        Direct model: whether urine takes its pressure off the friction, from the contact's upstream
        edge to the seal.
    accuracy : {"standard", "fast", "reference"}
        How finely the finite elements are solved; every answer carries an estimate of its error.
    circumferential_modulus, longitudinal_modulus : str or Pressure, optional
        Beam model: E₁ and E₂, Young's moduli of the fibres round and along the tube.
    secant_stretch : float, optional
        Beam model: take both as nominal plane-strain secants of the wall's law at this stretch.
    """

    model: str = "paper"
    seating: str = "pressed"
    seating_friction: float | None = None
    half_length: float = 10.0
    as_printed: bool = False
    closure_start: str = "inner-radius"
    closure: str = "linear"
    series_order: int = 3
    pairs: OpeningCurve | None = None
    far_field_ground: bool = False
    wetted: bool = False
    accuracy: str = "standard"
    circumferential_modulus: str | Pressure | None = None
    longitudinal_modulus: str | Pressure | None = None
    secant_stretch: float | None = None

    def __post_init__(self) -> None:
        _choice("model", self.model, ("paper", "direct", "beam"))
        self._check_beam()
        _choice("seating", self.seating, ("pressed", "frictionless", "growing"))
        if self.seating_friction is not None:
            _number(self.seating_friction, "seating_friction", *FRICTION)
            require(
                self.seating != "frictionless" or self.seating_friction == 0.0,
                "seating_friction",
                self.seating_friction,
                "left out where the seating is frictionless",
            )
        _choice("accuracy", self.accuracy, ("fast", "standard", "reference"))
        _choice("closure_start", self.closure_start, ("inner-radius", "lumen"))
        _choice("closure", self.closure, ("linear", "series"))
        if self.closure == "series" and self.model != "paper":
            why = f"it is of the model 'paper', not '{self.model}'"
            raise BadInput("closure", self.closure, "left out", why)
        low, high = ORDER
        whole = isinstance(self.series_order, int) and not isinstance(self.series_order, bool)
        allowed = f"a whole number from {low} to {high}"
        require(whole and low <= self.series_order <= high, "series_order", self.series_order,
                allowed)  # fmt: skip
        if self.pairs is not None:
            require(
                isinstance(self.pairs, OpeningCurve),
                "pairs",
                self.pairs,
                "as read_opening_curve gives them",
            )
            if self.closure != "series":
                raise BadInput("pairs", "given", "left out", "they are of the closure 'series'")
            least = f"at least as many as coefficients, {self.series_order}"
            count = len(self.pairs.alpha)
            require(count >= self.series_order, "pairs", count, least)
        _number(self.half_length, "half_length", *HALF_LENGTH)
        for name in ("as_printed", "far_field_ground", "wetted"):
            value = getattr(self, name)
            require(isinstance(value, bool), name, value, "true or false")

    def by(self, model: str) -> Method:
        """Return the same method with another model, without what is of one model alone."""
        of_paper: dict[str, Any] = {"closure": "linear", "pairs": None}
        of_beam: dict[str, Any] = dict.fromkeys((*MODULI, "secant_stretch"))
        dropped = {} if model == "paper" else of_paper
        dropped |= {} if model == "beam" else of_beam
        return replace(self, model=model, **dropped)

    def _check_beam(self) -> None:
        given = [name for name in MODULI if getattr(self, name) is not None]
        for name in given:
            value = getattr(self, name)
            read = pressure(value, name)
            low, high = MODULUS
            require(low <= read <= high, name, value, "0.1 kPa to 10 GPa")
            _set(self, name, read)
        if self.secant_stretch is not None:
            _number(self.secant_stretch, "secant_stretch", *SECANT_STRETCH)
        if self.model != "beam":
            for name in (*given, *(["secant_stretch"] if self.secant_stretch is not None else [])):
                raise BadInput(name, getattr(self, name), "left out", "it is of the model 'beam'")
        elif self.secant_stretch is None and len(given) < 2:
            missing = next(name for name in MODULI if name not in given)
            raise BadInput(missing, "missing", "given", "or give a secant_stretch")
        elif self.secant_stretch is not None and given:
            raise BadInput("secant_stretch", self.secant_stretch, f"left out beside a {given[0]}")


@dataclass(frozen=True)
class Case:
    """A stone in a ureter under a load, and the method: everything an answer depends on."""

    stone: Stone
    ureter: Ureter
    load: Load = field(default_factory=Load)
    method: Method = field(default_factory=Method)

    def __post_init__(self) -> None:
        if self.stone.diameter is not None and self.ureter.inner_diameter is None:
            raise BadInput(
                "inner diameter", "missing", "given where the stone has a diameter", _BY_RATIO
            )
        low, high = SIZE_RATIO
        require(
            low <= self.size_ratio <= high,
            "size ratio (stone diameter over inner diameter)",
            round(self.size_ratio, 6),
            f"{low:g} to {high:g}",
        )
        least = 2.0 * self.size_ratio * max(1.0, self.stone.shape.reach)
        require(
            self.method.half_length >= least,
            "half_length",
            self.method.half_length,
            f"at least twice the stone's largest extent from its widest place, {least:.4g}",
        )

    @property
    def size_ratio(self) -> float:
        """ξ = R_s/R_a."""
        if self.stone.size_ratio is not None:
            return self.stone.size_ratio
        assert self.stone.diameter is not None
        assert self.ureter.inner_diameter is not None
        return self.stone.diameter / self.ureter.inner_diameter

    @property
    def stone_diameter(self) -> Length | None:
        """Diameter of the stone in m, where the ureter has lengths."""
        inner = self.ureter.inner_diameter
        if self.stone.diameter is not None or inner is None:
            return self.stone.diameter
        return Length(self.size_ratio * inner)

    @property
    def seating_friction(self) -> float:
        """Coulomb coefficient on the way to the seated state."""
        if self.method.seating == "frictionless":
            return 0.0
        given = self.method.seating_friction
        return self.stone.friction if given is None else given

    @property
    def wall_ratio(self) -> float:
        """η = R_b/R_a."""
        return self.ureter.wall_ratio

    def with_friction(self, friction: float) -> Case:
        """Return the same case with another friction coefficient."""
        stone = self.stone
        other = Stone(stone.diameter, friction, stone.size_ratio, shape=stone.shape)
        return Case(other, self.ureter, self.load, self.method)

    def with_size_ratio(self, size_ratio: float) -> Case:
        """Return the same case with another stone of the same friction and shape.

        Raises
        ------
        BadInput
            Where pairs of the closure belong to the stone that it has.
        """
        if self.method.pairs is not None and size_ratio != self.size_ratio:
            why = "they are of one stone; the series is then fitted to direct states"
            raise BadInput("pairs", "given", "left out where the size varies", why)
        stone = Stone(size_ratio=size_ratio, friction=self.stone.friction, shape=self.stone.shape)
        return Case(stone, self.ureter, self.load, self.method)


def _material(value: str | Material) -> Material:
    if isinstance(value, Material):
        return value
    if not isinstance(value, str):
        raise BadInput("material", value, "a name of the catalogue or a Material")
    if names_a_file(value):
        raise BadInput("material", value, "a name of the catalogue or a Material",
                       "read the file first, with stonepass.load_material")  # fmt: skip
    return catalogued(value)


def _set(target: Any, name: str, value: Any) -> None:
    object.__setattr__(target, name, value)


def _one_of(what: str, **given: Any) -> None:
    names = " or ".join(given)
    count = sum(value is not None for value in given.values())
    if count != 1:
        state = "missing" if count == 0 else "given twice"
        raise BadInput(f"size of the {what}", state, f"given once, as {names}")


def _diameter(value: str | Length | None, name: str) -> Length | None:
    if value is None:
        return None
    read = length(value, name)
    low, high = DIAMETER
    require(low <= read <= high, name, value, "0.01 mm to 1000 mm")
    return read


def _number(value: Any, name: str, low: float, high: float) -> float:
    allowed = f"a number from {low:g} to {high:g}"
    if isinstance(value, bool) or not isinstance(value, Real):
        raise BadInput(name, value, allowed)
    number = float(value)
    require(low <= number <= high, name, number, allowed)
    return number


def _choice(name: str, value: Any, known: tuple[str, ...]) -> None:
    if value not in known:
        refuse_unknown(name, str(value), list(known))
