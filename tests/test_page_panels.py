"""The panels for a patient and for the laboratory, and the page about the model."""

from pathlib import Path

import pytest
from page_browser import SECONDS, faults_of_access, settled
from PIL import Image

EXAMPLES = Path(__file__).parents[1] / "examples"


def opened(page, name):
    page.get_by_role("tab", name=name).click()
    panel = page.get_by_role("tabpanel", name=name)
    panel.get_by_role("heading", level=1).wait_for()
    return panel


def test_patient_file_follows_the_form(page, tmp_path):
    from stonepass.clinic.patient import read_patient

    panel = opened(page, "Patient")
    panel.get_by_label("Largest diameter across the ureter", exact=True).fill("6")
    panel.get_by_label("Place in the ureter").select_option("distal")
    panel.get_by_label("was measured").uncheck()
    with page.expect_download() as saved:
        panel.get_by_role("button", name="Save patient.toml").click()
    saved.value.save_as(tmp_path / "patient.toml")
    patient = read_patient(tmp_path / "patient.toml")
    assert patient.measured["stone_diameter"].value == pytest.approx(6e-3)
    assert patient.measured["stone_diameter"].sd == pytest.approx(1e-3)
    assert (patient.place, patient.dilated, patient.limit) == ("distal", False, 6000.0)


def test_refused_measurement_is_named(page, watched):
    watched.expected = ("422",)
    panel = opened(page, "Patient")
    panel.get_by_label("Inner diameter", exact=True).first.fill("0.1 km")
    assert "assess patient.toml --html" in panel.inner_text()
    panel.get_by_label("Solve by finite elements, although").check()
    assert "assess patient.toml --solve --html" in panel.inner_text()
    panel.get_by_label("Solve by finite elements, although").uncheck()
    panel.get_by_role("button", name="Assess").click()
    panel.locator(".run-note[data-state=warning]").wait_for()
    assert "0.1 km" in panel.locator(".run-note").inner_text()


def test_assessment_is_cancelled(page):
    panel = opened(page, "Patient")
    panel.get_by_label("Largest diameter across the ureter", exact=True).fill("5.37")
    panel.get_by_role("button", name="Assess").click()
    panel.get_by_role("button", name="Cancel").click()
    panel.get_by_text("The work was cancelled.").wait_for()


def test_assessment_of_a_patient(page):
    panel = opened(page, "Patient")
    panel.get_by_role("button", name="Assess").click()
    panel.locator(".result-title").wait_for(timeout=4 * SECONDS)
    told = panel.inner_text()
    assert "the critical pressure is below the limit of 6 kPa" in told
    assert "not probabilities of passage" in told
    assert panel.locator(".reading .big").count() == 2
    assert panel.locator("figure svg").count() == 3
    assert not faults_of_access(page)
    panel.get_by_text("Published cohorts beside it").click()
    assert panel.locator("table tbody tr").count() > 5
    for kind, beginning in (("HTML", b"<!doctype html>"), ("PDF", b"%PDF")):
        with page.expect_download(timeout=SECONDS) as saved:
            panel.get_by_role("button", name=f"Report as {kind}").click()
        assert Path(saved.value.path()).read_bytes().lower().startswith(beginning.lower())


def test_fitted_wall_is_taken_over(page):
    panel = opened(page, "Laboratory")
    panel.get_by_label("Drop a CSV file").set_input_files(EXAMPLES / "latex_tensile.csv")
    panel.get_by_text("15 rows of stretch, force_N").wait_for()
    assert panel.get_by_label("Inner diameter at rest").is_hidden()
    panel.get_by_label("Width of the strip at rest").fill("10")
    panel.get_by_label("Thickness of the strip at rest").fill("1.2")
    panel.get_by_role("button", name="Fit", exact=True).click()
    use = panel.get_by_role("button", name="Use this wall in the calculator")
    use.wait_for(timeout=SECONDS)
    assert panel.locator("figure circle").count() == 15
    assert "C10" in panel.locator("table").inner_text()
    assert not faults_of_access(page)
    use.click()
    settled(page)
    assert page.get_by_label("Material of the wall").first.input_value() == "latex"
    # C10 of the fit is 146 kPa, that of the material 146.5 kPa
    stiffness = page.get_by_label("Stiffness, multiple of the material", exact=True).first
    assert float(stiffness.input_value()) == pytest.approx(1.0, abs=0.02)
    assert page.locator(".reading .big").count() == 2


def test_wall_with_constants_of_its_own_is_solved_and_linked(page):
    panel = opened(page, "Laboratory")
    panel.get_by_label("Drop a CSV file").set_input_files(EXAMPLES / "ureter_tensile.csv")
    panel.get_by_text("24 rows").wait_for()
    panel.get_by_label("Material law").select_option("fung")
    panel.get_by_label("Known constants").fill("G = 12 kPa, a1122 = 0.1856")
    panel.get_by_role("button", name="Fit", exact=True).click()
    use = panel.get_by_role("button", name="Use this wall in the calculator")
    use.wait_for(timeout=SECONDS)
    use.click()
    settled(page)
    assert page.locator(".reading .big").count() == 0  # no surrogate has these constants
    page.reload()
    settled(page)
    assert '"law":"fung"' in page.get_by_label("Material of the wall").first.input_value()
    page.get_by_role("button", name="Solve").click()
    page.locator(".reading.solve .big").wait_for(timeout=SECONDS)
    # the wall of the material 'ureter', which these data resemble, needs 11.0 kPa
    assert float(page.locator(".reading.solve .big").inner_text()) == pytest.approx(11.0, rel=0.05)


def test_fit_without_sizes_is_refused_in_words(page, watched):
    watched.expected = ("422",)
    panel = opened(page, "Laboratory")
    panel.get_by_role("button", name="Fit", exact=True).click()
    panel.get_by_text("Choose a CSV file first.").wait_for()
    panel.get_by_label("Drop a CSV file").set_input_files(EXAMPLES / "latex_tensile.csv")
    panel.get_by_text("15 rows of stretch, force_N").wait_for()
    panel.get_by_role("button", name="Fit", exact=True).click()
    panel.locator(".run-note[data-state=warning]").first.wait_for(timeout=SECONDS)


def test_damaged_table_is_refused_in_words(page, watched, tmp_path):
    watched.expected = ("422",)
    (tmp_path / "damaged.csv").write_bytes(b"\x00\x01 no table")
    panel = opened(page, "Laboratory")
    panel.get_by_label("Drop a CSV file").set_input_files(tmp_path / "damaged.csv")
    said = panel.locator(".chosen").first
    panel.get_by_text("is being read").wait_for(state="detached")
    assert len(said.inner_text()) > 10
    assert str(tmp_path) not in said.inner_text()


def test_friction_with_a_path_moved_by_keys_is_taken_over(page):
    panel = opened(page, "Laboratory")
    panel.get_by_label("Drop a micrograph").set_input_files(EXAMPLES / "known_slopes.png")
    panel.get_by_text("1001 × 240 pixels").wait_for()
    panel.get_by_label("Size of a pixel").fill("0.5")
    panel.get_by_label("Height", exact=True).fill("24.8")
    handle = panel.locator("[data-path='0'][data-end='0']")
    assert panel.locator(".handle").count() == 12
    handle.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowDown")
    assert "at x 10, y 30" in panel.locator("[data-path='0'][data-end='0']").get_attribute(
        "aria-label"
    )
    panel.locator("[data-path='5'][data-end='0']").focus()
    page.keyboard.press("Delete")
    assert panel.locator(".handle").count() == 10
    panel.get_by_role("button", name="Estimate the friction").click()
    use = panel.get_by_role("button", name="Use this friction in the calculator")
    use.wait_for(timeout=SECONDS)
    shown = float(panel.locator(".reading .big").inner_text())
    assert shown == pytest.approx(0.52, abs=0.02)  # the slopes 0.38 and 0.12 of the picture
    assert "of 5 paths" in panel.inner_text()
    assert not faults_of_access(page)
    use.click()
    settled(page)
    assert float(page.get_by_label("Friction coefficient", exact=True).first.input_value()) == shown


def test_coloured_scale_bar_is_left_out_by_the_area(page, watched, tmp_path):
    watched.expected = ("422",)
    with Image.open(EXAMPLES / "known_slopes.png") as image:
        picture = image.convert("RGB")
    picture.putpixel((500, 235), (255, 0, 0))
    picture.save(tmp_path / "scale.png")
    panel = opened(page, "Laboratory")
    panel.get_by_label("Drop a micrograph").set_input_files(tmp_path / "scale.png")
    panel.get_by_text("is coloured; select 'area' 0,0,1001,235.").wait_for()
    area = panel.get_by_label("Area that shows the surface")
    area.fill("0,0,1001")
    area.press("Tab")
    panel.get_by_text("but must be four whole numbers").wait_for()
    area.fill("0,0,1001,235")
    area.press("Tab")
    panel.get_by_text("1001 × 240 pixels").wait_for()
    last = panel.locator("[data-path='5'][data-end='1']").get_attribute("aria-label")
    assert "at x 1000, y 215" in last


def test_path_is_moved_with_the_mouse(page):
    panel = opened(page, "Laboratory")
    panel.get_by_label("Drop a micrograph").set_input_files(EXAMPLES / "known_slopes.png")
    handle = panel.locator("[data-path='2'][data-end='1']")
    handle.wait_for()
    handle.scroll_into_view_if_needed()
    box = handle.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 200, y + 10, steps=4)
    page.mouse.up()
    moved = panel.locator("[data-path='2'][data-end='1']").bounding_box()
    assert moved["x"] == pytest.approx(box["x"] - 200, abs=8)


def test_about_tells_limits_words_and_sources(page, server):
    panel = opened(page, "About")
    told = panel.inner_text()
    assert "whether or when a stone passes" in told.lower()
    for each in server.get("pressure-limits"):
        assert each["source"][:30] in told
    assert panel.locator("dt").count() == len(server.get("glossary"))
