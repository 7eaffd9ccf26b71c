#!/usr/bin/env python3
"""Opens the site in a headless Chromium, from local files, and looks for what a reader would trip over:
broken links and pictures, formulas left raw, figures that do not follow the page's colours, a search that finds nothing,
errors in the console, requests to a network, text wider than a phone. Prints a line per fault; exit code 77: no browser.

Run: browse.py SITE
Every page is opened, in two widths and both modes. What is dear and alike on all of them (paper, listings at other widths,
a drawing's steps in a wide window and without scripts) is looked at on some; BROWSE=all: on each."""

import html
import os
import pathlib
import re
import sys
import urllib.parse

from chromium import Chromium, fault, finish

chromium = Chromium()
from selenium.webdriver.common.by import By  # noqa: E402  which is there now
from selenium.webdriver.common.keys import Keys  # noqa: E402

site = pathlib.Path(sys.argv[1]).resolve()
everything = os.environ.get("BROWSE") == "all"
script = re.compile(r"(<script\b[^>]*>).*?(?=</script>)|<!--.*?-->", re.DOTALL)
tag = re.compile(r"<([a-zA-Z][\w-]*)(\s[^>]*)>")
attribute = re.compile(r"""\s(id|name|href|src|data|xmlns)=(?:"([^"]*)"|'([^']*)')""")


class Page:
    """The ids of a page, and what it links to and loads. Sixty megabytes take html.parser a quarter of a minute."""

    def __init__(self, text):
        self.ids, self.twice, self.links, self.parts = set(), set(), set(), set()
        for kind, rest in tag.findall(script.sub(r"\1", text)):
            attributes = {name: html.unescape(one or other) for name, one, other in attribute.findall(rest)}
            name = attributes.get("id")
            if name is not None:
                (self.twice if name in self.ids else self.ids).add(name)
            if kind == "a":
                self.ids.add(attributes.get("name"))
                if "href" in attributes:
                    self.links.add(attributes["href"])
            elif "src" in attributes or (kind in ("link", "object") and "xmlns" not in attributes):
                self.parts.add(attributes.get("src") or attributes.get("href") or attributes.get("data") or "")


# Pages of the code are Doxygen's; their links are checked too, but they are not opened one by one.
code = re.compile(r"(class|struct|concept|namespace|union|functions|dir_|globals|annotated|files|hierarchy|concepts).*|.*_8.*")
files = {file.relative_to(site).as_posix() for file in site.rglob("*")}
pages = {name: Page((site / name).read_text()) for name in sorted(files) if re.fullmatch(r"[^/]*\.html", name)}
book = [name for name in pages if not code.fullmatch(name.removesuffix(".html"))]
for needed in ("index.html", "exercises.html", "figures.html", "ledger.html"):
    if needed not in book:
        fault(needed, "is missing")

for name, page in pages.items():
    for link in page.links:
        target = urllib.parse.urlsplit(link)
        if target.scheme in ("http", "https", "javascript", "mailto") or link == "":
            continue
        file = urllib.parse.unquote(target.path) or name
        anchor = urllib.parse.unquote(target.fragment)
        if file not in files:
            fault(name, f"links to {link}, which is not there")
        elif anchor and file in pages and anchor not in pages[file].ids:
            fault(name, f"links to {link}: no such anchor")
    for part in page.parts:
        if urllib.parse.urlsplit(part).scheme not in ("", "data") or not (part.startswith("data:") or part in files):
            fault(name, f"needs {part}, which is not in the site")
    for twice in page.twice & page.ids if name in book else ():
        fault(name, f"has two elements with the id {twice}")

run, look_at_logs = chromium.run, chromium.look_at_logs


def wait(expression):  # where nothing is wrong it takes a moment, on a machine with other work some seconds
    return chromium.wait(expression, 60)


def window(width, mode="light", media=""):
    chromium.window(width, 844 if width < 500 else 900, mode, media)


def open_page(name):
    chromium.open(site / name)
    if not wait("document.documentElement.classList.contains('formulas-shown')"):
        fault(name, "formulas were never shown")


# What of ELEMENTS sticks out of the window and cannot be scrolled to in a box of its own.
sticking_out = """
    const width = document.documentElement.clientWidth, wide = [];
    if (document.documentElement.scrollWidth > width) wide.push("the page itself");
    for (const element of ELEMENTS) {
        if (element.getClientRects().length === 0 || element.closest("svg svg, .sm")) continue;
        if (element.getBoundingClientRect().right <= width + 1) continue;
        let box = element.parentElement;
        while (!box.matches(".contents, .header") && !/auto|scroll|hidden/.test(getComputedStyle(box).overflowX)) box = box.parentElement;
        if (box.matches(".contents, .header")) wide.push(element.outerHTML.slice(0, 100));
    }
    return wide.slice(0, 3);"""
raw_formulas = r"""
    const texts = document.createTreeWalker(document.querySelector(".contents"), NodeFilter.SHOW_TEXT), raw = [];
    while (texts.nextNode())
        if (/\\[(\[]|\\f\$|\*\*/.test(texts.currentNode.data) && !texts.currentNode.parentElement.closest("code, pre, script, .fragment"))
            raw.push(texts.currentNode.data.slice(0, 80));
    return raw;"""

# Text that stands less than 4.5 : 1 against what is under it (WCAG 2.1, level AA); large text and what is switched off
# are held to it, too, but for disabled buttons. A drawing's text is measured against its paper.
pale = """
    const numbers = (color) => { const c = color.match(/[\\d.]+/g).map(Number); return [c[0], c[1], c[2], c[3] ?? 1]; };
    const over = (top, under) => [0, 1, 2].map((i) => top[3] * top[i] + (1 - top[3]) * under[i]).concat(1);
    const backgrounds = new Map([[null, [255, 255, 255, 1]]]);
    const background = (element) => {
        if (!backgrounds.has(element)) {
            const own = numbers(getComputedStyle(element).backgroundColor);
            backgrounds.set(element, own[3] === 1 ? own : over(own, background(element.parentElement)));
        }
        return backgrounds.get(element);
    };
    const luminance = (color) => color.slice(0, 3).map((c) => c / 255).map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
        .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), found = new Map();
    let measured = 0;
    while (texts.nextNode()) {
        const element = texts.currentNode.parentElement, style = getComputedStyle(element);
        if (!texts.currentNode.data.trim() || !element.getClientRects().length || style.visibility !== "visible") continue;
        if (element.closest("script, style, title, desc, :disabled")) continue;
        const drawn = element.closest("svg.book-figure");
        const under = background(drawn ? drawn.parentElement : element);
        const ink = over(numbers(drawn ? style.fill : style.color), under);
        const [low, high] = [luminance(ink), luminance(under)].sort((a, b) => a - b), contrast = (high + 0.05) / (low + 0.05);
        measured += 1;
        if (contrast < 4.5) found.set(ink + " on " + under, contrast.toFixed(2) + " " + element.className + " " + texts.currentNode.data.trim().slice(0, 30));
    }
    return {measured, found: [...found].map(([colours, what]) => what + ": " + colours).slice(0, 5)};"""

printed = """
    const shown = (selector) => [...document.querySelectorAll(selector)].filter((e) => e.getClientRects().length).length;
    return {mode: document.documentElement.className.match(/(light|dark)-mode/)[0], paper: getComputedStyle(document.body).backgroundColor,
            pressed: shown("#top *, #side-nav *, .toc, .step-bar, doxygen-awesome-fragment-copy-button"),
            hidden: [...document.querySelectorAll("ol.steps li")].filter((e) => getComputedStyle(e).visibility !== "visible").length,
            scrolled: [...document.querySelectorAll(".fragment, .scroll, .formulaDsp, .line")].filter(
                (e) => /auto|scroll/.test(getComputedStyle(e).overflowX)).length};"""

samples = [name for name in pages if re.match(r"(struct|class)", name) and "-members" not in name][:2] + \
          [name for name in ("annotated.html", "files.html") if name in pages]
formulas = drawings = texts = 0


def look_at_page(name, width, mode):
    global texts
    for wide in run(sticking_out.replace("ELEMENTS", "document.querySelectorAll('.contents *, .header *')")) if name in book else ():
        fault(name, f"at {width} px sticks out: {wide}")
    contrasts = run(pale)
    texts += contrasts["measured"]
    for text in contrasts["found"]:
        fault(name, f"in {mode} mode is hard to read: {text}")


def look_at_paper(name):
    """From a dark page: light colours; nothing to press, nothing that scrolls, every sentence of the steps."""
    window(1280, "dark", "print")
    if not wait("document.documentElement.classList.contains('light-mode')"):
        fault(name, "is printed dark")
    on_paper = run(printed)
    if on_paper != dict(mode="light-mode", paper="rgb(255, 255, 255)", pressed=0, hidden=0, scrolled=0):
        fault(name, f"on paper: {on_paper}")
    for text in run(pale)["found"]:
        fault(name, f"on paper is hard to read: {text}")
    window(1280, "dark")
    if not wait("document.documentElement.classList.contains('dark-mode')"):
        fault(name, "is not dark again after printing")


def look_at_listings(name):
    """On laptops and wider screens every line of a chapter's code can be read without scrolling."""
    if not run("return document.querySelectorAll('.textblock .fragment').length"):
        return
    for width in (1280, 1100, 1450, 1920):
        window(width)
        cut = run("return [...document.querySelectorAll('.textblock .fragment')].filter((f) => f.scrollWidth > f.clientWidth).length")
        if cut:
            fault(name, f"at {width} px {cut} listings are cut")


# Drawings with steps: every step by its button and by its key shows its own groups and its own sentence (back again on a
# phone alone), and nothing sticks out. Keys move the drawing in view, and no other.
walk = """
    const list = document.querySelectorAll("ol.steps")[NUMBER], bar = list.previousElementSibling;
    const drawing = bar.previousElementSibling, seen = (element) => getComputedStyle(element).visibility === "visible";
    const sticking = () => {STICKING_OUT};
    // What sticks out at a step is looked for on the way forth, where each step is first seen.
    const look = (first_seen = false) => ({tells: [...list.children].filter(seen).map((item) => item.textContent),
            groups: [...drawing.querySelectorAll("[data-first]")].map((group) => group.getAttribute("display") !== "none"),
            buttons: [...bar.querySelectorAll("button")].map((button) => !button.disabled),
            count: bar.querySelector("output").textContent,
            height: list.getBoundingClientRect().bottom - drawing.getBoundingClientRect().top, wide: first_seen ? sticking() : []});
    const [first, back, forth, last] = bar.querySelectorAll("button");
    const press = (button) => { button.click(); return look(button === forth); }, seconds = [...list.children].slice(1);
    return {start: look(true), next: seconds.map(() => press(forth)), back: BACK_AGAIN ? seconds.map(() => press(back)).reverse() : [],
            last: press(last), first: press(first)};
    """.replace("STICKING_OUT", sticking_out.replace("ELEMENTS", "list.parentElement.querySelectorAll('*')"))
state = "const list = document.querySelectorAll('ol.steps')[NUMBER], bar = list.previousElementSibling;" \
        "return [bar.querySelector('output').textContent, [...list.children].findIndex((e) => getComputedStyle(e).visibility === 'visible')];"
static = """
    const list = document.querySelectorAll("ol.steps")[NUMBER], drawing = list.previousElementSibling;
    return {tells: list.children.length, bar: !!document.querySelector(".step-bar"),
            shown: [...drawing.querySelectorAll("[data-first]")].map((group) => getComputedStyle(group).display !== "none"),
            lasts: [...drawing.querySelectorAll("[data-first]")].map((group) => group.dataset.last === undefined)};"""
to_the_middle = """
    document.activeElement.blur();
    document.querySelectorAll("ol.steps")[NUMBER].parentElement.scrollIntoView({block: "center", behavior: "instant"});"""
steps_walked = 0


def drawings_with_steps(name):
    """Of each: its groups with their first and last steps, and what each step tells."""
    parts = (site / name).read_text().split('<ol class="steps">')
    for before, after in zip(parts, parts[1:]):
        drawing = before[before.rindex("<svg "):]
        yield ([(int(first), int(last) if last else None)
                for first, last in re.findall(r'<g data-first="(\d+)"(?: data-last="(\d+)")?', drawing)],
               [html.unescape(sentence) for sentence in re.findall(r"<li>(.*?)</li>", after.split("</ol>")[0])])


def walk_steps(name, width, number, groups, tells):
    """The drawing of that number on the page that stands, from its first step back to its first."""
    global steps_walked
    last = len(tells) - 1
    script = lambda text: run(text.replace("NUMBER", str(number)))
    if last < 1 or any(first > last or (end is not None and end < first) for first, end in groups):
        fault(name, f"a drawing's steps are none: {groups}")

    def look(now, step, how):
        expected = [first <= step and (end is None or step <= end) for first, end in groups]
        if now["groups"] != expected:
            fault(name, f"step {step} by {how} shows other groups than its own")
        if now["tells"] != [tells[step]]:
            fault(name, f"step {step} by {how} tells {now['tells']}")
        if now["buttons"] != [step > 0, step > 0, step < last, step < last] or now["count"] != f"{step + 1} of {last + 1}":
            fault(name, f"step {step} by {how}: its buttons are {now['buttons']}, {now['count']}")
        for wide in now["wide"]:
            fault(name, f"at {width} px, step {step}, sticks out: {wide}")

    walked = script(walk.replace("BACK_AGAIN", "true" if width < 500 else "false"))
    look(walked["start"], 0, "loading")
    for step in range(1, last + 1):
        look(walked["next"][step - 1], step, "Next")
        if walked["back"]:
            look(walked["back"][step - 1], step - 1, "Back")
        steps_walked += 1
    look(walked["last"], last, "Last")
    look(walked["first"], 0, "First")
    places = [now["height"] for now in [walked["start"], *walked["next"]]]
    if max(places) - min(places) > 1:
        fault(name, f"at {width} px the page below jumps from step to step: {sorted(places)}")
    # By hand: the button Next, then keys.
    script(to_the_middle)
    buttons = chromium.driver.find_elements(By.CSS_SELECTOR, ".step-bar")[number].find_elements(By.TAG_NAME, "button")
    buttons[2].click()
    run("document.activeElement.blur()")
    body = chromium.driver.find_element(By.TAG_NAME, "body")
    for key, step in ((None, 1), (Keys.ARROW_RIGHT, 2), (Keys.ARROW_LEFT, 1)):
        if key:
            body.send_keys(key)
        if script(state) != [f"{step + 1} of {last + 1}", step]:
            fault(name, f"a hand's press shows {script(state)}, not step {step}")
    counts = run("return [...document.querySelectorAll('.step-bar output')].map((output) => output.textContent[0])")
    if counts != ["2" if i == number else "1" for i in range(len(counts))]:
        fault(name, f"keys move another drawing than number {number}, which is in the middle: {counts}")
    buttons[0].click()


# A phone in the dark and a wide window by day: the page that stands follows, as it does on a desk. Every other page is
# opened in the window of the one before, and so the other way round.
views = [(390, "dark"), (1280, "light")]
for place, name in enumerate(book + samples):
    stepped = list(drawings_with_steps(name))
    for i, (width, mode) in enumerate(views if place % 2 == 0 else reversed(views)):
        window(width, mode)
        if i == 0:
            open_page(name)
        elif not wait(f"document.documentElement.classList.contains('{mode}-mode')"):
            fault(name, f"does not follow a system that turns {mode}")
        look_at_page(name, width, mode)
        for number, drawing in enumerate(stepped):
            # The gallery has the drawings of all chapters once more.
            if everything or (number == 0 if name == "figures.html" else width < 500 or number % 2 == 0):
                walk_steps(name, width, number, *drawing)
        if name in book and name.startswith("ch"):
            if mode == "dark" and (everything or place % 4 == 0):
                look_at_paper(name)
            if mode == "light" and (everything or place % 4 == 2):
                look_at_listings(name)
    for raw in run(raw_formulas):
        fault(name, f"a formula is left raw: {raw}")
    for image in run("return [...document.images].filter(i => !i.complete || !i.naturalWidth).map(i => i.src)"):
        fault(name, f"a picture does not show: {image}")
    formulas += run("return document.querySelectorAll('.MathJax_SVG svg').length")
    drawings += run("return document.querySelectorAll('svg.book-figure').length")
    look_at_logs(name)
if "ch03_step_by_step.html" in book and not steps_walked:
    fault("ch03_step_by_step.html", "has no steps")

# The switch between light and dark: the page and its drawings change, and change back, whatever the system prefers.
colours = """
    const shape = document.querySelector("svg.book-figure text, svg.book-figure [stroke]:not([stroke=none])");
    const style = shape ? getComputedStyle(shape) : {fill: 0, stroke: 0};
    return [document.documentElement.className.match(/(light|dark)-mode/)[0], getComputedStyle(document.body).backgroundColor,
            style.fill + " " + style.stroke];"""
with_drawing = next((name for name in book if "book-figure" in (site / name).read_text()), None)
for system in ("light", "dark"):
    window(1280, system)
    open_page(with_drawing or "index.html")
    before = run(colours)
    if before[0] != system + "-mode":
        fault("dark mode", f"a {system} system gets {before[0]}")
    chromium.driver.find_element(By.TAG_NAME, "doxygen-awesome-dark-mode-toggle").click()
    after = run(colours)
    for what, old, new in zip(("mode", "page", "drawing"), before, after):
        if old == new and (what != "drawing" or with_drawing):
            fault("dark mode", f"the switch does not change the {what}: {old}")
    chromium.driver.find_element(By.TAG_NAME, "doxygen-awesome-dark-mode-toggle").click()
    if run(colours) != before:
        fault("dark mode", "switching twice does not come back")

# By keyboard: from the search field on comes the switch, which a key turns, and never a box that nobody sees.
window(1280)
open_page("index.html")
chromium.driver.find_element(By.ID, "MSearchField").send_keys(Keys.TAB)
switch = chromium.driver.switch_to.active_element
if switch.tag_name != "doxygen-awesome-dark-mode-toggle" or not switch.get_attribute("aria-label"):
    fault("keyboard", f"after the search field comes {switch.tag_name} {switch.get_attribute('id')}")
else:
    for key, mode in ((" ", "true"), (Keys.ENTER, "false")):
        switch.send_keys(key)
        if switch.get_attribute("aria-checked") != mode:
            fault("keyboard", f"the switch is {switch.get_attribute('aria-checked')} after a key that makes it {mode}")
if run("return document.getElementById('main-menu-state')?.getClientRects().length"):
    fault("keyboard", "the phone's menu box is in the way")

# The menu: a phone's marks the page, and without scripts there is one, too.
window(390)
open_page("exercises.html")
if run("return [...document.querySelectorAll('#main-menu a[aria-current=page]')].map((a) => a.textContent)") != ["Exercises"]:
    fault("menu", "a phone's does not mark the page")
chromium.command("Emulation.setScriptExecutionDisabled", value=True)
for width in (390, 1280):
    window(width)
    chromium.open(site / "exercises.html")
    names = run("return [...document.querySelectorAll('.plain-menu a')].filter((a) => a.getClientRects().length).map((a) => a.textContent)")
    if "Exercises" not in names or "Glossary" not in names or "Code" not in names:
        fault("menu", f"without scripts it has {names}")
# ... and of a drawing with steps the last step stands, with all sentences.
pages_with_steps = [name for name in book if '<ol class="steps">' in (site / name).read_text()]
for name in pages_with_steps if everything else pages_with_steps[::4]:
    chromium.open(site / name)
    for number, (_, tells) in enumerate(drawings_with_steps(name)):
        still = run(static.replace("NUMBER", str(number)))
        if still["bar"] or still["tells"] != len(tells) or still["shown"] != still["lasts"]:
            fault(name, f"without scripts a drawing is not the last step's: {still}")
chromium.command("Emulation.setScriptExecutionDisabled", value=False)

# The search, by keyboard: something is found, and opening it leads to a page that has the word.
def results():
    return [element.text for element in chromium.driver.find_elements(By.CSS_SELECTOR, "#search-results a")]


window(1280)
for word in ("Möller", "moller", "rasteriser", "closest_hit"):
    open_page("index.html")
    field = chromium.driver.find_element(By.ID, "MSearchField")
    field.send_keys(word)
    if not wait("document.querySelectorAll('#search-results a').length"):
        fault("search", f"finds nothing for {word}")
        continue
    field.send_keys(Keys.ENTER)
    if not wait("!location.pathname.endsWith('index.html') || location.hash"):
        fault("search", f"{word}: Enter opens nothing")
    text = run("return document.body.textContent.normalize('NFD').replace(/\\p{Mark}/gu, '').toLowerCase()")
    if word.replace("ö", "o").lower() not in text:
        fault("search", f"{word}: the page {chromium.driver.current_url} does not have the word")
# Words that begin so come before those in which the letters stand somewhere: NaN before discriminant.
open_page("index.html")
chromium.driver.find_element(By.ID, "MSearchField").send_keys("nan")
wait("document.querySelectorAll('#search-results a').length")
for text in results()[:3]:
    if not re.search(r"\bnan", text, re.IGNORECASE):
        fault("search", f"finds {text!r} first for nan")
for text in run("return window.bookText.map((entry) => entry.text)"):
    if re.search(r"\\(frac|cdot|le|times|mathrm|varepsilon)\b", text):
        fault("search", f"shows raw formulas: {text[:80]}")
        break
open_page("index.html")
chromium.driver.find_element(By.ID, "MSearchField").send_keys("xyzzyplugh")
wait("document.getElementById('search-results').textContent")
if results():
    fault("search", "finds what is not in the book")
look_at_logs("search")
chromium.driver.quit()
finish(f"{len(pages)} pages, {len(book)} of the book opened at two widths, {formulas} formulas, {drawings} drawings, "
       f"{texts} texts, {steps_walked} steps")
