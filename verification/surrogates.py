"""The surrogates of the package against solved cases, and against a Gaussian process."""

from __future__ import annotations

import warnings

import numpy as np
from cores import on_all_cores
from page import Check, Section
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

import stonepass as sp
from stonepass.array_types import Float
from stonepass.studies.conditions import Conditions, case_at, lumen_ratios
from stonepass.studies.surrogates.box import opening_pressure
from stonepass.studies.surrogates.check import compare
from stonepass.studies.surrogates.solved import NO_SOLUTION
from stonepass.studies.surrogates.store import shipped_surrogates

# Random conditions, uniform in the coordinates: no points of the sequence that the surrogates use.
SEED, CASES = 20261, 120
LARGEST, WITHIN = 0.005, 0.98  # relative error of P_ucr; fraction within the claimed error
SMALL = 10.0  # Pa


def section() -> Section:
    rows, checks = [], []
    for material, model in shipped_surrogates():
        surrogate = sp.load_surrogate(material, model)
        asked = conditions(surrogate)
        jobs = [(case_at(surrogate.case, asked, k),) for k in range(CASES)]
        answers = on_all_cores("surrogates", solved, jobs)
        found = compare(surrogate, asked, answers)
        process = gaussian_process(surrogate, asked, answers)
        rows.append([material, model, str(found.cases), str(found.compared),
                     f"{100 * found.typical:.2f} %", f"{100 * found.largest:.2f} %",
                     f"{100 * found.within:.1f} %", f"{100 * process:.2f} %"])  # fmt: skip
        name = f"{material}, {model}"
        checks += [
            Check(f"{name}: P_ucr within {LARGEST:.1%} or 10 Pa", f"{found.largest:.2%} at worst",
                  found.largest <= LARGEST),
            Check(f"{name}: the claimed error covers {WITHIN:.0%}", f"{found.within:.1%}",
                  found.within >= WITHIN),
            Check(f"{name}: the outcome is that of the solve", f"{found.same_outcome} of {CASES}",
                  found.same_outcome >= 0.98 * CASES),
            Check(f"{name}: the error is below that of a Gaussian process of these cases",
                  f"{found.typical:.2%} and {process:.2%}", found.typical < process),
        ]  # fmt: skip
    header = ("material", "model", "cases", "compared", "root mean square", "largest",
              "within the claim", "Gaussian process, root mean square")  # fmt: skip
    text = (
        f"{CASES} random cases that each surrogate of the package covers are solved "
        "at standard accuracy. They are not those of `stonepass surrogate check`. The Gaussian "
        "process (scikit-learn, one length for each coordinate) learns ln(P_ucr/(μ P_s)) from four "
        "fifths of these cases and predicts the others, five times in turn; it is an independent "
        "method, and it shows what the solved cases alone say without the mechanics."
    )
    return Section("Surrogates", text, checks, [("Errors of P_ucr:", header, rows)])


def conditions(surrogate: sp.Surrogate) -> Conditions:
    """Return random conditions that the surrogate covers, half of them without a load."""
    rng, box, case = np.random.default_rng(SEED), surrogate.box, surrogate.case
    root, wall, friction, load = rng.uniform(size=(4, 2 * CASES))
    low, high = (edge - 1.0 for edge in box.wall_ratio)
    eta = 1.0 + low * (high / low) ** wall
    loaded = case.load.confining_pressure > 0.0
    factor = np.maximum(2.0 * load - 1.0, 0.0) * surrogate.stable(eta) if loaded else 0.0 * load
    lumen = lumen_ratios(case, eta, factor)
    size = lumen * (1.0 + np.maximum(root, 0.05) ** 2 * (box.size_ratio / lumen - 1.0))
    mu = np.maximum(friction * box.friction[1], 0.01)
    drawn = Conditions(size, eta, mu, factor)
    covered = surrogate.solve(drawn).outcome != NO_SOLUTION
    return drawn.where(covered & (np.cumsum(covered) <= CASES))


def solved(case: sp.Case) -> sp.Answer:
    return sp.solve(case, case.numerics.resolution).without_wall()


def gaussian_process(surrogate: sp.Surrogate, asked: Conditions, answers: list[sp.Answer]) -> float:
    """Return the root-mean-square relative error of P_ucr, by cross-validation in five parts."""
    true = np.array([np.nan if each.pressure is None else each.pressure for each in answers])
    known = np.isfinite(true) & (true > 0.0)
    case = surrogate.case
    lumen = lumen_ratios(case, asked.wall_ratio, asked.load_factor)
    at = surrogate.box.setting(case, asked, lumen, surrogate.stable.narrowest).where(known)
    scale = at.conditions.friction * opening_pressure(case, at)
    varying = np.ptp(at.unit, axis=0) > 0.0
    points, values = at.unit[:, varying], np.log(true[known] / scale)
    predicted = np.empty(len(values))
    for part in range(5):
        left_out = np.arange(len(values)) % 5 == part
        predicted[left_out] = predict(points[~left_out], values[~left_out], points[left_out])
    off = np.abs(np.exp(predicted - values) - 1.0)
    small = off * true[known] <= SMALL
    return float(np.sqrt(np.mean(np.where(small, 0.0, off) ** 2)))


def predict(
    points: Float[np.ndarray, "n d"], values: Float[np.ndarray, " n"],
    others: Float[np.ndarray, "m d"],
) -> Float[np.ndarray, " m"]:  # fmt: skip
    kernel = ConstantKernel(1.0) * RBF(np.ones(points.shape[1]), (0.05, 50.0)) + WhiteKernel(
        1e-6, (1e-10, 1e-2)
    )
    process = GaussianProcessRegressor(kernel, normalize_y=True, random_state=0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ConvergenceWarning)
        return process.fit(points, values).predict(others)
