"""Figures look the same whatever the user's own settings of matplotlib are, and leave them alone."""

import ast
from pathlib import Path

import matplotlib as mpl

import stonepass
from stonepass.report.style import in_style, new_figure, save

ROOT = Path(stonepass.__file__).parent


@in_style
def drawn():
    figure = new_figure(3.0, 2.0)
    axes = figure.add_subplot()
    axes.plot([0.0, 1.0], [0.0, 1.0], label="a line")
    axes.set_title("A title")
    axes.legend()
    return figure


def test_a_users_settings_are_neither_used_nor_changed(tmp_path):
    save(drawn(), tmp_path / "plain.svg")
    theirs = {"font.size": 31.0, "legend.frameon": True, "xtick.color": "red", "text.color": "red"}
    with mpl.rc_context(theirs):
        before = dict(mpl.rcParams)
        save(drawn(), tmp_path / "theirs.svg")
        assert dict(mpl.rcParams) == before
    assert (tmp_path / "plain.svg").read_bytes() == (tmp_path / "theirs.svg").read_bytes()


def test_every_function_that_makes_a_figure_is_in_style():
    found, plain = 0, []
    for path in sorted(ROOT.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.FunctionDef) or node.name == "new_figure":
                continue
            calls = {
                each.func.id
                for each in ast.walk(node)
                if isinstance(each, ast.Call) and isinstance(each.func, ast.Name)
            }
            if "new_figure" in calls:
                found += 1
                if "in_style" not in map(ast.unparse, node.decorator_list):
                    plain.append(f"{path.name}: {node.name}")
    assert found > 15
    assert plain == []
