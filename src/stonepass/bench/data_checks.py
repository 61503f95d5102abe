"""Checks of laboratory data for wrong signs, wrong sizes at rest and strains given as stretches.

A strip that is stretched beyond its length at rest is in tension, and a tube that is wider than at
rest has the higher pressure inside. This holds for every stable solid. Data that contradict it were
recorded with another convention, and no constants of a law can fit them.
"""

from __future__ import annotations

from typing import NoReturn

import numpy as np

from stonepass.array_types import Float
from stonepass.bench.other_reading import explains_better, strip_shapes, tube_shapes
from stonepass.errors import BadInput
from stonepass.io.csv_file import Columns
from stonepass.model.ureter import Ureter

__all__ = ["check_inflation", "check_tension", "inner_ratio"]

STRETCH = (0.1, 15.0)  # smallest and largest stretch that any rubber survives
LARGEST_STRESS = 1e10  # Pa
# Products load × strain are positive except for noise or an offset near rest. Data are refused if
# the negative products are a larger fraction of Σ |load × strain| than this.
WRONG_SHARE = 0.05
# This fraction is larger for a tube under axial stretch, since its diameter without pressure is not
# measured but estimated.
WRONG_SHARE_STRETCHED = 0.2
# Data should begin near the state at rest. They are refused if the smallest stretch of the strips,
# or the smallest diameter of the tube divided by that at rest, is at least this large.
FARTHEST_START, FARTHEST_TUBE = 2.0, 1.7
# A pressure below this fraction of the largest one is none, and a diameter within this relative
# distance of that at rest is the latter.
NO_PRESSURE, SAME_SIZE = 0.01, 0.01
SAME_AS_REST = 0.02  # relative difference of two diameters that may both be measured at rest
STRAINS = "a stretch is the length divided by that at rest: 1 + strain, or 1 + per cent/100"


def check_tension(
    file: str,
    columns: Columns,
    along: str,
    stretch: Float[np.ndarray, " n"],
    stress: Float[np.ndarray, " n"],
) -> None:
    """Refuse data of strips that contradict every stable solid, and name the probable mistake.

    Parameters
    ----------
    file : str
        Name of the data file, for the message.
    columns : Columns
        The table as it was read.
    along : str
        Name of the column with the stretches or extensions.
    stretch : array (n)
        Stretch of each row, dimensionless.
    stress : array (n)
        Nominal stress of each row in Pa.

    Raises
    ------
    BadInput
        A stretch lies outside 0.1 to 15, no stretch is below 2, a stress exceeds 1e7 kPa, more than
        5 % of Σ |stress × strain| has the wrong sign, or the stress is zero at 0 instead of 1.

    References
    ----------
    docs/bench.md, "The data".
    """
    _check_stretches(file, columns, along, stretch)
    measured = "force_N" if "force_N" in columns else "nominal_stress_kPa"
    if not np.all(np.abs(stress) <= LARGEST_STRESS):
        row = int(np.argmax(~(np.abs(stress) <= LARGEST_STRESS)))
        raise BadInput(f"in {file}, {columns.place(row, measured)}",
                       f"{columns[measured][row]:g}", "a stress below 1e7 kPa")  # fmt: skip
    wrong = _wrong(stress * (stretch - 1.0), WRONG_SHARE)
    if wrong is None:
        if along == "stretch":
            _check_rest(file, stretch, stress)
        return
    row = wrong
    place = f"in {file}, {columns.place(row, measured)}"
    shown = f"{columns[measured][row]:g} at stretch {stretch[row]:.4g}"
    if stretch[row] > 1.0:
        raise BadInput(place, shown, "positive where a strip is stretched",
                       "change the sign of the column if pulling was recorded as negative"
                       )  # fmt: skip
    strains = f"if the column '{along}' holds strains, add 1 to them; " * (along == "stretch")
    raise BadInput(place, shown, "negative where a strip is shortened",
                   f"{strains}change the sign of the column if compression was recorded as positive"
                   )  # fmt: skip


def _check_stretches(
    file: str, columns: Columns, along: str, stretch: Float[np.ndarray, " n"]
) -> None:
    low, high = STRETCH
    outside = ~((low <= stretch) & (stretch <= high))
    if outside.any():
        row = int(np.argmax(outside))
        place, value = f"in {file}, {columns.place(row, along)}", columns[along][row]
        if along == "extension_mm":
            raise BadInput(place, f"{value:g}", f"such that 1 + extension/length is {low:g} to "
                           f"{high:g}", "check the unit of the extensions and --gauge-length"
                           )  # fmt: skip
        raise BadInput(place, f"{value:g}", f"a number from {low:g} to {high:g}",
                       _swapped(columns) or STRAINS)  # fmt: skip
    if stretch.min() >= FARTHEST_START:
        remedy = f"{STRAINS}; if the column holds stretches, add the row at rest (1, 0)"
        raise BadInput(f"in {file}, the smallest stretch", f"{stretch.min():.4g}",
                       f"below {FARTHEST_START:g} for data that begin at rest", remedy
                       )  # fmt: skip


def _check_rest(
    file: str, stretch: Float[np.ndarray, " n"], stress: Float[np.ndarray, " n"]
) -> None:
    """Refuse stretches if the stress is zero at 0 and not at 1, as it is for strains."""
    as_named = strip_shapes(stretch, 3)
    for kind, written, part in (("strains", "", 1.0), ("strains in per cent", "/100", 100.0)):
        if explains_better(stress, as_named, strip_shapes(1.0 + stretch / part, 2)):
            raise BadInput(f"in {file}, column 'stretch'",
                           f"{stretch.min():g} to {stretch.max():g}",
                           "the length divided by that at rest, so that the stress is zero at 1",
                           f"the values look like {kind}, since the stress is zero at 0: replace "
                           f"each by 1 + value{written}")  # fmt: skip


def _swapped(columns: Columns) -> str:
    """Return a remark if the column of stresses looks as if it held the stretches, else ""."""
    other = columns.get("nominal_stress_kPa", columns.get("force_N"))
    if other is None or np.ptp(other) < 0.01 or not 0.8 <= other.min() < other.max() < 4.0:
        return ""
    return "the columns look as if they were exchanged"


def check_inflation(
    file: str,
    columns: Columns,
    given: str,
    ureter: Ureter,
    axial: Float[np.ndarray, " n"],
) -> None:
    """Refuse data of tubes that contradict every stable solid, and name the probable mistake.

    Parameters
    ----------
    file : str
        Name of the data file, for the message.
    columns : Columns
        The table as it was read; pressures in kPa, diameters in mm.
    given : str
        Name of the column with the diameters.
    ureter : Ureter
        Inner and outer diameter of the tube at rest.
    axial : array (n)
        Axial stretch λ_z of each row.

    Raises
    ------
    BadInput
        The wall does not fit into an outer diameter, all diameters are above 1.7 times the diameter
        at rest, too large a fraction of Σ |pressure × widening| has the wrong sign (5 %, or
        20 % if the tube is stretched along its axis), or the diameters are of the other kind.

    References
    ----------
    docs/bench.md, "The data".
    """
    ratio = inner_ratio(columns[given], given, ureter, axial)
    doubled = inner_ratio(2.0 * columns[given], given, ureter, axial)
    option, rest = ("--outer", ureter.outer_diameter) if given[0] == "o" else (
        "--inner", ureter.inner_diameter)  # fmt: skip
    other = "inner_diameter_mm" if given[0] == "o" else "outer_diameter_mm"
    swapped = inner_ratio(columns[given], other, ureter, axial)
    at_rest = f"{1e3 * (rest or 0.0):.4g} mm ({option})"
    renamed = f"name the column {other} if they are {other[:5]} diameters"
    radii = bool(np.all(doubled > 1.0 - SAME_AS_REST))
    remedy = "double the values if they are radii" if radii else f"check {option} and the unit"
    if np.all(swapped > 0.9):
        remedy = renamed
    if not np.all(ratio > 0.0):
        row = int(np.argmin(ratio > 0.0))
        raise BadInput(f"in {file}, {columns.place(row, given)}", f"{columns[given][row]:g}",
                       f"large enough for the volume of the wall, {at_rest} at rest", remedy
                       )  # fmt: skip
    pressure, widening = columns["pressure_kPa"], ratio * np.sqrt(axial) - 1.0
    allowed = WRONG_SHARE if np.all(axial == 1.0) else WRONG_SHARE_STRETCHED
    wrong = _wrong(pressure * widening, allowed)
    if wrong is not None:
        _refuse_tube(file, columns, given, wrong, at_rest, remedy)
    if widening.min() >= FARTHEST_TUBE - 1.0:
        raise BadInput(f"in {file}, the smallest diameter",
                       f"{1.0 + widening.min():.3g} times that at rest, {at_rest}",
                       f"below {FARTHEST_TUBE:g} times for data that begin at rest",
                       "give diameters, not radii, as --inner and --outer, or add the row at rest, "
                       "without pressure")  # fmt: skip
    _check_size_without_pressure(file, columns, given, ureter, axial)
    shapes = [tube_shapes(each, ureter.wall_ratio, axial, 2) for each in (ratio, swapped)]
    if explains_better(pressure, *shapes):
        values = columns[given]
        raise BadInput(f"in {file}, column '{given}'", f"{values.min():g} to {values.max():g}",
                       f"{given[:5]} diameters, so that the pressure is zero at {at_rest}",
                       f"as {other[:5]} diameters the values agree with a tube: {renamed}"
                       )  # fmt: skip


def _check_size_without_pressure(
    file: str, columns: Columns, given: str, ureter: Ureter, axial: Float[np.ndarray, " n"]
) -> None:
    """Refuse diameters that begin, nearly without pressure, at the other diameter at rest."""
    pressure, diameter = np.abs(columns["pressure_kPa"]), columns[given]
    sizes = {"--inner": ureter.inner_diameter, "--outer": ureter.outer_diameter}
    other = "--outer" if given[0] == "i" else "--inner"
    size = 1e3 * (sizes[other] or np.nan)
    first = int(np.argmin(diameter))
    at_rest = pressure[first] <= NO_PRESSURE * pressure.max() and axial[first] == 1.0
    if at_rest and abs(diameter[first] / size - 1.0) < SAME_SIZE:
        kind, right = ("inner", "outer") if given[0] == "i" else ("outer", "inner")
        raise BadInput(f"in {file}, {columns.place(first, given)}",
                       f"{diameter[first]:g} at {columns['pressure_kPa'][first]:g} kPa",
                       f"the {kind} diameter at rest where there is no pressure",
                       f"{size:.4g} mm is the diameter {other}: name the column "
                       f"{right}_diameter_mm if the values are {right} diameters")  # fmt: skip


def _refuse_tube(
    file: str, columns: Columns, given: str, row: int, at_rest: str, remedy: str
) -> NoReturn:
    pressure, diameter = columns["pressure_kPa"][row], columns[given][row]
    if pressure > 0.0:
        raise BadInput(f"in {file}, {columns.place(row, given)}",
                       f"{diameter:g} at {pressure:g} kPa",
                       f"larger than at rest, {at_rest}, where the pressure is positive",
                       remedy)  # fmt: skip
    raise BadInput(f"in {file}, {columns.place(row, 'pressure_kPa')}",
                   f"{pressure:g} at a diameter of {diameter:g} mm",
                   f"positive where the tube is wider than at rest, {at_rest}",
                   "the transmural pressure is the inner minus the outer pressure")  # fmt: skip


def inner_ratio(
    diameter_mm: Float[np.ndarray, " n"], given: str, ureter: Ureter, axial: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Compute the ratio of the inner radius to the inner radius at rest.

    If the outer diameter was measured, the inner radius follows from the constant volume of the
    wall, r_a² = r_b² − (R_b² − R_a²)/λ_z.

    Parameters
    ----------
    diameter_mm : array (n)
        Measured inner or outer diameters in mm.
    given : {"inner_diameter_mm", "outer_diameter_mm"}
        Which diameter was measured.
    ureter : Ureter
        Inner and outer diameter of the tube at rest.
    axial : array (n)
        Axial stretch λ_z of each row.

    Returns
    -------
    array (n)
        r_a/R_a; NaN if the wall does not fit into the measured outer diameter.

    References
    ----------
    docs/theory.md, "Far field".
    """
    ratio = 1e-3 * diameter_mm / (ureter.inner_diameter or np.nan)
    if given == "outer_diameter_mm":
        with np.errstate(invalid="ignore"):
            ratio = np.sqrt(ratio**2 - (ureter.wall_ratio**2 - 1.0) / axial)
    return ratio


def _wrong(work: Float[np.ndarray, " n"], allowed: float) -> int | None:
    """Return the row with the most negative product of load and strain.

    None is returned if the negative products are at most the fraction `allowed` of Σ |product|.
    """
    negative = float(np.sum(-work[work < 0.0]))
    return int(np.argmin(work)) if negative > allowed * float(np.sum(np.abs(work))) else None
