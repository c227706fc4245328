"""Tests of the page in a browser (headless Chromium, driven by its WebDriver): sorting, filtering, opening a cell, widths."""
import shutil
import time

import pytest

from ulpgate_report.app import cli
from ulpgate_report.testing import sample_records

CHROMIUM = shutil.which("chromium")
DRIVER = shutil.which("chromedriver")
FLAGS = (
    "--headless=new",
    # Root has no sandbox, and containers little shared memory.
    "--no-sandbox",
    "--disable-dev-shm-usage",
    "--disable-gpu",
)


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    base = tmp_path_factory.mktemp("browser")
    context = sample_records.context(["sin", "exp", "fmod", "ctan"])
    math = sample_records.math_records(context)
    timing = sample_records.timing_records(context)
    run = sample_records.write(base / "run", context, math, timing)
    assert cli.main([str(run), "--out", str(base / "out")]) == 0
    return (base / "out/index.html").as_uri()


@pytest.fixture(scope="module")
def chromium(tmp_path_factory):
    webdriver = pytest.importorskip("selenium.webdriver")
    if CHROMIUM is None or DRIVER is None:
        pytest.skip("no Chromium with its WebDriver: scripts/setup --browser")
    options = webdriver.ChromeOptions()
    options.binary_location = CHROMIUM
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('profile')}"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.chrome.service.Service(DRIVER)
    driver = webdriver.Chrome(service=service, options=options)
    yield driver
    driver.quit()


@pytest.fixture
def browser(chromium, page):
    chromium.get(page)
    yield chromium
    # Of its own accord Chromium notes there that an address with a fragment keeps it from focusing the filter.
    said = [one for one in chromium.get_log("browser") if one["source"] != "rendering"]
    assert said == [], "the console stays empty"


def texts(browser, selector):
    script = "return [...document.querySelectorAll(arguments[0])].filter(e => e.offsetParent).map(e => e.innerText.trim())"
    return browser.execute_script(script, selector)


def test_a_column_sorts_up_and_down(browser):
    column = "#ulp_matrix tbody td:nth-child(2)"
    head = browser.find_element("css selector", "#ulp_matrix th:nth-child(2) button")
    before = texts(browser, column)
    head.click()
    up = texts(browser, column)
    head.click()
    down = texts(browser, column)
    values = [float(text.split()[0]) for text in up]
    assert values == sorted(values) and sorted(up) == sorted(before)
    assert [float(text.split()[0]) for text in down] == sorted(values, reverse=True)


def test_the_filter_leaves_what_is_asked_for(browser):
    names = "#ulp_matrix tbody td:first-child code"
    assert len(texts(browser, names)) > 2
    browser.find_element("id", "filter").send_keys("fmod")
    count = browser.find_element("id", "count")
    wait_until(lambda: "of" in count.text)
    assert texts(browser, names) == ["fmod"]
    browser.find_element("id", "filter").clear()


def wait_until(true, seconds=5):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end
        time.sleep(0.05)


def test_the_first_distribution_is_one_of_the_largest_errors(browser):
    # A bucket has a quarter of an octave: 113 ULP and 118 ULP are in the same.
    worst = texts(browser, "#worst_table td:first-child code")[:3]
    assert browser.find_element("id", "row").get_property("value") in worst


def test_a_cell_opens_and_leads_to_its_distribution(browser):
    row = "//table[@id='ulp_matrix']//tr[td[1]/code='exp']/td[2]/button"
    browser.find_element("xpath", row).click()
    dialog = browser.find_element("id", "cell")
    assert dialog.is_displayed() and dialog.text.startswith("exp, ")
    command = browser.find_element("id", "cell-command").text
    assert command.startswith("ulpgate at exp ")
    browser.find_element("id", "cell-copy").click()
    selected = browser.execute_script("return window.getSelection().toString()")
    assert selected.strip() == command
    browser.find_element("id", "cell-distribution").click()
    assert not dialog.is_displayed()
    assert browser.find_element("id", "row").get_property("value") == "exp"


def test_keys_open_and_close_a_cell(browser):
    from selenium.webdriver.common.keys import Keys

    cell = browser.find_element("css selector", "#ulp_matrix button.cell")
    cell.send_keys(Keys.ENTER)
    dialog = browser.find_element("id", "cell")
    assert dialog.is_displayed()
    browser.switch_to.active_element.send_keys(Keys.ESCAPE)
    wait_until(lambda: not dialog.is_displayed())


def test_a_row_has_a_link_that_leads_to_it(browser, page):
    link = browser.find_element(
        "xpath", "//table[@id='ulp_table']//tr[td[1]/code='fmod'][1]//a"
    )
    address = link.get_property("href")
    browser.get("about:blank")
    browser.get(address)
    target = browser.execute_script("return document.querySelector(':target').id")
    assert target.startswith("ulp_table.fmod")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [360, 800, 1400])
def test_nothing_overflows(browser, width, scheme):
    metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    feature = {"name": "prefers-color-scheme", "value": scheme}
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [feature]})
    wide = "return document.documentElement.scrollWidth"
    assert browser.execute_script(wide) <= width
    # The names stay where they are while their numbers are scrolled.
    left = """
const box = document.querySelector('#long_table').closest('.scroll');
box.closest('details').open = true;
box.scrollLeft = 200;
return document.querySelector('#long_table td').getBoundingClientRect().left - box.getBoundingClientRect().left"""
    assert 0 <= browser.execute_script(left) < 4
    # Short ones are not broken.
    broken = """
const lines = (e) => {
  const all = document.createRange();
  all.selectNodeContents(e);
  return all.getClientRects().length;
};
return [...document.querySelectorAll('.data td:first-child code')].filter(
  (e) => e.textContent.length < 15 && lines(e) > 1).map((e) => e.textContent)"""
    assert browser.execute_script(broken) == []
    # A long one leaves room for them.
    name = """
const cell = document.querySelector('#long_table td');
cell.querySelector('code').textContent = 'problem/integrator_to_17.0652165601579'.repeat(2);
return cell.getBoundingClientRect().width"""
    assert width > 640 or browser.execute_script(name) <= width / 2
    # Figures fill the width of a screen; on a phone they are scrolled instead of made illegible.
    sizes = """
return [...document.querySelectorAll('.paper')].map(
  (e) => [e.clientWidth, e.querySelector('svg').getBoundingClientRect().width])"""
    for room, figure in browser.execute_script(sizes):
        assert figure == pytest.approx(max(room - 16, 576), abs=2)
    back = "return getComputedStyle(document.body).backgroundColor"
    light = browser.execute_script(back) == "rgb(255, 255, 255)"
    assert light == (scheme == "light")
