// Slides (docs/slides.hpp): keys, touch and clicks go on through the steps of a figure (steps.js), then to the next one. Where
// one is stands in the address: #7.16/3.
const page = document.documentElement, all = [...document.querySelectorAll(".slide")];
const bar = document.createElement("nav"), place = document.createElement("output");
let now = 0, typed = "";

const steps = () => all[now].querySelector("ol.steps");
const step = () => steps()?.step() ?? 0;
const isDark = () => page.classList.contains("dark-mode");
function setDark(dark) {
  page.classList.toggle("dark-mode", dark);
  page.classList.toggle("light-mode", !dark);
}

function tell() {
  place.textContent = typed || (now ? `${now} of ${all.length - 1}` : "Outline");
  const address = `#${all[now].id}${step() ? `/${step() + 1}` : ""}`;
  if (address !== location.hash) history.replaceState(null, "", address);  // browsers count how often
}
function show(slide, at = 0) {
  now = Math.max(0, Math.min(all.length - 1, slide));
  typed = "";
  all.forEach((element, i) => element.classList.toggle("now", i === now));
  all[now].scrollTop = 0;
  steps()?.show(at);
  tell();
}
const on = () => (step() + 1 < (steps()?.children.length ?? 1) ? show(now, step() + 1) : now + 1 < all.length && show(now + 1));
const back = () => (step() ? show(now, step() - 1) : now && show(now - 1, Infinity));
const outline = () => show(0);
const full = () => (document.fullscreenElement ? document.exitFullscreen() : page.requestFullscreen?.());
const turnDark = () => setDark(!isDark());

function showAddress() {
  const [id, at] = location.hash.slice(1).split(/\/|%2F/i);
  show(all.findIndex((slide) => slide.id === id), (Number.parseInt(at) || 1) - 1);
}

const keys = { ArrowRight: on, ArrowDown: on, PageDown: on, " ": on, ArrowLeft: back, ArrowUp: back, PageUp: back, Backspace: back,
               Home: outline, End: () => show(all.length - 1), f: full, d: turnDark };
document.addEventListener("keydown", (event) => {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (/^\d$/.test(key)) typed = (typed + key).slice(-3);
  else if (key === "Enter" && typed) show(Number(typed));
  else if (/^( |Enter)$/.test(key) && document.activeElement.matches("a, button")) return;
  else if (Object.hasOwn(keys, key)) keys[key]();
  else if (key === "Enter") on();
  else if (key === "Escape") typed = "";
  else return;
  tell();
  event.preventDefault();
});

document.addEventListener("click", (event) => {
  if (event.target.closest(".step-bar")) tell();
  else if (!event.target.closest("a, button, nav") && getSelection().isCollapsed) (event.clientX < innerWidth / 4 ? back : on)();
});
// A finger that moves to the side turns; one that rests is a click.
let touched = null;
document.addEventListener("touchstart", ({ touches }) => (touched = touches.length === 1 ? touches[0] : null), { passive: true });
document.addEventListener("touchend", ({ changedTouches: [{ clientX, clientY }] }) => {
  const x = clientX - touched?.clientX, y = clientY - touched?.clientY;
  if (Math.abs(x) > 50 && Math.abs(x) > 2 * Math.abs(y)) (x < 0 ? on : back)();
});

let darkBefore = false;
whenPrinting(() => {
  darkBefore = isDark();
  setDark(false);
}, () => setDark(darkBefore));

for (const [sign, name, act] of [["☰", "Outline", outline], ["◀", "Back", back], ["▶", "On", on], ["◐", "Dark or light", turnDark],
                                 ["⤢", "Full screen", full]]) {
  const button = Object.assign(document.createElement("button"), { type: "button", textContent: sign, title: name, onclick: act });
  button.setAttribute("aria-label", name);
  bar.append(button);
}
bar.className = "turn";
bar.setAttribute("aria-label", "Slides");
place.setAttribute("aria-live", "polite");
bar.children[1].after(place);
document.body.append(bar);
page.classList.add("turning");
if (!page.matches(".dark-mode, .light-mode")) setDark(matchMedia("(prefers-color-scheme: dark)").matches);
stepLists().forEach((list) => stepThrough(list));
window.addEventListener("hashchange", showAddress);
showAddress();
