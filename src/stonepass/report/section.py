"""The meridian section of a stretched wall and its stone, upstream left."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from stonepass.fe.readout import Field
from stonepass.model.case import Case
from stonepass.report.stone import draw_stone

__all__ = ["draw_section"]


def draw_section(
    axes: Axes, wall: Field, case: Case, top: float, sides: Sequence[float] = (1.0,)
) -> None:
    """Draw wall and stone, coloured by radial compression in Pa from 0 to `top`.

    `wall` is drawn once for each of `sides`: -1 mirrors a half tube at the stone's equator.
    """
    order = round(np.sqrt(wall.r.shape[1])) - 1
    shape = (order + 1, order + 1)
    compression, image = -wall.stress_rr / 1e3, None
    for side in sides:
        for half in (1.0, -1.0):  # above and below the axis
            for r, z, value in zip(wall.r, wall.z, compression, strict=True):
                x, y, c = (side * z).reshape(shape), (half * r).reshape(shape), value.reshape(shape)
                image = axes.pcolormesh(
                    x,
                    y,
                    c,
                    shading="gouraud",
                    cmap="magma_r",
                    vmin=0.0,
                    vmax=top / 1e3,
                    rasterized=True,
                )
                outline = np.r_[x[0], x[:, -1], x[-1, ::-1], x[::-1, 0]]
                outline_y = np.r_[y[0], y[:, -1], y[-1, ::-1], y[::-1, 0]]
                axes.plot(outline, outline_y, color="white", linewidth=0.25, alpha=0.6)
    draw_stone(axes, case)
    extent = 2.2 * case.size_ratio * case.stone.shape.reach + 0.6
    height = float(wall.r.max()) * 1.06
    axes.set(xlim=(-extent, extent), ylim=(-height, height), aspect="equal")
    axes.set(xlabel="z / inner radius   (urine comes from the left)", ylabel="r / inner radius")
    axes.spines[["top", "right"]].set_visible(False)
    assert image is not None
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.85, pad=0.01)
    bar.set_label(r"$-\sigma_{rr}$  (kPa)")
    bar.outline.set_visible(False)
