"""Make the test data of the examples: tests of strips and a tube of known laws, with noise.

    python examples/make_bench.py [FOLDER]

writes ``latex_tensile.csv`` (C10 0.1465 MPa), ``ureter_tensile.csv`` and ``ureter_inflation.csv``
(the catalogue's ureter), each with noise of 1 % on every point, and ``latex_series.csv``: critical
pressures of spheres in latex tubes at friction 0.475, in air and in water, with noise of 3 %.
"""

import sys
from pathlib import Path

import numpy as np

import stonepass as sp
from stonepass.bench.test_data import AXES, Tension
from stonepass.materials.catalogue import material
from stonepass.model.far_field import inflation

SEED = 2022
NOISE, SERIES_NOISE = 0.01, 0.03
FAST = sp.Numerics("fast")
# wall ratio, size ratio, confining pressure in kPa
SPHERES = (
    (1.5, 1.1, 0.0), (1.5, 1.2, 0.0), (1.5, 1.3, 0.0), (2.0, 1.1, 0.0), (2.0, 1.2, 0.0),
    (2.0, 1.3, 0.0), (1.5, 1.1, 5.4), (1.5, 1.2, 5.4), (2.0, 1.2, 5.4), (2.0, 1.3, 5.4),
)  # fmt: skip


def write(path, header, rows):
    lines = [
        header,
        *(",".join(f"{x:.6g}" if isinstance(x, float) else x for x in r) for r in rows),
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def nominal_stress(law, stretch, axis):
    strip = Tension(stretch, np.ones(len(stretch)), (axis,) * len(stretch))
    return strip.predicted(law)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent)
    generator = np.random.default_rng(SEED)

    def measured(values):
        return values * (1.0 + NOISE * generator.normal(size=len(values)))

    latex, ureter = material("latex").law, material("ureter").law
    stretch = np.linspace(1.04, 1.6, 15)
    force = measured(nominal_stress(latex, stretch, AXES[1])) * 10e-3 * 1.2e-3  # 10 mm × 1.2 mm
    write(folder / "latex_tensile.csv", "stretch,force_N", zip(stretch, force, strict=True))
    rows = []
    for axis in AXES:
        stretch = np.linspace(1.03, 1.36, 12)
        stress = measured(nominal_stress(ureter, stretch, axis)) / 1e3
        rows += [(x, y, axis) for x, y in zip(stretch, stress, strict=True)]
    write(folder / "ureter_tensile.csv", "stretch,nominal_stress_kPa,axis", rows)
    ratio = np.linspace(1.02, 1.3, 15)
    pressure = measured(inflation(ratio, 1.3, ureter)) / 1e3
    diameter = 3.5 * ratio
    write(folder / "ureter_inflation.csv", "pressure_kPa,inner_diameter_mm",
          zip(pressure, diameter, strict=True))  # fmt: skip
    series = []
    for eta, xi, confining in SPHERES:
        stone, tube = sp.Stone(size_ratio=xi, friction=0.475), sp.Ureter(None, None, "latex", eta)
        bath = sp.Load(f"{confining} kPa", "hydrostatic")
        exact = sp.critical_pressure(stone, tube, bath, numerics=FAST).pressure / 1e3
        found = exact * (1.0 + SERIES_NOISE * generator.normal())
        series.append((xi, eta, confining, found, SERIES_NOISE * exact))
    write(folder / "latex_series.csv", "xi,eta,confining_kPa,pressure_kPa,sd_kPa", series)
    print(f"written into {folder}")


if __name__ == "__main__":
    main()
