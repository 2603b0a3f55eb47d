// Draws the page of a comparison from its embedded data. Every number shown was computed by hysteron; this script only
// sets numbers and curves on the page. Text from the data reaches the page as text nodes or through esc().
(function () {
"use strict";

const { isNumber, fmt, el, section, css } = common;
const { svgNode, extent, padded, chart } = charts;
const data = JSON.parse(document.getElementById("report-data").textContent);
const models = data.models;
// Charts stand side by side where there is room.
const grid = "display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,420px),1fr));gap:18px";
const dashes = ["", "7 3", "2 3", "9 3 2 3"];
const color = (k) => css(`--s${k % 7}`);
const dash = (k) => dashes[Math.floor(k / 7) % dashes.length];

function table(caption, columns, rows) {
  return el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    el("table", { class: columns.length > 3 ? "stack" : null }, el("caption", {}, el("span", {}, caption)),
      el("thead", {}, el("tr", {}, columns.map((c) => el("th", { scope: "col", class: c.num ? "num" : null }, c.title)))),
      el("tbody", {}, rows.map((cells) => el("tr", {}, cells.map((cell, i) =>
        el(i === 0 ? "th" : "td", { scope: i === 0 ? "row" : null, class: columns[i].num ? "num" : null, "data-title": columns[i].title }, cell)))))));
}

// series: [{x, y, color, dash, cls}]
function figure(title, xlabel, ylabel, series) {
  // On a phone as wide as the screen, so that the writing keeps its size.
  const width = Math.max(300, Math.min(560, document.documentElement.clientWidth - 40));
  return el("figure", {}, svgNode(chart({
    width, height: 340, title, margin: [10, 12, 40, 66], series,
    x: { label: xlabel, range: padded(extent(series.map((s) => s.x)), 0.04) }, y: { label: ylabel, range: padded(extent(series.map((s) => s.y)), 0.04) } })),
  el("figcaption", {}, title));
}

const item = (stroke, pattern, text) =>
  el("li", {}, el("i", { style: `border-top-color:${stroke};border-top-style:${pattern ? "dashed" : "solid"}` }), text);
function legend(measured) {
  return el("ul", { class: "legend" }, measured ? item(css("--ink"), "", measured) : [],
    models.map((m, k) => item(color(k), dash(k), m.label)));
}

function draw() {
  const content = document.getElementById("content");
  const signed = (v, digits) => (isNumber(v) ? v.toFixed(digits) : "–");
  const summary = table("Models", [{ title: "Model" }, { title: "Free parameters", num: true },
    { title: "NRMSE, fitted", num: true }, { title: "NRMSE, unseen", num: true }, { title: "ΔAIC", num: true },
    { title: "ΔBIC", num: true }, { title: "Lag-1 correlation", num: true }, { title: "Lags not white", num: true }],
  models.map((m) => [m.label, String(m.free_parameters), fmt(m.nrmse.fitted), fmt(m.nrmse.unseen), signed(m.delta_aic, 1),
    signed(m.delta_bic, 1), signed(m.residual.autocorrelation[0], 3), `${signed(100 * m.residual.lags_outside, 1)} %`]));
  const each = table("NRMSE of every recording", [{ title: "Recording" }, ...models.map((m) => ({ title: m.label, num: true }))],
    data.recordings.map((r) => [r.file, ...r.nrmse.map((v, k) => fmt(v) + (r.fitted[k] ? "" : " *"))]));

  const figures = el("div", { style: grid });
  const select = el("select", { onchange: () => loops(select.selectedIndex) }, data.loops.map((r) => el("option", {}, r.file)));
  const loops = (k) => {
    const r = data.loops[k];
    const curves = (x) => [{ x, y: r.force_n, color: css("--ink"), cls: "chosen" },
      ...r.models.map((y, m) => ({ x, y, color: color(m), dash: dash(m) }))];
    figures.replaceChildren(
      figure(`Force over displacement, ${r.file}`, "displacement [mm]", "force [N]", curves(r.displacement_mm)),
      figure(`Force over velocity, ${r.file}`, "velocity [mm/s]", "force [N]", curves(r.velocity_mm_s)),
      figure(`Residual over time, ${r.file}`, "time [s]", "measured − model [N]",
        r.models.map((y, m) => ({ x: r.time, y: y.map((v, i) => (isNumber(v) ? r.force_n[i] - v : null)), color: color(m), dash: dash(m) }))));
  };
  const lags = models[0].residual.autocorrelation.map((_, k) => k + 1);
  const limit = models[0].residual.white_band ?? 1.96 / Math.sqrt(models[0].residual.samples);
  const edge = (sign) => ({ x: [1, lags.length], y: [sign * limit, sign * limit], color: css("--muted"), dash: "3 3" });
  const reach = models[0].residual.histogram.reach;
  const bins = models[0].residual.histogram.density.length;
  const centres = Array.from({ length: bins }, (_, k) => -reach + ((k + 0.5) * 2 * reach) / bins);
  const normal = { x: centres, y: centres.map((v) => Math.exp(-0.5 * v * v) / Math.sqrt(2 * Math.PI)), color: css("--muted"), dash: "3 3" };
  content.replaceChildren(
    el("header", {}, el("h1", {}, data.title), el("p", { class: "sub" },
      `${models.length} models on ${data.recordings.length} recordings · NRMSE normalised by ${data.normalisation} · hysteron ${data.version}`)),
    el("main", {},
      section("models", "Models", summary, el("p", { class: "note" }, data.note + ".")),
      section("loops", "Loops", el("label", { class: "interactive" }, "Recording ", select), legend("measured"), figures),
      section("residuals", "Residuals", legend(), el("div", { style: grid },
        figure("Autocorrelation of the residual; white noise stays between the dashed lines", "lag [samples]", "correlation",
          [edge(1), edge(-1), ...models.map((m, k) => ({ x: lags, y: m.residual.autocorrelation, color: color(k), dash: dash(k) }))]),
        figure("Histogram of the residual over its root mean square; dashed: normal", "residual / RMS", "density",
          [normal, ...models.map((m, k) => ({ x: centres, y: m.residual.histogram.density, color: color(k), dash: dash(k) }))]))),
      section("recordings", "Recordings", each,
        data.recordings.every((r) => r.fitted.every(Boolean)) ? [] : el("p", { class: "note" }, "* the model was not fitted on this recording.")),
      section("command", "Command", el("pre", { style: "white-space:pre-wrap;overflow-wrap:anywhere" }, data.command))));
  loops(0);
}

draw();
document.documentElement.dataset.ready = "true";
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
})();
