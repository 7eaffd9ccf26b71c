// Live figures: the book's own C++, compiled to WebAssembly, draws a figure again whenever its reader moves something.
// Without scripts or without the module the drawing stays as the book has it. Nothing is fetched: the module is a script
// that holds its bytes in base64, so that a page works from a folder, too.
const live = {
  rest: 400,  // ms without a change until the address follows and the new state is told
  held: new WeakMap(),  // what a pointer drags: which one, and its end
};

// What the module's functions do, with texts: one for all figures of a page, made when the first is played.
live.start = async () => {
  if (!window.bookModule) await load("live_module.js");
  const bytes = Uint8Array.from(atob(window.bookModule), (c) => c.charCodeAt(0)), nothing = {};
  const module = await WebAssembly.compile(bytes);
  // What the C library would ask of a system: there is none, and each call fails (ENOSYS), or it would ask again for ever.
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (nothing[from] ??= {})[name] = () => 52;
  const make = async () => {
    const { exports } = await WebAssembly.instantiate(module, nothing);
    exports._initialize();
    return exports;
  };
  let made = make();
  await made;
  live.ask = async (text) => {
    const code = await made, request = new TextEncoder().encode(text), began = performance.now();
    const view = (at, size) => new Uint8Array(code.memory.buffer, at, size);
    try {
      view(code.request_buffer(request.length), request.length).set(request);
      const size = code.answer_request(), answer = JSON.parse(new TextDecoder().decode(view(code.answer_bytes(), size)));
      answer.ms = performance.now() - began;
      const { picture } = answer;
      if (picture) picture.rgba = new Uint8ClampedArray(view(code.picture_bytes(), 4 * picture.width * picture.rows));
      return answer;
    } catch (fault) {  // what would have been an exception ended the call: the module begins anew
      made = make();
      return { error: String(fault) };
    }
  };
};

live.element = (tag, properties = {}, parent = null) => {
  const element = Object.assign(document.createElement(tag), properties);
  parent?.append(element);
  return element;
};
live.drawn = (tag, attributes = {}, parent = null) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  parent?.append(element);
  return element;
};

// Makes the drawing in `box` live, in a state: a Map from names to texts.
live.play = async (box, state) => {
  const id = box.dataset.live, { element, drawn } = live;
  live.started ??= live.start();
  await live.started;
  const svg = box.querySelector("svg.book-figure") ?? drawn("svg", { id, class: "book-figure" });
  box.querySelector("img")?.replaceWith(svg);
  svg.setAttribute("role", "group");  // of an image no screen reader would show the parts
  svg.classList.add("played");

  const bar = element("div", { className: "live-bar", role: "group" }), controls = element("div", { className: "live-controls" }, bar);
  bar.setAttribute("aria-label", "What may be changed in the figure");
  const buttons = element("div", { className: "live-controls" }, bar), told = element("p", { className: "live-told", role: "status" }, bar);
  const said = element("p", { className: "live-said" });  // below: its lines don't move what is dragged
  // Over the drawing, whose parts are drawn anew: points to drag, and pixels.
  const overlay = drawn("g", { class: "live-overlay" }, svg), shown = new Map();
  let answer = null, fault = "", held = false, waits = false, resting = 0, changes = 0;
  // Of a figure with a picture: how much is asked for at once, and what the picture has taken so far.
  let effort = 1, taken = null;

  const address = () => [id, ...[...state].map(([name, value]) => `${name}=${value}`)].join(";");
  const rest = async () => {
    history.replaceState(null, "", `#${encodeURI(address())}`);
    await finish();
    told.textContent = fault || (answer?.summary ?? "");
  };
  const isWhole = ({ picture }) => !picture || picture.first_row + picture.rows >= picture.height;
  // A picture at rest comes in full, in parts: between them the page answers to whatever is moved.
  const finish = async () => {
    for (const now = changes; answer?.picture && !fault && !held && now === changes;) {
      await draw("more");
      if (isWhole(answer)) return;
      await new Promise((done) => setTimeout(done));
    }
  };
  // Of each kind of part, those that this answer names: made where they are new, gone where they are named no more.
  const renew = (parts, make) => parts.map((part) => {
    let control = shown.get(part.name);
    if (!control) shown.set(part.name, control = make(part));
    control.renew(part);
    return part.name;
  });
  const draw = async (detail = "low") => {
    const began = performance.now();
    const next = await live.ask(address().replace(id, `${id};detail=${detail};effort=${effort}`));
    fault = next.error ? `This can't be drawn (${next.error}).` : "";
    if (fault) return void (said.textContent = fault);
    const first = !answer;
    answer = next;
    const parsed = element("template", { innerHTML: answer.svg }).content.firstElementChild;
    const lastStep = [...parsed.querySelectorAll("desc")].at(-1)?.textContent ?? "";
    for (const name of ["width", "height", "viewBox"]) svg.setAttribute(name, parsed.getAttribute(name));
    // All but its style, which is always the same: with another one a browser looks at the whole page anew.
    const style = svg.querySelector(":scope > style"), stays = style?.textContent === parsed.querySelector("style")?.textContent;
    for (const part of [...svg.childNodes]) if (part !== overlay && !(stays && part === style)) part.remove();
    overlay.before(...[...parsed.childNodes].filter(({ nodeName }) => !(stays && nodeName === "style")));
    if (first) {  // on a phone it is as narrow as its smallest text can be read
      const sizes = [...svg.querySelectorAll("text")].map((text) => parseFloat(getComputedStyle(text).fontSize));
      svg.style.setProperty("--narrowest", `${(9.5 / Math.min(...sizes)) * svg.viewBox.baseVal.width}px`);
    }
    renewSteps(box, first ? Infinity : 0);  // the last step shows most of what changes
    const { handles, points, choices, sliders, picture } = answer;
    const byHand = points ? points.values.map((value, i) => (
      { ...points, name: `${points.name} ${i + 1}`, label: `${points.label} ${i + 1}`, value, of: points, i })) : [];
    const named = new Set([
      ...renew(picture ? [{ ...picture, name: " pixels" }] : [], pixels),
      ...renew(points ? [{ name: " paper", points }] : [], paper),
      ...renew([...handles, ...byHand], dot), ...renew(choices, choice), ...renew(sliders, slider)]);
    for (const [name, control] of shown) if (!named.has(name)) {
      const hadFocus = control.parts.some((part) => part.contains(document.activeElement));
      control.parts.forEach((part) => part.remove());
      shown.delete(name);
      const next = overlay.lastElementChild?.closest(".live-dot") ?? bar.querySelector("select, input, button");
      if (hadFocus) next.focus({ preventScroll: true });
    }
    fit();  // once, at the end: the browser finds now where all parts are
    const ms = performance.now() - began, { summary } = answer;
    let time = `drawn in ${ms.toFixed(1)}\u00a0ms`;
    if (picture) {
      effort = Math.min(1, Math.max(1 / 16, effort * (ms > 35 ? 0.7 : ms < 20 ? 1.4 : 1)));  // not without end where all is slow
      const before = picture.first_row ? taken : { rays: 0, tracing: 0, ms: 0, most: 0 };
      taken = { rays: before.rays + picture.rays, tracing: before.tracing + answer.ms, ms: before.ms + ms, most: Math.max(before.most, ms) };
      if (!isWhole(answer)) return;
      if (picture.first_row) time = `drawn in ${taken.ms.toFixed(0)}\u00a0ms, at most ${taken.most.toFixed(0)}\u00a0ms at once`;
      time += `, ${(taken.rays / taken.tracing / 1000).toFixed(2)} million rays a second`;
    }
    const asTold = lastStep.endsWith(summary) ? "as-told" : "";
    said.replaceChildren(element("span", { className: asTold, textContent: `${summary} ` }), `(${time})`);
    if (state.size) said.append(element("span", { className: "live-printed", textContent: "The caption tells of the figure as the book has it." }));
  };
  const again = () => {
    ++changes;
    clearTimeout(resting);
    resting = setTimeout(rest, live.rest);
    if (waits) return;
    waits = true;
    requestAnimationFrame(() => {
      waits = false;
      draw();
    });
  };
  const change = (name, value) => {
    state.set(name, value);
    again();
  };

  // Units of the drawing to a pixel of the screen: what is touched keeps its size.
  const fit = () => {
    const { width } = svg.getBoundingClientRect();
    overlay.style.setProperty("--unit", width ? svg.viewBox.baseVal.width / width : 1);
  };
  new ResizeObserver(fit).observe(svg);
  const under = ({ clientX, clientY }, { zero, unit }) => {
    const { x, y } = new DOMPoint(clientX, clientY).matrixTransform(svg.getScreenCTM().inverse());
    return [(x - zero[0]) / unit[0], (y - zero[1]) / unit[1]];
  };
  // So many decimals that a point may stand anywhere on the paper.
  const decimals = ({ unit }) => Math.max(0, Math.ceil(Math.log10(2 * Math.abs(unit[0]))));
  const rounded = (part, value) => value.map((v) => Number(v.toFixed(decimals(part)))).join(",");
  const list = (points, values) => change(points.name, values.map((value) => rounded(points, value)).join(" "));
  const moved = ({ part }, value) =>
    part.of ? list(part.of, part.of.values.map((old, i) => (i === part.i ? value : old))) : change(part.name, rounded(part, value));

  const dot = () => {
    const group = drawn("g", { tabindex: 0, role: "slider", "aria-roledescription": "point", class: "live-dot" }, overlay);
    const circles = [drawn("circle", { class: "reach" }, group), drawn("circle", { class: "dot" }, group)];
    const control = { parts: [group], renew: (part) => {
      control.part = part;
      const [x, y] = part.value, { zero, unit } = part;
      control.at = [zero[0] + unit[0] * x, zero[1] + unit[1] * y];
      for (const circle of circles) ["cx", "cy"].forEach((name, i) => circle.setAttribute(name, control.at[i]));
      group.setAttribute("aria-label", part.label);
      const ends = [0, svg.viewBox.baseVal.width].map((end) => (end - zero[0]) / unit[0]).sort((a, b) => a - b);
      ["min", "max"].forEach((end, i) => group.setAttribute(`aria-value${end}`, ends[i].toFixed(decimals(part))));
      group.setAttribute("aria-valuenow", x);
      group.setAttribute("aria-valuetext", rounded(part, part.value).replace(",", ", "));
    } };
    group.control = control;
    group.addEventListener("keydown", (event) => {
      const { part } = control, by = 10 ** (1 - decimals(part)), way = live.way(event);
      if (way) moved(control, part.value.map((v, i) => v + by * way[i] * (i ? -Math.sign(part.unit[1]) : Math.sign(part.unit[0]))));
      else if (/^(Delete|Backspace)$/.test(event.key) && part.of) list(part.of, part.of.values.filter((_, i) => i !== part.i));
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
    return control;
  };
  // Dragging. Of points that lie close together the nearest is taken, and it keeps its distance to the finger.
  overlay.addEventListener("pointerdown", (event) => {
    if (!event.target.closest(".live-dot") || event.button) return;
    const [x, y] = under(event, { zero: [0, 0], unit: [1, 1] });
    const away = ({ at }) => Math.hypot(at[0] - x, at[1] - y);
    const group = [...overlay.querySelectorAll(".live-dot")].reduce((a, b) => (away(b.control) < away(a.control) ? b : a));
    const { control } = group, start = under(event, control.part), from = control.part.value;
    const move = (now) => {
      const at = under(now, control.part);
      moved(control, from.map((v, i) => v + at[i] - start[i]));
    };
    live.hold(event, group, move, () => {});
  });
  // A finger on a point moves the point and not the page: parts of a drawing know no touch-action.
  overlay.addEventListener("touchstart", (event) => event.target.closest(".live-dot") && event.preventDefault(), { passive: false });
  // Points by hand: a press on the paper.
  const paper = () => {
    const rect = drawn("rect", { class: "live-paper" });
    overlay.prepend(rect);
    const add = (points, value) => {
      if (points.values.length < points.limit) list(points, [...points.values, value]);
    };
    const press = (textContent, onclick) => element("button", { type: "button", textContent, onclick }, buttons);
    const control = { renew: ({ points }) => {
      control.points = points;
      const { least, most, zero, unit } = points;
      const [x, y] = [0, 1].map((i) => zero[i] + unit[i] * (unit[i] > 0 ? least : most));
      const size = { x, y, width: Math.abs(unit[0]) * (most - least), height: Math.abs(unit[1]) * (most - least) };
      for (const [name, value] of Object.entries(size)) rect.setAttribute(name, value);
    } };
    rect.addEventListener("click", (event) => add(control.points, under(event, control.points)));
    control.parts = [rect,
      press("Add a point", () => add(control.points, [0, 0].map(() => (control.points.least + control.points.most) / 2))),
      press("Remove the last", () => list(control.points, control.points.values.slice(0, -1))),
      press("Remove all", () => list(control.points, []))];
    return control;
  };
  // Pixels: who drags them turns what they show, by the first two sliders.
  const pixels = () => {
    const frame = drawn("foreignObject", { class: "live-pixels" });
    overlay.prepend(frame);
    const canvas = element("canvas", {}, frame), control = { parts: [frame], canvas, renew: (picture) => {
      const { corner: [x, y], size: [width, height] } = picture;
      for (const [name, value] of Object.entries({ x, y, width, height })) frame.setAttribute(name, value);
      const paper = canvas.getContext("2d"), before = canvas.cloneNode();
      if (canvas.width !== picture.width) {  // the coarse picture stays where the finer one has no rows yet
        before.getContext("2d").drawImage(canvas, 0, 0);
        [canvas.width, canvas.height] = [picture.width, picture.height];
        paper.drawImage(before, 0, 0, canvas.width, canvas.height);
      }
      if (picture.rows) paper.putImageData(new ImageData(picture.rgba, picture.width), 0, picture.first_row);
    } };
    const turn = ({ name, least, most }, i, to) => {
      const span = most - least, round = least + (((to - least) % span) + span) % span;
      change(name, String(Number((i ? Math.min(most, Math.max(least, to)) : round).toFixed(2))));
    };
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "The picture: arrow keys turn it");
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button) return;
      const { width, height } = canvas.getBoundingClientRect(), sliders = answer.sliders.slice(0, 2);
      live.hold(event, canvas, (now) => {
        const by = [(now.clientX - event.clientX) / width, (now.clientY - event.clientY) / height];
        sliders.forEach((slider, i) => turn(slider, i, slider.value + by[i] * (slider.most - slider.least)));
      }, (down) => {
        held = down;
        if (!down) again();
      });
    });
    canvas.addEventListener("keydown", (event) => {
      const way = live.way(event);
      if (!way) return;
      answer.sliders.slice(0, 2).forEach((slider, i) => way[i] && turn(slider, i, slider.value + way[i] * (i ? -slider.step : slider.step)));
      event.preventDefault();
      event.stopPropagation();
    });
    return control;
  };
  const labelled = ({ label }, make) => {
    const box = element("label", { textContent: `${label} ` }, controls), control = make(box);
    return { parts: [box], ...control };
  };
  const choice = (first) => labelled(first, (label) => {
    const select = element("select", { onchange: () => change(first.name, select.value) }, label);
    return { renew: ({ names, chosen }) => {
      if ([...select.options].map((option) => option.value).join("\n") !== names.join("\n"))
        select.replaceChildren(...names.map((text) => element("option", { value: text, textContent: text })));
      select.selectedIndex = chosen;
    } };
  });
  const slider = (first) => labelled(first, (label) => {
    const input = element("input", { type: "range", oninput: () => change(first.name, input.value) }, label);
    const number = element("span", {}, label);
    number.setAttribute("aria-hidden", true);  // it is the slider's value, and no part of its name
    return { renew: ({ value, least, most, step }) => {
      Object.assign(input, { min: least, max: most, step });
      input.value = value;
      number.textContent = Number(value.toPrecision(6));
    } };
  });

  element("button", { type: "button", textContent: "As in the book", onclick: () => {
    state.clear();
    again();
  } }, buttons);
  element("button", { type: "button", textContent: "Save as SVG", onclick: () => {
    if (!answer) return;
    const { picture } = answer, image = picture && drawn("image", {
      x: picture.corner[0], y: picture.corner[1], width: picture.size[0], height: picture.size[1],
      href: shown.get(" pixels").canvas.toDataURL() });
    // At the step that is shown.
    const groups = [...svg.querySelectorAll("[data-first]")], step = answer.svg.replace(/(<g data-first="[^>]*?)( display="none")?>/g,
      (_, group) => `${group}${groups.shift().hasAttribute("display") ? ' display="none"' : ""}>`);
    const whole = image ? step.replace(/<\/svg>\s*$/, `${new XMLSerializer().serializeToString(image)}</svg>\n`) : step;
    const href = URL.createObjectURL(new Blob([whole], { type: "image/svg+xml" }));
    element("a", { href, download: `${id}.svg` }).click();
    setTimeout(() => URL.revokeObjectURL(href), 1000);
  } }, buttons);
  box.classList.add("played");
  box.before(bar);
  let last = box;
  while (last.nextElementSibling?.matches(".step-bar, ol.steps")) last = last.nextElementSibling;
  last.after(said);
  box.renew = (to) => {
    state = to;
    again();
  };
  await draw();
  finish();
};

// Which way an arrow key goes, to the right and upwards, ten times as far with Shift; nothing for another key.
live.way = ({ key, shiftKey, altKey, ctrlKey, metaKey }) => {
  const far = shiftKey ? 10 : 1, way = { ArrowRight: [far, 0], ArrowLeft: [-far, 0], ArrowUp: [0, far], ArrowDown: [0, -far] }[key];
  return altKey || ctrlKey || metaKey ? null : way;
};

// While a pointer is down: `move` for each of its moves, `hold` with whether it is down. A second finger on what one holds
// moves nothing.
live.hold = (event, target, move, hold) => {
  event.preventDefault();  // no text is selected
  const before = live.held.get(target);
  if (before && before.pointerId !== event.pointerId && target.hasPointerCapture(before.pointerId)) return;
  before?.end();  // which the browser did not tell
  target.focus({ preventScroll: true });
  target.setPointerCapture(event.pointerId);
  hold(true);
  const end = () => {
    for (const [name, listener] of Object.entries(listeners)) target.removeEventListener(name, listener);
    live.held.delete(target);
    hold(false);
  };
  const own = (act) => (now) => now.pointerId === event.pointerId && act(now);
  const listeners = { pointermove: own(move), pointerup: own(end), pointercancel: own(end) };
  live.held.set(target, { pointerId: event.pointerId, end });
  for (const [name, listener] of Object.entries(listeners)) target.addEventListener(name, listener);
};

// "#fig_07_17;ray=1,2" -> its id and state.
live.address = () => {
  mendAddress();
  const [id, ...parts] = decodeURIComponent(location.hash.slice(1)).split(";");
  return [id, new Map(parts.filter((part) => part.includes("=")).map((part) => part.split(/=(.*)/s).slice(0, 2)))];
};
live.follow = async () => {
  const [id, state] = live.address(), box = [...document.querySelectorAll("[data-live]")].find((each) => each.dataset.live === id);
  if (!box) return;
  let gone = false;
  for (const own of ["wheel", "touchstart", "pointerdown", "keydown"])
    window.addEventListener(own, () => (gone = true), { once: true, passive: true, capture: true });
  const show = () => gone || box.scrollIntoView({ block: "center" });
  const played = box.playing ? box.playing.then(() => box.renew?.(state)) : box.play(state);
  show();
  await Promise.all([played, formulasShown]);  // the bar and the formulas above move it, but for a reader who has gone on
  show();
};

document.addEventListener("DOMContentLoaded", () => {
  for (const box of document.querySelectorAll("[data-live]")) {
    const button = live.element("button", { type: "button", className: "live-play", textContent: "Move it yourself" });
    button.setAttribute("aria-describedby", `${box.dataset.live}-title`);
    box.play = (state) => (box.playing ??= play(state));  // once
    const play = async (state) => {
      button.disabled = true;
      try {
        await live.play(box, state);
        button.remove();
      } catch (fault) {  // no module, or a browser that takes none
        button.textContent = `This can't be played here (${fault.message})`;
      }
    };
    button.addEventListener("click", async () => {
      await box.play(new Map());
      box.previousElementSibling.querySelector?.("select, input, button")?.focus();
    });
    box.before(button);
  }
  live.follow();
  window.addEventListener("hashchange", live.follow);
});
