"""Writer of input files for FEBio 4, in millimetres, kilopascals and millinewtons.

FEBio has no axisymmetric elements. The model is a wedge about the axis z that is one element thick.
One side lies in the plane y = 0, the other is rotated by the angle `WEDGE`. On the rotated side the
constraint u_y = u_x tan(WEDGE) keeps the nodes in their plane. FEBio's "normal displacement" cannot
be used, because it prescribes all three components of the displacement.
"""

from __future__ import annotations

from xml.etree.ElementTree import Comment, Element, SubElement, indent, tostring

import numpy as np

from stonepass.about import DISCLAIMER
from stonepass.array_types import Num
from stonepass.export.feb_material import add_wall_material
from stonepass.export.seating import KPA, MM, DeckSeating
from stonepass.export.wedge import WEDGE, Wedge
from stonepass.materials.derivatives import hoop_modulus

__all__ = ["CONTACT_FILE", "INNER_FILE", "WEDGE", "write_feb"]

LOAD_INCREMENTS = 10  # number of increments of the first step if it applies a load
SEARCH = 0.25  # distance in inner radii within which a face of the wall can find the element strip
INNER_FILE = "seated_inner.csv"  # columns: node, u_r, 0, u_z of the inner wall in mm
CONTACT_FILE = "seated_contact.csv"  # columns: face, contact pressure in kPa

STRIP_CURVE, LOAD_CURVE = "1", "2"  # numbers of the load curves
# Squared residual in mN² below which a step has converged. FEBio's default of 1e-20 is below the
# rounding errors of a step without forces, such as the first step of a tube without a load.
NO_RESIDUAL = 1e-12


def write_feb(seating: DeckSeating) -> str:
    """Return the text of the input file.

    Parameters
    ----------
    seating : DeckSeating
        Meshes, prescribed displacements and loads.

    Raises
    ------
    BadInput
        FEBio does not have the law of the wall.

    References
    ----------
    docs/export.md, "What is in an input deck".
    """
    wall = Wedge(seating.wall, 1)
    strip = Wedge(seating.element_strip, 1 + wall.count)
    root = Element("febio_spec", version="4.0")
    root.append(Comment(_header(seating)))
    SubElement(root, "Module", type="solid")
    _materials(root, seating)
    _mesh(root, seating, wall, strip)
    _travel(root, seating, strip)
    _boundary(root, seating, wall)
    _load(root, seating)
    _contact(root, seating)
    _steps(root, seating)
    _curves(root, seating)
    _output(root)
    indent(root)
    return '<?xml version="1.0" encoding="ISO-8859-1"?>\n' + tostring(root, "unicode") + "\n"


def _header(s: DeckSeating) -> str:
    lines = (
        *s.heading(),
        f"units mm, mN, kPa; a wedge of {np.degrees(WEDGE):g} degrees about z, from y = 0 to y > 0",
        DISCLAIMER,
    )
    plain = (line.encode("ascii", "replace").decode().replace("--", "- -") for line in lines)
    return "\n    " + "\n    ".join(plain) + "\n  "


def _materials(root: Element, s: DeckSeating) -> None:
    section = SubElement(root, "Material")
    law = s.case.ureter.material.law
    add_wall_material(section, law, id="1", name="wall")
    stone = SubElement(section, "material", id="2", name="stone", type="neo-Hookean")
    _leaf(stone, "E", 100.0 * hoop_modulus(law) / KPA)
    _leaf(stone, "v", 0.3)


def _mesh(root: Element, s: DeckSeating, wall: Wedge, strip: Wedge) -> None:
    mesh = SubElement(root, "Mesh")
    bodies = {"wall": wall, "stone": strip}
    for name, wedge in bodies.items():
        points = wedge.turned(wedge.grid.points) * s.inner_radius / MM
        _rows(SubElement(mesh, "Nodes", name=f"{name}_nodes"), "node", points, wedge.first)
    first = 1
    for name, wedge in bodies.items():
        elements = SubElement(mesh, "Elements", type="hex20", name=name)
        _rows(elements, "elem", wedge.elements(), first)
        first += len(wedge.grid.cells)
    faces = {"lumen": wall.inner(s.facing), "outside": wall.outer(), "facing": strip.outer()}
    for name, corners in faces.items():
        _rows(SubElement(mesh, "Surface", name=name), "quad8", corners, 1)
    sets = {
        "side": wall.sides[0],
        "first": wall.on(s.wall.column_line(0)),
        "last": wall.on(s.wall.column_line(-1)),
        "inner": wall.sides[0][s.wall.row_line(0)],
        "strip": strip.first + np.arange(strip.count),
    }
    for name, numbers in sets.items():
        SubElement(mesh, "NodeSet", name=name).text = _joined(numbers)
    pair = SubElement(mesh, "SurfacePair", name="touch")
    _leaf(pair, "primary", "lumen")
    _leaf(pair, "secondary", "facing")
    domains = SubElement(root, "MeshDomains")
    for name in bodies:
        SubElement(domains, "SolidDomain", name=name, mat=name)


def _travel(root: Element, s: DeckSeating, strip: Wedge) -> None:
    data = SubElement(root, "MeshData")
    travel = strip.turned(s.travel) * s.inner_radius / MM
    for dof, values in zip("xyz", travel.T, strict=True):
        table = SubElement(data, "NodeData", name=f"travel_{dof}", node_set="strip")
        table.set("data_type", "scalar")
        for position, value in enumerate(values, start=1):
            _leaf(table, "node", float(value), lid=str(position))


def _boundary(root: Element, s: DeckSeating, wall: Wedge) -> None:
    section = SubElement(root, "Boundary")
    _hold(section, "side", "y")
    pull = s.pull * s.inner_radius / MM
    for end, distance in (("first", -pull if s.whole else 0.0), ("last", pull)):
        if distance == 0.0:
            _hold(section, end, "z")
        else:
            _leaf(_move(section, end, "z"), "value", distance, lc=LOAD_CURVE)
    for dof in "xyz":
        move = _move(section, "strip", dof)
        _leaf(move, "value", f"travel_{dof}", lc=STRIP_CURVE, type="map")
    for number in wall.sides[1]:
        tie = SubElement(section, "bc", type="linear constraint")
        _leaf(tie, "node", int(number))
        _leaf(tie, "dof", "y")
        child = SubElement(tie, "child_dof")
        _leaf(child, "node", int(number))
        _leaf(child, "dof", "x")
        _leaf(child, "value", float(np.tan(WEDGE)))


def _hold(section: Element, node_set: str, held: str) -> None:
    bc = SubElement(section, "bc", type="zero displacement", node_set=node_set)
    for dof in "xyz":
        _leaf(bc, f"{dof}_dof", int(dof == held))


def _move(section: Element, node_set: str, dof: str) -> Element:
    bc = SubElement(section, "bc", type="prescribed displacement", node_set=node_set)
    _leaf(bc, "dof", dof)
    _leaf(bc, "relative", 0)
    return bc


def _load(root: Element, s: DeckSeating) -> None:
    """Add the confining pressure.

    FEBio's linear pressure acts on the initial area in the initial direction, so that its forces
    stay constant like those of a dead load.
    """
    load = s.case.load
    if load.confining_pressure == 0.0:
        return
    section = SubElement(root, "Loads")
    pressure = SubElement(section, "surface_load", type="pressure", surface="outside")
    _leaf(pressure, "pressure", load.confining_pressure / KPA, lc=LOAD_CURVE)
    _leaf(pressure, "symmetric_stiffness", 0)
    _leaf(pressure, "linear", int(not load.hydrostatic))


def _contact(root: Element, s: DeckSeating) -> None:
    """Add the contact; the contact pressure is the penalty times the penetration."""
    section = SubElement(root, "Contact")
    touch = SubElement(section, "contact", type="sliding-elastic", surface_pair="touch")
    _leaf(touch, "laugon", "PENALTY")
    _leaf(touch, "penalty", s.penalty / KPA / (s.inner_radius / MM))
    _leaf(touch, "auto_penalty", 0)
    _leaf(touch, "two_pass", 0)
    _leaf(touch, "symmetric_stiffness", 0)
    _leaf(touch, "search_radius", SEARCH * s.inner_radius / MM)
    _leaf(touch, "fric_coeff", s.friction)


def _steps(root: Element, s: DeckSeating) -> None:
    section = SubElement(root, "Step")
    counts = (LOAD_INCREMENTS if s.loaded else 1, int(np.ceil(s.length / s.increment)))
    for number, (name, count) in enumerate(zip(("load", "press"), counts, strict=True), start=1):
        step = SubElement(section, "step", id=str(number), name=name)
        _control(SubElement(step, "Control"), count)


def _control(control: Element, count: int) -> None:
    """Add the control of a step of duration 1 that starts with the increment 1/`count`.

    The solver takes full Newton steps with a new tangent in every iteration.
    """
    _leaf(control, "analysis", "STATIC")
    _leaf(control, "time_steps", count)
    _leaf(control, "step_size", 1.0 / count)
    stepper = SubElement(control, "time_stepper", type="default")
    for name, value in {"max_retries": 10, "opt_iter": 15, "aggressiveness": 1}.items():
        _leaf(stepper, name, value)
    _leaf(stepper, "dtmin", 1e-3 / count)
    _leaf(stepper, "dtmax", min(2.0 / count, 1.0))
    solver = SubElement(control, "solver", type="solid")
    _leaf(solver, "symmetric_stiffness", "non-symmetric")
    _leaf(solver, "max_refs", 25)
    _leaf(solver, "dtol", 1e-3)
    _leaf(solver, "etol", 1e-3)
    _leaf(solver, "min_residual", NO_RESIDUAL)
    _leaf(SubElement(solver, "qn_method", type="BFGS"), "max_ups", 0)


def _curves(root: Element, s: DeckSeating) -> None:
    section = SubElement(root, "LoadData")
    curves = {STRIP_CURVE: s.first_fraction} | ({LOAD_CURVE: 1.0} if s.loaded else {})
    for number, first in curves.items():
        curve = SubElement(section, "load_controller", id=number, type="loadcurve")
        _leaf(curve, "interpolate", "LINEAR")
        _leaf(curve, "extend", "CONSTANT")
        points = SubElement(curve, "points")
        for point in ((0.0, 0.0), (1.0, first), (2.0, 1.0)):
            _leaf(points, "pt", _joined(np.array(point)))


def _output(root: Element) -> None:
    section = SubElement(root, "Output")
    log = SubElement(section, "logfile")
    inner = SubElement(log, "node_data", data="ux;uy;uz", node_set="inner", file=INNER_FILE)
    faces = SubElement(log, "face_data", data="contact pressure", surface="lumen")
    faces.set("file", CONTACT_FILE)
    for record in (inner, faces):
        record.set("delim", ",")
    plot = SubElement(section, "plotfile", type="febio")
    for name in ("displacement", "stress", "contact pressure", "contact gap"):
        SubElement(plot, "var", type=name)


def _rows(parent: Element, tag: str, rows: Num[np.ndarray, "rows columns"], first: int) -> None:
    for number, row in enumerate(rows, start=first):
        SubElement(parent, tag, id=str(number)).text = _joined(row)


def _joined(values: Num[np.ndarray, " values"]) -> str:
    return ",".join(f"{value:.12g}" for value in values)


def _leaf(parent: Element, tag: str, value: str | int | float, **attributes: str) -> None:
    text = value if isinstance(value, str) else f"{value:.12g}"
    SubElement(parent, tag, attributes).text = text
