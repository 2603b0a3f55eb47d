// How good a fit is, beside its error: what the recordings say of the parameters. Draws what the record of the fit holds.
const quality = (function () {
"use strict";

const { isNumber, fmt, el, section } = common;
const { svgNode } = charts;

const list = (value) => (Array.isArray(value) ? value : []);

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

return { parameters };
})();
