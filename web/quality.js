// How good a fit is, beside its error: what the recordings say of the parameters, what is left over, and where the starts
// of its solvers ended. Draws what the record of the fit holds.
const quality = (function () {
"use strict";

const { isNumber, fmt, el, section } = common;
const { half, svgNode, extent, padded, chart } = charts;

const list = (value) => (Array.isArray(value) ? value : []);
const percent = (share, digits) => `${fmt(100 * share, digits)} %`;
const figure = (caption, node, note) =>
  el("figure", { class: "plot" }, el("figcaption", {}, el("span", {}, caption)), node, note ? el("p", { class: "muted" }, note) : "");

function correlations(record) {
  if (!record || !list(record.names).length) return [];
  return [el("h3", {}, "Correlation of the parameters"),
    el("p", { class: list(record.inseparable).length ? "warning" : null }, record.note.replace(/= -/g, "= −")),
    el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Correlations of the parameters" }, correlation.map(record.names, record.values)),
    el("p", { class: "muted" }, "Of the estimates at the optimum, from the curvature there; parameters on a bound are left out, and of a parameter with a law its values at the levels named stand for it. Near 1 or −1 the recordings fix a combination of the two, not each.")];
}

function sensitivities(rows, of) {
  if (!list(rows).length) return [];
  const largest = Math.max(...rows.map((row) => row.value ?? 0)) || 1;
  return [el("h3", {}, "Sensitivity"),
    el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Sensitivity" }, el("table", { class: "bars" },
      el("caption", {}, el("span", {}, `Scaled sensitivity of each parameter p: rms of p ∂${of.symbol}/∂p over the rms of the measured ${of.word}. At 0.5 a parameter that is 1 % larger changes the ${of.word} by 0.5 %.`)),
      el("tbody", {}, rows.map((row) => el("tr", {}, el("th", { scope: "row" }, el("code", {}, row.parameter)),
        el("td", { class: "num" }, fmt(row.value, 3)),
        el("td", { class: "bar" }, isNumber(row.value) ? svgNode(`<svg viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true"><rect class="cell below" width="${(100 * row.value / largest).toFixed(2)}" height="10"/></svg>`) : "not known"))))))];
}

// of: {word, symbol} of what was fitted, the force or the displacement.
function parameters(report, of) {
  const parts = [...sensitivities(report.sensitivity, of), ...correlations(report.correlation)];
  return parts.length ? section("known", "What the recordings say of the parameters", ...parts) : null;
}

function residual(record, of) {
  if (!record || !list(record.autocorrelation).length) return null;
  const facts = [
    ["AIC", `${fmt(record.aic, 5)}, n ln(mean square) + 2 k with n the effective sample size and k = ${record.free_parameters} free parameters`],
    ["BIC", `${fmt(record.bic, 5)}, with a penalty of k ln n`],
    ["Effective sample size", `${fmt(record.effective_samples, 3)} of ${record.samples} samples, by their correlation with their neighbours`],
    ["Lag-1 correlation", fmt(record.autocorrelation[0], 3)],
    ["Whiteness", `${percent(record.lags_outside, 2)} of ${record.autocorrelation.length} lags are outside the band within which white noise keeps 95 %`],
  ];
  const lags = record.autocorrelation.map((_, k) => k + 1);
  const limit = record.white_band ?? 1.96 / Math.sqrt(record.samples);
  const edge = (sign) => ({ x: [1, lags.length], y: [sign * limit, sign * limit], cls: "measured", dash: "5 4" });
  const { reach, density } = record.histogram;
  const edges = density.map((_, k) => -reach + (2 * reach * k) / density.length);
  const width = (2 * reach) / density.length;
  const steps = { x: [-reach, ...edges.flatMap((at) => [at, at + width]), reach], y: [0, ...density.flatMap((v) => [v, v]), 0], cls: "residual" };
  const grid = Array.from({ length: 81 }, (_, k) => -reach + (k * reach) / 40);
  const bell = { x: grid, y: grid.map((v) => Math.exp(-0.5 * v * v) / Math.sqrt(2 * Math.PI)), cls: "measured", dash: "5 4" };
  const size = { width: half(), height: 280, margin: [8, 10, 38, 46] };
  return section("residual", "What is left over",
    el("p", { class: "muted" }, `Measured less simulated ${of.word} of the fitted recordings, all samples, each recording over its own normaliser. AIC and BIC rank models on the same recordings only, as compare does.`),
    el("dl", { class: "facts" }, facts.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)])),
    el("div", { class: "plots" },
      figure("Autocorrelation; white noise stays between the dashed lines", svgNode(chart({ ...size, title: "Autocorrelation of the residual",
        x: { label: "Lag [samples]", range: [0, lags.length + 1] }, y: { label: "Correlation", range: padded(extent([record.autocorrelation, [-limit, limit]])) },
        series: [edge(1), edge(-1), { x: lags, y: record.autocorrelation, cls: "residual", dots: true }] }))),
      figure("Histogram; dashed: normal", svgNode(chart({ ...size, title: "Histogram of the residual over its root mean square",
        x: { label: "Residual / RMS", range: [-reach, reach] }, y: { label: "Density", range: [0, 1.1 * Math.max(0.42, ...density)] }, series: [bell, steps] })),
      record.histogram.beyond > 0 ? `${percent(record.histogram.beyond, 2)} of the samples are beyond ${reach} times the root mean square.` : "")));
}

// runs: [{name, starts}] of solvers that start more than once.
function waterfall(runs) {
  const shown = runs.filter((run) => run.starts && list(run.starts.costs).length > 1);
  if (!shown.length) return [];
  const figures = shown.map(({ name, starts }) => {
    const costs = starts.costs;
    const [lo, hi] = extent([costs]);
    const log = lo > 0 && hi > 1.02 * lo;
    const diverged = starts.diverged ? ` ${starts.diverged} more diverged.` : "";
    return figure(`${name}: ${starts.reached} of ${costs.length} starts ended at the best`,
      svgNode(chart({ width: half(), height: 240, margin: [8, 10, 38, 46], title: `Final costs of the starts of ${name}, sorted`,
        x: { label: "Start, best first", range: [0.5, costs.length + 0.5], whole: true },
        y: { label: starts.screened ? "Screened cost" : "Cost", log, range: log ? [lo / 1.02, hi * 1.02] : padded([lo, hi]) },
        series: [{ x: costs.map((_, k) => k + 1), y: costs, cls: "residual", dots: true }] })),
      `Within ${percent(starts.same, 2)} of it.${diverged}${starts.screened ? " Costs of a coarse simulation of thinned recordings, by which the starts are compared before the best are taken further." : ""}`);
  });
  return [el("h3", {}, "Waterfall: final cost of every start, sorted"),
    el("p", { class: "muted" }, "A flat step is an optimum found again and again; a best that one start alone found may not be the best there is."),
    el("div", { class: "plots" }, figures)];
}

return { parameters, residual, waterfall };
})();
