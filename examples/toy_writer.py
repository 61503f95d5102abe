"""An export format in one file: contact pressure over the angle, as a table.

python examples/toy_writer.py [FOLDER]

To add the format to the package, put this file into `stonepass/export/writers` and its `CONTACT`
into the tuple of `stonepass/export/registry.py`. ``stonepass export`` then has the format, its
option and its help.
"""

import sys
from pathlib import Path

import stonepass as sp
from stonepass import export
from stonepass.materials.known_laws import KNOWN_LAWS

PASCAL_PER = {"kPa": 1e3, "mmHg": 133.322387415}


def contact_table(case, options, solved):
    """Return the table, or no content if the stone is not held and there is no contact."""
    answer, unit = solved(), options["unit"]
    contact = answer.contact
    if contact is None:
        return export.Export(None, f"{answer.outcome.name}: {answer.message}")
    rows = [
        f"{theta:.6f},{pressure / PASCAL_PER[unit]:.6g}"
        for theta, pressure in zip(contact.theta, contact.contact_pressure, strict=True)
    ]
    text = "\n".join([f"theta_rad,contact_pressure_{unit}", *rows]) + "\n"
    return export.Export(text, f"{len(rows)} angles", "plot it with: gnuplot {file}")


CONTACT = export.Writer(
    name="contact",
    ending=".csv",
    description="table of the contact pressure",
    write=contact_table,
    options=(
        export.Option("unit", "unit of the pressure", str, default="kPa", choices=("kPa", "mmHg")),
    ),
    limits={
        "model": export.Limit(("paper",), "the table shows the contact of the seated state"),
        "law": export.Limit(tuple(KNOWN_LAWS)),
    },
)


def main() -> None:
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    case = sp.Case(
        sp.Stone(size_ratio=1.2),
        sp.Ureter(wall_ratio=1.5, material="latex"),
        model=sp.SeatedBalance(seating="frictionless"),
        numerics=sp.Numerics("fast"),
    )
    writers = (*export.formats(), CONTACT)  # the registration
    made = export.write(case, folder / "contact.csv", writers=writers, unit="mmHg")
    print(f"{made.path.name}: {made.summary}; {made.next_step}")


if __name__ == "__main__":
    main()
