"""What every result must do when it is shown, whatever it is; see `test_results.py`."""

import json

from matplotlib.figure import Figure

from stonepass.report.presentation import rows

LONGEST = 300  # characters of a short description


def check_shown(result, *columns):
    """Check description, tables, record, rows and graph; `columns` must be among its columns."""
    described = repr(result)
    assert described.startswith(f"<{type(result).__name__}: ")
    assert len(described) < LONGEST
    assert "\n" not in described
    printed, html = str(result), result._repr_html_()
    assert len(printed.splitlines()) > 3
    assert "[bold]" not in printed + html
    assert html.count("<table>") == html.count("</table>") >= 1
    json.dumps(result.to_dict(), allow_nan=False)
    table = rows(result)
    assert table
    for row in table:
        assert set(columns) <= set(row)
        assert all(value is None or isinstance(value, str | float | int) for value in row.values())
    axes = Figure().add_subplot()
    assert result.plot(axes) is axes
    assert axes.lines or axes.patches
    assert axes.get_xlabel()
    assert axes.get_ylabel()
    assert axes.get_title(loc="left")
    assert isinstance(result.figure(), Figure)
