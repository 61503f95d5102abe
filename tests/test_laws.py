"""Properties of every law: registered ones, laws of the catalogue and of the examples.

A registered law without members here fails the first test, so that none is left out.
"""

from dataclasses import replace
from pathlib import Path

import autograd.numpy as anp
import ngsolve as ng
import numpy as np
import pytest

import stonepass as sp
from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.discretisation import discretise, free_unknowns, wall_form
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.wall import SYMBOLS
from stonepass.fe.core.newton import newton
from stonepass.fe.core.systems import FormSystem
from stonepass.inputs.material_file import load_material, write_law
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.composition import Composed, HasGroundMatrix, fibres_of
from stonepass.materials.constants import constants_of
from stonepass.materials.demiray import Demiray
from stonepass.materials.derivatives import energy_derivatives, hoop_modulus, rest_gradient
from stonepass.materials.ellipticity import weakest
from stonepass.materials.fung import Fung
from stonepass.materials.holzapfel import HolzapfelGasserOgden
from stonepass.materials.known_laws import KNOWN_LAWS, name_of_law
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.protocol import ClosedForm, Law, Material
from stonepass.materials.relaxed_energy import relaxed
from stonepass.materials.user_law import UserLaw
from stonepass.materials.yeoh import Yeoh
from stonepass.model.far_field import inflation, inflation_by_quadrature
from stonepass.model.states.nondimensional import tube_of
from stonepass.strain import INNER_WALL, CauchyGreen, Place

EXAMPLE = Path(__file__).parents[1] / "examples" / "own_law.py"

REGISTERED = {
    "neo-hookean": NeoHookean(146.5e3),
    "mooney-rivlin": MooneyRivlin(20e3, 5e3),
    "mooney-rivlin, mostly I2": MooneyRivlin(5e3, 25e3),
    "mooney-rivlin, negative": MooneyRivlin(20e3, -11e3),
    "yeoh": Yeoh(50e3, -5e3, 2e3),
    "fung": CATALOGUE["ureter"].law,
    "ogden": Ogden(6.3e5, 1.3, 0.012e5, 5.0, -0.1e5, -2.0),
    "ogden, one term": Ogden(-30e3, -4.0),
    "ogden, steep": Ogden(2e3, 9.5),
    "holzapfel-gasser-ogden": HolzapfelGasserOgden(20e3, 60e3, 2.0, np.radians(40.0)),
    "holzapfel-gasser-ogden, dispersed": HolzapfelGasserOgden(2e4, 6e4, 2.0, np.radians(50.0), 0.2),
    "demiray": Demiray(60e3, 2.0),
}


def stiffer_outside(C, place, xp):
    """Half as stiff again at R = 2 as at the lumen."""
    return 50e3 * (1.0 + 0.5 * (place.R - 1.0)) * (C.I1 - 3.0)


OTHERS = {
    "ureter-soft-cross": CATALOGUE["ureter-soft-cross"].law,
    "own_law.py": load_material(f"{EXAMPLE}:energy").law,
    "stiffer outside": UserLaw(stiffer_outside, "stiffer outside"),
    "composed": Composed(Fung(0.4e6, 0.7, 0.9, 0.2), NeoHookean(6e3)),
}
LAWS = REGISTERED | OTHERS
ENGINE_PLACE = Place(1.2, 0.5)
ISOTROPIC = ("NeoHookean", "MooneyRivlin", "Yeoh", "Ogden", "Demiray", "UserLaw")

every_law = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
every_registered_law = pytest.mark.parametrize("law", REGISTERED.values(), ids=REGISTERED)


def cauchy_green(F):
    """Components of FᵀF for deformation gradients (..., 3, 3) in the axes r, t, z."""
    C = np.swapaxes(F, -1, -2) @ F
    rows = ((0, 0), (1, 1), (2, 2), (0, 2), (0, 1), (1, 2))
    return CauchyGreen(*(C[..., i, j] for i, j in rows))


def isochoric(seed, count, size=0.15):
    """Random deformation gradients of determinant 1."""
    F = np.eye(3) + size * np.random.default_rng(seed).normal(size=(count, 3, 3))
    return F / np.cbrt(np.linalg.det(F))[:, None, None]


def rotations(seed, count):
    Q, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(count, 3, 3)))
    return Q * np.linalg.det(Q)[:, None, None]


def axisymmetric(states):
    """(F as five columns, F as matrices) from (λ_θ, λ_z, shear)."""
    hoop, axial, shear = np.array(states).T
    zero = np.zeros_like(hoop)
    columns = np.column_stack([1.0 / (hoop * axial), shear, zero, axial, hoop])
    F = np.zeros((len(hoop), 3, 3))
    F[:, 0, 0], F[:, 0, 2], F[:, 2, 2], F[:, 1, 1] = *columns[:, [0, 1, 3]].T, hoop
    return columns, F


# At rest, equibiaxial, uniaxial (repeated stretches) and two general ones.
REPEATED = [(1.0, 1.0, 0.0), (1.2, 1.2, 0.0), (1.3, 1.3**-0.5, 0.0), (1.3**-0.5, 1.3, 0.0)]
GENERAL = [(1.15, 1.05, 0.0), (1.1, 1.05, 0.1)]


def test_every_registered_law_has_members_here():
    assert {name.split(",")[0] for name in REGISTERED} == set(KNOWN_LAWS)
    for name, law in REGISTERED.items():
        assert name_of_law(law) == name.split(",")[0]
    assert len(KNOWN_LAWS) >= 7
    assert len(LAWS) >= 16


def test_every_registered_law_declares_all_its_constants():
    for law in KNOWN_LAWS.values():
        declared = constants_of(law)
        assert [each.name for each in declared] == list(law.__dataclass_fields__)
        for each in declared:
            assert each.meaning
            assert each.symbol
            assert each.name in law.__doc__


def test_a_constant_of_one_name_has_one_unit():
    units = {}
    for law in KNOWN_LAWS.values():
        for each in constants_of(law):
            assert units.setdefault(each.name, each.unit) == each.unit


@every_registered_law
def test_bounds_of_constants_are_enforced(law):
    tried = 0
    for each in constants_of(law):
        below = np.nextafter(each.low, -np.inf) if each.low_allowed else each.low
        above = np.nextafter(each.high, np.inf) if each.high_allowed else each.high
        for bad in (below, above, np.nan, np.inf, -np.inf):
            with pytest.raises(sp.BadInput, match=rf"{each.name} is .*, but must be"):
                replace(law, **{each.name: bad})
            tried += 1
    assert tried >= 5


@every_law
def test_a_law_is_a_value_and_a_law(law):
    assert isinstance(law, Law)
    assert hash(law) == hash(replace(law))
    assert law == replace(law)


def written_and_read(law, path):
    write_law(Material("mine", law, "a source", "a test", "v", (1.0, 1.4)), path)
    return load_material(str(path))


def test_law_files_give_a_composed_law_back(tmp_path):
    inner = Composed(NeoHookean(5e3), MooneyRivlin(1e3, 2e3))
    law = Composed(Fung(0.4e6, 0.7, 0.9, 0.2), inner)
    assert written_and_read(law, tmp_path / "law.toml").law == law


COMPOSED_FILE = """
law = "composed"
source = "two parts"
strain_range = [1.0, 1.3]
[fibres]
law = "fung"
C = "0.4 MPa"
a1111 = 0.7
a2222 = 0.9
a1122 = 0.2
[matrix]
law = "neo-hookean"
C10 = "6 kPa"
"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            'C10 = "6 kPa"',
            'G = "6 kPa"',
            r"'matrix.G' is given, but must be left out for law 'neo",
        ),
        ("[matrix]", "[matrx]", "did you mean 'matrix'"),
        ("a1111 = 0.7", 'a1111 = "x"', "'fibres.a1111' is x, but must be a number"),
        ("a2222 = 0.9", "", "'fibres.a2222' is missing, but must be given for law 'fung'"),
        ('law = "fung"', 'law = "fang"', "'fibres.law' is fang, .* did you mean 'fung'"),
        ("a2222", "a2233", r"key of \[fibres\] is a2233, .* did you mean 'a2222'"),
        ('"6 kPa"', '"6"', "'matrix.C10' is 6, but must be a pressure with its unit"),
        ('"6 kPa"', '"-6 kPa"', "'matrix.C10' is -6000.0, but must be a positive modulus"),
        ('law = "composed"', 'law = "yeoh"', "'fibres' is given, but must be left out for law 'ye"),
        (
            '"neo-hookean"',
            '"composed"',
            "'matrix.C10' is given, but must be left out for law 'com",
        ),
        (
            '[matrix]\nlaw = "neo-hookean"\nC10 = "6 kPa"\n',
            "",
            "'matrix' is missing, but must be a",
        ),
    ],
)
def test_a_wrong_part_of_a_composed_law_is_named(old, new, message, tmp_path):
    path = tmp_path / "law.toml"
    path.write_text(COMPOSED_FILE)
    assert load_material(str(path)).law == LAWS["composed"]
    assert old in COMPOSED_FILE
    path.write_text(COMPOSED_FILE.replace(old, new))
    with pytest.raises(BadInput, match=message):
        load_material(str(path))


def test_a_law_is_composed_in_a_few_levels_only(tmp_path):
    law = NeoHookean(5e3)
    for _ in range(5):
        law = Composed(NeoHookean(1e3), law)
    path = tmp_path / "law.toml"
    assert written_and_read(law, path).law == law
    with pytest.raises(BadInput, match="composed in 5 levels at most"):
        written_and_read(Composed(NeoHookean(1e3), law), tmp_path / "deep.toml")
    assert not (tmp_path / "deep.toml").exists()
    part = 'law = "neo-hookean"\nC10 = "5 kPa"\n'
    table = ".".join(["matrix"] * 5)
    deeper = f'law = "composed"\n[{table}.fibres]\n{part}[{table}.matrix]\n{part}'
    path.write_text(path.read_text().replace(part, deeper))
    with pytest.raises(
        BadInput, match=r"'matrix.matrix.matrix.matrix.matrix.fibres' is given, but"
    ):
        load_material(str(path))


def test_a_composed_law_is_shown_with_its_parts(tmp_path, capsys):
    path = tmp_path / "law.toml"
    path.write_text(COMPOSED_FILE)
    assert run(["material", "show", str(path)]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    for part in ("fibres.law Fung", "fibres.C 0.4 MPa", "matrix.law NeoHookean", "matrix.C10 "):
        assert part in shown


@every_registered_law
def test_law_files_give_the_law_back(law, tmp_path):
    back = written_and_read(law, tmp_path / "law.toml")
    for each in constants_of(law):
        assert getattr(back.law, each.name) == pytest.approx(getattr(law, each.name), rel=1e-11)
    assert type(back.law) is type(law)


@every_law
def test_rest_is_free_of_energy_and_stress(law):
    assert law.energy(CauchyGreen(1.0, 1.0, 1.0), INNER_WALL, np) == pytest.approx(0.0, abs=1e-9)
    gradient = rest_gradient(law)
    np.testing.assert_allclose(gradient[:3], gradient[0], rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(gradient[3:], 0.0, atol=1e-9)


@every_law
def test_isotropic_laws_do_not_see_rotations_of_the_reference(law):
    F = isochoric(1, 20)
    turned = F @ rotations(2, 20)
    one, other = (law.energy(cauchy_green(each), INNER_WALL, np) for each in (F, turned))
    if type(law).__name__ in ISOTROPIC:
        np.testing.assert_allclose(other, one, rtol=1e-9, atol=1e-6)
    else:
        assert np.abs(other - one).max() > 1e-3 * np.abs(one).max()


@every_law
def test_mirror_images_along_and_around_the_tube_have_the_same_energy(law):
    """The wall is orthotropic: (t, z) → (−t, z) and (t, −z) change signs of shears only."""
    C = cauchy_green(isochoric(3, 20))
    energy = law.energy(C, INNER_WALL, np)
    for mirrored in (C._replace(rt=-C.rt, tz=-C.tz), C._replace(rz=-C.rz, tz=-C.tz)):
        np.testing.assert_allclose(law.energy(mirrored, INNER_WALL, np), energy, rtol=1e-12)


@every_law
def test_derivatives_are_those_of_finite_differences(law):
    """Slopes and second derivatives, in general and where principal stretches are equal."""
    _, F = axisymmetric([*REPEATED, *GENERAL])
    C = cauchy_green(np.concatenate([F, isochoric(4, 6)]))
    slopes, curvature = energy_derivatives(law, C, INNER_WALL)
    assert np.isfinite(slopes).all()
    assert np.isfinite(curvature).all()
    step, scale = 1e-5, np.abs(curvature).max()
    smooth = ~at_the_edge_of_tension(law, C)
    assert smooth.sum() >= 9
    for i, name in enumerate(CauchyGreen._fields):
        moved = [C._replace(**{name: getattr(C, name) + way}) for way in (step, -step)]
        above, below = (law.energy(each, INNER_WALL, np) for each in moved)
        found = ((above - below) / (2 * step))[smooth]
        np.testing.assert_allclose(slopes[smooth, i], found, rtol=1e-6, atol=1e-7 * scale)
        above, below = (energy_derivatives(law, each, INNER_WALL)[0] for each in moved)
        found = ((above - below) / (2 * step))[smooth]
        np.testing.assert_allclose(curvature[smooth, i], found, rtol=1e-5, atol=1e-6 * scale)


def at_the_edge_of_tension(law, C):
    """Whether fibres that bear tension only are just taut: no second derivative there."""
    if not isinstance(law, HolzapfelGasserOgden):
        return np.zeros(len(C.rr), dtype=bool)
    c, s = np.cos(law.angle), np.sin(law.angle)
    along = c * c * C.tt + s * s * C.zz + 2.0 * np.array([[1.0], [-1.0]]) * c * s * C.tz - 1.0
    E = law.kappa * (C.I1 - 3.0) + (1.0 - 3.0 * law.kappa) * along
    return (np.abs(E) < 1e-3).any(axis=0)


@every_law
def test_the_engine_evaluates_the_law_as_numpy_does(law):
    """Energy, slopes and second derivatives by symbols, also where stretches are equal."""
    _, F = axisymmetric([*REPEATED, *GENERAL])
    C = cauchy_green(F)
    slopes, curvature = energy_derivatives(law, C, ENGINE_PLACE)
    energies = law.energy(CauchyGreen(*C[:4]), ENGINE_PLACE, np)
    smooth = ~at_the_edge_of_tension(law, C)
    wall = some_wall()
    at = wall.mesh(*ENGINE_PLACE)
    for k in range(len(F)):
        c = CauchyGreen(*(ng.Parameter(float(each[k])) for each in C[:4]))
        U = ng.CF(law.energy(c, Place(ng.x, ng.y), SYMBOLS))
        assert U(at) == pytest.approx(energies[k], rel=1e-12, abs=1e-8)
        scale = np.abs(curvature[k]).max()
        for i in range(4):
            first = U.Diff(c[i])
            assert first(at) == pytest.approx(slopes[k, i], rel=1e-10, abs=1e-10 * scale)
            for j in range(4) if smooth[k] else ():
                second = first.Diff(c[j])(at)
                assert second == pytest.approx(curvature[k, i, j], rel=1e-8, abs=1e-9 * scale)


def some_wall():
    return discretise(
        Tube(lambda C, place, xp: C.I1, 1.5, 1.0),
        Arc.at(Profile(1.0)),
        Layout(np.array([1.0, 1.5]), np.array([0.0, 1.0]), 1),
        2,
    )


@every_law
def test_the_far_field_by_quadrature_is_the_closed_form(law):
    if not isinstance(law, ClosedForm):
        pytest.skip("the law has no closed form")
    ratio = np.array([0.9, 1.0, 1.1, 1.4])
    np.testing.assert_allclose(
        law.inflation_pressure(ratio, 1.6),
        inflation_by_quadrature(ratio, 1.6, law),
        rtol=1e-11,
        atol=1e-9,
    )


@every_law
def test_the_weakest_shear_band_against_a_scan_of_space(law):
    """Second differences of U((1 + ε m⊗n) F) over random unit vectors m ⊥ n: none is below."""
    columns, F = axisymmetric([*GENERAL, (1.3, 1.0, 0.0), (1.3, 1.3**-0.5, 0.0)])
    generator, step, shear = np.random.default_rng(5), 1e-4, rest_shear(law)
    n = generator.normal(size=(4000, 3))
    n /= np.linalg.norm(n, axis=1)[:, None]
    m = np.cross(n, generator.normal(size=(4000, 3)))
    m /= np.linalg.norm(m, axis=1)[:, None]
    band = m[:, :, None] * n[:, None, :]

    def energy(e, at):
        return law.energy(cauchy_green((np.eye(3) + e * band) @ at), INNER_WALL, np)

    checked = 0
    for k in range(len(F)):
        if at_the_edge_of_tension(law, cauchy_green(F[k : k + 1])).any():
            continue
        second = (energy(step, F[k]) - 2.0 * energy(0.0, F[k]) + energy(-step, F[k])) / step**2
        found = weakest(law, columns[k : k + 1], INNER_WALL).stiffness * shear
        scale = np.abs(second).max()
        assert second.min() >= found - 1e-5 * scale
        assert second.min() <= found + 0.02 * scale
        checked += 1
    assert checked >= 2


def rest_shear(law):
    """r–z shear modulus at rest, which is the unit of the margin."""
    g = 1e-3
    C = CauchyGreen(1.0, 1.0, np.array([1.0, 1.0 + g * g]), np.array([0.0, g]))
    energy = law.energy(C, INNER_WALL, np)
    return 2.0 * (energy[1] - energy[0]) / g**2


@every_law
def test_finite_elements_of_an_inflated_tube_converge(law):
    """The lumen of a uniform tube under pressure against the far field, on two meshes."""
    ratio, eta = 1.15, 1.6
    pressure = float(inflation(np.array(ratio), eta, law))
    tube = tube_of(law, eta, sp.Load(), 1.0)
    tube = replace(tube, outside_pressure=-pressure / hoop_modulus(law), hydrostatic=True)
    errors = [abs(lumen_by_elements(tube, ratio, rows) - ratio) for rows in (1, 2)]
    assert errors[0] < 1e-3
    # Quadratic elements: the displacement converges with the third power at least.
    assert errors[1] < errors[0] / 6.0 or errors[1] < 1e-10


def lumen_by_elements(tube, guess, rows):
    layout = Layout(np.linspace(1.0, tube.wall_ratio, rows + 1), np.array([0.0, 0.5]), 1)
    wall = discretise(tube, Arc.at(Profile(guess)), layout, 2)
    u = wall.fields.u
    u.Set(ng.sqrt(ng.x * ng.x - 1.0 + guess * guess) - ng.x)
    free = free_unknowns(wall, "")
    assert newton(FormSystem(wall_form(wall), wall.state, free), 1e-12).converged
    return 1.0 + float(u(wall.mesh(1.0 + 1e-12, 0.2)))


@every_law
def test_relaxing_and_leaving_out_the_matrix_keep_what_they_do_not_mean(law):
    """Only composed laws have a fibre part, and a stretched wall is not relaxed."""
    if not isinstance(law, HasGroundMatrix):
        assert fibres_of(law) is law
    C = CauchyGreen(1.0 / 1.2**2, 1.2**2, 1.1)
    assert relaxed(law).energy(C, INNER_WALL, anp) == pytest.approx(law.energy(C, INNER_WALL, anp))


def test_a_fung_wall_is_fibres_in_a_matrix():
    law, C = CATALOGUE["ureter"].law, cauchy_green(isochoric(6, 8))
    parts = Composed(law.fibres, NeoHookean(law.G / 2.0))
    np.testing.assert_array_equal(parts.energy(C, INNER_WALL, np), law.energy(C, INNER_WALL, np))
    assert fibres_of(law) == replace(law, G=0.0)
    assert fibres_of(relaxed(law)) == replace(law, G=0.0)
    assert fibres_of(parts) == law.fibres
