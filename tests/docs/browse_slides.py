#!/usr/bin/env python3
"""Opens slides (make_slides) in a headless Chromium, from local files, as a lecturer does: turns them forth and back by
keys, by touch and by clicks, steps of a figure included; looks at each in the sizes of two projectors and of a telephone
for what sticks out; prints them; has them without scripts. Prints a line per fault; exit code 77: no browser.

Run: browse_slides.py FOLDER; every fourth file of those that are alike, SLIDES=all: each."""

import base64
import html.parser
import os
import pathlib
import re
import sys

from chromium import Chromium, fault, finish


class Slides(html.parser.HTMLParser):
    """The states that a file can be in, in their order: a slide's id, and for those after a figure's first step "/2" and so
    on; and what would be fetched."""

    def __init__(self, text):
        super().__init__()
        self.ids, self.steps, self.outside, self.in_steps = [], {}, [], False
        self.feed(text)
        self.states = [name + (f"/{step + 1}" if step else "") for name in self.ids for step in range(max(1, self.steps[name]))]

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "section":
            self.ids.append(attributes["id"])
            self.steps[self.ids[-1]] = 0
        elif tag == "ol":
            self.in_steps = attributes.get("class") == "steps"
        elif tag == "li" and self.in_steps:
            self.steps[self.ids[-1]] += 1
        for name in ("href", "src", "data", "xlink:href"):
            if name in attributes and not attributes[name].startswith(("#", "data:")):
                self.outside.append(attributes[name])


key = """
    const key = (name) => document.dispatchEvent(new KeyboardEvent("keydown", {key: name, bubbles: true, cancelable: true}));"""
# Forth and back through all states, by every key that does so: where one is, and whether what is seen is that step's.
turn = key + """
    const here = () => {
        const slide = document.querySelector(".slide.now"), list = slide.querySelector("ol.steps"), step = list?.step() ?? 0;
        const due = (group) => step >= Number(group.dataset.first) && step <= Number(group.dataset.last ?? Infinity);
        const told = [...list?.children ?? []].map((item) => item.matches(".now"));
        const right = told.every((now, i) => now === (i === step)) && [...slide.querySelectorAll("[data-first]")]
            .every((group) => due(group) === (group.getAttribute("display") !== "none"));
        return location.hash.slice(1) + (right ? "" : ", but shows another step");
    };
    const go = (keys) => Array.from({length: COUNT}, (_, i) => {
        const state = here();
        key(keys[i % keys.length]);
        return state;
    });
    key("Home");
    const forth = go(["ArrowRight", "PageDown", " ", "ArrowDown", "Enter"]);
    return [forth, go(["ArrowLeft", "PageUp", "Backspace", "ArrowUp"]).reverse()];"""
# What is wrong with the sight of each slide. A figure's steps have places of one size.
look = key + """
    const faults = [];
    const look = (slide, wrong) => {
        const {clientWidth: width, clientHeight: height} = document.documentElement;
        const bar = document.querySelector(".turn").getBoundingClientRect();
        if (slide.scrollWidth > width || document.documentElement.scrollHeight > height) wrong("the slide sticks out");
        if (slide.matches(".outline")) return;
        const boxes = [...slide.querySelectorAll(".drawing > *, .caption, ol.steps, .step-bar")].map((part) => [part, part.getBoundingClientRect()]);
        const name = (part) => part.outerHTML.slice(0, 60);
        for (const [part, box] of boxes) {
            if (box.left < 0 || box.top < 0 || box.right > width + 1 || box.bottom > height + 1) wrong("sticks out: " + name(part));
            if (part.scrollWidth > part.clientWidth + 1) wrong("is cut: " + name(part));
            if (box.width < 20 || box.height < 8) wrong("is nothing: " + name(part));
            if (box.bottom > bar.top + 1 && box.right > bar.left) wrong("is under the buttons: " + name(part));
        }
        boxes.forEach(([part, a], i) => boxes.slice(i + 1).forEach(([other, b]) => {
            if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1)
                wrong("lie on each other: " + name(part) + " and " + name(other));
        }));
        const picture = slide.querySelector("svg.book-figure, img"), {width: w, height: h} = picture.getBoundingClientRect();
        const [, , across, down] = picture.getAttribute("viewBox")?.split(" ").map(Number) ?? [0, 0, picture.naturalWidth, picture.naturalHeight];
        const scale = Math.min(w / across, h / down), share = scale * across / width * (scale * down / height);
        if (share < SMALLEST) wrong("its picture takes " + share.toFixed(2) + " of the window");
    };
    document.querySelectorAll(".slide").forEach((slide, number) => {
        [...String(number)].forEach(key);
        key("Enter");
        if (getComputedStyle(slide).display === "none") faults.push(slide.id + ": is not shown by its number");
        else look(slide, (what) => faults.push(slide.id + ": " + what));
    });
    return faults;"""

chromium = Chromium()
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402  which is there now
from selenium.webdriver.common.keys import Keys  # noqa: E402

folder = pathlib.Path(sys.argv[1])
files = sorted(folder.glob("slides_*.html"))
if not files:
    fault(folder, "holds no slides")
file_of_most_steps = max(files, key=lambda file: len(Slides(file.read_text()).states))
if os.environ.get("SLIDES") != "all":
    files = [file for i, file in enumerate(files) if i % 4 == 0 or file == file_of_most_steps]
looked = 0
for file in files:
    slides = Slides(file.read_text())
    for outside in slides.outside:
        fault(file.name, f"needs {outside}")
    chromium.window(1280, 720)
    chromium.open(file)
    forth, back = chromium.run(turn.replace("COUNT", str(len(slides.states))))
    for way, states in (("on", forth), ("back", back)):
        for state, due in zip(states, slides.states):
            if state != due:
                fault(file.name, f"goes {way} to #{state}, not to #{due}")
    # The least share of the window that a picture takes: a wide or a high one does not fill it, on a telephone least.
    for width, height, smallest in ((1280, 720, 0.2), (1920, 1080, 0.2), (390, 844, 0.08)):
        chromium.window(width, height)
        for what in chromium.run(look.replace("SMALLEST", str(smallest))):
            fault(file.name, f"at {width} x {height} {what}")
    looked += len(slides.states)
    chromium.look_at_logs(file.name)


def here():
    return chromium.run("return location.hash.slice(1)")


def expect(state, how):
    if not chromium.wait(f"location.hash.slice(1) === '{state}'", 5):
        fault(how, f"leads to {here()}, not to {state}")


def press(*keys):
    for key in keys:
        ActionChains(chromium.driver).send_keys(key).perform()


def tap(x, y):
    for kind, points in (("touchStart", [dict(x=x, y=y)]), ("touchEnd", [])):
        chromium.command("Input.dispatchTouchEvent", type=kind, touchPoints=points)


def swipe(first, last):
    chromium.command("Input.dispatchTouchEvent", type="touchStart", touchPoints=[dict(x=first, y=300)])
    for i in range(1, 5):
        chromium.command("Input.dispatchTouchEvent", type="touchMove", touchPoints=[dict(x=first + (last - first) * i / 4, y=300)])
    chromium.command("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])


# The file with the most steps, by real keys, clicks and fingers.
file = file_of_most_steps
slides = Slides(file.read_text())
stepped = max(slides.ids, key=lambda name: slides.steps[name])
after = slides.states[slides.states.index(stepped):]
for mode in ("light", "dark"):
    chromium.window(1280, 720, mode)
    chromium.open(file)
    chromium.driver.refresh()
    colours = lambda: chromium.run("return [document.documentElement.className.match(/(light|dark)-mode/)[0], getComputedStyle(document.body.parentElement).backgroundColor]")
    before = colours()
    if before[0] != f"{mode}-mode":
        fault(file.name, f"is in {before} where the system is {mode}")
    press("d")
    turned = colours()
    press("D")
    if turned == before or turned[1] == before[1] or colours() != before:
        fault(file.name, f"D turns {before} into {turned}, then into {colours()}")
press(*str(slides.ids.index(stepped)), Keys.ENTER)
expect(stepped, "a number and Enter")
press(Keys.ARROW_RIGHT, Keys.PAGE_DOWN)
expect(after[2], "two keys")
chromium.driver.refresh()
expect(after[2], "the same address again")
press("9", "9", Keys.ENTER)
expect(slides.ids[-1], "a number that is too large")
press(Keys.HOME)
expect("outline", "Home")
chromium.run(f"location.hash = '{after[3]}'")
expect(after[3], "an address")
if chromium.run("return document.querySelector('.slide.now ol.steps').step()") != 3:
    fault(file.name, "an address shows another step")
for button, state in (("On", after[4]), ("Back", after[3]), ("Next step", after[4]), ("First step", after[0])):
    chromium.run(f"document.querySelector('.now [aria-label=\"{button}\"], .turn [aria-label=\"{button}\"]').click()")
    expect(state, f"the button {button}")
chromium.run("document.querySelector('.turn [aria-label=Outline]').click()")
expect("outline", "the button Outline")
chromium.run(f"document.querySelector('.outline a[href=\"#{stepped}\"]').click()")
expect(stepped, "a link of the outline")
press("f")
if not chromium.wait("document.fullscreenElement === document.documentElement", 5):
    fault(file.name, "F does not fill the screen")
press("f")
chromium.wait("!document.fullscreenElement", 5)

chromium.window(390, 844)
chromium.command("Emulation.setTouchEmulationEnabled", enabled=True)
chromium.open(file, "#" + stepped)
chromium.driver.refresh()
for how, move, state in (("a swipe to the left", lambda: swipe(300, 100), after[1]), ("a tap at the right", lambda: tap(300, 200), after[2]),
                         ("a tap at the left", lambda: tap(30, 200), after[1]), ("a swipe to the right", lambda: swipe(100, 300), after[0])):
    move()
    expect(state, how)
chromium.command("Emulation.setTouchEmulationEnabled", enabled=False)
chromium.look_at_logs(file.name)

# On paper each has a sheet, in light colours, and all sentences of the steps; afterwards all is as it was.
for file in files if os.environ.get("SLIDES") == "all" else files[:2]:
    slides = Slides(file.read_text())
    chromium.window(1280, 720, "dark")
    chromium.open(file, "#" + slides.ids[1])
    chromium.driver.refresh()
    sheets = base64.b64decode(chromium.command("Page.printToPDF", preferCSSPageSize=True)["data"])
    count = len(re.findall(rb"/Type\s*/Page\b(?!s)", sheets))
    if count != len(slides.ids):
        fault(file.name, f"is printed on {count} sheets for {len(slides.ids)} slides")
    chromium.window(1280, 720, "dark", "print")
    if not chromium.wait("document.documentElement.classList.contains('light-mode')", 5):
        fault(file.name, "is printed dark")
    hidden = chromium.run("""return [...document.querySelectorAll(".slide, ol.steps li")].filter((part) =>
        !part.getClientRects().length || getComputedStyle(part).visibility !== "visible").length""")
    if hidden:
        fault(file.name, f"on paper {hidden} slides or sentences are hidden")
    chromium.window(1280, 720, "dark")
    if not chromium.wait("document.documentElement.classList.contains('dark-mode')", 5) or here() != slides.ids[1]:
        fault(file.name, "is another one after printing")

# Without scripts they stand below each other.
chromium.command("Emulation.setScriptExecutionDisabled", value=True)
chromium.open(files[0])
chromium.driver.refresh()
count = chromium.run("return [...document.querySelectorAll('.slide')].filter((slide) => slide.getClientRects().length).length")
if count != len(Slides(files[0].read_text()).ids):
    fault(files[0].name, f"without scripts shows {count} slides")
chromium.driver.quit()
finish(f"{len(files)} files, {looked} slides and steps")
