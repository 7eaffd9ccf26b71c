// What the pages of the book do in a browser, beside what doxygen-awesome brings: formulas, search, wide tables.
DoxygenAwesomeDarkModeToggle.title = "Light or dark page";
// The switch by keyboard and for screen readers; doxygen-awesome calls this when it makes and when it turns it.
const updateIcon = DoxygenAwesomeDarkModeToggle.prototype.updateIcon;
DoxygenAwesomeDarkModeToggle.prototype.updateIcon = function () {
  updateIcon.call(this);
  this.tabIndex = 0;
  this.setAttribute("role", "switch");
  this.setAttribute("aria-label", "Dark page");
  this.setAttribute("aria-checked", Boolean(DoxygenAwesomeDarkModeToggle.darkModeEnabled));
  this.onkeydown = (event) => {
    if (event.key !== " " && event.key !== "Enter") return;
    event.preventDefault();
    this.toggleDarkMode();
  };
};
DoxygenAwesomeDarkModeToggle.init();
DoxygenAwesomeFragmentCopyButton.init();
DoxygenAwesomeParagraphLink.init();
DoxygenAwesomeInteractiveToc.topOffset = 45;
DoxygenAwesomeInteractiveToc.init();

// Of an address like "#fig_07_17;ray=1,2" what can't be read, a % that begins no sign, is taken out: MathJax would stop at it.
function mendAddress() {
  const isRead = (text) => {
    try {
      decodeURIComponent(text);
      return true;
    } catch {
      return false;
    }
  };
  if (!isRead(location.hash)) history.replaceState(null, "", `#${location.hash.slice(1).split(";").filter(isRead).join(";")}`);
}
mendAddress();

// Formulas: MathJax is in the site and is loaded where a page has any. They stand larger than what they are written with:
// what is below them moves.
let showFormulas;
const formulasShown = new Promise((shown) => {
  showFormulas = () => shown(document.documentElement.classList.add("formulas-shown"));
});
window.MathJax = {
  showMathMenu: false,
  messageStyle: "none",
  tex2jax: { inlineMath: [["\\(", "\\)"]], displayMath: [["\\[", "\\]"]] },
  SVG: { font: "TeX", scale: 92 },  // a formula wider than the page scrolls: broken, it can't be read
  TeX: { noErrors: { disabled: true }, noUndefined: { disabled: true } },
  AuthorInit() {
    for (const fault of ["TeX Jax - parse error", "TeX Jax - undefined macro", "Math Processing Error"])
      MathJax.Hub.Register.MessageHook(fault, (message) => console.error("formula: " + message.slice(1, 3).join(": ")));
    MathJax.Hub.Register.StartupHook("End", showFormulas);
  },
};

function load(script) {
  const element = document.createElement("script");
  element.src = script;
  return new Promise((loaded, failed) => {
    element.onload = loaded;
    element.onerror = () => failed(new Error(`${script} can't be read`));
    document.head.append(element);
  });
}

// Letters without accents, in lower case: "Möller" is found as "moller" too.
const plain = (text) => text.normalize("NFD").replace(/\p{Mark}/gu, "").toLowerCase();

const startsWord = (text, at) => !/[\p{L}\p{N}]/u.test(text[at - 1] ?? " ");

// All words must occur; a word of the heading counts most, then one that starts a word of the text: "NaN" before
// "discriminant".
function score(entry, words) {
  let sum = 0;
  for (const word of words) {
    const inTitle = entry.plainTitle.indexOf(word), inText = entry.plainText.indexOf(word);
    if (inTitle < 0 && inText < 0) return 0;
    if (inTitle >= 0) sum += entry.plainTitle === word ? 40 : startsWord(entry.plainTitle, inTitle) ? 20 : 2;
    let starts = 0;
    for (let at = inText; at >= 0 && starts < 4; at = entry.plainText.indexOf(word, at + 1))
      starts += startsWord(entry.plainText, at);
    sum += starts || (inText >= 0 ? 0.25 : 0);
  }
  return sum * (entry.book ? 2 : 1);
}

function excerpt(entry, words) {
  const at = Math.max(0, entry.plainText.indexOf(words.find((word) => entry.plainText.includes(word)) ?? "") - 40);
  const start = at && entry.text.indexOf(" ", at) + 1;
  const end = entry.text.length > start + 130 ? entry.text.lastIndexOf(" ", start + 130) : entry.text.length;
  return (start ? "… " : "") + entry.text.slice(start, end) + (end < entry.text.length ? " …" : "");
}

function search() {
  const field = document.getElementById("MSearchField"), results = document.getElementById("search-results");
  const words = plain(field.value).split(/\s+/).filter(Boolean);
  results.replaceChildren();
  results.hidden = !words.length || !window.bookText;
  if (results.hidden) return;
  const found = window.bookText.map((entry) => [score(entry, words), entry]).filter(([points]) => points);
  found.sort(([a], [b]) => b - a);
  for (const [, entry] of found.slice(0, 12)) {
    const link = document.createElement("a"), title = document.createElement("b"), text = document.createElement("span");
    link.href = entry.url;
    title.textContent = entry.title === entry.page ? entry.title : `${entry.title} · ${entry.page}`;
    text.textContent = excerpt(entry, words);
    link.append(title, text);
    results.append(link);
  }
  if (!found.length) results.append("Nothing in the book has all of these words.");
}

// ./book print names the number of a page's first sheet: page.html?sheet=41.
const sheet = Number(new URLSearchParams(location.search).get("sheet"));
if (sheet > 0) document.documentElement.style.counterReset = `page ${sheet - 1}`;

// Paper is white, whatever the reader's screen is: page, formulas and drawings are printed in their light colours.
let darkBefore = false;
whenPrinting(() => {
  darkBefore = document.documentElement.classList.contains("dark-mode");
  DoxygenAwesomeDarkModeToggle.enableDarkMode(false);
}, () => DoxygenAwesomeDarkModeToggle.enableDarkMode(darkBefore));

// Of several lists of steps the one whose drawing and sentences are nearest to the middle of the window.
function inTheMiddle(lists) {
  const away = (list) => {
    const { top, bottom } = list.parentElement.getBoundingClientRect();
    return Math.abs((top + bottom) / 2 - window.innerHeight / 2);
  };
  return lists.reduce((best, list) => (away(list) < away(best) ? list : best));
}

// The steps of a drawing that was drawn again: its sentences stand in its groups. Who was at the last step stays there.
function renewSteps(drawing, at = 0) {
  for (let next; (next = drawing.nextElementSibling)?.matches(".step-bar, ol.steps"); next.remove())
    if (next.step && at < Infinity) at = next.step() < next.children.length - 1 ? next.step() : Infinity;
  const told = [...drawing.querySelectorAll("[data-first] > desc")];
  if (!told.length) return;
  const list = document.createElement("ol");
  list.className = "steps";
  for (const { textContent } of told) list.append(Object.assign(document.createElement("li"), { textContent }));
  drawing.after(list);
  stepThrough(list, at, false);
}

// The steps that have the focus listen; if none have, those nearest to the window's middle do, but leave Home and End to
// the page. Sliders and lists of a live figure have moves of their own.
document.addEventListener("keydown", (event) => {
  if (event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
  const lists = stepLists(), active = document.activeElement;
  const focused = lists.find((list) => list.parentElement.contains(active)), list = focused ?? (lists.length ? inTheMiddle(lists) : null);
  if (!list || !(event.key in list.moves()) || active.matches("input, select, textarea")) return;
  if (!focused && (event.key.length < 5 || active.matches(".scroll, .fragment"))) return;
  list.show(list.moves()[event.key]);
  event.preventDefault();
});

document.addEventListener("DOMContentLoaded", () => {
  stepLists().forEach((list) => stepThrough(list));
  if (/\\[(\[]/.test(document.querySelector(".contents")?.textContent)) load("mathjax/MathJax.js?config=TeX-AMS_SVG-full");
  else showFormulas();

  // A table wider than the page scrolls in a box of its own.
  for (const table of document.querySelectorAll(".contents table.markdownTable, .contents table.doxtable")) {
    const box = document.createElement("div");
    box.className = "scroll";
    table.replaceWith(box);
    box.append(table);
  }

  // The menu of a phone and the box that opens it are Doxygen's, which makes them with jQuery, just before this.
  $(() => {
    document.getElementById("main-menu-state")?.setAttribute("aria-label", "Menu");
    const here = location.pathname.split("/").pop();
    for (const link of document.querySelectorAll("#main-menu a"))
      if (link.getAttribute("href") === here) link.setAttribute("aria-current", "page");
  });

  const field = document.getElementById("MSearchField"), results = document.createElement("div");
  results.id = "search-results";
  results.hidden = true;
  document.body.append(results);
  field.addEventListener("focus", async () => {
    if (window.bookText) return;
    await load("search_text.js");
    for (const entry of window.bookText) {
      entry.plainTitle = plain(entry.title);
      entry.plainText = plain(entry.text);
    }
    search();
  });
  field.addEventListener("input", search);
  document.addEventListener("keydown", (event) => {
    const links = [...results.querySelectorAll("a")], at = links.indexOf(document.activeElement);
    const typing = /^(INPUT|TEXTAREA)$/.test(document.activeElement.tagName);
    if (event.key === "/" && !typing) field.focus();
    else if (event.key === "Escape" && !results.hidden) results.hidden = true;
    else if (event.key === "Enter" && typing && links.length) links[0].click();
    else if (event.key === "ArrowDown" && !results.hidden) (links[at + 1] ?? links[0])?.focus();
    else if (event.key === "ArrowUp" && at >= 0) (links[at - 1] ?? field).focus();
    else return;
    event.preventDefault();
  });
  document.addEventListener("click", (event) => {
    if (!event.target.closest("#search-results a, #MSearchBox")) results.hidden ||= !results.contains(event.target);
    if (event.target.closest("#search-results a")) results.hidden = true;
  });
});
