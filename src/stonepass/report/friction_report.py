"""The friction coefficient of a surface as a table."""

from __future__ import annotations

from math import degrees

from rich import box
from rich.table import Table
from rich.text import Text

from stonepass.surface.friction_result import SurfaceFriction

__all__ = ["friction_table"]

MICRO = 1e6  # µm per m


def friction_table(found: SurfaceFriction, image: str) -> Table:
    """Return a table of the result, of its inputs, and of its spread over the analysis choices."""
    table = Table(box=box.SIMPLE_HEAD, title=Text(f"Friction of {image}"), title_justify="left")
    for name in ("", "value", ""):
        table.add_column(name)
    for name, value, remark in _rows(found):
        table.add_row(Text(name, "bold" if name == "friction coefficient" else ""), value, remark)
    return table


def _rows(found: SurfaceFriction) -> list[tuple[str, str, str]]:
    assert found.picture.pixel is not None
    across, down = (each * MICRO for each in found.picture.pixel)
    first, rest, rough, spread = (
        found.baseline, found.deviation_baseline, found.roughness, found.spread,
    )  # fmt: skip
    sd = (
        "spread unknown"
        if spread.sd is None
        else f"± {spread.sd:.2g} (spread over analysis choices)"
    )
    pixel = f"{across:.4g} µm" if across == down else f"{across:.4g} × {down:.4g} µm"
    rows = [
        ("friction coefficient", f"{found.friction:.3f}", sd),
        ("slope k0", f"{found.k0:.3f}",
         f"wavelengths above {first.wavelength * MICRO:.3g} µm (order {first.order})"),
        ("slope k1", f"{found.k1:.3f}",
         f"wavelengths above {rest.wavelength * MICRO:.3g} µm (order {rest.order})"),
        ("friction by RMS slope", f"{rough.RdeltaQ:.3f}", "single profiles, from pixel to pixel"),
        ("Ra, Rq", f"{rough.Ra * MICRO:.3g}, {rough.Rq * MICRO:.3g} µm", "single profiles"),
        ("height range", _height_range(found), ""),
        ("tilt", f"{degrees(found.tilt):.2f}°", _levelled(found)),
        ("pixel", pixel, "; ".join((found.picture.pixel_source, *found.picture.notes))),
        ("profiles", f"{len(found.paths)}", f"each {found.distance[-1] * MICRO:.4g} µm long"),
    ]  # fmt: skip
    if spread.paths:
        rows.append(("leaving out one profile", _between(spread.paths), ""))
    orders = ", ".join(f"{order}: {_shown(mu)}" for order, mu in spread.orders)
    rows.append(("range over baseline orders", _between([mu for _, mu in spread.orders]), orders))
    if spread.height_range:
        scalings = ", ".join(f"{how}: {_shown(mu)}" for how, mu in spread.height_range)
        rows.append(
            ("range over grey scalings", _between([mu for _, mu in spread.height_range]), scalings)
        )
    margins = ", ".join(f"{margin:g}: {_shown(mu)}" for margin, mu in spread.margins)
    rows.append(("range over end margins", _between([mu for _, mu in spread.margins]),
                 f"{margins} (in shortest waves; used: {first.margin:g})"))  # fmt: skip
    return rows


def _levelled(found: SurfaceFriction) -> str:
    """Return whether the surface was levelled, and the friction coefficient with levelling."""
    if found.levelled:
        return "the least-squares plane is subtracted"
    if found.friction_levelled is None:
        return "not levelled"
    return f"not levelled; --level gives a friction coefficient of {found.friction_levelled:.3f}"


def _between(values: list[float] | tuple[float, ...]) -> str:
    known = [value for value in values if value == value]
    return f"{min(known):.3f} to {max(known):.3f}" if known else "–"


def _shown(value: float) -> str:
    return f"{value:.3f}" if value == value else "too steep"


def _height_range(found: SurfaceFriction) -> str:
    return (
        "given by the file"
        if found.height_range is None
        else f"{found.height_range * MICRO:.4g} µm"
    )
