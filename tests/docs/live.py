#!/usr/bin/env python3
"""Plays with every live figure of the site in a headless Chromium, from local files: drags, keys, touches, choices, sliders,
random states. Prints a line per fault, and how long the slowest answer took; exit code 77: no browser, or no live figures.

Mouse, keys and fingers play with a figure that has a kind of part which no figure before it had; LIVE=all: with each.

Run: live.py SITE FIGURES; LIVE_STATES says how many random states a figure (25; hundreds take minutes). LIVE_TIMES=100 tests
nothing, and tells how long a figure takes to follow its reader, over so many drags and other changes of each."""

import os
import pathlib
import re
import sys

import chromium as browser
from chromium import fault

site, figures = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
where = {}  # the first page of each figure
for page in sorted(site.glob("*.html"), key=lambda page: (page.name == "figures.html", page.name)):
    for name in re.findall(r' data-live="(\w+)"', page.read_text()) if (site / "live_module.js").exists() else ():
        where.setdefault(name, page.name)
if not where:
    print("skipped: the site has no live figures")
    sys.exit(77)
chromium = browser.Chromium()
from selenium.webdriver.common.keys import Keys  # noqa: E402  which is there now

# Helpers in the page. A figure's parts are looked at from outside, as its reader sees them.
helpers = """
    window.box = document.querySelector('[data-live="ID"]');
    window.svg = () => box.querySelector("svg.book-figure");
    window.bar = () => box.previousElementSibling;
    window.said = () => box.parentElement.querySelector(".live-said").textContent;
    window.dots = () => [...svg().querySelectorAll(".live-dot")];
    window.centre = (element) => {
        const { left, top, width, height } = element.getBoundingClientRect();
        return [left + width / 2, top + height / 2];
    };
    window.middle = () => [0, 1].map((i) => dots().reduce((sum, dot) => sum + centre(dot)[i], 0) / dots().length);
    // The drawing without what the page lays over it.
    window.parts = () => [...svg().children].filter((child) => !child.matches(".live-overlay"));
    window.pixels = () => svg().querySelector("canvas")?.toDataURL() ?? "";
    window.picture = () => parts().map((child) => child.outerHTML).join() + pixels();
    window.painted = () => new Promise((done) => requestAnimationFrame(() => {
        const { port1, port2 } = new MessageChannel();
        port1.onmessage = done;  // the first task after the frame
        port2.postMessage(0);
    }));
    window.settled = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done))));
    // A seeded generator (mulberry32), so that a fault comes again.
    window.generator = (seed) => () => {
        seed = seed + 0x6D2B79F5 | 0;
        let t = Math.imul(seed ^ seed >>> 15, 1 | seed);
        t = t + Math.imul(t ^ t >>> 7, 61 | t) ^ t;
        return ((t ^ t >>> 14) >>> 0) / 4294967296;
    };
    // Some state of what an answer says may be changed: mostly anywhere, now and then where the figure has it, in a
    // corner, on whole numbers, on another handle, or nonsense.
    window.some_state = (answer, random) => {
        const pick = (list) => list[Math.floor(random() * list.length)];
        const parts = [];
        for (const { name, names } of answer.choices) if (random() < 0.8) parts.push(`${name}=${pick(names)}`);
        for (const { name, least, most } of answer.sliders)
            if (random() < 0.8) parts.push(`${name}=${pick([least, most, least + random() * (most - least)])}`);
        const points = [];
        const somewhere = (value) => {
            const round = pick([1, 2, 4, 100]), scale = 2 * Math.max(...value.map(Math.abs), 0.5);
            return pick([value, points.length ? pick(points) : value, [0, 0].map(() => pick([-1e9, 1e9, 1e-40, 0])),
                ...Array(5).fill(0).map(() => [0, 0].map(() => Math.round((random() * 1.2 - 0.1) * scale * round) / round))]);
        };
        for (const { name, value } of answer.handles)
            if (random() < 0.7) {
                points.push(somewhere(value));
                parts.push(`${name}=${random() < 0.02 ? "nan,inf" : points.at(-1).join(",")}`);
            }
        if (answer.points && random() < 0.9) {
            const { name, least, most, limit } = answer.points, count = Math.floor(random() * (limit + 1));
            const list = Array(count).fill(0).map(() => somewhere([least + random() * (most - least), least + random() * (most - least)]));
            parts.push(`${name}=${list.map((point) => point.join(",")).join(" ")}`);
        }
        return parts.join(";");
    };
    // Points in one place, or as near to each other as floats can be, and what is no number; choices and sliders at their ends.
    window.hard_states = ({ handles, points, choices, sliders }) => {
        const places = [["0,0", "0,0"], ["0,0", "1e-40,0"], ["8,8", "8,8.000001"], ["1e999,<b>", "1,2;3=&quot;"]];
        return places.flatMap((pair) => [0, -1].map((end) => [
            ...handles.map(({ name }, i) => `${name}=${pair[i % 2]}`),
            ...(points ? [`${points.name}=${Array.from({ length: points.limit }, (_, i) => pair[i % 2]).join(" ")}`] : []),
            ...choices.map(({ name, names }) => `${name}=${names.at(end)}`),
            ...sliders.map(({ name, least, most }) => `${name}=${end ? most : least}`)].join(";")));
    };
    // These and COUNT random states: those that end the module, and the times of the others.
    window.fuzz = async (id, count, seed) => {
        const random = generator(seed), times = [], faults = [];
        let answer = await live.ask(id);
        const hard = hard_states(answer);
        for (let k = -hard.length; k < count; ++k) {
            const state = k < 0 ? hard.at(k) : some_state(answer, random) + (random() < 0.3 ? ";detail=more" : "");
            const request = `${id};${state}`, next = await live.ask(request);
            if (next.error) faults.push(`${request}: ${next.error}`);
            else times.push(next.ms), answer = next;
            if (!next.error && (!next.summary || /NaN|inf/.test(next.svg))) faults.push(`${request}: no summary, or no number`);
            // What was drawn before changes nothing: the same picture again.
            if (k % 8 === 0 && next.picture && !/detail=more/.test(state) && (await live.ask(request)).picture.rgba.some((byte, i) => byte !== next.picture.rgba[i]))
                faults.push(`${request}: has another picture the second time`);
            if (!next.error && !next.picture && next.sliders.some(({ step, value }) => step === 1 && value % 1))
                faults.push(`${request}: a slider of whole numbers shows another`);
        }
        times.sort((a, b) => a - b);
        return { faults: faults.slice(0, 3), median: times[times.length >> 1], worst: times.at(-1), bytes: answer.svg.length };
    };
    // COUNT changes at random times, each when the one before has been painted: from the reader's move to the end of the frame
    // that shows it, and how much of it the page's thread took to draw (live.ask and all of what draw() does).
    window.reactions = async (count, seed) => {
        Element.prototype.setPointerCapture = () => {};  // there is no true pointer
        const random = generator(seed), pick = (list) => list[Math.floor(random() * list.length)];
        const inFrame = () => [...dots(), ...svg().querySelectorAll("canvas")];
        const kinds = { drags: inFrame, sliders: () => [...bar().querySelectorAll("input")], lists: () => [...bar().querySelectorAll("select")] };
        const times = { drags: [], sliders: [], lists: [] };
        for (let k = 0; k < count; ++k) {
            const kind = k % 10 === 9 ? "lists" : inFrame().length && k % 5 ? "drags" : "sliders", parts = kinds[kind]();
            if (!parts.length) continue;
            let part = pick(parts);
            const pointer = (what, [clientX, clientY]) =>
                part.dispatchEvent(new PointerEvent(`pointer${what}`, { bubbles: true, pointerId: 1, clientX, clientY }));
            const { left, top, width, height } = svg().getBoundingClientRect();
            const to = [left + random() * width, top + random() * height];
            if (kind === "drags") {
                pointer("down", centre(part));
                part = document.activeElement;  // the nearest
            }
            await new Promise((done) => setTimeout(done, 17 * random()));
            const began = performance.now();
            if (kind === "drags") pointer("move", to);
            else if (kind === "lists") {
                part.selectedIndex = Math.floor(random() * part.options.length);
                part.dispatchEvent(new Event("change"));
            } else {
                part.value = Number(part.min) + random() * (part.max - part.min);
                part.dispatchEvent(new Event("input"));
            }
            await painted();
            times[kind].push(performance.now() - began);
            if (kind === "drags") pointer("up", to);
            await settled();
        }
        return times;
    };
    // How a screenshot looks from afar, 24 x 24 grey values; and how many colours it has.
    window.from_afar = async (png) => {
        const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${png}`)).blob());
        const seen = (width, height) => {
            const paper = new OffscreenCanvas(width, height).getContext("2d");
            paper.drawImage(image, 0, 0, width, height);
            return paper.getImageData(0, 0, width, height).data;
        };
        const small = seen(24, 24), large = seen(image.width, image.height), colours = new Set();
        for (let i = 0; i < large.length; i += 4) colours.add(large[i] >> 4 << 8 | large[i + 1] >> 4 << 4 | large[i + 2] >> 4);
        const grey = Array.from({ length: 576 }, (_, i) => (small[4 * i] + small[4 * i + 1] + small[4 * i + 2]) / 3);
        return { grey, colours: colours.size };
    };
"""


in_the_middle = """(() => {
    const { top, bottom } = box.getBoundingClientRect();
    return top < 0.75 * innerHeight && bottom > 0.25 * innerHeight;
})()"""


def open_figure(name, width, mode, state=None):
    """Its page, with the figure played where a state is given, as by a link."""
    chromium.window(width, mode=mode)
    chromium.driver.get("about:blank")  # the same page with another #... would stay
    chromium.open(site / where[name], "" if state is None else f"#{name}{state}")
    chromium.run(helpers.replace("ID", name))
    if state is not None and not chromium.wait("box.classList.contains('played')"):
        fault(name, "is not played by its address")
    if not chromium.wait("document.documentElement.classList.contains('formulas-shown')", 60):
        fault(name, "formulas were never shown")  # until then the page moves
    if state is not None and not chromium.wait(in_the_middle, 3):
        fault(name, "a link to it leads to another place of its page")
    chromium.run("svg().scrollIntoView({block: 'center', behavior: 'instant'})")


def shot():
    clip = chromium.run("const r = box.getBoundingClientRect(); return [r.left + scrollX, r.top + scrollY, r.width, r.height]")
    area = dict(zip(("x", "y", "width", "height"), clip), scale=1)
    return chromium.run("return from_afar('%s')" % chromium.command("Page.captureScreenshot", clip=area)["data"])


def mouse(kind, at):
    chromium.command("Input.dispatchMouseEvent", type="mouse" + kind, x=at[0], y=at[1], button="left",
                     buttons=int(kind != "Released"), clickCount=1)


def touch(kind, points):
    chromium.command("Input.dispatchTouchEvent", type="touch" + kind, touchPoints=[dict(x=x, y=y) for x, y in points])


def drag(start, way, by_touch=False):
    ends = [start] + [[start[0] + way[0] * k / 3, start[1] + way[1] * k / 3] for k in (1, 2, 3)]
    if by_touch:
        touch("Start", ends[:1])
        for end in ends[1:]:
            touch("Move", [end])
        touch("End", [])
    else:
        for kind, at in zip(("Pressed", "Moved", "Moved", "Moved", "Released"), ends + ends[-1:]):
            mouse(kind, at)
    chromium.run("return settled()")


def expect_change(name, how, act, kept=None):
    """`act` changes the drawing; what `kept` gives stays."""
    before, stays = chromium.run("return picture()"), kept and chromium.run(kept)
    act()
    chromium.run("return settled()")
    if chromium.run("return picture()") == before:
        fault(name, f"{how} changes nothing")
    if kept and chromium.run(kept) != stays:
        fault(name, f"{how} also moves the page")
    if told := chromium.run("return said().match(/can't be drawn.*/)?.[0]"):
        fault(name, f"{how}: {told}")


def look_at_start(name):
    """The drawing of the book, then the same one made by the module: the same bytes, and the same to the eye."""
    open_figure(name, 1280, "light")
    chromium.run("box.parentElement.querySelector('ol.steps')?.show(Infinity)")  # where what is played begins
    still = shot()
    chromium.run("box.previousElementSibling.click()")
    if not chromium.wait("box.classList.contains('played') && said()"):
        return fault(name, "is not played by its button")
    file = figures / f"{name}.svg"
    if not file.exists():
        fault(name, f"has no {file}")
    else:
        svg, has_pixels = chromium.run(f"return live.ask('{name}').then(({{svg, picture}}) => [svg, !!picture])")
        book = file.read_text()
        if has_pixels:  # they are laid over the module's drawing; the book's holds them
            book = re.sub(r"<image .*\n", "", book)
        if svg != book:
            fault(name, "begins with another drawing than the book's")
    chromium.run("dots().forEach((dot) => (dot.style.opacity = 0))")
    played = shot()
    chromium.run("dots().forEach((dot) => (dot.style.opacity = 1))")
    if max(abs(a - b) for a, b in zip(still["grey"], played["grey"])) > 40 or played["colours"] < 3:
        fault(name, "looks other than the book's drawing")
    return True


def play(name):
    """By mouse and keys, in a light window of a desk."""
    count = chromium.run("return dots().length")
    for k in sorted({0, count // 2, count - 1} if count else ()):
        at = chromium.run(f"return centre(dots()[{k}].lastElementChild)")
        aim = chromium.run("return middle()")  # there is room
        way = [40 if aim[0] > at[0] else -40, 28 if aim[1] > at[1] else -28]
        expect_change(name, f"dragging point {k}", lambda: drag(at, way))
        now = chromium.run(f"return centre(dots()[{k}].lastElementChild)")
        if abs(now[0] - at[0] - way[0]) + abs(now[1] - at[1] - way[1]) > 6:
            fault(name, f"point {k} was dragged by {way}, from {at} to {now}")
        key = Keys.ARROW_RIGHT if way[0] > 0 else Keys.ARROW_LEFT
        chromium.run(f"dots()[{k}].focus()")
        before = chromium.run(f"return dots()[{k}].getAttribute('aria-valuetext')")
        for _ in range(3):
            chromium.driver.switch_to.active_element.send_keys(key)
        chromium.run("return settled()")
        if chromium.run(f"return dots()[{k}].getAttribute('aria-valuetext')") == before:
            fault(name, f"a key does not move point {k}")
    controls = chromium.run("return bar().querySelectorAll('select, input').length")
    changes = 0
    for k in range(controls):
        # Two other values, one after another: one of them shows, unless what was dragged before hides it.
        before = chromium.run("return picture()")
        shown = chromium.run(f"""return (async () => {{
            const seen = [];
            for (const end of [-1, 0]) {{
                const control = bar().querySelectorAll("select, input")[{k}];
                if (!control) break;
                if (control.matches("select")) control.selectedIndex = end < 0 ? control.options.length - 1 : 0;
                else control.value = end < 0 ? control.max : control.min;
                control.dispatchEvent(new Event(control.matches("select") ? "change" : "input"));
                await settled();
                seen.push(picture());
            }}
            return seen;
        }})()""")
        changes += any(picture != before for picture in shown)
    if not chromium.run("return box.parentElement.querySelector('.live-printed')"):
        fault(name, "does not say that its caption tells of another")
    if controls and not changes:  # one of several may change nothing: straddlers, where none are
        fault(name, "no control changes anything")
    if chromium.run("return svg().querySelector('.live-paper') !== null"):
        expect_change(name, "a press on the paper", lambda: drag(chromium.run("return centre(svg().querySelector('.live-paper'))"), (0, 0)))
    if chromium.run("return svg().querySelector('canvas') !== null"):
        middle = chromium.run("return centre(svg().querySelector('canvas'))")
        expect_change(name, "dragging the picture", lambda: drag(middle, (60, 20)))
        chromium.run("box.renew(new Map([['detail', 'low']]))")  # that is the page's to say
        if not chromium.wait("said().includes('at most')"):
            fault(name, "has no finer picture when it rests")
    if not chromium.wait("decodeURIComponent(location.hash).startsWith('#%s;')" % name, 3):
        fault(name, "its state is not in the address")
    if not chromium.wait("bar().querySelector('[role=status]').textContent", 3):
        fault(name, "is not told to those who don't see it")
    unnamed = chromium.run("return [...dots(), ...bar().querySelectorAll('select, input')].filter("
                           "(e) => !e.getAttribute('aria-label') && !e.labels?.length).length")
    if unnamed:
        fault(name, f"{unnamed} of its parts have no name")
    # The address, once it has come to rest, makes the same figure again.
    chromium.run("return new Promise((done) => setTimeout(done, 2 * live.rest))")
    address, drawn, pixels = chromium.run("return [location.hash, picture(), pixels()]")
    open_figure(name, 1280, "light", address.removeprefix(f"#{name}"))
    if chromium.run("return picture()") != drawn and not pixels:  # how many of those depends on the machine's speed
        fault(name, "its address makes another figure")
    expect_change(name, "As in the book", lambda: chromium.run(
        "[...bar().querySelectorAll('button')].find((b) => b.textContent === 'As in the book').click()"))


def move_by_keys(name):
    """Left and right move a slider, and not the steps of its drawing."""
    if not chromium.run("const slider = bar().querySelector('input'); slider?.focus(); return slider !== null"):
        return
    seen = []
    for key in (Keys.ARROW_LEFT, Keys.ARROW_RIGHT):
        chromium.driver.switch_to.active_element.send_keys(key)
        chromium.run("return settled()")
        seen.append(chromium.run("return bar().querySelector('input').value"))
    if seen[0] == seen[1]:
        fault(name, "keys do not move its slider")
    if chromium.run("const list = box.parentElement.querySelector('ol.steps'); return list && list.step() + 1 < list.children.length"):
        fault(name, "keys that move its slider move its steps, too")


def touch_it(name):
    """On a phone, in the dark: a finger moves a point and not the page, and nothing sticks out."""
    open_figure(name, 390, "dark", ";of=%")
    if chromium.run("return document.documentElement.scrollWidth > document.documentElement.clientWidth"):
        fault(name, "makes a phone's page wider than its window")
    if chromium.run("return dots().length"):
        reach = chromium.run("return dots()[0].getBoundingClientRect().width")
        if reach < 43.5:
            fault(name, f"a finger has {reach:.0f} pixels to meet a point")
        at, aim = chromium.run("return [centre(dots()[0].lastElementChild), middle()]")
        # What lies under the neighbour's finger may be nearer: the page must stand still all the same.
        if 0 < at[0] < 390:
            expect_change(name, "a finger", lambda: drag(at, [30 if aim[0] > at[0] else -30, 30 if aim[1] > at[1] else -30], True),
                          "return [scrollX, scrollY]")
    low = chromium.run("return [...bar().querySelectorAll('button, select')].filter((e) => e.getBoundingClientRect().height < 36).length")
    if low:
        fault(name, f"{low} of its controls are too low for a finger")
    if shot()["colours"] < 3:
        fault(name, "is blank in the dark")


def without_module(name):
    """The drawing stays, and the button says why."""
    chromium.command("Network.enable")
    chromium.command("Network.setBlockedURLs", urls=["*live_module.js"])
    open_figure(name, 1280, "light")
    chromium.run("box.previousElementSibling.click()")
    if not chromium.wait("/can't/.test(box.previousElementSibling.textContent)") or chromium.run("return !svg()"):
        fault(name, "without its module does not say so")
    chromium.command("Network.setBlockedURLs", urls=[])
    chromium.driver.get_log("browser")


def read_addresses(name):
    """What can't be read of an address is left out, and the rest is not."""
    chromium.run(f"history.replaceState(null, '', '#{name};a=3%;b=1,2;c=%41=;%ff=1')")
    read = chromium.run("const [id, state] = live.address(); return [id, Object.fromEntries(state)]")
    if read != [name, {"b": "1,2", "c": "A="}]:
        fault(name, f"reads {read} in an address of which a part is wrong")


def tell_times(changes):
    """Two lines a figure: how long its reader waits."""
    print("from a move to the end of the frame that shows it, in ms: median, 95 %, worst")
    for name in where:
        open_figure(name, 1280, "light", "")
        chromium.wait("said()")
        times = chromium.run(f"return reactions({changes}, 1)")
        told = []
        for kind, all_times in times.items():
            if all_times:
                all_times.sort()
                at = [all_times[len(all_times) // 2], all_times[len(all_times) * 95 // 100], all_times[-1]]
                told.append(f"{len(all_times)} {kind} " + ", ".join(f"{t:.0f}" for t in at))
        print(f"{name}: {'; '.join(told)}", flush=True)
        if chromium.run("return svg().querySelector('canvas') !== null"):
            chromium.run("box.renew(new Map())")
            chromium.wait("said().includes('at most')")
            print(f"{name}, at rest: {chromium.run('return said()')}")


kinds = """return ['.live-dot', '.live-paper', 'canvas'].filter((part) => svg().querySelector(part)).concat(
    ['select', 'input'].filter((part) => bar().querySelector(part)))"""
if changes := int(os.environ.get("LIVE_TIMES", 0)):
    tell_times(changes)
    chromium.driver.quit()
    sys.exit(0)
states, slowest, played = int(os.environ.get("LIVE_STATES", 25)), 0, set()
for name in where:
    if look_at_start(name):
        found = chromium.run(f"return fuzz('{name}', {states}, 1)")
        for what in found["faults"]:
            fault(name, what)
        slowest = max(slowest, found["worst"])
        print(f"{name}: {found['median']:.1f} ms, at worst {found['worst']:.1f} ms")
        move_by_keys(name)
        parts = set(chromium.run(kinds))
        if parts - played or os.environ.get("LIVE") == "all":
            play(name)
            touch_it(name)
            played |= parts
    chromium.look_at_logs(name)
read_addresses(name)
without_module(next(iter(where)))
size = (site / "live_module.js").stat().st_size * 3 / 4
print(f"the module: {size / 1e6:.2f} MB")
if size > 1.5e6:
    fault("live_module.js", "is larger than 1.5 MB")
chromium.driver.quit()
browser.finish(f"{len(where)} live figures, the slowest answer of {states} random states each in {slowest:.1f} ms")
