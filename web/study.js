// Draws the page of a study from its embedded data. Every number shown was computed by hysteron; this script only sets
// numbers and curves on the page. Text from the data reaches the page as text nodes or through esc(), never as HTML.
(function () {
"use strict";

const { root, isNumber, superscript, fmt, esc, el, section, css, logTicks } = common;
const { font, widest, axisWidth, svgNode } = charts;
const study = JSON.parse(document.getElementById("report-data").textContent);
const solvers = study.solvers.map((s) => s.label);
const problems = study.problems.map((p) => p.label);

function picker(label, words, change) {
  const select = el("select", { onchange: () => change(select.selectedIndex) }, words.map((w) => el("option", {}, w)));
  return el("label", { class: "interactive" }, label, select);
}

// Controls are not printed: says in their place which of the choices the figures below are of.
function printed(words) {
  const node = el("p", { class: "print-only" });
  const say = (k) => { node.textContent = `Shown: ${words[k]}${words.length > 1 ? ` (one of ${words.length})` : ""}`; };
  return { node, say };
}

// ------------------------------------------------------------------------------------------------------------- colours

// Seven colours, then the same ones dashed: no two of the first 28 solvers look alike.
const dashes = [null, [7, 3], [2, 3], [9, 3, 2, 3]];
const color = (s) => css(`--s${s % 7}`);
const dash = (s) => dashes[Math.floor(s / 7) % dashes.length];

function faded(text, alpha) {
  const value = text.replace("#", "");
  const [r, g, b] = [0, 2, 4].map((k) => parseInt(value.slice(k, k + 2), 16));
  return `rgba(${r},${g},${b},${alpha})`;
}

// --------------------------------------------------------------------------------------------------------------- plots

const redraw = [];  // every plot again: other colours, other width

// options: title, x and y {label, log, range}, grid, series [{name, solver, y, band}], step, points
function plot(host, options) {
  const axis = (label, side, log) => ({
    label, font, labelFont: font, labelSize: 20, gap: 4, stroke: css("--ink"), size: side === 3 ? axisWidth(58) : 32, space: side === 3 ? 30 : 60,
    grid: { stroke: css("--grid"), width: 1 }, ticks: { stroke: css("--line"), width: 1, size: 4 },
    ...(log ? {
      splits: (u, k, low, high) => logTicks(low, high).map(([value]) => value),
      filter: (u, splits) => splits,
      values: (u, splits, k) => { const { min, max } = u.scales[u.axes[k].scale]; const words = new Map(logTicks(min, max)); return splits.map((v) => words.get(v) ?? ""); },
    } : { values: (u, splits) => splits.map((v) => String(Number(v.toPrecision(6)))) }),
  });
  const series = [{ label: options.x.short || options.x.label, value: (u, v) => (isNumber(v) ? fmt(v, 4) : "–") }];
  const data = [options.grid];
  const bands = [];
  for (const s of options.series) {
    const stroke = color(s.solver);
    series.push({
      label: s.name, stroke, width: 1.8, dash: dash(s.solver) || undefined, spanGaps: false,
      points: options.points ? { show: true, size: 5, stroke, fill: stroke } : { show: false },
      paths: options.step ? uPlot.paths.stepped({ align: 1 }) : undefined,
      value: (u, v) => (v === null || v === undefined ? "–" : fmt(v, options.digits || 3)),
    });
    data.push(s.y);
    if (s.band) {
      const at = series.length;
      for (const edge of s.band) {
        series.push({ label: `${s.name} quartile`, stroke: "transparent", width: 1, points: { show: false } });
        data.push(edge);
      }
      bands.push({ series: [at, at + 1], fill: faded(stroke, 0.14) });
    }
  }
  let u = null;
  function build() {
    if (u) u.destroy();
    host.replaceChildren();
    const width = Math.max(280, host.clientWidth);
    u = new uPlot({
      width, height: Math.round(Math.min(options.height || 340, Math.max(240, width * 0.6))),
      scales: { x: { time: false, distr: options.x.log ? 3 : 1, range: options.x.range || [options.grid[0], options.grid[options.grid.length - 1]] }, y: { distr: options.y.log ? 3 : 1, range: options.y.range } },
      axes: [axis(options.x.label, 2, options.x.log), axis(options.y.label, 3, options.y.log)],
      series, bands, cursor: { points: { size: 6 } }, legend: { live: true },
      hooks: {
        init: [(self) => {
          // Edges of bands are no curves of their own: out of the legend.
          const rows = self.root.querySelectorAll(".u-legend .u-series");
          self.series.forEach((s, k) => { if (k && s.stroke && s.label.endsWith(" quartile") && rows[k]) rows[k].style.display = "none"; });
        }],
      },
    }, data, host);
  }
  build();
  redraw.push(build);
  return { destroy: () => { if (u) u.destroy(); const at = redraw.indexOf(build); if (at >= 0) redraw.splice(at, 1); } };
}

function figure(caption, note) {
  const host = el("div", { class: "host", role: "img", "aria-label": caption });
  return { host, node: el("figure", { class: "plot" }, el("figcaption", {}, el("span", {}, caption)), host, note ? el("p", { class: "muted" }, note) : "") };
}

// A figure that is drawn again for every problem chosen.
function byProblem(caption, note, draw) {
  const f = figure(caption, note);
  let current = null;
  return { node: f.node, show: (p) => { if (current) current.destroy(); current = draw(f.host, p); } };
}

const decades = (values) => {
  const positive = values.flat().filter((v) => isNumber(v) && v > 0);
  if (!positive.length) return [0.1, 1];
  const low = Math.min(...positive), high = Math.max(...positive);
  return [low / 1.1, Math.max(high * 1.1, low * 1.5)];
};

// ------------------------------------------------------------------------------------- critical difference diagram

function criticalDifference() {
  if (study.ranking.rows.length < 2) return null;
  const rows = study.ranking.rows.map((row) => ({ ...row, name: solvers[row.solver] }));
  const host = el("div", {});
  // On paper as on a screen; as wide as there is room, up to where lines become long to follow.
  const draw = () => { host.innerHTML = ranks.diagram(rows, study.ranking.cliques, study.ranking.critical_difference, Math.min(900, Math.max(280, host.clientWidth)), color); };
  redraw.push(draw);
  return {
    node: el("figure", { class: "plot wide ranks" }, el("figcaption", {}, el("span", {}, "Mean ranks, 1 the best; a bar joins solvers that are not told apart")), host),
    draw,
  };
}

// -------------------------------------------------------------------------------------------------------------- tables

// Names do not break at their hyphens; sentences wrap.
const kept = (text) => (text.length < 32 ? "nowrap" : null);
// Tables too wide for a phone stand there as one block a row, each cell beside its column's title.
const stacked = (titles) => (titles.length > 3 ? "stack" : null);
const tableOf = (id) => study.tables.find((t) => t.id === id);

// filter: column whose words the reader can choose from
function shownTable(id, filter) {
  const t = tableOf(id);
  if (!t || !t.rows.length) return t ? el("div", {}, el("h3", {}, t.title), el("p", { class: "muted" }, t.note)) : null;
  const body = el("tbody", {});
  const fill = (word) => body.replaceChildren(...t.rows.filter((r) => !word || r[filter] === word).map((cells) =>
    el("tr", {}, cells.map((cell, i) => el("td", { class: t.numeric[i] ? "num" : kept(cell), "data-title": t.header[i] }, cell)))));
  fill();
  const words = filter === undefined ? [] : [...new Set(t.rows.map((r) => r[filter]))];
  return el("div", { id: `table-${id}` }, el("h3", {}, t.title), el("p", { class: "muted" }, t.note),
    words.length > 1 ? el("div", { class: "controls" }, picker(t.header[filter], ["all", ...words], (k) => fill(k ? words[k - 1] : ""))) : "",
    el("div", { class: `scroll${t.rows.length > 20 ? " tall" : ""}`, tabindex: 0, role: "region", "aria-label": t.title },
      el("table", { class: stacked(t.header) }, el("thead", {}, el("tr", {}, t.header.map((h, i) => el("th", { scope: "col", class: t.numeric[i] ? "num" : null }, h)))), body)));
}

// ---------------------------------------------------------------------------------------------------------- the page

function progress() {
  const grid = study.convergence.evaluations;
  const bands = byProblem("Convergence: median and quartiles of the best NRMSE so far", "", (host, p) => {
    const rows = study.convergence.rows.filter((r) => r.problem === p);
    return plot(host, {
      grid, x: { label: "evaluations", log: true }, y: { label: "NRMSE", log: true, range: decades(rows.flatMap((r) => [r.q1, r.q3])) },
      series: rows.map((r) => ({ name: solvers[r.solver], solver: r.solver, y: r.median, band: [r.q3, r.q1] })),
    });
  });
  const starts = byProblem("Waterfall: final NRMSE of every start, sorted", "A flat step is an optimum found again and again.", (host, p) => {
    const rows = study.waterfall.filter((r) => r.problem === p && r.nrmse.length);
    const most = Math.max(1, ...rows.map((r) => r.nrmse.length));
    return plot(host, {
      grid: Array.from({ length: most }, (_, k) => k + 1), points: true,
      x: { label: "start, best first", range: [0.5, most + 0.5] }, y: { label: "NRMSE", log: true, range: decades(rows.map((r) => r.nrmse)) },
      series: rows.map((r) => ({ name: solvers[r.solver], solver: r.solver, y: Array.from({ length: most }, (_, k) => r.nrmse[k] ?? null) })),
    });
  });
  const paper = printed(problems);
  const show = (p) => { bands.show(p); starts.show(p); paper.say(p); };
  return {
    node: section("progress", "Every problem", el("div", { class: "controls" }, problems.length > 1 ? picker("Problem", problems, show) : el("strong", {}, problems[0])),
      paper.node, el("div", { class: "plots" }, bands.node, starts.node)),
    draw: () => show(0),
  };
}

function profiles() {
  const parts = [
    ["Targets reached", `Share of (problem, seed, target) reached; ${study.ecdf.targets} targets from ${study.ecdf.closest} to ${study.ecdf.farthest} above the best known NRMSE, relative to it.`,
      study.ecdf.evaluations, { label: "evaluations", log: true }, study.ecdf.share],
    ["Performance profile", `Share of ${study.profiles.performance_cases} (problem, target) pairs whose expected run time is within a factor of the best solver's. Relative to the solvers present.`,
      study.profiles.ratios, { label: "factor to the best", log: true }, study.profiles.performance],
    ["Data profile", `Share of ${study.profiles.data_cases} (problem, seed) solved to ${study.profiles.data_target || "the first target"} within a number of (dimension + 1) evaluations.`,
      study.profiles.simplex_gradients, { label: "evaluations / (dimension + 1)", log: true }, study.profiles.data],
  ];
  const figures = parts.map(([caption, note]) => figure(caption, note));
  return {
    node: section("profiles", "Over all problems", el("div", { class: "plots" }, figures.map((f) => f.node))),
    draw: () => parts.forEach(([, , grid, x, shares], k) => plot(figures[k].host, {
      grid, x, y: { label: "share", range: [-0.02, 1.02] }, step: true,
      series: shares.map((y, s) => ({ name: solvers[s], solver: s, y })),
    })),
  };
}

// ---------------------------------------------------------------------------------------------------- identifiability

// Every eigenvalue a bar down to it, with the parameters its direction is made of: beside it, below it on a phone.
function spectrumPlot(one, room) {
  const rows = one.spectrum;
  const parts = rows.map((row) => [...row.parts].sort((a, b) => Math.abs(b.weight) - Math.abs(a.weight)).slice(0, 3)
    .map((p) => `${p.weight < 0 ? "−" : "+"}${Math.abs(p.weight).toFixed(2)} ${one.parameters[p.parameter].name}`).join("  "));
  const text = Math.ceil(widest(parts));
  const left = 30, top = 8;
  const beside = left + 160 + 14 + text <= room;
  const width = beside ? Math.min(room, left + 250 + 14 + text) : room;
  const end = beside ? width - 14 - text : width - 12;
  const line = beside ? 21 : 36;
  const low = Math.min(-1, Math.floor(Math.log10(rows[rows.length - 1].eigenvalue)));
  const px = (value) => left + (1 - Math.max(low, Math.log10(value)) / low) * (end - left);
  const height = top + rows.length * line + 26;
  const out = [`<svg viewBox="0 0 ${width} ${height}" style="max-width:${width}px" role="img" aria-label="Eigenvalues of the Gauss-Newton matrix in logarithms of the parameters">`];
  const step = Math.max(1, Math.ceil(-low / 6));
  for (let e = 0; e >= low; e -= step) {
    const x = px(10 ** e);
    out.push(`<path d="M${x} ${top}V${top + rows.length * line}" style="stroke:var(--grid)"/><text class="tick" x="${x}" y="${height - 8}" text-anchor="middle">${e ? `10${superscript(e)}` : "1"}</text>`);
  }
  rows.forEach((row, k) => {
    const y = top + k * line + 10.5;
    out.push(`<path d="M${left} ${y}H${px(row.eigenvalue)}" style="stroke:${color(0)};stroke-width:9"/>`);
    out.push(`<text class="tick" x="${left - 8}" y="${y}" dy="0.35em" text-anchor="end">${k + 1}</text>`);
    out.push(`<text class="tick over" x="${beside ? end + 14 : left}" y="${beside ? y : y + 15}" dy="0.35em">${esc(parts[k])}</text>`);
  });
  out.push("</svg>");
  return out.join("");
}

function drawn(caption, note, picture) {
  const holder = el("div", { class: "scroll" }, picture);
  return el("figure", { class: "plot" }, el("figcaption", {}, el("span", {}, caption)), holder, el("p", { class: "muted" }, note));
}

function identifiabilitySection() {
  const all = study.identifiability || [];
  const known = all.map((one, p) => p).filter((p) => all[p]);
  if (!known.length) return null;
  const maps = el("div", { class: "plots" });
  const curves = el("div", { class: "plots" });
  const paper = printed(known.map((p) => problems[p]));
  let shown = [];
  const unit = (row, before = "") => (row.unit && row.unit !== "1" ? before + row.unit : "");
  const show = (p) => {
    const one = all[p];
    paper.say(known.indexOf(p));
    shown.forEach((s) => s.destroy());
    maps.replaceChildren(
      ...(one.free.length > 1 ? [drawn("Correlations of the parameters", "At the best fit, of parameters inside the box. Near 1 or −1: the data fix a combination of the two, not each.", correlation.map(one.free.map((c) => one.parameters[c].name), one.correlation))] : []),
      ...(one.spectrum.length > 1 ? [drawn("Sloppiness: eigenvalues for relative changes of the parameters", "The largest is 1. A direction far down may change by much and the force hardly does; beside it the parameters it is made of.", svgNode(spectrumPlot(one, Math.min(620, root.clientWidth - 56))))] : []));
    const figures = one.parameters.map((row) => {
      const bound = row.at_bound ? `, on its ${row.at_bound} bound` : "";
      const range = row.low === null && row.high === null ? "open to both sides" : row.low === null ? `below ${fmt(row.high, 4)}` : row.high === null ? `above ${fmt(row.low, 4)}` : `${fmt(row.low, 4)} to ${fmt(row.high, 4)}`;
      return figure(`${row.name} = ${fmt(row.value, 4)}${unit(row, " ")}${bound}`, `95 %: ${range}`);
    });
    curves.replaceChildren(...figures.map((f) => f.node));
    shown = one.parameters.map((row, c) => {
      const grid = row.profile.value;
      const high = Math.max(one.threshold + 2 * (one.threshold - one.nrmse), Math.min(Math.max(...row.profile.nrmse), one.nrmse + 6 * (one.threshold - one.nrmse)));
      return plot(figures[c].host, {
        grid, height: 230, points: true, digits: 6, x: { label: row.name + (unit(row) && ` [${unit(row)}]`), short: row.name }, y: { label: "NRMSE", range: [one.nrmse - 0.1 * (high - one.nrmse), high] },
        series: [{ name: "profile", solver: 0, y: row.profile.nrmse }, { name: "95 %", solver: 8, y: grid.map(() => one.threshold) }],
      });
    });
  };
  return {
    node: section("identifiability", "Identifiability of the best fits",
      el("p", { class: "muted" }, "Which parameters the data fix, at the best fit of every problem. A profile that rises above the dashed line on both sides bounds its parameter; a flat one leaves it open, however good the fit."),
      el("div", { class: "controls" }, known.length > 1 ? picker("Problem", known.map((p) => problems[p]), (k) => show(known[k])) : el("strong", {}, problems[known[0]])),
      paper.node, maps, curves, shownTable("identifiability", 0)),
    draw: () => show(known[0]),
  };
}

function runsSection() {
  const chosen = { problem: -1, solver: -1, budget: -1 };
  const limit = 500;
  const body = el("tbody", {});
  const count = el("span", { class: "muted" });
  const titles = ["key", "problem", "solver", "budget", "seed", "NRMSE", "evaluations", "stopped"];
  const fill = () => {
    const rows = study.runs.filter((r) => (chosen.problem < 0 || r[1] === chosen.problem) && (chosen.solver < 0 || r[2] === chosen.solver) &&
      (chosen.budget < 0 || r[3] === study.budgets[chosen.budget]));
    count.textContent = rows.length > limit ? `the first ${limit} of ${rows.length}; all are in runs.csv` : `${rows.length} runs`;
    body.replaceChildren(...rows.slice(0, limit).map((r) => {
      const cells = [r[0].slice(0, 12), problems[r[1]], solvers[r[2]], String(r[3]), String(r[4]), fmt(r[5], 6), String(r[6]), r[7]];
      const kind = (i) => (i === 0 ? "mono" : i > 2 && i < 7 ? "num" : i < 3 ? kept(cells[i]) : null);
      return el("tr", {}, cells.map((cell, i) => el("td", { class: kind(i), title: i === 0 ? r[0] : null, "data-title": titles[i] }, cell)));
    }));
  };
  const pick = (name, label, words) => picker(label, ["all", ...words], (k) => { chosen[name] = k - 1; fill(); });
  fill();
  return section("runs", "Runs", el("p", { class: "muted" }, "Every number above comes from these runs. A key is the sha256 of the whole configuration: data, model, box, solver, settings, budget, seed, version."),
    el("div", { class: "controls" }, pick("problem", "Problem", problems), pick("solver", "Solver", solvers), pick("budget", "Budget", study.budgets.map(String)), count),
    el("div", { class: "scroll tall", tabindex: 0, role: "region", "aria-label": "Runs" }, el("table", { class: stacked(titles) }, el("thead", {}, el("tr", {},
      titles.map((h, i) => el("th", { scope: "col", class: i > 2 && i < 7 ? "num" : null }, h)))), body)));
}

function methodSection() {
  const facts = [
    ["Cost", `NRMSE, normalised by ${study.normalisation}, weighting ${study.weighting}, integration tolerance ${study.tolerance}`],
    ["Budgets", `${study.budgets.join(", ")} evaluations; a point with derivatives costs 1 + dimension. Rankings, targets and profiles are those of the largest.`],
    ["Seeds", study.seeds.length > 12 ? `${study.seeds[0]} to ${study.seeds[study.seeds.length - 1]} (${study.seeds.length})` : study.seeds.join(", ")],
    ["Start", study.start === "card" ? "the model's default values, in every run" : "one random point a seed, the same for every solver"],
    ["Tie", `costs within ${fmt(100 * study.tie, 3)} % count as equal`],
    ...study.solvers.map((s) => [s.label, `${s.id}${Object.keys(s.settings).length ? `: ${Object.entries(s.settings).map(([k, v]) => `${k} = ${v}`).join(", ")}` : ", default settings"}`]),
  ];
  return section("method", "Method", el("dl", { class: "facts" }, facts.flatMap(([t, d]) => [el("dt", {}, t), el("dd", {}, d)])));
}

const parts = { ranks: criticalDifference(), progress: progress(), profiles: profiles(), identifiability: identifiabilitySection() };
const sections = [
  section("answer", "Ranking", parts.ranks ? parts.ranks.node : "", shownTable("ranking"), shownTable("ranking-inside"), shownTable("ranking-on-box"), shownTable("models")),
  parts.progress.node,
  parts.profiles.node,
  section("tables", "Tables", shownTable("fixed-budget", 0), shownTable("fixed-target", 0), shownTable("pairs"), shownTable("pairs-by-problem", 0), shownTable("problems"), shownTable("times", 0)),
  ...(parts.identifiability ? [parts.identifiability.node] : []),
  runsSection(),
  methodSection(),
];
const titles = { answer: "Ranking", progress: "Every problem", profiles: "Profiles", tables: "Tables", identifiability: "Identifiability", runs: "Runs", method: "Method" };
const tile = (label, value, note) => el("div", { class: "tile" }, el("dt", {}, label), el("dd", {}, el("div", { class: "value" }, value), note ? el("div", { class: "note" }, note) : ""));
document.getElementById("content").replaceChildren(
  el("header", {}, el("h1", {}, study.title), el("p", { class: "subtitle" }, study.state), el("p", { class: "verdict" }, study.verdict),
    el("dl", { class: "tiles" }, tile("Runs", `${study.done} of ${study.planned}`), tile("Problems", String(problems.length)), tile("Solvers", String(solvers.length)),
      tile("Seeds", String(study.seeds.length)), tile("Largest budget", String(study.budgets[study.budgets.length - 1]), "evaluations a run")),
    study.warnings.length ? el("div", { class: "warning", role: "note", "aria-label": "Warnings" }, el("strong", {}, "Warnings"), el("ul", {}, study.warnings.map((w) => el("li", {}, w)))) : ""),
  el("nav", { "aria-label": "Sections" }, sections.map((s) => el("a", { href: `#${s.id}` }, titles[s.id]))),
  el("main", {}, sections),
  el("footer", {}, "Made by hysteron. Plots: uPlot (MIT licence). This page loads nothing from the network."));
if (parts.ranks) parts.ranks.draw();
parts.progress.draw();
parts.profiles.draw();
if (parts.identifiability) parts.identifiability.draw();

let pending = 0;
let lastWidth = window.innerWidth;
const again = () => { cancelAnimationFrame(pending); pending = requestAnimationFrame(() => [...redraw].forEach((build) => build())); };
window.addEventListener("resize", () => { if (window.innerWidth !== lastWidth) { lastWidth = window.innerWidth; again(); } });
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", again);
root.dataset.plots = String(redraw.length);
root.dataset.ready = "true";
})();
