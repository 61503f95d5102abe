"""The beam model: a thin wall as a beam on an elastic foundation (paper, section 3.3, Eqs 23–28).

The axial fibres of the wall act as a beam of unit width, the circumferential fibres as springs
under the beam. The stone presses on the beam like a disc on a half-plane (Hertz contact). Lengths
in this module are divided by the inner radius R_a. See "The thin wall as a beam" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.declaration import Kind, check_inputs, declared, described
from stonepass.errors import BadInput, Misplaced, Outcome, require
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.materials.secant import STRETCH, secant_moduli
from stonepass.model.answer import Answer, NamedQuantity, unanswered
from stonepass.model.closure import linear_closure
from stonepass.model.far_field import far_field_law
from stonepass.model.models.shared_options import far_field_ground
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.roots import first_root
from stonepass.model.states.state_solver import StateSolver
from stonepass.units import Pressure, Values, pressure

__all__ = ["BeamState", "ElasticFoundation", "ElasticFoundationDetail"]

THICKEST = 1.5  # largest η
WIDEST = 2.0  # largest ξ
# Smallest half-length of the contact in radii of the stone. The closure divides by 1 − sin α₀, of
# which half the square of this ratio is left; rounding would be too large a part of less.
NARROWEST = 1e-5
# Largest wall thickness and largest deflection without a warning, in inner radii.
THIN, SMALL = 0.1, 0.1
WHY = (
    "the beam model is for a thin, unloaded tube round a sphere: use the paper's or the direct "
    "model"
)
MODULUS = (1e2, 1e10)  # bounds of a modulus in Pa


@dataclass(frozen=True)
class ElasticFoundation:
    """The beam model of a thin wall.

    Either both moduli or `secant_stretch` must be given.

    Parameters
    ----------
    circumferential_modulus, longitudinal_modulus : str or Pressure, optional
        E₁ and E₂, Young's moduli of the circumferential and the axial fibres, 100 Pa to 10 GPa.
    secant_stretch : float, optional
        Stretch, 1.001 to 2, at which both moduli are computed as nominal plane-strain secant moduli
        of the wall's law (`materials.secant`).
    far_field_ground : bool
        True if the secant moduli include the ground matrix of the law.

    Raises
    ------
    BadInput
        A modulus is missing or out of bounds, or both moduli and a stretch are given.
    """

    SECTION: ClassVar[str] = "method"
    NAME: ClassVar[str] = "beam"
    MEANING: ClassVar[str] = "a thin wall as a beam on an elastic foundation"
    NEEDS_ELEMENTS: ClassVar[bool] = False

    circumferential_modulus: Pressure | str | None = declared(
        Kind.PRESSURE,
        "--E1",
        "Young's modulus of the wall around the tube.",
        default=None,
        bounds=MODULUS,
    )
    longitudinal_modulus: Pressure | str | None = declared(
        Kind.PRESSURE,
        "--E2",
        "Young's modulus of the wall along the tube.",
        default=None,
        bounds=MODULUS,
    )
    secant_stretch: float | None = declared(
        Kind.NUMBER,
        "--secant-stretch",
        "Take both moduli as secant moduli of the material at this stretch.",
        default=None,
        bounds=STRETCH,
    )
    far_field_ground: bool = far_field_ground()

    __repr__ = described

    def __post_init__(self) -> None:
        check_inputs(self)
        moduli = {
            "circumferential_modulus": self.circumferential_modulus,
            "longitudinal_modulus": self.longitudinal_modulus,
        }
        missing = [name for name, value in moduli.items() if value is None]
        if self.secant_stretch is None and missing:
            raise BadInput(missing[0], "missing", "given", "or give a secant_stretch")
        if self.secant_stretch is not None and len(missing) < 2:
            raise Misplaced("secant_stretch", "a modulus", "", "give both moduli, or the stretch")

    def moduli(self, case: Problem) -> tuple[float, float]:
        """Return E₁ and E₂ in Pa: the given moduli, or the secant moduli of the wall's law."""
        if self.secant_stretch is not None:
            law = far_field_law(case, ground=self.far_field_ground)
            return secant_moduli(law, self.secant_stretch)
        hoop, axial = self.circumferential_modulus, self.longitudinal_modulus
        return pressure(hoop, "circumferential_modulus"), pressure(axial, "longitudinal_modulus")

    def require_any_size(self) -> None:
        """Do nothing: no option of this model restricts it to one stone."""

    def largest_size(self, case: Problem) -> float:
        """Return the size ratio below which the contact is shorter than the stone, at most 2.

        The half-length a of the contact satisfies (a/R_a)² = c ξ (ξ − 1) with a constant c, so that
        a < R_s if c (ξ − 1) < ξ.
        """
        at_one = _beam_state(self, case.with_size_ratio(2.0))
        c = at_one.half_length**2 / 2.0
        return WIDEST if c <= 2.0 else c / (c - 1.0) * (1.0 - 1e-9)

    def solve(
        self,
        case: Problem,
        numerics: Numerics,
        states: StateSolver,
        resolution: Resolution | None = None,
    ) -> Answer:
        """Find the critical pressure with the beam equations.

        For the parameters see `Model.solve`; `states` and `resolution` are not used.

        Raises
        ------
        BadInput
            The stone is not a sphere, the tube is under confining pressure or pre-stretch, or the
            wall is too thick (η > 1.5).
        """
        state = _beam_state(self, case)
        a, xi = state.half_length, case.size_ratio
        if not a < xi:
            reason = (
                f"the beam model does not hold: half the contact length, {a:.3g} inner radii, is "
                f"not less than the radius of the stone, {xi:.3g}"
            )
            return unanswered(case, self, numerics, reason)

        if a < NARROWEST * xi:
            reason = (
                f"half the contact length, {a:.3g} inner radii, is too small beside the radius of "
                f"the stone, {xi:.3g}, to be resolved"
            )
            return unanswered(case, self, numerics, reason)

        def excess(y: Values) -> Values:
            return state.friction(y) - state.urine_pressure(y) * np.pi * (xi**2 - y**2)

        root = a if case.stone.friction == 0.0 else first_root(excess, a, 0.0)
        return Answer(
            case,
            self,
            numerics,
            Outcome.BEYOND_CLOSURE if root is None else Outcome.MOVES,
            pressure=None if root is None else float(state.urine_pressure(root)),
            critical_angle=None if root is None else float(np.arccos(root / xi)),
            contact=state,
            detail=ElasticFoundationDetail(float(state.urine_pressure(0.0)), state),
            warnings=tuple(state.warnings()),
        )


@dataclass(frozen=True)
class ElasticFoundationDetail:
    """Additional results of the beam model.

    Attributes
    ----------
    closure_end_pressure : float
        Urine pressure in Pa at α = π/2, where the closure ends; it is not a physical bound.
    state : BeamState
    """

    closure_end_pressure: float
    state: BeamState

    def quantities(self) -> tuple[NamedQuantity, ...]:
        """Return end pressure of the closure, moduli, foundation, decay and contact length."""
        state = self.state
        return (
            NamedQuantity(
                "closure_end_pressure", self.closure_end_pressure / 1e3, "kPa", "closure end"
            ),
            NamedQuantity("circumferential_modulus", state.circumferential_modulus, "Pa", "E1"),
            NamedQuantity("longitudinal_modulus", state.longitudinal_modulus, "Pa", "E2"),
            NamedQuantity("foundation", state.foundation, "Pa"),
            NamedQuantity("decay", state.decay),
            NamedQuantity("half_contact_length", state.half_length, "R_a", "half contact length"),
        )


@dataclass(frozen=True)
class BeamState:
    """The contact of stone and beam, without urine pressure.

    Attributes
    ----------
    case : Problem
    circumferential_modulus, longitudinal_modulus : float
        E₁ and E₂ in Pa.
    foundation : float
        Stiffness k = h E₁/R_a² of the foundation (Eq. 23), in Pa per inner radius of deflection;
        h is the thickness of the wall.
    decay : float
        β = (3k/(E₂ h³))^¼ per inner radius. Eq. 24 is printed with a square root instead of the
        fourth root of a Winkler beam under a point load; the printed form has the wrong units.
    line_load : float
        Force per width F_n = 2 k δ/β (Eq. 24), in Pa × inner radius, with δ = R_s − R_a.
    half_length : float
        Half the length of the contact a = √(4 R_s F_n/(π E₂)) (Eq. 25), in inner radii.
    """

    case: Problem
    circumferential_modulus: float
    longitudinal_modulus: float
    foundation: float
    decay: float
    line_load: float
    half_length: float

    @property
    def contact_angle(self) -> float:
        """Contact angle α₀ in rad, from cos α₀ = a/R_s."""
        return float(np.arccos(self.half_length / self.case.size_ratio))

    @property
    def downstream_angle(self) -> float:
        """Angle π − α₀ in rad at which the contact ends."""
        return float(np.pi - self.contact_angle)

    @property
    def peak_contact_pressure(self) -> float:
        """Largest contact pressure 2 F_n/(π a) in Pa, at the equator."""
        return 2.0 * self.line_load / (np.pi * self.half_length)

    @property
    def equator_contact_pressure(self) -> float:
        """Contact pressure σ(π/2) in Pa."""
        return self.peak_contact_pressure

    def pressure_at(self, theta: Float[np.ndarray, "*m"]) -> Float[np.ndarray, "*m"]:
        """Return σ(θ) in Pa for θ in rad; as a function of R_s cos θ it is half an ellipse."""
        share = self.case.size_ratio * np.cos(theta) / self.half_length
        return np.asarray(self.peak_contact_pressure * np.sqrt(np.maximum(1.0 - share**2, 0.0)))

    def friction(self, y: Values) -> Values:
        """Return the friction force of the remaining contact in Pa × inner radius² (Eq. 26).

        Parameters
        ----------
        y : float or array
            Axial distance in inner radii, upstream of the equator, up to which the wall is still in
            contact; y = a − x with the paper's coordinate x.
        """
        t = y / self.half_length
        arc = t / 2.0 * np.sqrt(np.maximum(1.0 - t**2, 0.0)) + np.arcsin(t) / 2.0 + np.pi / 4.0
        case = self.case
        return 4.0 * self.line_load * case.stone.friction * case.size_ratio * arc

    def urine_pressure(self, y: Values) -> Values:
        """Return the urine pressure P_u = k (r_a − R_a) in Pa (Eqs 27 and 28).

        r_a follows from Eq. 28, which is Eq. 15 with sin α = √(1 − (y/R_s)²).

        Parameters
        ----------
        y : float or array
            See `friction`.
        """
        xi = self.case.size_ratio
        width, first = (np.sqrt(1.0 - (each / xi) ** 2) for each in (y, self.half_length))
        return self.foundation * (linear_closure(width, float(first), xi) - 1.0)

    def warnings(self) -> list[Caution]:
        """Return a caution for each assumption of the beam that is not well satisfied."""
        found, reach = [], self.half_length * self.decay
        if reach > 1.0:
            found.append(caution("long_beam_contact", decay_lengths=reach))
        thick, wide = self.case.wall_ratio - 1.0, self.case.size_ratio - 1.0
        if thick > THIN or wide > SMALL:
            found.append(caution("thick_beam", thickness=thick, widening=wide))
        return found

    def without_wall(self) -> BeamState:
        """Return the state itself, because a beam has no stress field."""
        return self


def _beam_state(model: ElasticFoundation, case: Problem) -> BeamState:
    """Solve the contact of stone and beam.

    Raises
    ------
    BadInput
        The stone is not a sphere, the tube is under confining pressure or pre-stretch, or the wall
        is too thick (η > 1.5).
    """
    load, eta = case.load, case.wall_ratio
    stone = case.stone.shape
    require(stone.spheroidal and stone.aspect == 1.0, "shape of the stone", "not a sphere",
            "a sphere", WHY)  # fmt: skip
    require(eta <= THICKEST, "wall ratio", round(eta, 6), f"at most {THICKEST:g}", WHY)
    if load.confining_pressure > 0.0:
        shown = f"{load.confining_pressure / 1e3:g} kPa"
        raise BadInput("confining pressure", shown, "none", WHY)
    require(load.prestretch == 1.0, "prestretch", load.prestretch, "1", WHY)
    hoop, axial = model.moduli(case)
    h = eta - 1.0
    foundation = h * hoop
    decay = (3.0 * foundation / (axial * h**3)) ** 0.25
    line_load = 2.0 * foundation * (case.size_ratio - 1.0) / decay
    half_length = float(np.sqrt(4.0 * case.size_ratio * line_load / (np.pi * axial)))
    return BeamState(case, hoop, axial, foundation, decay, line_load, half_length)
