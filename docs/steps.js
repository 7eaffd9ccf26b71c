// Drawings with steps, in the pages of the book and in its slides.

// Calls `begin` before a page is printed and `end` after it, once each: browsers differ in which event they send.
function whenPrinting(begin, end) {
  let printing = false;
  const change = (now) => {
    if (now === printing) return;
    printing = now;
    (now ? begin : end)();
  };
  window.addEventListener("beforeprint", () => change(true));
  window.addEventListener("afterprint", () => change(false));
  window.matchMedia("print").addEventListener("change", (event) => change(event.matches));
}

// A drawing with steps (Svg::begin_step): its list of steps shows one at a time, with the groups of that step. Steps are
// told to those who don't see them; those of a drawing that is made again and again (`tells` false), from its reader's first on.
function stepThrough(list, at = 0, tells = true) {
  const drawing = list.previousElementSibling, items = [...list.children], last = items.length - 1;
  const groups = [...drawing.querySelectorAll("[data-first]")];
  const bar = document.createElement("div"), count = document.createElement("output");
  bar.className = "step-bar";
  bar.setAttribute("role", "group");
  bar.setAttribute("aria-label", "Steps of the drawing");
  let now = 0;
  const show = (step) => {
    now = Math.max(0, Math.min(last, step));
    for (const group of groups) {
      const shown = now >= Number(group.dataset.first) && now <= Number(group.dataset.last ?? last);
      if (shown) group.removeAttribute("display");
      else if (!group.hasAttribute("display")) group.setAttribute("display", "none");  // the same once more costs time, too
    }
    items.forEach((item, i) => item.classList.toggle("now", i === now));
    count.textContent = `${now + 1} of ${last + 1}`;
    for (const [button, , end] of buttons) button.disabled = now === end;
  };
  const button = (sign, name, step, end) => {
    const element = document.createElement("button");
    element.type = "button";
    element.textContent = sign;
    element.title = name;
    element.setAttribute("aria-label", name);
    element.addEventListener("click", () => show(step()));
    return [element, step, end];
  };
  const buttons = [button("|◀", "First step", () => 0, 0), button("◀ Back", "Step back", () => now - 1, 0),
                   button("Next ▶", "Next step", () => now + 1, last), button("▶|", "Last step", () => last, last)];
  bar.append(buttons[0][0], buttons[1][0], count, buttons[2][0], buttons[3][0]);
  list.before(bar);
  const tell = (politely) => [list, count].forEach((part) => part.setAttribute("aria-live", politely ? "polite" : "off"));
  tell(tells);
  bar.addEventListener("focusin", () => tell(true));
  list.classList.add("one-at-a-time");
  list.show = (step) => {
    tell(true);
    show(step);
  };
  list.moves = () => ({ ArrowLeft: now - 1, ArrowRight: now + 1, Home: 0, End: last });
  list.step = () => now;
  show(at);
}

const stepLists = () => [...document.querySelectorAll("ol.steps")];
// On paper all sentences stand under the last step's picture.
let stepsBefore = new Map();
whenPrinting(() => {
  stepsBefore = new Map(stepLists().map((list) => [list, list.step()]));
  for (const list of stepLists()) list.show(Infinity);
}, () => stepsBefore.forEach((step, list) => list.show(step)));
