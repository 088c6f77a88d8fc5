// SPDX-License-Identifier: Apache-2.0
"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const $ = id => document.getElementById(id);
const make = (tag, props = {}, ...children) => {
  const e = Object.assign(document.createElement(tag), props);
  e.append(...children);
  return e;
};
const has = v => v !== undefined && v !== null;
const short = v => !has(v) ? "–" : v === 0 ? "0" : Math.abs(v) >= 1e-5 ? v.toFixed(5) : v.toExponential(1);
const digits = n => v => !has(v) ? "–" : v === 0 ? "0" : v.toFixed(n);

const first = data.runs[0], lights = [...new Set(data.runs.map(r => r.light))], ran = data.runs.filter(r => !r.skipped);
const entries = new Set(data.runs.map(r => r.name)).size, ids = new Set(data.runs.map(r => r.technique)).size, samples = Math.max(...ran.map(r => r.truth.samples));
const many = (n, what) => `${n} ${what}${n === 1 ? "" : "s"}`;
$("title").textContent = `${first.scene}: ${many(ids, "technique")}${entries > ids ? ` in ${entries} settings` : ""} against ray-traced truth`;
document.title = "Gnomon: " + first.scene;
$("about").textContent = [`${first.size.join("x")}${first.camera ? ", camera " + first.camera : ""}`, `${lights.length > 1 ? "lights" : "light"} ${lights.join(", ")}`,
  `${data.device}, ${data.driver}`, `commit ${data.commit}`, `truth of ${many(samples, "sample")} a pixel`].join("; ");

// What is shown of all: by the words of the filter, in the order of the sorted column.
const columns = [{ name: "technique", of: r => r.name, help: "with the parameters that are not its defaults" },
  { name: "ms", of: r => r.technique_ms, help: "of the technique's own passes, mean of the repetitions", text: digits(2) },
  { name: "±", unit: "ms", of: r => r.technique_deviation, help: "standard deviation of the milliseconds", text: digits(2), plain: true },
  { name: "MiB", of: r => has(r.bytes) ? r.bytes / 1048576 : undefined, help: "of its own images and buffers", text: digits(2) }];
// parts and relatives of other metrics: shown on demand
const detail = new Set(["wrong_outside_band", "acne_outside_band", "leak_outside_band", "contact_gap", "rms", "max", "bias_penumbra", "bias_outside", "grain", "noise", "filter_rms", "filter_max", "filter_bias"]);
const early = ["popping", "swimming", "flicker", "flip", "wrong_pixels", "mae"];
for (const m of [...data.metrics].sort((a, b) => early.indexOf(b.id) - early.indexOf(a.id)))
  if (ran.some(r => has(r.metrics[m.id])))
    columns.push({ name: m.id, unit: m.unit, of: r => r.metrics && r.metrics[m.id], help: m.help, text: m.unit === "pixels" ? digits(3) : short, detail: detail.has(m.id), plain: m.id.endsWith("noise") });
let sorted = columns.findIndex(c => c.name === "mae"), sign = 1;
function order(a, b) {
  const x = columns[sorted].of(a), y = columns[sorted].of(b);
  return !has(x) ? has(y) ? 1 : 0 : !has(y) ? -1 : sign * (typeof x === "string" ? x.localeCompare(y) : Math.abs(x) - Math.abs(y));
}
function shown(runs) {
  const words = $("filter").value.toLowerCase().split(/\s+/).filter(Boolean);
  return runs.filter(r => words.every(w => `${r.name} ${r.title} ${r.family} ${r.light}`.toLowerCase().includes(w))).sort(order);
}
/// [heading, runs] by light and family, as far as there is more than one of them.
function groups(runs, withLight) {
  const out = new Map(), families = [...new Set(data.runs.map(r => r.family))];
  const rank = r => [withLight ? lights.indexOf(r.light) : 0, $("families").checked ? families.indexOf(r.family) : 0];
  for (const r of [...runs].sort((a, b) => rank(a)[0] - rank(b)[0] || rank(a)[1] - rank(b)[1])) {
    const heading = [withLight && lights.length > 1 && r.light, $("families").checked && families.length > 1 && r.family].filter(Boolean).join(": ");
    if (!out.has(heading)) out.set(heading, []);
    out.get(heading).push(r);
  }
  return [...out];
}

function drawTable() {
  const visible = columns.filter(c => !c.detail || $("all").checked || c === columns[sorted]);
  const best = new Map(lights.map(l => [l, new Map(visible.filter(c => c.text && !c.plain).map(c => [c, Math.min(...ran.filter(r => r.light === l).map(c.of).filter(has).map(Math.abs))]))]));
  const head = visible.map(c => {
    const button = make("button", { onclick: () => { sign = c === columns[sorted] ? -sign : 1; sorted = columns.indexOf(c); draw(); $("numbers").querySelector("[aria-sort] button").focus(); } }, c.name.replaceAll("_", "\n"));
    if (c.unit) button.append(make("small", { textContent: c.unit }));
    const th = make("th", { title: c.help, scope: "col" }, button);
    if (c === columns[sorted]) th.ariaSort = sign > 0 ? "ascending" : "descending";
    return th;
  });
  const cells = r => [make("td", { title: `${r.title} (${r.cite})` }, (r.front ? "★ " : "") + r.name + " ", make("span", { className: "faint", textContent: r.title })), ...r.skipped
    ? [make("td", { className: "text faint", colSpan: visible.length - 1, textContent: "skipped: " + r.skipped })]
    : visible.slice(1).map(c => make("td", { className: has(c.of(r)) && Math.abs(c.of(r)) === best.get(r.light).get(c) ? "best" : "", textContent: c.text(c.of(r)) }))];
  const rows = groups(shown(data.runs), true).flatMap(([heading, runs]) => [
    ...heading ? [make("tr", { className: "group" }, make("td", { textContent: heading }), make("td", { colSpan: visible.length - 1 }))] : [],
    ...runs.map(r => make("tr", {}, ...cells(r)))]);
  $("numbers").replaceChildren(make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...rows));
  const left = new Set(shown(data.runs).map(r => r.name)).size;
  $("shown").textContent = left === entries ? "" : `${left} of ${entries}`;
}

for (const plot of data.plots) {
  const div = make("div", { innerHTML: plot });
  for (const title of div.querySelectorAll("title")) title.remove();
  // gnuplot leaves what is said of a mark to a script of its own
  for (const mark of div.querySelectorAll("[onmousemove]")) {
    const title = document.createElementNS("http://www.w3.org/2000/svg", "title");
    title.textContent = mark.getAttribute("onmousemove").split("'")[1];
    for (const name of ["onmousemove", "onmouseout"]) mark.removeAttribute(name);
    mark.prepend(title);
  }
  $("plots").append(div);
}
if (!data.plots.length) $("plots").textContent = data.no_plot;
for (const light of lights) {
  const on = data.runs.filter(r => r.front && r.light === light).sort((a, b) => a.technique_ms - b.technique_ms);
  $("front").append(make("p", {}, `★ ${lights.length > 1 ? light + ": " : ""}` + on.map(r => `${r.name} (${r.technique_ms.toFixed(2)} ms, mae ${short(r.metrics.mae)})`).join(", ")));
}

// the pictures
$("light").append(...lights.map(l => make("option", { textContent: l })));
$("lights").hidden = lights.length === 1;
const kinds = { lit: "lit", visibility: "visibility", error: "signed error" };
if (data.runs.some(r => r.pictures && r.pictures.change)) kinds.change = "change a frame";
let kind = "lit", at = { x: 0, y: 0, scale: 1 }, views = [];
for (const [id, name] of Object.entries(kinds))
  $("kinds").append(make("button", { textContent: name, value: id, onclick: () => { kind = id; drawGrid(); } }), " ");
const uri = name => "data:image/png;base64," + data.pictures[name];
function card(name, note, picture, truth, more = []) {
  const view = make("div", { className: "view", tabIndex: views.length ? -1 : 0 });
  view.style.aspectRatio = first.size.join("/");
  view.append(make("img", { src: uri(picture), alt: `${name}, ${kinds[kind]}`, loading: "lazy", decoding: "async" }));
  if (truth && truth !== picture)
    view.append(make("img", { src: uri(truth), alt: "", className: "truth", loading: "lazy", decoding: "async" }), make("div", { className: "wipe" }));
  views.push(view);
  return make("figure", {}, view, make("figcaption", {}, make("strong", { textContent: name }), make("span", { className: "faint", textContent: note })), ...more);
}
function detailsOf(r) {
  const passes = make("table", {}, ...r.passes.map(p => make("tr", {}, make("td", { textContent: p.name + (p.count > 1 ? ` (${p.count})` : "") }), make("td", { textContent: `${p.ms.toFixed(2)} ± ${p.deviation.toFixed(2)} ms` }))));
  const counts = Object.entries(r.counts || {}).map(([n, v]) => `${n} ${v.toLocaleString("en")}`).join(", ");
  const params = Object.entries(r.params).map(([n, v]) => `${n}=${v}`).join(", ");
  return make("details", { open: $("details").checked }, make("summary", { textContent: "times and parameters" }), make("p", { className: "faint", textContent: `${r.title} (${r.cite})` }),
    passes, make("p", { className: "faint", textContent: [params, counts].filter(Boolean).join("; ") }));
}
function drawGrid() {
  const light = $("light").value, truths = data.truths.filter(t => t.light === light);
  for (const b of $("kinds").querySelectorAll("button")) b.ariaPressed = String(b.value === kind);
  $("legend").hidden = kind !== "error";
  views = [];
  const cards = truths.filter(t => t[kind]).map(t => card(truths.length > 1 ? `truth (${t.quantity})` : "truth", "ray traced", t[kind], null));
  for (const [heading, runs] of groups(shown(ran.filter(r => r.light === light)), false)) {
    if (heading) cards.push(make("h3", { textContent: heading }));
    for (const r of runs) {
      const truth = truths.find(t => t.quantity === r.quantity);
      cards.push(card((r.front ? "★ " : "") + r.name, `mae ${short(r.metrics.mae)}, ${r.technique_ms.toFixed(1)} ms`, r.pictures[kind], truth && truth[kind], [detailsOf(r)]));
    }
  }
  $("grid").replaceChildren(...cards);
  place();
}
function draw() { drawTable(), drawGrid(); }
function place() {
  const wipe = Number($("wipe").value);
  for (const v of views) {
    const w = v.clientWidth, h = v.clientHeight;
    for (const i of v.querySelectorAll("img")) {
      i.style.transform = `translate(${-at.x * w * at.scale}px, ${-at.y * h * at.scale}px) scale(${at.scale})`;
      // what is shown left of the wipe, as a part of the unscaled picture
      if (i.className === "truth") i.style.clipPath = `inset(0 ${100 - Math.min(100, 100 * (at.x + wipe / 100 / at.scale))}% 0 0)`;
    }
    const line = v.querySelector(".wipe");
    if (line) line.style.left = wipe + "%", line.hidden = wipe === 0;
    v.classList.toggle("near", at.scale * w > 1.5 * first.size[0]);
  }
  $("zoom").value = Math.log2(at.scale);
  $("times").textContent = at.scale.toFixed(at.scale < 10 ? 1 : 0) + "x";
  const said = { light: $("light").value, kind, truth: wipe, x: at.x.toFixed(4), y: at.y.toFixed(4), zoom: at.scale.toFixed(2), width: $("wide").value };
  if ($("filter").value) said.only = $("filter").value;
  if (!$("families").checked) said.families = 0;
  if ($("all").checked) said.all = 1;
  history.replaceState(null, "", "#" + new URLSearchParams(said));
}
// The address holds what is looked at, so that it can be passed on.
function readAddress() {
  const said = new URLSearchParams(location.hash.slice(1)), number = (key, otherwise) => Number.isFinite(parseFloat(said.get(key))) ? parseFloat(said.get(key)) : otherwise;
  if (lights.includes(said.get("light"))) $("light").value = said.get("light");
  if (said.get("kind") in kinds) kind = said.get("kind");
  $("wipe").value = number("truth", 0);
  $("wide").value = number("width", 420);
  $("filter").value = said.get("only") || "";
  $("families").checked = said.get("families") !== "0", $("all").checked = said.get("all") === "1";
  $("grid").style.setProperty("--wide", $("wide").value + "px");
  at = { x: number("x", 0), y: number("y", 0), scale: Math.min(Math.max(number("zoom", 1), 1), 64) };
  hold();
}
function hold() { const room = 1 - 1 / at.scale; at.x = Math.min(Math.max(at.x, 0), room); at.y = Math.min(Math.max(at.y, 0), room); }
/// What lies at (u, v) of the view stays there.
function zoomTo(scale, u = 0.5, v = 0.5) {
  const next = Math.min(Math.max(scale, 1), 64);
  at.x += u / at.scale - u / next, at.y += v / at.scale - v / next, at.scale = next;
  hold(), place();
}
$("grid").addEventListener("wheel", e => {
  const v = e.target.closest(".view");
  if (!v) return;
  e.preventDefault();
  const box = v.getBoundingClientRect();
  zoomTo(at.scale * Math.exp(-e.deltaY * 0.002), (e.clientX - box.left) / box.width, (e.clientY - box.top) / box.height);
}, { passive: false });
let drag = null;
$("grid").addEventListener("pointerdown", e => { const v = e.target.closest(".view"); if (v) drag = { v, x: e.clientX, y: e.clientY }, v.setPointerCapture(e.pointerId); });
$("grid").addEventListener("pointermove", e => {
  if (!drag) return;
  const box = drag.v.getBoundingClientRect();
  if (e.shiftKey) $("wipe").value = 100 * (e.clientX - box.left) / box.width;
  else at.x -= (e.clientX - drag.x) / box.width / at.scale, at.y -= (e.clientY - drag.y) / box.height / at.scale, hold();
  drag.x = e.clientX, drag.y = e.clientY;
  place();
});
for (const end of ["pointerup", "pointercancel"]) $("grid").addEventListener(end, () => { drag = null; });
const whole = () => { at = { x: 0, y: 0, scale: 1 }; place(); };
$("grid").addEventListener("keydown", e => {
  if (!e.target.classList.contains("view") || e.ctrlKey || e.metaKey || e.altKey) return;
  const move = (x, y) => () => { at.x += 0.1 * x / at.scale, at.y += 0.1 * y / at.scale; hold(), place(); };
  const keys = { ArrowLeft: move(-1, 0), ArrowRight: move(1, 0), ArrowUp: move(0, -1), ArrowDown: move(0, 1), "+": () => zoomTo(at.scale * 1.25), "=": () => zoomTo(at.scale * 1.25),
    "-": () => zoomTo(at.scale / 1.25), 0: whole, t: () => { $("wipe").value = Number($("wipe").value) < 100 ? 100 : 0; place(); } };
  // arrows scroll the page while there is nothing to move
  if (!keys[e.key] || (at.scale === 1 && e.key.startsWith("Arrow"))) return;
  e.preventDefault();
  keys[e.key]();
});
$("wipe").oninput = place;
$("zoom").oninput = () => zoomTo(2 ** Number($("zoom").value));
$("wide").oninput = () => { $("grid").style.setProperty("--wide", $("wide").value + "px"); place(); };
$("details").onchange = () => { for (const d of $("grid").querySelectorAll("details")) d.open = $("details").checked; };
$("reset").onclick = whole;
$("light").onchange = drawGrid;
$("filter").oninput = $("families").onchange = $("all").onchange = draw;
new ResizeObserver(place).observe($("grid"));
addEventListener("beforeprint", () => { for (const i of $("grid").querySelectorAll("img")) i.loading = "eager"; });
document.querySelector(".legend").style.background = `linear-gradient(90deg, ${data.error_colors.join(", ")})`;
readAddress();
draw();
