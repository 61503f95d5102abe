"""The calculator of the page, in a real browser against a real server."""

import json
import re
import shlex
import time

import pytest
from page_browser import ANSWERED, SECONDS, settled, until

from stonepass.cli import run

ASKED = {
    "case": {
        "stone": {"diameter": "4.2 mm", "friction": 0.5},
        "ureter": {"inner_diameter": "3.5 mm", "wall_thickness": "0.52 mm", "material": "ureter"},
        "load": {"confining_pressure": "0 kPa"},
    },
    "limit": "6 kPa",
}


def asked(**stone):
    return {**ASKED, "case": {**ASKED["case"], "stone": {**ASKED["case"]["stone"], **stone}}}


def reading(page, name):
    """The number of one of the readings, as it is shown."""
    return page.locator(".reading", has_text=name).locator(".big").inner_text()


def pressure(page):
    return reading(page, "This stone starts to move")


def near(number):
    """A number as it is shown, with at least two decimals."""
    return pytest.approx(number, abs=0.0051)


def test_first_answer_is_that_of_the_api(page, server):
    found = server.post("instant", ASKED)
    assert float(pressure(page)) == near(found["answer"]["critical_pressure_kPa"])
    assert float(reading(page, "largest stone")) == near(found["size"]["critical_diameter_mm"])
    kilopascals = found["answer"]["critical_pressure_kPa"]
    others = f"{kilopascals / 0.133322:.3g} mmHg · {kilopascals / 0.0980665:.3g} cmH₂O"
    assert others in page.locator(".reading").first.inner_text()
    assert "this stone does not move" in page.locator(".verdict").inner_text()
    # The live region waits until the sliders rest.
    page.locator(".answer [aria-live=polite]", has_text="does not move").wait_for()


def test_sliders_change_the_answer_and_the_link_reproduces_it(open_page, server):
    page = open_page()
    page.get_by_label("Diameter across the ureter, slider").fill("3.9")
    page.get_by_label("Friction coefficient, slider").fill("0.3")
    settled(page)
    found = server.post("instant", asked(diameter="3.9 mm", friction=0.3))["answer"]
    assert float(pressure(page)) == near(found["critical_pressure_kPa"])
    assert "this stone moves" in page.locator(".verdict").inner_text()
    page.wait_for_url("**stone=3.9mm**")
    link = page.url.split("/", 3)[3]
    again = open_page(link)
    assert again.get_by_label("Friction coefficient", exact=True).input_value() == "0.3"
    assert pressure(again) == pressure(page)


def test_boxes_accept_the_units_of_the_clinic(page):
    limit = page.get_by_label("Pressure limit", exact=True)
    limit.fill("61 cmH2O")
    limit.blur()
    settled(page)
    assert limit.input_value() == "5.9821"
    limit.fill("45 mmHg")
    settled(page)
    assert "45.0 mmHg · 61.2 cmH₂O" in page.locator(".inputs").inner_text()
    limit.fill("nonsense")
    assert page.locator(".box[data-state=bad]").count() == 1
    limit.blur()
    assert limit.input_value() == "5.9995"  # the last number that could be read


def test_wall_by_outer_diameter_is_the_same_wall(page):
    before = pressure(page)
    page.get_by_role("button", name="outer diameter").click()
    settled(page)
    assert page.get_by_label("Outer diameter", exact=True).input_value() == "4.54"
    assert pressure(page) == before
    page.get_by_label("Outer diameter", exact=True).fill("5.5")
    settled(page)
    page.get_by_role("button", name="thickness", exact=True).click()
    settled(page)
    assert page.get_by_label("Wall thickness", exact=True).input_value() == "1"


def test_published_limits_have_their_source(page, server):
    known = server.get("pressure-limits")
    box = page.get_by_label("Published limits")
    assert box.locator("option").count() == len(known) + 1
    box.select_option("12")
    settled(page)
    assert known[-1]["source"].rstrip(".") in page.locator(".inputs").inner_text()
    assert page.get_by_label("Pressure limit", exact=True).input_value() == "12"


@pytest.mark.parametrize(
    ("diameter", "outcome", "words"),
    [("3", "LOOSE", "not held"), ("8", "NO_SOLUTION", "no instant answer")],
)
def test_outcomes_without_a_pressure_are_told_in_words(page, server, diameter, outcome, words):
    page.get_by_label("Diameter across the ureter", exact=True).fill(diameter)
    settled(page)
    assert server.post("instant", asked(diameter=f"{diameter} mm"))["answer"]["outcome"] == outcome
    assert words in page.locator(".verdict").inner_text()


def test_nothing_is_extrapolated(page):
    page.get_by_label("Diameter across the ureter", exact=True).fill("6.5")
    settled(page)
    first = page.locator(".reading").first
    assert first.locator(".big").count() == 0
    assert not re.search(r"\d+ mmHg", first.inner_text())
    control = page.locator(".control", has=page.get_by_label("Diameter across the ureter, slider"))
    assert "The instant answer covers" in control.locator(".note").inner_text()
    assert control.locator(".note").get_attribute("data-state") == "warning"


@pytest.mark.parametrize("material", ["ureter", "latex"])
def test_loads_are_answered_or_refused_beside_their_slider(open_page, material):
    """No surrogate reaches 60 kPa, and each answers without a load."""
    page = open_page(f"#calculator?stone=4.2mm&inner=3.5mm&thickness=0.52mm&material={material}")
    assert page.locator(".reading .big").count() == 2
    page.get_by_label("Confining pressure", exact=True).fill("60")
    settled(page)
    assert page.locator(".reading").first.locator(".big").count() == 0
    control = page.locator(".control", has=page.get_by_label("Confining pressure, slider"))
    assert control.locator(".note").get_attribute("data-state") == "warning"


def test_shape_without_a_surrogate_warns_beside_its_slider(page):
    page.get_by_label("Length over width", exact=True).fill("1.4")
    settled(page)
    control = page.locator(".control", has=page.get_by_label("Length over width, slider"))
    assert control.locator(".note").get_attribute("data-state") == "warning"
    assert page.locator(".reading").first.locator(".big").count() == 0


def test_refused_input_is_named_beside_its_box(page, watched):
    watched.expected = ("422",)
    page.get_by_label("Friction coefficient", exact=True).fill("7")
    settled(page)
    control = page.locator(".control", has=page.get_by_label("Friction coefficient, slider"))
    assert control.locator(".note").get_attribute("data-state") == "warning"
    assert "2" in control.locator(".note").inner_text()  # the largest friction


def test_finite_elements_beside_the_instant_answer(page):
    page.get_by_role("button", name="Solve").click()
    solved = page.locator(".reading.solve")
    solved.locator(".big").wait_for(timeout=SECONDS)
    assert abs(float(solved.locator(".big").inner_text()) - float(pressure(page))) < 0.1
    assert "from the instant answer" in solved.inner_text()
    figure = page.locator("figure", has_text="Section through")
    assert "Solved for exactly these inputs" in figure.inner_text()
    assert figure.locator(".pressure-fill").count() == 2
    page.get_by_label("Diameter across the ureter", exact=True).fill("4.1")
    settled(page)
    assert solved.locator(".big").count() == 0  # never the number of other inputs
    assert "earlier inputs" in solved.inner_text()


def test_the_direct_model_answers_at_once_too(open_page, server):
    page = open_page("#calculator?material=latex")
    of_paper = pressure(page)
    page.get_by_role("group", name="Model of the instant answer").get_by_text("direct").click()
    settled(page)
    question = asked()
    question["case"]["ureter"] = question["case"]["ureter"] | {"material": "latex"}
    question["case"]["method"] = {"model": "direct"}
    found = server.post("instant", question)
    assert float(pressure(page)) == near(found["answer"]["critical_pressure_kPa"])
    assert reading(page, "largest stone") == f"{found['size']['critical_diameter_mm']:.2f}"
    assert pressure(page) != of_paper
    assert page.get_by_label("Model of the finite elements").input_value() == "direct"
    assert "no urine pressure" in page.locator("figure", has_text="Section through").inner_text()
    page.wait_for_url("**direct**")
    again = open_page(page.url.split("/", 3)[3])
    assert pressure(again) == pressure(page)


def ask_for_a_long_solve(page, stone):
    """Fill in a case of the direct model that takes most of a minute."""
    page.get_by_label("Diameter across the ureter", exact=True).fill(stone)
    page.get_by_label("Wall thickness", exact=True).fill("1.7")
    page.get_by_label("Friction coefficient", exact=True).fill("0.98")
    page.get_by_label("Model of the finite elements").select_option("direct")


def test_solve_is_cancelled(page):
    ask_for_a_long_solve(page, "4.37")
    page.get_by_role("button", name="Solve").click()
    page.get_by_role("button", name="Cancel").click()
    told = page.get_by_text("The solve was cancelled.")
    told.wait_for()
    assert page.get_by_role("button", name="Solve").is_enabled()
    page.get_by_label("Pressure limit", exact=True).fill("8")
    settled(page)
    assert told.is_visible()  # the limit is no input of the solve
    page.get_by_label("Diameter across the ureter", exact=True).fill("4.36")
    settled(page)
    assert told.is_hidden()


def test_solve_is_cancelled_before_the_server_has_accepted_it(page):
    def late(route):
        time.sleep(0.5)
        route.continue_()

    page.route("**/api/v1/jobs", late)
    ask_for_a_long_solve(page, "4.39")
    page.get_by_role("button", name="Solve").dispatch_event("click")
    page.get_by_role("button", name="Cancel").dispatch_event("click")
    page.get_by_text("The solve was cancelled.").wait_for()
    assert page.get_by_role("button", name="Solve").is_enabled()


def test_command_line_repeats_the_number(page, capsys):
    text = page.get_by_label("Text that repeats the answer")
    words = shlex.split(text.inner_text())
    assert words[0] == "stonepass"
    assert run([*words[1:], "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert float(pressure(page)) == near(found[0]["critical_pressure_kPa"])
    page.get_by_role("button", name="curl").click()
    assert text.inner_text().startswith("curl")
    page.get_by_role("button", name="Case file").click()
    assert "[stone]" in text.inner_text()


def test_view_in_three_dimensions_loads_when_it_is_opened_and_turns(page, watched):
    assert not any("revolved" in url for url in watched.sizes)
    page.get_by_role("button", name="Turn it in 3-D").click()
    canvas = page.locator("canvas")
    canvas.wait_for()
    until(page, lambda: any("revolved" in url for url in watched.sizes))
    before = canvas.screenshot()
    canvas.focus()
    page.keyboard.press("ArrowRight")
    until(page, lambda: canvas.screenshot() != before)
    page.get_by_role("button", name="Show the section").click()
    assert canvas.is_hidden()


def test_definition_on_demand(page, server):
    page.get_by_role("button", name="critical pressure").first.click()
    told = page.get_by_role("dialog")
    told.wait_for()
    meaning = server.get("glossary")["critical pressure"]
    assert meaning.lower() in told.inner_text().lower()
    page.keyboard.press("Escape")
    assert told.is_hidden()


# The sum of all shifts of the layout so far.
SHIFT = """() => new Promise((resolve) => {
  let sum = 0;
  new PerformanceObserver((list) => {
    for (const each of list.getEntries()) sum += each.value;
  }).observe({type: "layout-shift", buffered: true});
  setTimeout(() => resolve(sum), 300);
})"""


def test_nothing_moves_while_loading_and_sliding(page):
    assert page.evaluate(SHIFT) < 0.01
    slider = page.get_by_label("Diameter across the ureter, slider")
    for size in ("3.2", "3.6", "4.4", "5", "5.6", "6.4", "4.2"):
        slider.fill(size)
        settled(page)
    assert page.evaluate(SHIFT) < 0.02


@pytest.mark.parametrize("late", ["**/inter.woff2", "**/js/pictures/*.js", "**/api/v1/**"])
def test_nothing_moves_when_a_part_of_the_page_arrives_late(open_page, late):
    def delay(route):
        time.sleep(0.7)
        route.continue_()

    page = open_page(prepare=lambda page: page.route(late, delay))
    assert page.evaluate(SHIFT) < 0.01


def test_first_answer_needs_few_bytes(page, watched):
    assert page.locator(ANSWERED).count() == 1
    assert len(watched.sizes) > 20  # the files of the page were counted
    assert sum(watched.sizes.values()) < 1_500_000


def test_beyond_the_closure_only_the_lower_bound_is_told(open_page):
    page = open_page("#calculator?stone=4.9mm&inner=3.5mm&thickness=0.52mm&friction=0.9&limit=6kPa")
    assert page.locator(".reading .big").count() == 1  # the largest stone alone
    assert "more than" in page.locator(".reading").first.inner_text()
    assert "this stone does not move: it needs more than" in page.locator(".verdict").inner_text()


def test_long_warning_is_shown_in_full_on_demand(open_page):
    page = open_page("#calculator?stone=4.9mm&inner=3.5mm&thickness=0.52mm")
    note = page.locator(".note[data-state=warning]").first
    assert "stretches the wall" in note.inner_text()
    text = note.locator(".note-text")
    cut = "(each) => each.scrollHeight > each.clientHeight + 1"
    assert text.evaluate(cut)
    note.get_by_role("button", name="more").click()
    assert not text.evaluate(cut)
