"""Records: what a command prints with --json is its record, and every key is in the reference."""

import json
from pathlib import Path

import pytest
import typer
from options import asking
from typer.main import get_command

import stonepass as sp
from stonepass.caution import SENTENCES, caution
from stonepass.cli import run
from stonepass.cli.app import COMMANDS, app
from stonepass.export.comparison import DeckComparison
from stonepass.records.base import CautionRecord, Record, warning_records
from stonepass.records.compare import CompareRecord, compare_record
from stonepass.records.reference import LISTS, RECORDS, parts, reference

pytestmark = pytest.mark.usefixtures("shared_solutions")

EXAMPLES = Path(__file__).parents[1] / "examples"
LOOSE = "--xi 0.9 --eta 1.3 --json"
TUBE_OF_LATEX = "--xi 1.2 --eta 1.5 --material latex --friction 0.475 --accuracy fast"
BEAM = "--model beam --E1 0.465MPa --E2 0.02MPa --eta 1.3"
STRIPS = f"{EXAMPLES}/latex_tensile.csv --law neo-hookean --width 10mm --thickness 1.2mm"
TUBE = f"{EXAMPLES}/ureter_inflation.csv --law neo-hookean --inner 3mm --outer 4mm"
STUDY = f"{EXAMPLES}/uncertain_stone.toml"
DOORS = {
    "pressure of a loose stone": f"pressure {LOOSE}",
    "pressure of a beam": f"pressure {BEAM} --xi 1.2 --json",
    "size": f"size {BEAM} --limit 4kPa --json",
    "curve": f"curve {BEAM} --xi 0.9:1.35:0.15 --no-cache --json",
    "closures of a loose stone": f"closures {LOOSE} --no-cache",
    "closures": f"closures {TUBE_OF_LATEX} --no-cache --json",
    "push of a loose stone": f"push {LOOSE} --no-cache",
    "push": f"push {TUBE_OF_LATEX} --steps 2 --no-cache --json",
    "friction": f"friction {EXAMPLES}/known_slopes.png --pixel 0.5um --height-range 24.8um --json",
    "sensitivity": f"sensitivity {STUDY} --workers 1 --samples 64 --json",
    "elementary effects": f"sensitivity {STUDY} --workers 1 --method morris --samples 6 --json",
    "surrogate": "surrogate evaluate ureter --xi 1.2 --eta 1.3 --json",
    "fit of strips": f"fit tensile {STRIPS} --json",
    "fit of a tube": f"fit inflation {TUBE} --json",
}  # the records of `invitro` and `assess` are validated in the tests of these


def commands_with_json():
    """Names of the commands that have --json, those of a group by the name of the group."""
    group, found = get_command(app), set()
    context = typer.Context(group)
    for name in COMMANDS:
        command = group.get_command(context, name)
        for each in getattr(command, "commands", {"": command}).values():
            if any("--json" in parameter.opts for parameter in each.params):
                found.add(name)
    return found


def test_every_command_with_json_has_a_record():
    assert commands_with_json() == set(RECORDS)
    assert len(RECORDS) >= 10
    for command, record in RECORDS.items():
        assert issubclass(record, Record) or command in LISTS


@pytest.mark.parametrize("door", DOORS)
def test_what_is_printed_is_the_record(door, capsys):
    arguments = DOORS[door].split()
    assert run(arguments) == 0
    printed = json.loads(capsys.readouterr().out)
    record = RECORDS[arguments[0]]
    rows = printed if arguments[0] in LISTS else [printed]
    assert rows
    for row in rows:
        validated = record.model_validate(row)
        assert set(row) == set(record.model_fields)
        assert validated.to_dict() == row
        assert [key for key in row.get("detail", ()) if f"`{key}`" not in reference()] == []


def test_every_key_is_in_the_reference_and_has_a_meaning():
    page, counted = reference(), 0
    titles = [f"### `stonepass {name}`" for name in RECORDS]
    titles += [f"### {part.__name__}" for part in parts()]
    assert CautionRecord in parts()
    for title, record in zip(titles, [*RECORDS.values(), *parts()], strict=True):
        assert page.count(f"{title}\n") == 1
        assert record.__doc__
        section = page.split(f"{title}\n")[1].split("\n### ")[0]
        inherited = sp.AnswerRecord.model_fields if "has all keys" in section else {}
        for name, field in record.model_fields.items():
            assert field.description
            assert f"| `{name}` | " in section or name in inherited
            counted += 1
    assert counted > 200


def test_records_are_closed_and_frozen():
    record = RECORDS["pressure"]
    loose = sp.answer_record(
        sp.critical_pressure(sp.Stone(size_ratio=0.9), sp.Ureter(wall_ratio=1.3))
    )
    known = loose.to_dict()
    assert known["record_version"] == 1
    with pytest.raises(ValueError, match="Extra inputs"):
        record.model_validate(known | {"new_key": 1.0})
    with pytest.raises(ValueError, match="finite"):
        record.model_validate(known | {"wall_ratio": float("nan")})
    with pytest.raises(ValueError, match="frozen"):
        loose.wall_ratio = 1.0


def test_warnings_become_data():
    made = caution("loaded_imbalance", imbalance=0.02)
    (told,) = warning_records([made])
    assert told == CautionRecord.of(made)
    assert (told.code, told.values) == ("loaded_imbalance", {"imbalance": 0.02})
    assert told.sentence == "the axial forces on tube and stone are out of balance by 2.0%"
    with pytest.raises(KeyError):
        caution("loaded_imbalance")  # its value is missing


def test_every_code_of_a_warning_is_used_and_in_the_reference():
    source = "".join(path.read_text(encoding="utf-8") for path in Path(sp.__file__).parent.rglob("*.py")
                     if path.name != "caution.py")  # fmt: skip
    assert len(SENTENCES) >= 40
    assert [code for code in SENTENCES if f'"{code}"' not in source] == []
    assert [code for code in SENTENCES if f"| `{code}` |" not in reference()] == []


def test_a_comparison_adds_what_the_other_contact_gives():
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.3), **asking(accuracy="fast"))
    answer = sp.solve(case)
    record = compare_record(DeckComparison(answer, answer.contact, answer.contact, answer.pressure))
    assert record.calculix.critical_pressure_kPa == record.critical_pressure_kPa
    assert record.calculix.contact_angle_deg == record.contact_angle_deg
    assert CompareRecord.model_validate(json.loads(json.dumps(record.to_dict()))) == record


def test_every_public_name_is_there():
    assert len(sp.__all__) > 60
    for name in sp.__all__:
        assert getattr(sp, name) is not None
