"""The file for FEBio 4: its mesh, its law, its motions, and every word one that FEBio reads."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest
from options import asking
from pyfebio import (
    boundary,
    contact,
    control,
    loaddata,
    loads,
    material,
    mesh,
    meshdata,
    meshdomains,
    output,
)

import stonepass as sp
from stonepass.errors import BadInput
from stonepass.export.feb import CONTACT_FILE, INNER_FILE, write_feb
from stonepass.export.feb_material import VANISHING, fung_constants
from stonepass.export.seating import bulk_modulus, seating
from stonepass.export.wedge import WEDGE
from stonepass.materials.fung import Fung
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.protocol import Material
from stonepass.materials.user_law import UserLaw
from stonepass.materials.yeoh import Yeoh
from stonepass.model.shape import Shape
from stonepass.strain import INNER_WALL, CauchyGreen

XI, ETA = 1.2, 1.3
EGG = Shape(1.3, (1.01, 0.12, 0.01, 0.04))
LAWS = {
    "neo-hookean": NeoHookean(2e5),
    "mooney-rivlin": MooneyRivlin(2e5, -5e4),
    "yeoh": Yeoh(2e5, 3e4, 1e3),
    "fung": Fung(4e5, 0.7, 0.9, 0.2, 1.2e4),
}


def made_of(law):
    return Material("named", law, "a test", "none", "no", (1.0, 1.3))


def case(load=None, shape=None, material="ureter", friction=0.3, **method):
    stone = sp.Stone(size_ratio=XI, friction=friction, shape=shape)
    ureter = sp.Ureter(inner_diameter="3 mm", wall_ratio=ETA, material=material)
    return sp.Case(stone, ureter, load or sp.Load(), **asking(**method))


CASES = {
    "plain": case(friction=0.0),
    "bath": case(sp.Load("2 kPa", "hydrostatic", 1.1), material="latex"),
    "dead": case(sp.Load("2 kPa"), seating="growing"),
    "whole": case(sp.Load("1 kPa", "dead", 1.1), shape=EGG),
}


class Deck:
    """The file, read again."""

    def __init__(self, name):
        self.seating = seating(CASES[name], 0.2)
        self.text = write_feb(self.seating)
        self.root = ET.fromstring(self.text)
        nodes = self.root.findall("Mesh/Nodes/node")
        self.ids = [int(node.get("id")) for node in nodes]
        self.points = np.array([numbers(node) for node in nodes])
        self.angle = np.arctan2(self.points[:, 1], self.points[:, 0])

    def elements(self, name):
        return rows(self.root.find(f"Mesh/Elements[@name='{name}']"))

    def surface(self, name):
        return rows(self.root.find(f"Mesh/Surface[@name='{name}']"))

    def node_set(self, name):
        return rows([self.root.find(f"Mesh/NodeSet[@name='{name}']")])[0]

    def named(self, tag):
        return {each.get("name") for each in self.root.iter(tag)}


def numbers(element):
    return [float(value) for value in element.text.split(",")]


def rows(elements):
    """Node numbers from 0."""
    return np.array([numbers(each) for each in elements]).astype(int) - 1


@pytest.fixture(scope="module", params=list(CASES))
def deck(request):
    return Deck(request.param)


# What FEBio 4 reads: element -> (attributes, elements inside). The files are of its sources.
FORMAT = {
    # FEBioXML/FEBioImport.cpp
    "febio_spec": (
        "version",
        "Module Material Mesh MeshDomains MeshData Boundary Loads Contact Step LoadData Output",
    ),
    "Module:solid": ("type", ""),
    # FEBioXML/FEBioMaterialSection.cpp, FEBioMech/FEMooneyRivlin.cpp, FEYeoh.cpp,
    # FEFungOrthotropic.cpp, FEUncoupledElasticMixture.cpp, FEUncoupledMaterial.cpp, FENeoHookean.cpp
    "Material": ("", "material"),
    "material:Mooney-Rivlin": ("id name type", "c1 c2 k"),
    "material:Yeoh": ("id name type", "c1 c2 c3 k"),
    "material:Fung orthotropic": (
        "id name type",
        "E1 E2 E3 G12 G23 G31 v12 v23 v31 c k mat_axis",
    ),
    "material:uncoupled solid mixture": ("id name type", "k solid"),
    "solid:Fung orthotropic": ("type", "E1 E2 E3 G12 G23 G31 v12 v23 v31 c mat_axis"),
    "solid:Mooney-Rivlin": ("type", "c1 c2"),
    "material:neo-Hookean": ("id name type", "E v"),
    "mat_axis:cylindrical": ("type", "center axis vector"),  # FECore/FEMat3dValuator.cpp
    # FEBioXML/FEBioMeshSection4.cpp
    "Mesh": ("", "Nodes Elements NodeSet Surface SurfacePair"),
    "Nodes": ("name", "node"),
    "Nodes/node": ("id", ""),
    "Elements:hex20": ("type name", "elem"),
    "elem": ("id", ""),
    "NodeSet": ("name", ""),
    "Surface": ("name", "quad8"),
    "quad8": ("id", ""),
    "SurfacePair": ("name", "primary secondary"),
    # FEBioXML/FEBioMeshDomainsSection4.cpp, FEBioMeshDataSection4.cpp
    "MeshDomains": ("", "SolidDomain"),
    "SolidDomain": ("name mat", ""),
    "MeshData": ("", "NodeData"),
    "NodeData": ("name node_set data_type", "node"),
    "NodeData/node": ("lid", ""),
    # FEBioXML/FEBioBoundarySection3.cpp, FEBioMech/FEPrescribedDisplacement.cpp
    "Boundary": ("", "bc"),
    "bc:zero displacement": ("type node_set", "x_dof y_dof z_dof"),
    "bc:prescribed displacement": ("type node_set", "dof value relative"),
    "bc:linear constraint": ("type", "node dof child_dof"),
    "child_dof": ("", "node dof value"),
    "value": ("lc", ""),
    "value:map": ("lc type", ""),
    # FEBioXML/FEBioLoadsSection3.cpp, FEBioMech/FEPressureLoad.cpp
    "Loads": ("", "surface_load"),
    "surface_load:pressure": ("type surface", "pressure symmetric_stiffness linear"),
    "pressure": ("lc", ""),
    # FEBioXML/FEBioContactSection.cpp, FEBioMech/FESlidingElasticInterface.cpp
    "Contact": ("", "contact"),
    "contact:sliding-elastic": (
        "type surface_pair",
        "laugon penalty auto_penalty two_pass symmetric_stiffness search_radius fric_coeff",
    ),
    # FEBioXML/FEBioStepSection4.cpp, FECore/FEAnalysis.cpp, FETimeStepController.cpp,
    # FESolver.cpp, FENewtonSolver.cpp, FEBioMech/FESolidSolver2.cpp
    "Step": ("", "step"),
    "step": ("id name", "Control"),
    "Control": ("", "analysis time_steps step_size time_stepper solver"),
    "time_stepper:default": ("type", "max_retries opt_iter dtmin dtmax aggressiveness"),
    "solver:solid": ("type", "symmetric_stiffness max_refs dtol etol min_residual qn_method"),
    "qn_method:BFGS": ("type", "max_ups"),
    # FEBioXML/FEBioLoadDataSection3.cpp, FECore/FELoadCurve.cpp
    "LoadData": ("", "load_controller"),
    "load_controller:loadcurve": ("id type", "interpolate extend points"),
    "points": ("", "pt"),
    # FEBioXML/FEBioOutputSection.cpp; names of data: FEBioMech/FEBioMechModule.cpp
    "Output": ("", "logfile plotfile"),
    "logfile": ("", "node_data face_data"),
    "node_data": ("data node_set file delim", ""),
    "face_data": ("data surface file delim", ""),
    "plotfile:febio": ("type", "var"),
    **{
        f"var:{name}": ("type", "")
        for name in ("displacement", "stress", "contact pressure", "contact gap")
    },
}


def unknown_words(element, parent=""):
    """Names that `FORMAT` lacks, below and in an element; and how many it looked at."""
    kind = f"{element.tag}:{element.get('type')}" if element.get("type") else element.tag
    kind = f"{parent}/{kind}" if f"{parent}/{kind}" in FORMAT else kind
    attributes, inside = (words.split() for words in FORMAT.get(kind, ("", "")))
    found = [f"{kind}@{name}" for name in element.keys() if name not in attributes]  # noqa: SIM118
    found += [f"{kind}/{child.tag}" for child in element if child.tag not in inside]
    seen = 1
    for child in element:
        more, count = unknown_words(child, element.tag)
        found, seen = found + more, seen + count
    return found, seen


def test_every_word_is_one_that_febio_reads(deck):
    found, seen = unknown_words(deck.root)
    assert not found
    assert seen > 1000


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_every_word_of_a_law_is_one_that_febio_reads(law):
    text = write_feb(seating(case(material=made_of(law)), 0.3))
    assert unknown_words(ET.fromstring(text))[0] == []


def test_an_unknown_word_is_found():
    assert unknown_words(ET.fromstring('<Mesh><Part x="1"/></Mesh>'))[0] == ["Mesh/Part", "Part@x"]


def test_the_file_says_what_it_is_and_is_the_same_each_time(deck):
    assert deck.text.startswith('<?xml version="1.0" encoding="ISO-8859-1"?>\n<febio_spec')
    for words in ("Research use only. Not a medical device.", "mm, mN, kPa", sp.__version__):
        assert words in deck.text
    assert deck.text.isascii()
    assert deck.text == write_feb(deck.seating)


def test_everything_referred_to_is_there(deck):
    count = len(deck.ids)
    assert deck.ids == list(range(1, count + 1))
    used = [deck.elements(name) for name in ("wall", "stone")]
    used += [deck.surface(name) for name in deck.named("Surface")]
    used += [deck.node_set(name)[None] for name in deck.named("NodeSet")]
    for nodes in used:
        assert nodes.min() >= 0
        assert nodes.max() < count
    assert np.unique(np.concatenate([each.ravel() for each in used[:2]])).size == count
    elements = [int(each.get("id")) for each in deck.root.iter("elem")]
    assert elements == list(range(1, len(elements) + 1))
    names = {
        "node_set": deck.named("NodeSet"),
        "surface": deck.named("Surface"),
        "surface_pair": deck.named("SurfacePair"),
        "mat": deck.named("material"),
        "lc": {each.get("id") for each in deck.root.iter("load_controller")},
    }
    seen = 0
    for element in deck.root.iter():
        for attribute, known in names.items():
            if element.get(attribute) is not None:
                assert element.get(attribute) in known
                seen += 1
    assert seen >= 9
    used_curves = {each.get("lc") for each in deck.root.iter() if each.get("lc") is not None}
    assert used_curves == names["lc"]  # FEBio warns of a curve that nothing refers to
    assert {each.get("name") for each in deck.root.iter("SolidDomain")} == deck.named("Elements")
    maps = {each.text for each in deck.root.iter("value") if each.get("type") == "map"}
    assert maps == deck.named("NodeData") == {f"travel_{dof}" for dof in "xyz"}
    for tag in ("primary", "secondary"):
        assert deck.root.find(f"Mesh/SurfacePair/{tag}").text in deck.named("Surface")


# FEBio's hex20 (FECore/FESolidElementShape.cpp): corners, then the middles of the edges along r and
# s at t = −1, the same at t = 1, then of those along t.
CORNERS = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
EDGES = np.array([[0, -1], [1, 0], [0, 1], [-1, 0]])
HEX20 = np.array(
    [(*a, t) for t in (-1, 1) for a in CORNERS]
    + [(*a, t) for t in (-1, 1) for a in EDGES]
    + [(*a, 0) for a in CORNERS],
    dtype=float,
)
QUAD8 = np.vstack([CORNERS, EDGES]).astype(float)
GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(3)


def serendipity(nodes, at):
    """Shape functions of 8 or 20 nodes: ∏ (1 + ξ ξ_a), or 1 − ξ² where ξ_a = 0."""
    factors = np.where(nodes == 0.0, 1.0 - at**2, 1.0 + nodes * at)
    values = factors.prod(axis=1) / 2.0 ** np.abs(nodes).sum(axis=1)
    corner = np.abs(nodes).sum(axis=1) == nodes.shape[1]
    values[corner] *= (nodes[corner] @ at) - nodes.shape[1] + 1.0
    return values


def slopes(nodes, at, step=1e-4):
    """Exact to rounding: no shape function has more than three powers of one coordinate."""
    columns = []
    for unit in np.eye(nodes.shape[1]):
        two, four = (
            (serendipity(nodes, at + h * unit) - serendipity(nodes, at - h * unit)) / (2.0 * h)
            for h in (step, 2.0 * step)
        )
        columns.append((4.0 * two - four) / 3.0)
    return np.column_stack(columns)


def test_the_shape_functions_of_these_tests_are_right():
    for nodes in (HEX20, QUAD8):
        values = np.array([serendipity(nodes, at) for at in nodes])
        np.testing.assert_allclose(values, np.eye(len(nodes)), atol=1e-14)


def test_elements_are_turned_right_side_out_and_fill_the_wedge(deck):
    for name, elements in (("wall", deck.elements("wall")), ("stone", deck.elements("stone"))):
        x = deck.points[elements]
        for at in HEX20[:8]:
            jacobian = np.linalg.det(np.einsum("eai,aj->eij", x, slopes(HEX20, at)))
            assert jacobian.min() > 0.0
        volume = 0.0
        for i, r in enumerate(GAUSS):
            for j, s in enumerate(GAUSS):
                for k, t in enumerate(GAUSS):
                    gradient = np.einsum("eai,aj->eij", x, slopes(HEX20, np.array([r, s, t])))
                    weight = WEIGHTS[i] * WEIGHTS[j] * WEIGHTS[k]
                    volume += weight * np.linalg.det(gradient).sum()
        if name == "wall":
            s = deck.seating
            length = s.wall.points[:, 1].max() - s.wall.points[:, 1].min()
            exact = WEDGE / 2.0 * (ETA**2 - 1.0) * length * 1.5**3
            assert volume == pytest.approx(exact, rel=1e-7)


def test_nodes_lie_on_the_sides_and_halfway_on_the_circle(deck):
    for elements in (deck.elements("wall"), deck.elements("stone")):
        angle = deck.angle[elements]
        radius = np.hypot(deck.points[elements, 0], deck.points[elements, 1])
        bottom = [*range(4), *range(8, 12)]
        top = [*range(4, 8), *range(12, 16)]
        np.testing.assert_allclose(angle[:, bottom], WEDGE, atol=1e-9)
        assert not angle[:, top].any()
        np.testing.assert_allclose(angle[:, 16:], WEDGE / 2.0, atol=1e-9)
        np.testing.assert_allclose(radius[:, bottom], radius[:, top], rtol=1e-10)
        np.testing.assert_allclose(radius[:, 16:], radius[:, :4], rtol=1e-10)


@pytest.mark.parametrize(("name", "sign"), [("lumen", -1), ("outside", 1), ("facing", 1)])
def test_faces_look_away_from_their_bodies(deck, name, sign):
    x = deck.points[deck.surface(name)]
    tangents = np.einsum("eai,aj->eij", x, slopes(QUAD8, np.zeros(2)))
    normal = np.cross(tangents[..., 0], tangents[..., 1])
    middle = x[:, :4].mean(axis=1)
    assert (sign * np.einsum("ei,ei->e", normal[:, :2], middle[:, :2])).min() > 0.0
    for at in QUAD8:  # every one the right node, or the normal would turn over somewhere
        tangents = np.einsum("eai,aj->eij", x, slopes(QUAD8, at))
        assert np.einsum("ei,ei->e", np.cross(tangents[..., 0], tangents[..., 1]), normal).min() > 0


def test_the_faces_that_touch_are_the_right_ones(deck):
    s = deck.seating
    assert len(deck.surface("lumen")) == s.facing.stop - s.facing.start
    assert len(deck.surface("outside")) == s.wall.columns
    assert len(deck.surface("facing")) == s.element_strip.columns
    radius = np.hypot(deck.points[:, 0], deck.points[:, 1])
    np.testing.assert_allclose(radius[deck.surface("lumen")], 1.5, rtol=1e-9)
    np.testing.assert_allclose(radius[deck.surface("outside")], 1.5 * ETA, rtol=1e-9)
    facing = deck.points[deck.surface("lumen")][..., 2]
    lines = s.wall.points[s.wall.row_line(0)[::2], 1] * 1.5
    ends = lines[s.facing.start], lines[s.facing.stop]
    assert (facing.min(), facing.max()) == pytest.approx(ends)


def travel(deck):
    tables = [deck.root.find(f"MeshData/NodeData[@name='travel_{dof}']") for dof in "xyz"]
    strip = deck.node_set("strip")
    for table in tables:
        assert [int(row.get("lid")) for row in table] == list(range(1, len(strip) + 1))
    return strip, np.array([[float(row.text) for row in table] for table in tables]).T


def test_the_strip_ends_on_the_stone(deck):
    strip, way = travel(deck)
    end = deck.points.copy()
    end[strip] += way
    s = deck.seating
    facing = np.unique(deck.surface("facing"))
    np.testing.assert_allclose(np.arctan2(end[strip, 1], end[strip, 0]), deck.angle[strip], 1e-9)
    rho, z = np.hypot(end[facing, 0], end[facing, 1]) / (1.5 * XI), end[facing, 2] / (1.5 * XI)
    tau = np.linspace(0.0, np.pi, 20001)
    exact_rho, exact_z = s.case.stone.shape.meridian(tau)
    np.testing.assert_allclose(rho, np.interp(z, exact_z, exact_rho), atol=1e-6)
    assert np.linalg.norm(way, axis=1).max() == pytest.approx(1.5 * s.length)


def test_each_node_is_held_once_in_each_direction(deck):
    """And the turned side can only slide in itself."""
    held = {dof: [] for dof in "xyz"}
    for bc in deck.root.iterfind("Boundary/bc"):
        kind = bc.get("type")
        if kind == "zero displacement":
            for dof in "xyz":
                if bc.find(f"{dof}_dof").text == "1":
                    held[dof].append(deck.node_set(bc.get("node_set")))
        elif kind == "prescribed displacement":
            held[bc.find("dof").text].append(deck.node_set(bc.get("node_set")))
        else:
            assert kind == "linear constraint"
            assert (bc.find("dof").text, bc.find("child_dof/dof").text) == ("y", "x")
            assert bc.find("node").text == bc.find("child_dof/node").text
            assert float(bc.find("child_dof/value").text) == pytest.approx(np.tan(WEDGE))
            held["y"].append(rows([bc.find("node")])[0])
    wall = np.unique(deck.elements("wall"))
    strip = deck.node_set("strip")
    for dof, nodes in held.items():
        together = np.concatenate(nodes)
        assert len(together) == len(np.unique(together)), dof
        assert np.isin(strip, together).all()
    sides = wall[np.isin(np.round(deck.angle[wall], 8), np.round([0.0, WEDGE], 8))]
    y = np.concatenate(held["y"])
    np.testing.assert_array_equal(np.sort(y[np.isin(y, wall)]), np.sort(sides))
    assert not np.isin(np.concatenate(held["x"]), wall).any()
    ends = np.isin(deck.points[wall, 2], [deck.points[wall, 2].min(), deck.points[wall, 2].max()])
    z = np.concatenate(held["z"])
    np.testing.assert_array_equal(np.sort(z[np.isin(z, wall)]), wall[ends])


@pytest.mark.parametrize(
    ("name", "ways"), [("plain", (0, 0)), ("bath", (0, 1.5)), ("whole", (-1.5, 1.5))]
)
def test_ends_are_pulled_to_the_prestretch(name, ways):
    """(1.1 − 1) × 10 R_a × 1.5 mm."""
    deck = Deck(name)
    for node_set, way in zip(("first", "last"), ways, strict=True):
        (bc,) = (
            each for each in deck.root.iterfind("Boundary/bc") if each.get("node_set") == node_set
        )
        if way == 0:
            assert bc.get("type") == "zero displacement"
        else:
            assert float(bc.find("value").text) == pytest.approx(way)
            assert deck.points[deck.node_set(node_set), 2] == pytest.approx(10.0 * way)


def curve(deck, number):
    points = deck.root.findall(f"LoadData/load_controller[@id='{number}']/points/pt")
    return [tuple(numbers(point)) for point in points]


def test_steps_take_a_time_of_one_each_and_the_curves_go_on(deck):
    for each in deck.root.iterfind("Step/step/Control"):
        whole = float(each.find("time_steps").text) * float(each.find("step_size").text)
        assert whole == pytest.approx(1.0)
        stepper = each.find("time_stepper")
        dtmin, dtmax = (float(stepper.find(name).text) for name in ("dtmin", "dtmax"))
        assert dtmin < float(each.find("step_size").text) <= dtmax
    share = pytest.approx(deck.seating.first_fraction)
    assert curve(deck, 1) == [(0.0, 0.0), (1.0, share), (2.0, 1.0)]
    loading = [(0.0, 0.0), (1.0, 1.0), (2.0, 1.0)]
    assert curve(deck, 2) == (loading if deck.seating.loaded else [])
    strip = [bc for bc in deck.root.iterfind("Boundary/bc") if bc.get("node_set") == "strip"]
    assert {bc.find("value").get("lc") for bc in strip} == {"1"}


def forces_on_lines(deck, pressure):
    """Radial nodal forces of FEBio's pressure load, H_a p N J summed over each r, z."""
    faces = deck.surface("outside")
    x = deck.points[faces]
    radial = np.zeros(len(deck.points))
    for i, r in enumerate(GAUSS):
        for j, s in enumerate(GAUSS):
            at = np.array([r, s])
            tangents = np.einsum("eai,aj->eij", x, slopes(QUAD8, at))
            normal = np.cross(tangents[..., 0], tangents[..., 1])
            force = -pressure * np.einsum("a,ei->eai", serendipity(QUAD8, at), normal)
            along = np.stack([np.cos(deck.angle[faces]), np.sin(deck.angle[faces])], axis=-1)
            part = WEIGHTS[i] * WEIGHTS[j] * np.einsum("eai,eai->ea", force[..., :2], along)
            np.add.at(radial, faces, part)
    places, index = np.unique(np.round(deck.points[:, 2], 9), return_inverse=True)
    total = np.bincount(index, radial)
    return total[np.isin(places, np.round(deck.points[np.unique(faces), 2], 9))]


@pytest.mark.parametrize("name", ["dead", "whole"])
def test_a_dead_pressure_gives_the_dead_forces(name):
    """The first area and normal of the wedge: its share of the whole turn, on every line.

    In all to the fourth power of the angle. On a line to φ²/6, 2e-4, since between two nodes on a
    circle without one halfway a field goes straight.
    """
    deck = Deck(name)
    load = deck.root.find("Loads/surface_load")
    assert load.find("linear").text == "1"
    found = forces_on_lines(deck, float(load.find("pressure").text))
    exact = -deck.seating.dead_forces() / 1e3 * 1.5**2 * WEDGE / (2.0 * np.pi)
    np.testing.assert_allclose(found, exact, rtol=WEDGE**2 / 5.0)
    assert found.sum() == pytest.approx(exact.sum(), rel=1e-7)


def test_a_bath_follows_the_wall_and_no_pressure_is_no_load():
    load = Deck("bath").root.find("Loads/surface_load")
    assert load.find("linear").text == "0"
    assert float(load.find("pressure").text) == pytest.approx(2.0)
    assert Deck("plain").root.find("Loads") is None


def test_contact_is_the_penalty_and_the_friction_of_the_case(deck):
    contact = deck.root.find("Contact/contact")
    s = deck.seating
    penalty = float(contact.find("penalty").text)
    assert penalty * 1e3 * 1.5 == pytest.approx(s.penalty)  # kPa/mm to Pa per R_a
    assert float(contact.find("fric_coeff").text) == s.case.model.seating_of(s.case).friction
    assert contact.find("auto_penalty").text == "0"
    assert contact.find("laugon").text == "PENALTY"


def test_results_are_of_the_inner_wall_at_angle_zero(deck):
    nodes = deck.root.find("Output/logfile/node_data")
    faces = deck.root.find("Output/logfile/face_data")
    assert (nodes.get("file"), faces.get("file")) == (INNER_FILE, CONTACT_FILE)
    inner = deck.points[deck.node_set(nodes.get("node_set"))]
    assert len(inner) == 2 * deck.seating.wall.columns + 1
    np.testing.assert_allclose(inner[:, 0], 1.5)
    assert not inner[:, 1].any()
    assert (np.diff(inner[:, 2]) > 0.0).all()
    # Where the name finds the surface of the contact, not one without contact's data.
    assert faces.get("surface") == deck.root.find("Mesh/SurfacePair/primary").text


def strains(count=200):
    """C of incompressible deformations without torsion: components rr, tt, zz, rz."""
    random = np.random.default_rng(7)
    t, z = random.uniform(0.8, 1.5, (2, count))
    shear = random.uniform(-0.3, 0.3, count)
    r = 1.0 / (t * z)  # F = [r, shear; 0, z] in r, z
    return r**2, t**2, shear**2 + z**2, r * shear


def febio_energy(material, C_rr, C_tt, C_zz, C_rz):
    """Energies of FEBio's manual at J = 1, directions 1, 2, 3 along r, θ, z; in kPa."""
    kind = material.get("type")
    if kind == "uncoupled solid mixture":
        parts = material.findall("solid")
        assert len(parts) == 2
        return sum(febio_energy(part, C_rr, C_tt, C_zz, C_rz) for part in parts)
    c = {child.tag: float(child.text) for child in material if child.tag != "mat_axis"}
    I1 = C_rr + C_tt + C_zz
    I2 = C_tt * (C_rr + C_zz) + C_rr * C_zz - C_rz**2
    if kind == "Mooney-Rivlin":
        return c["c1"] * (I1 - 3.0) + c["c2"] * (I2 - 3.0)
    if kind == "Yeoh":
        return sum(c[f"c{i}"] * (I1 - 3.0) ** i for i in (1, 2, 3))
    assert kind == "Fung orthotropic"
    # FEFungOrthotropic.cpp: λ from the compliance, less 2 μ on the diagonal.
    mu = np.array(
        [
            c["G12"] + c["G31"] - c["G23"],
            c["G12"] - c["G31"] + c["G23"],
            -c["G12"] + c["G31"] + c["G23"],
        ]
    )
    S = np.diag([1.0 / c["E1"], 1.0 / c["E2"], 1.0 / c["E3"]])
    S[0, 1] = S[1, 0] = -c["v12"] / c["E1"]
    S[1, 2] = S[2, 1] = -c["v23"] / c["E2"]
    S[2, 0] = S[0, 2] = -c["v31"] / c["E3"]
    lam = np.linalg.inv(S) - 2.0 * np.diag(mu)
    E = np.stack([C_rr - 1.0, C_tt - 1.0, C_zz - 1.0]) / 2.0
    squares = E**2 + np.stack([C_rz**2, 0.0 * C_rz, C_rz**2]) / 4.0
    Q = (2.0 * mu @ squares + np.einsum("ab,an,bn->n", lam, E, E)) / c["c"]
    return c["c"] / 2.0 * (np.exp(Q) - 1.0)


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_febio_has_the_energy_of_the_law(law):
    root = ET.fromstring(write_feb(seating(case(material=made_of(law)), 0.3)))
    material = root.find("Material/material[@name='wall']")
    C = strains()
    ours = law.energy(CauchyGreen(*C), INNER_WALL, np)
    theirs = 1e3 * febio_energy(material, *C)
    allowed = 1e-9 * np.abs(ours).max()
    if isinstance(law, Fung):
        # ε a1111 E_rr² in the exponent, |E_rr| < 0.5 here after compression to 1/(1.5 × 1.5)
        grown = law.C / 2.0 * np.exp(ours / law.C * 2.0 + 1.0)
        allowed = VANISHING * law.a1111 * 0.25 * grown + allowed
        assert (theirs >= ours - 1e-9 * np.abs(ours).max()).all()
    assert (np.abs(theirs - ours) <= allowed).all()
    assert np.abs(theirs - ours).max() <= 1e-6 * np.abs(ours).max()
    assert float(material.find("k").text) == pytest.approx(bulk_modulus(law) / 1e3)


@pytest.mark.parametrize("cross", [0.3, -0.3])
def test_fung_constants_pass_the_checks_of_febio(cross):
    """FEFungOrthotropic.cpp refuses v_ab > √(E_a/E_b); here it would be a1122² > a1111 a2222."""
    c = fung_constants(Fung(4e5, 0.7, 0.2, cross))
    for a, b in ((1, 2), (2, 3), (3, 1)):
        assert c[f"v{a}{b}"] <= np.sqrt(c[f"E{a}"] / c[f"E{b}"])
        assert c[f"E{a}"] > 0.0


def test_the_bulk_modulus_is_of_the_shear_modulus():
    """2 C10 = μ: k = 2 μ 1.499/(3 × 0.002)."""
    assert bulk_modulus(NeoHookean(1.0)) == pytest.approx(4.0 * 1.499 / 0.006)
    assert bulk_modulus(MooneyRivlin(0.7, 0.3)) == pytest.approx(4.0 * 1.499 / 0.006)


def test_other_laws_are_refused():
    own = UserLaw(lambda C, place, xp: C.I1, "own")
    with pytest.raises(BadInput, match="neo-hookean, mooney-rivlin, yeoh, fung, ogden or"):
        write_feb(seating(case(material=made_of(own)), 0.3))
    with pytest.raises(BadInput, match="a1122"):
        fung_constants(Fung(4e5, 0.7, 0.2, 0.9))


# pyfebio's models of the format check values too. It reads back no element that takes 0 or 1, knows
# no value by a map and no axes in a Fung law; there the names are looked at.
def test_pyfebio_reads_the_sections_it_can(deck):
    def read(model, tag):
        return model.from_xml(ET.tostring(deck.root.find(tag)))

    found = read(mesh.Mesh, "Mesh")
    assert sum(len(each.all_nodes) for each in found.nodes) == len(deck.ids)
    assert [each.type for each in found.elements] == ["hex20", "hex20"]
    assert len(found.elements[0].all_elements) == len(deck.seating.wall.cells)
    assert len(found.node_sets) == len(deck.named("NodeSet"))
    assert sum(len(each.all_quad8) for each in found.surfaces) == len(list(deck.root.iter("quad8")))
    assert len(found.surface_pairs) == 1
    assert len(read(meshdomains.MeshDomains, "MeshDomains").solid_domains) == 2
    assert len(read(meshdata.MeshData, "MeshData").node_data) == 3
    assert len(read(loaddata.LoadData, "LoadData").load_controllers) == 1 + deck.seating.loaded
    found = read(output.Output, "Output")
    assert len(found.plotfile[0].all_vars) == 4
    assert len(found.logfile[0].node_data) == len(found.logfile[0].face_data) == 1


def test_pyfebio_has_the_same_names(deck):
    models = {
        "Boundary/bc[@type='zero displacement']": boundary.BCZeroDisplacement,
        "Boundary/bc[@type='prescribed displacement']": boundary.BCPrescribedDisplacement,
        "Boundary/bc[@type='linear constraint']": boundary.BCLinearConstraint,
        "Boundary/bc/child_dof": boundary.ChildDof,
        "Loads/surface_load": loads.PressureLoad,
        "Contact/contact": contact.SlidingElastic,
        "Step/step/Control": control.Control,
        "Step/step/Control/time_stepper": control.TimeStepper,
        "Step/step/Control/solver": control.SolidSolver,
        "Step/step/Control/solver/qn_method": control.BFGSMethod,
        "Material/material[@type='Mooney-Rivlin']": material.MooneyRivlinUC,
        "Material/material[@type='neo-Hookean']": material.NeoHookean,
        ".//solid[@type='Fung orthotropic']": material.FungOrthotropicUC,
    }
    seen = 0
    for path, model in models.items():
        for element in deck.root.iterfind(path):
            words = {*element.keys(), *(child.tag for child in element)} - {"mat_axis"}
            assert words <= set(model.model_fields), path
            seen += 1
    assert seen > 30
