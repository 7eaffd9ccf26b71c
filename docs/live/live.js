// Live figures: the book's own C++, compiled to WebAssembly, draws a figure again whenever its reader moves something.
// Without scripts or without the module the drawing stays as the book has it. Nothing is fetched: the module is a script
// that holds its bytes in base64, so that a page works from a folder, too.
const live = { asked: null };

// The module's three functions, called with texts.
live.start = async () => {
  if (!window.bookModule) await load("live_module.js");
  const bytes = Uint8Array.from(atob(window.bookModule), (c) => c.charCodeAt(0));
  const module = await WebAssembly.compile(bytes), nothing = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (nothing[from] ??= {})[name] = () => 0;
  const make = async () => {
    live.code = (await WebAssembly.instantiate(module, nothing)).exports;
    live.code._initialize();
  };
  await make();
  live.ask = (text) => {
    const request = new TextEncoder().encode(text), { memory } = live.code;
    try {
      new Uint8Array(memory.buffer, live.code.request_buffer(request.length), request.length).set(request);
      const size = live.code.answer_request();
      return JSON.parse(new TextDecoder().decode(new Uint8Array(memory.buffer, live.code.answer_bytes(), size)));
    } catch (fault) {  // what would have been an exception ended the call: the module begins anew
      make();
      return { error: String(fault) };
    }
  };
};

live.play = async (box, state) => {
  const drawing = box.querySelector("svg.book-figure"), id = drawing.id;
  await (live.asked ??= live.start());
  const make = (tag, properties, parent = bar) => {
    const element = Object.assign(document.createElement(tag), properties);
    parent?.append(element);
    return element;
  };
  const bar = make("div", { className: "live-bar" }, null), said = make("output", {}), controls = new Map();
  const svgElement = (tag, attributes, parent) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    parent?.append(element);
    return element;
  };
  const overlay = svgElement("svg", { class: "live-handles", viewBox: drawing.getAttribute("viewBox") });
  let shown = drawing, answer = null, waits = false;

  const address = () => [id, ...[...state].map(([name, value]) => `${name}=${value}`)].join(";");
  const draw = (text = address()) => {
    const began = performance.now(), next = live.ask(text);
    if (next.error) return void (said.textContent = `This can't be drawn (${next.error}).`);
    answer = next;
    const parsed = new DOMParser().parseFromString(answer.svg, "image/svg+xml").documentElement;
    const svg = document.importNode(parsed, true);
    shown.replaceWith(svg);
    shown = svg;
    said.textContent = `${answer.summary} (${(performance.now() - began).toFixed(1)} ms)`;
    renewSteps(box);
    for (const handle of answer.handles) place(handle);
    for (const choice of answer.choices) choose(choice);
    for (const slider of answer.sliders) slide(slider);
  };
  const change = (name, value) => {
    state.set(name, value);
    if (waits) return;
    waits = true;
    requestAnimationFrame(() => {
      waits = false;
      draw();
      history.replaceState(null, "", `#${encodeURI(address())}`);
    });
  };
  const move = (handle, x, y) => change(handle.name, [x, y].map((v) => Math.round(v * 100) / 100).join(","));

  const place = (handle) => {
    const [x, y] = handle.value, at = { cx: handle.zero[0] + handle.unit[0] * x, cy: handle.zero[1] + handle.unit[1] * y };
    let group = controls.get(handle.name);
    if (!group) {
      group = svgElement("g", { tabindex: 0, role: "slider", "aria-label": handle.label }, overlay);
      controls.set(handle.name, group);
      svgElement("circle", { class: "reach", r: 16 }, group);
      svgElement("circle", { class: "dot", r: 7 }, group);
      group.addEventListener("pointerdown", (event) => group.setPointerCapture(event.pointerId));
      group.addEventListener("pointermove", (event) => {
        if (!group.hasPointerCapture(event.pointerId)) return;
        const now = group.handle, point = new DOMPoint(event.clientX, event.clientY).matrixTransform(overlay.getScreenCTM().inverse());
        move(now, (point.x - now.zero[0]) / now.unit[0], (point.y - now.zero[1]) / now.unit[1]);
      });
      group.addEventListener("keydown", (event) => {
        const [right, up] = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [0, 0];
        if (!right && !up) return;
        event.preventDefault();
        event.stopPropagation();
        const by = event.shiftKey ? 1 : 0.1, [x0, y0] = group.handle.value;
        move(group.handle, x0 + by * right, y0 + by * up);
      });
    }
    group.handle = handle;
    group.setAttribute("aria-valuetext", `${x}, ${y}`);
    for (const circle of group.children) for (const [name, value] of Object.entries(at)) circle.setAttribute(name, value);
  };
  const labelled = (name, label, tag, properties) => {
    const element = make(tag, properties, make("label", { textContent: `${label} ` }));
    controls.set(name, element);
    return element;
  };
  const choose = ({ name, label, names, chosen }) => {
    let select = controls.get(name);
    if (!select) {
      select = labelled(name, label, "select", { onchange: () => change(name, select.value) });
      for (const text of names) make("option", { value: text, textContent: text }, select);
    }
    select.selectedIndex = chosen;
  };
  const slide = ({ name, label, value, least, most, step }) => {
    const input = controls.get(name) ??
        labelled(name, label, "input", { type: "range", min: least, max: most, step, oninput: () => change(name, input.value) });
    input.value = value;
  };

  said.setAttribute("aria-live", "polite");
  make("button", { type: "button", textContent: "As in the book", onclick: () => {
    state.clear();
    draw();
    history.replaceState(null, "", `#${id}`);
  } });
  make("button", { type: "button", textContent: "Save as SVG", onclick: () => {
    const link = make("a", { href: URL.createObjectURL(new Blob([answer.svg], { type: "image/svg+xml" })), download: `${id}.svg` }, null);
    link.click();
    URL.revokeObjectURL(link.href);
  } });
  box.classList.add("played");
  box.append(overlay);
  box.before(bar);
  draw();
};

// "#fig_07_17;ray=1,2" -> its id and state
live.address = () => {
  const [id, ...parts] = decodeURI(location.hash.slice(1)).split(";");
  return [id, new Map(parts.filter((part) => part.includes("=")).map((part) => part.split(/=(.*)/s).slice(0, 2)))];
};

document.addEventListener("DOMContentLoaded", () => {
  const [asked, state] = live.address();
  for (const box of document.querySelectorAll(".drawing.live")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "play";
    button.textContent = "Move it yourself";
    const start = (from) => {
      button.remove();
      live.play(box, from);
    };
    button.addEventListener("click", () => start(new Map()));
    box.before(button);
    if (box.querySelector("svg").id === asked) start(state);
  }
});
