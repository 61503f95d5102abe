"""Pages that follow from the code: Python interface, command line, errors of surrogates."""

import re
from pathlib import Path
from types import ModuleType

from typer import Context
from typer.core import TyperGroup
from typer.main import get_command

import stonepass
from stonepass.cli.app import app as command_line
from stonepass.studies.surrogates.store import shipped_surrogates

# Pages of the Python interface: its name, its title, and the packages whose public names it has.
GROUPS = (
    ("cases", "Questions, cases and answers", ("model",)),
    ("laws", "Wall laws and materials", ("materials",)),
    ("files", "Reading and writing files", ("inputs", "export")),
    ("studies", "Studies of many cases", ("studies",)),
    ("laboratory", "Laboratory", ("bench",)),
    ("surface", "Friction from a surface", ("surface",)),
    ("patients", "Patients", ("clinic",)),
    ("quantities", "Quantities and results", ("units", "result")),
    ("errors", "Errors, outcomes and warnings", ("errors", "caution")),
    ("records", "Records", ("records",)),
)
# Functions of the packages that are public as a whole.
FUNCTIONS = {"export": ("formats", "write")}
INTRODUCTION = """# Python interface

These pages list every public name of the package, which is `import stonepass as sp` in the
examples. Quantities are accepted as text with a unit (`"4.2 mm"`), as quantities of pint, or as SI
numbers of the types `sp.Length` and `sp.Pressure`; results are in SI units. The
[glossary](../glossary.md) explains the words and the symbols.
"""
RECORDS = """Records are the results as they are printed by `--json`: typed, versioned and with
units in their keys. The [keys of records](../reference.md) have a page of their own.
"""


def python_interface():
    """Yield name and text of the pages of the Python interface: every name of `__all__`, once."""
    homes = stonepass._HOME
    left = {name: homes.get(name, name).split(".")[0] for name in stonepass.__all__}
    tree = ["```{toctree}", ":hidden:", "", *(f"api_{page}" for page, _, _ in GROUPS), "```"]
    overview = ["| page | names |", "| --- | --- |"]
    for page, title, packages in GROUPS:
        names = sorted((n for n, home in left.items() if home in packages), key=_functions_first)
        left = {name: home for name, home in left.items() if name not in names}
        lines = [f"# {title}", RECORDS if page == "records" else "", "```{eval-rst}"]
        yield f"api_{page}", "\n".join([*lines, *map(_directive, names), "```", ""])
        listed = ", ".join(f"{{py:obj}}`{name} <stonepass.{name}>`" for name in names)
        overview.append(f"| [{title}](api_{page}.md) | {listed} |")
    if left:
        raise ValueError(f"no page of the Python interface has {sorted(left)}")
    yield "api", "\n".join([INTRODUCTION, *overview, "", *tree, ""])


def _functions_first(name):
    return isinstance(getattr(stonepass, name), type), name


def _directive(name):
    thing = getattr(stonepass, name)
    if isinstance(thing, ModuleType):
        members = "".join(
            f".. autofunction:: stonepass.{name}.{each}\n" for each in FUNCTIONS[name]
        )
        return f".. automodule:: stonepass.{name}\n   :no-members:\n\n{members}"
    if not isinstance(thing, type):
        kind = "function" if callable(thing) else "data"
        return f".. auto{kind}:: stonepass.{name}\n" + ("   :no-value:\n" * (kind == "data"))
    if name.endswith("Record"):
        return f".. autoclass:: stonepass.{name}()\n"
    return f".. autoclass:: stonepass.{name}\n   :members:\n"


def command_line_page():
    """Return the page of the command line: help, options and examples of every command."""
    command = get_command(command_line)
    context = Context(command, None, "stonepass")
    return "\n".join(["# Command line", "", *_command("stonepass", command, context, 2)])


def _command(name, command, context, level):
    """Yield the lines of a command, and those of its sub-commands."""
    usage = " ".join([name, *command.collect_usage_pieces(context)])
    yield from (_paragraphs(command.help), f"```text\n{usage}\n```", "")
    panels = {}
    for parameter in command.get_params(context):
        if (record := parameter.get_help_record(context)) is not None:
            panel = getattr(parameter, "rich_help_panel", None) or "Options"
            option, meaning = record
            panels.setdefault(panel, []).append((option.split(" <")[0], meaning))
    for panel, records in panels.items():
        yield from (f"| {panel.lower()} | meaning |", "| --- | --- |")
        yield from (f"| {_code(option)} | {_cell(meaning)} |" for option, meaning in records)
        yield ""
    yield _paragraphs(command.epilog)
    for each in command.list_commands(context) if isinstance(command, TyperGroup) else ():
        inner = command.get_command(context, each)
        yield from ("#" * level + f" `{name} {each}`", "")
        yield from _command(f"{name} {each}", inner, Context(inner, context, each), level + 1)


def _paragraphs(text):
    """Return the help of a command as Markdown; lines that are to stay as they are become code."""
    found = []
    for paragraph in (text or "").split("\n\n"):
        if paragraph.startswith("\b"):
            found.append("```text\n" + paragraph.removeprefix("\b").strip("\n") + "\n```")
        else:
            found.append(_prose(" ".join(paragraph.split())))
    return "\n\n".join(found) + "\n"


def _prose(text):
    """Return a text with its options as code, and without anything that Markdown would read."""
    plain = re.sub(r"([*_<>\[\]])", r"\\\1", text)
    return re.sub(r"(?<![\w`-])(--?[a-zA-Z][\w-]*)", r"`\1`", plain)


def _cell(text):
    return _prose(" ".join(text.split())).replace("|", "\\|")


def _code(text):
    return "`" + text.replace("|", "\\|") + "`"


def surrogate_errors():
    """Return the measured errors of the surrogates of the package as a table."""
    lines = [
        "| material, model | cases | same outcome | compared | largest error | root mean square "
        "| within the claim |",
        "| --- | --- | --- | --- | --- | --- | --- |",
    ]
    for material, model in shipped_surrogates():
        found = stonepass.load_surrogate(material, model).about["check"]
        errors = (f"{100.0 * found[name]:.2g} %" for name in ("largest", "typical"))
        cells = [f"`{material}`, {model}", found["cases"], found["same_outcome"],
                 found["compared"], *errors, f"{100.0 * found['within']:.1f} %"]  # fmt: skip
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join([*lines, ""])


def write(app):
    """Write the pages where the build reads them; they are not under version control."""
    folder = Path(app.srcdir) / "generated"
    folder.mkdir(exist_ok=True)
    pages = {"command_line": command_line_page(), "surrogates": surrogate_errors()}
    for name, text in (*python_interface(), *pages.items()):
        path = folder / f"{name}.md"
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def link_pages(app, what, name, thing, options, lines):
    """Link the pages and sections that a docstring names as its source."""
    text = "\n".join(lines)
    section = re.compile(r"(?<![`\w])docs/([\w/-]+)\.md,\s+(section\s+)?\"([^\"]+)\"")
    text = section.sub(_link_to_section, text)
    text = re.sub(r"(?<![`\w])docs/([\w/-]+)\.md(?!`)", r":doc:`docs/\1.md </\1>`", text)
    lines[:] = text.split("\n")


def _link_to_section(found):
    page, title = found[1], " ".join(found[3].split())
    return f':ref:`"{title}" <{page}:{title}>` (page {page})'


def setup(app):
    """Write the pages before anything is read."""
    app.connect("builder-inited", write)
    app.connect("autodoc-process-docstring", link_pages)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
