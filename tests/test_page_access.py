"""Keyboard, screen reader, phone, print, dark theme, and the policy of the page."""

import re
from pathlib import Path
from urllib.request import urlopen

import pytest
from page_browser import faults_of_access, settled

from stonepass import web

SCRIPTS = Path(web.__file__).parent / "page" / "js"
PANELS = ("calculator", "patient", "laboratory", "about")


def visit(page, panel):
    """Open a panel by its address, as the browser does when a link is followed."""
    page.evaluate("(panel) => { location.hash = panel; }", panel)
    page.get_by_role("tabpanel", name=panel.capitalize()).wait_for()
    page.get_by_role("tabpanel").get_by_role("heading", level=1).wait_for()


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_axe_finds_nothing_serious(open_page, theme):
    page = open_page(color_scheme=theme)
    for panel in PANELS:
        visit(page, panel)
        page.wait_for_timeout(150)
        faults = faults_of_access(page)
        assert not faults, "\n".join([panel, *faults])


def test_dark_theme_follows_the_system_and_the_choice(open_page):
    ground = "() => getComputedStyle(document.documentElement).backgroundColor"
    page = open_page(color_scheme="dark")
    dark = page.evaluate(ground)
    assert sum(map(int, dark[4:-1].split(","))) < 120
    button = page.get_by_role("button", name="Dark theme")
    assert button.get_attribute("aria-pressed") == "true"
    button.click()
    assert page.evaluate(ground) != dark
    page.reload()
    assert page.evaluate(ground) != dark  # the choice is remembered


@pytest.mark.parametrize("width", [360, 768, 1280, 1920])
def test_no_panel_is_wider_than_the_screen(open_page, width):
    page = open_page(viewport={"width": width, "height": 800})
    for panel in PANELS:
        visit(page, panel)
        assert page.evaluate("document.documentElement.scrollWidth") <= width, panel


@pytest.mark.parametrize("panel", PANELS)
def test_a_panel_is_opened_by_its_address(open_page, panel):
    page = open_page(f"#{panel}")
    page.get_by_role("tabpanel", name=panel.capitalize()).wait_for()
    page.get_by_role("tabpanel").get_by_role("heading", level=1).wait_for()


def test_phone_keeps_the_answer_in_view(open_page):
    page = open_page(
        viewport={"width": 360, "height": 740}, is_mobile=True, has_touch=True,
        device_scale_factor=2,
    )  # fmt: skip
    slider = page.get_by_label("Diameter across the ureter, slider")
    slider.scroll_into_view_if_needed()
    page.locator(".pictures").scroll_into_view_if_needed()
    pinned = page.locator(".pinned")
    pinned.wait_for()
    before = pinned.inner_text()
    slider.fill("3.8")
    settled(page)
    assert pinned.inner_text() != before
    small = page.evaluate("""() => [...document.querySelectorAll("button, select, input")]
      .filter((each) => each.offsetParent && !each.matches(".term, [type=range]"))
      .filter((each) => each.closest(".box, button, select, .check").getBoundingClientRect().height < 40)
      .map((each) => each.outerHTML.slice(0, 120))""")
    assert not small, small


def focused(page):
    return page.evaluate("""() => {
      const each = document.activeElement;
      return each.getAttribute("aria-label") || each.labels?.[0]?.textContent || each.textContent;
    }""")


def press_until(page, words, most=60):
    """Press Tab until an element with these words has the focus."""
    passed = []
    for _ in range(most):
        page.keyboard.press("Tab")
        passed.append(focused(page).strip())
        if words in passed[-1]:
            return
    raise AssertionError(f"the keyboard does not reach '{words}': {passed}")


def test_calculator_by_the_keyboard_alone(page):
    page.keyboard.press("Tab")
    assert focused(page) == "Skip to the content"
    page.keyboard.press("Tab")
    page.keyboard.press("Tab")
    assert focused(page) == "Calculator"
    page.keyboard.press("ArrowRight")
    assert focused(page) == "Patient"
    assert page.get_by_role("tab", name="Patient").get_attribute("aria-selected") == "true"
    page.keyboard.press("ArrowLeft")
    before = page.locator(".reading .big").first.inner_text()
    press_until(page, "Diameter across the ureter")
    page.keyboard.press("ArrowDown")
    settled(page)
    assert page.get_by_label("Diameter across the ureter", exact=True).input_value() == "4.15"
    press_until(page, "Diameter across the ureter, slider")
    page.keyboard.press("ArrowLeft")
    settled(page)
    after = page.locator(".reading .big").first.inner_text()
    assert float(after) < float(before)
    press_until(page, "friction coefficient".capitalize())
    page.keyboard.press("Enter")
    page.get_by_role("dialog").wait_for()
    page.keyboard.press("Escape")
    press_until(page, "Turn it in 3-D")
    page.keyboard.press("Enter")
    page.locator("canvas").wait_for()
    press_until(page, "Copy the link")


def test_every_focus_is_visible(page):
    hidden = []
    for _ in range(40):
        page.keyboard.press("Tab")
        found = page.evaluate("""() => {
          const each = document.activeElement;
          const frame = each.closest(".box") ?? each;
          const style = getComputedStyle(frame);
          const ring = style.outlineStyle !== "none" || style.boxShadow !== "none";
          return ring ? "" : each.outerHTML.slice(0, 120);
        }""")
        if found:
            hidden.append(found)
    assert not hidden, hidden


def test_printed_page_has_inputs_answer_and_notice_without_controls(page):
    page.emulate_media(media="print")
    assert page.locator(".inputs").is_hidden()
    assert page.locator(".tabs").is_hidden()
    printed = page.locator("#panel-calculator").inner_text()
    assert "4.20 mm across" in printed
    assert "Fingerprint" in printed or "fingerprint" in printed
    assert "Research use only. Not a medical device." in page.locator("body").inner_text()
    assert page.locator("figure svg").count() == 3
    document = page.pdf()
    assert document.startswith(b"%PDF")


def imported(module, found):
    """Add a module and all that it imports at once, in this order."""
    if module in found:
        return
    found.append(module)
    for name in re.findall(r'^import [^;]*?from "(\.[^"]+)";', module.read_text("utf-8"), re.M):
        imported((module.parent / name).resolve(), found)


def test_modules_of_the_first_answer_are_loaded_together():
    found = []
    imported(SCRIPTS / "main.js", found)
    expected = [f"/assets/js/{each.relative_to(SCRIPTS).as_posix()}" for each in found[1:]]
    page = (SCRIPTS.parent / "index.html").read_text("utf-8")
    assert len(expected) > 15
    assert re.findall(r'rel="modulepreload" href="([^"]+)"', page) == expected


def test_policy_is_strict(server):
    with urlopen(server.address) as answer:
        policy = answer.headers["content-security-policy"]
        page = answer.read().decode()
    assert "unsafe" not in policy
    for rule in ("default-src 'none'", "script-src 'self'", "style-src 'self'"):
        assert rule in policy
    assert "<style" not in page
    assert " style=" not in page
    assert "onclick" not in page


def test_links_of_other_panels_are_opened(open_page):
    page = open_page("#laboratory")
    assert page.get_by_role("tab", name="Laboratory").get_attribute("aria-selected") == "true"
    page.get_by_role("tab", name="Calculator").click()
    page.go_back()
    page.get_by_role("tabpanel", name="Laboratory").wait_for()
