// Draws the report from its embedded data. Every number shown was computed by hysteron; this script only sets
// numbers and curves on the page. Text from the data reaches the page as text nodes or through esc(), never as HTML.
(function () {
"use strict";

const { root, isNumber, superscript, fmt, fmtEnds, esc, el, section, css, tickText, linearTicks } = common;
const { font, widest, whole, half, axisWidth, svgNode, extent, padded, margins, chart } = charts;
const report = JSON.parse(document.getElementById("report-data").textContent);
const list = (value) => (Array.isArray(value) ? value : []);
const recordings = list(report.recordings);
const solvers = list(report.solvers);
const parameters = list(report.parameters);

// ---------------------------------------------------------------------------------------------- numbers and elements

// A number somebody chose, such as a bound: no trailing zeros.
function brief(v) {
  if (!isNumber(v)) return "–";
  const e = v === 0 ? 0 : Math.floor(Math.log10(Math.abs(v)) + 1e-12);
  if (e >= -4 && e < 6) return String(Number(v.toPrecision(4))).replace("-", "−");
  const mantissa = String(Number((v / 10 ** e).toPrecision(4)));
  return ((mantissa === "1" ? "" : mantissa === "-1" ? "-" : `${mantissa} × `) + `10${superscript(e)}`).replace("-", "−");
}

// Counts with narrow spaces between thousands.
const count = (v) => (isNumber(v) ? String(v).replace(/\B(?=(\d{3})+(?!\d))/g, "\u202f") : "–");
// "^-2" as a raised power.
const raised = (power) => superscript(power.slice(1));
// A sentence written by the program, its powers of ten and of units as a reader writes them.
const prose = (text) => String(text).replace(/(\d)e([+-])0*(\d+)/g, (_, digit, sign, power) => `${digit} × 10${superscript((sign === "-" ? "-" : "") + power)}`)
  .replace(/(?<=[A-Za-z])\^-?\d+/g, raised);
// What there is much of is put on the page in parts, the next one when the reader asks for it: `make(item)` gives a node
// of `host`. Returns the node to stand below the host.
function inParts(host, items, atOnce, what, make, added) {
  let shown = 0;
  const said = el("span", {});
  const more = el("button", { type: "button", onclick: () => add() });
  const node = el("p", { class: "more" }, said, " ", more);
  function add() {
    host.append(...items.slice(shown, shown + atOnce).map(make));
    shown = Math.min(shown + atOnce, items.length);
    said.textContent = `${count(shown)} of ${count(items.length)} ${what} shown.`;
    more.textContent = `Show ${count(Math.min(atOnce, items.length - shown))} more`;
    more.hidden = shown === items.length;
    node.hidden = items.length <= atOnce;
    if (added) added();
  }
  host.replaceChildren();
  add();
  return node;
}

const plural = (n, one) => `${n} ${one}${n === 1 ? "" : "s"}`;

// Tables too wide for a phone stand there as one block a row, each cell beside its column's title.
const stacked = (columns) => (columns.length > 3 || columns.some((c) => c.wide) ? "stack" : null);

// columns: {title, num, wide (too long to stand beside others on a phone), pair (two numbers, which may stand below one another), head (cell is the row's header)}; cells are text or nodes.
function plainTable(caption, columns, rows) {
  return el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    el("table", { class: stacked(columns) }, el("caption", {}, el("span", {}, caption)),
      el("thead", {}, el("tr", {}, columns.map((c) => el("th", { scope: "col", class: c.num ? "num" : null }, c.title)))),
      el("tbody", {}, rows.map((cells) => el("tr", {}, cells.map((cell, i) =>
        el(columns[i].head ? "th" : "td", {
          scope: columns[i].head ? "row" : null,
          class: columns[i].pair ? "num pair" : columns[i].num ? "num" : columns[i].nowrap ? "nowrap" : columns[i].text ? "text" : null,
          "data-title": columns[i].head ? null : columns[i].title,
        }, cell)))))));
}

// File names may break after their separators only.
const breakable = (name) => String(name).split(/(?<=[_\-/ ])/).flatMap((part, i) => (i ? [document.createElement("wbr"), part] : [part]));

const badge = (text, kind) => el("span", { class: `badge ${kind || ""}` }, text);

// ----------------------------------------------------------------------------------------------------------- recordings

const channels = {
  time: { key: "time", label: "Time [s]", short: "t [s]", word: "time" },
  displacement: { key: "displacement_mm", label: "Displacement [mm]", short: "x [mm]", word: "displacement" },
  velocity: { key: "velocity_mm_s", label: "Velocity [mm/s]", short: "v [mm/s]", word: "velocity" },
};
const roleWords = { fit: "fitted", validate: "held out", checked: "held out in the check, then fitted" };
const roleOf = (r) => roleWords[r.role] || r.role || "–";
const hasBaseline = recordings.some((r) => list(r.baseline_n).length > 0);
// What is measured and simulated: the force on a recorded motion, or the motion of a mass under a known excitation.
const ofMotion = Boolean(report.response);
const plotted = ofMotion
  ? { word: "displacement", symbol: "x", label: "Displacement [mm]", short: "x [mm]", unit: "mm" }
  : { word: "force", symbol: "F", label: "Force [N]", short: "F [N]", unit: "N" };
const measuredOf = (r) => list(ofMotion ? r.displacement_mm : r.force_n);
const simulatedOf = (r) => list(ofMotion ? r.simulated_mm : r.predicted_n);
const residual = (r) => measuredOf(r).map((f, i) => (isNumber(f) && isNumber(simulatedOf(r)[i]) ? f - simulatedOf(r)[i] : null));
const baselineResidual = (r) => list(r.force_n).map((f, i) => (isNumber(f) && isNumber(r.baseline_n[i]) ? f - r.baseline_n[i] : null));
// What of a recording the curves show, where that is not all of it.
const partOf = (r) => (r.part ? `, ${fmt(r.part.from, 4)} to ${fmt(r.part.to, 4)} s of ${fmt(r.part.duration, 4)} s shown` : "");
const nameOf = (r) => `${r.file}${r.drive ? `, ${r.drive}` : ""}`;

// With a base model beside it, each residual has the colour of its simulation; alone, one of its own.
function residualCurves(r) {
  if (!list(r.baseline_n).length) return [{ y: residual(r), cls: "residual" }];
  return [{ y: baselineResidual(r), cls: "baseline" }, { y: residual(r), cls: "simulated" }];
}

// Curves of a recording in drawing order: the measurement below, simulations above it.
function curves(r) {
  const result = [{ y: measuredOf(r), cls: "measured", name: "measured" }];
  if (list(r.baseline_n).length) result.push({ y: r.baseline_n, cls: "baseline", name: "base model" });
  result.push({ y: simulatedOf(r), cls: "simulated", name: "simulated" });
  return result;
}

function legend(withResidual) {
  const item = (cls, text, dashed) => el("li", {}, el("i", { style: `border-color:var(--${cls});border-top-style:${dashed ? "dashed" : "solid"}` }), text);
  return el("ul", { class: "legend" }, item("measured", "measured"), item("simulated", hasBaseline ? "simulated, augmented model" : "simulated"),
    hasBaseline ? item("baseline", "simulated, base model", true) : null,
    withResidual && !hasBaseline ? item("residual", "residual, measured − simulated") : null);
}

function overview() {
  const grid = el("div", { class: "minis" });
  const rest = el("div", {});
  const against = el("select", {}, (ofMotion ? ["time"] : ["velocity", "displacement", "time"]).map((k) => el("option", { value: k }, k)));
  const scale = el("select", {}, el("option", { value: "own" }, "own for each"), el("option", { value: "same" }, "same for all"));
  const order = el("select", {}, el("option", { value: "given" }, "as given"), el("option", { value: "worst" }, "largest NRMSE first"));
  function draw() {
    const channel = channels[against.value];
    const shared = scale.value === "same";
    const allX = extent(recordings.map((r) => extent([r[channel.key]])));
    const allY = extent(recordings.map((r) => extent(curves(r).map((c) => c.y))));
    const sequence = recordings.map((_, i) => i);
    if (order.value === "worst") sequence.sort((a, b) => (recordings[b].nrmse ?? -1) - (recordings[a].nrmse ?? -1));
    rest.replaceChildren(inParts(grid, sequence, 60, "recordings", (i) => {
      const r = recordings[i];
      const markup = chart({
        width: 240, height: 168, small: true, margin: [4, 4, 16, 40],
        title: `${plotted.label} against ${channel.label} of ${nameOf(r)}, measured and simulated`,
        x: { label: channel.short, range: padded(shared ? allX : extent([r[channel.key]])) },
        y: { label: plotted.short, range: padded(shared ? allY : extent(curves(r).map((c) => c.y))) },
        series: curves(r).map((c) => ({ x: list(r[channel.key]), y: c.y, cls: c.cls, limit: 600 })),
      });
      return el("button", { class: "mini", type: "button", "data-index": i, title: r.file, onclick: () => select(i, true) },
        el("b", {}, breakable(r.file)),
        el("span", { class: "sub" }, el("span", {}, [r.drive, roleOf(r)].filter(Boolean).join(" · ")), el("strong", {}, `NRMSE ${fmt(r.nrmse, 3)}`)),
        svgNode(markup));
    }, markSelected));
  }
  for (const control of [against, scale, order]) control.addEventListener("change", draw);
  draw();
  return section("overview", "Every recording at a glance",
    el("div", { class: "controls" },
      el("label", {}, `${capital(plotted.word)} against`, against), el("label", {}, "Scale", scale), el("label", {}, "Order", order)),
    legend(false),
    el("p", { class: "muted interactive" }, "Select a recording to see it in full below."),
    grid, rest);
}

function recordingTable() {
  const columns = [
    { title: "Recording", value: (r) => r.file },
    { title: "NRMSE", value: (r) => r.nrmse, num: true, digits: 3 },
    { title: `RMSE [${plotted.unit}]`, value: (r) => (ofMotion ? r.rmse_mm : r.rmse_n), num: true, digits: 3 },
    { title: "Fit [%]", value: (r) => r.fit_percent, num: true, digits: 3 },
    { title: "Role", value: roleOf },
    ...(recordings.some((r) => r.drive) ? [{ title: "Drive", value: (r) => r.drive || "–" }] : []),
  ];
  const order = recordings.map((_, i) => i);
  let sorted = -1;
  let direction = 1;
  const body = el("tbody", {});
  const rest = el("div", {});
  const heads = columns.map((c, k) => el("th", { scope: "col", class: c.num ? "num" : null },
    el("button", { type: "button", title: `Sort by ${c.title}`, onclick: () => sort(k) }, c.title)));
  function fill() {
    rest.replaceChildren(inParts(body, order, 200, "recordings", (i) => {
      const r = recordings[i];
      return el("tr", { class: "pick", "data-index": i, onclick: () => select(i) }, columns.map((c, k) => k === 0
        ? el("th", { scope: "row" }, el("button", { type: "button", class: "link" }, r.file))
        : el("td", { class: c.num ? "num" : "nowrap", "data-title": c.title }, c.num ? fmt(c.value(r), c.digits) : c.value(r))));
    }, markSelected));
  }
  function sort(k) {
    direction = sorted === k ? -direction : columns[k].num ? -1 : 1;
    sorted = k;
    const value = columns[k].value;
    order.sort((a, b) => {
      const [u, v] = [value(recordings[a]), value(recordings[b])];
      const by = columns[k].num ? (u ?? -Infinity) - (v ?? -Infinity) : String(u).localeCompare(String(v), "en", { numeric: true });
      return by * direction || a - b;
    });
    heads.forEach((h, j) => { if (j === k) h.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending"); else h.removeAttribute("aria-sort"); });
    fill();
  }
  fill();
  return el("div", { class: "scroll tall", tabindex: 0, role: "region", "aria-label": "Recordings" },
    el("table", { class: stacked(columns) }, el("caption", {}, el("span", {}, "Misfit of each recording", el("span", { class: "interactive" }, "; a heading sorts, a row selects"))),
      el("thead", {}, el("tr", {}, heads)), body), rest);
}

// ------------------------------------------------------------------------------------------------- interactive plots

let selected = -1;
let plots = [];          // uPlot instances of the selected recording
let detail = null;       // elements of the detail view
let resizeWatch = null;

function axis(label, side) {
  return {
    label, font, labelFont: font, labelGap: 0, labelSize: 18, gap: 4,
    stroke: css("--ink"),
    size: side === 3 ? axisWidth(52) : 30,
    space: side === 3 ? 34 : 64,
    grid: { stroke: css("--grid"), width: 1 },
    ticks: { stroke: css("--line"), width: 1, size: 4 },
    values: (u, splits, axisIndex, space, step) => splits.map((v) => tickText(v, step || 1)),
  };
}

// Shift and drag moves what is shown; plain drag is uPlot's zoom.
const zoomUnlessShift = (u, target, handler) => (event) => { if (event.button === 0 && !event.shiftKey) handler(event); };

function addPan(u, scales) {
  u.over.addEventListener("mousedown", (down) => {
    if (down.button !== 0 || !down.shiftKey) return;
    down.preventDefault();
    const start = scales.map((key) => ({ key, min: u.scales[key].min, max: u.scales[key].max }));
    const move = (event) => {
      u.batch(() => {
        for (const { key, min, max } of start) {
          const share = key === "x" ? (down.clientX - event.clientX) / u.over.clientWidth : (event.clientY - down.clientY) / u.over.clientHeight;
          u.setScale(key, { min: min + share * (max - min), max: max + share * (max - min) });
        }
      });
    };
    const up = () => {
      window.removeEventListener("mousemove", move);
      window.removeEventListener("mouseup", up);
    };
    window.addEventListener("mousemove", move);
    window.addEventListener("mouseup", up);
  });
}

function buildPlots(r) {
  for (const u of plots) u.destroy();
  plots = [];
  const time = list(r.time);
  if (time.length < 2) return;
  const shown = curves(r);
  const full = { lo: time[0], hi: time[time.length - 1] };
  const windowOf = { lo: full.lo, hi: full.hi };  // the part of the record the time plots show; loops follow it
  const color = { measured: css("--measured"), simulated: css("--simulated"), baseline: css("--baseline"), residual: css("--residual") };
  const widths = { measured: 2, simulated: 1.4, baseline: 1.2, residual: 1.2 };
  const dashes = { baseline: [5, 3] };
  const loops = [];
  const timePlots = [];

  function figure(holder, caption, label) {
    const reset = el("button", { type: "button", class: "reset", hidden: true }, "Reset zoom");
    const host = el("div", { class: "host", role: "img", "aria-label": label });
    holder.replaceChildren(el("figcaption", {}, el("span", {}, caption), reset), host);
    return { host, reset };
  }
  const size = (host, wide) => ({ width: Math.max(200, host.clientWidth), height: wide || Math.round(Math.min(380, Math.max(250, host.clientWidth * 0.68))) });

  function showAt(index) {
    const t = index === null || index === undefined ? null : time[index];
    for (const loop of loops) loop.mark(t === null ? null : index);
    if (t === null) {
      detail.readout.textContent = detail.hint;
      return;
    }
    const parts = [`t = ${fmt(t, 5)} s`, `x = ${fmt(list(r.displacement_mm)[index], 4)} mm`, `v = ${fmt(list(r.velocity_mm_s)[index], 4)} mm/s`];
    for (const c of shown) parts.push(`${c.name} ${fmt(c.y[index], 4)} ${plotted.unit}`);
    parts.push(`residual ${fmt(rest[index], 3)} ${plotted.unit}`);
    detail.readout.textContent = parts.join("  ·  ");
  }
  const rest = residual(r);

  function timePlot(holder, caption, label, height, lines) {
    const { host, reset } = figure(holder, caption, `${caption} of ${nameOf(r)}`);
    const u = new uPlot({
      ...size(host, height),
      padding: [8, 10, 0, 0],
      legend: { show: false },
      scales: { x: { time: false } },
      axes: [axis("Time [s]", 2), axis(label, 3)],
      series: [{}, ...lines.map((c) => ({ stroke: color[c.cls], width: widths[c.cls], dash: dashes[c.cls], points: { show: false } }))],
      cursor: {
        drag: { x: true, y: false, dist: 5 },
        sync: { key: "hysteron-time" },
        bind: { mousedown: zoomUnlessShift },
        points: { size: 7 },
      },
      hooks: {
        setCursor: [(plot) => { if (plot === timePlots[0]) showAt(plot.cursor.left >= 0 ? plot.cursor.idx : null); }],
        setScale: [(plot, key) => {
          if (key !== "x") return;
          const { min, max } = plot.scales.x;
          const zoomed = min > full.lo || max < full.hi;
          reset.hidden = !zoomed;
          if (windowOf.lo === min && windowOf.hi === max) return;
          windowOf.lo = min;
          windowOf.hi = max;
          for (const other of timePlots) {
            if (other !== plot && (other.scales.x.min !== min || other.scales.x.max !== max)) other.setScale("x", { min, max });
          }
          for (const loop of loops) loop.u.redraw(false);
        }],
      },
    }, [time, ...lines.map((c) => c.y)], host);
    reset.addEventListener("click", () => u.setScale("x", { min: full.lo, max: full.hi }));
    addPan(u, ["x"]);
    timePlots.push(u);
    plots.push(u);
    u.wideHeight = height;
    return u;
  }

  // A loop is not a function of its abscissa, which uPlot's line plots want sorted. Here uPlot keeps axes, zoom and
  // cursor over the extent of the data; the curves are drawn in sample order onto its canvas.
  function loopPlot(holder, channel) {
    const caption = `Force against ${channel.word}`;
    const { host, reset } = figure(holder, caption, `${caption} of ${nameOf(r)}: measured and simulated loops`);
    const xs = list(r[channel.key]);
    const rangeX = padded(extent([xs]), 0.04);
    const rangeY = padded(extent(shown.map((c) => c.y)), 0.06);
    function trace(plot, c, from, to, alpha) {
      const { ctx } = plot;
      const ax = plot.valToPos(rangeX[0], "x", true);
      const bx = (plot.valToPos(rangeX[1], "x", true) - ax) / (rangeX[1] - rangeX[0]);
      const ay = plot.valToPos(rangeY[0], "y", true);
      const by = (plot.valToPos(rangeY[1], "y", true) - ay) / (rangeY[1] - rangeY[0]);
      ctx.beginPath();
      let pen = false;
      for (let i = from; i < to; ++i) {
        if (!isNumber(xs[i]) || !isNumber(c.y[i])) { pen = false; continue; }
        const h = ax + (xs[i] - rangeX[0]) * bx;
        const v = ay + (c.y[i] - rangeY[0]) * by;
        if (pen) ctx.lineTo(h, v); else ctx.moveTo(h, v);
        pen = true;
      }
      ctx.globalAlpha = alpha;
      ctx.strokeStyle = color[c.cls];
      ctx.lineWidth = widths[c.cls] * uPlot.pxRatio;
      ctx.setLineDash((dashes[c.cls] || []).map((d) => d * uPlot.pxRatio));
      ctx.lineJoin = "round";
      ctx.stroke();
    }
    const u = new uPlot({
      ...size(host),
      padding: [8, 10, 0, 0],
      legend: { show: false },
      scales: { x: { time: false }, y: { range: () => rangeY } },
      axes: [axis(channel.label, 2), axis("Force [N]", 3)],
      series: [{}, { paths: () => null, points: { show: false } }],
      cursor: { drag: { x: true, y: true, dist: 5 }, points: { show: false }, bind: { mousedown: zoomUnlessShift } },
      hooks: {
        draw: [(plot) => {
          const { ctx, bbox } = plot;
          ctx.save();
          ctx.beginPath();
          ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
          ctx.clip();
          let from = 0;
          let to = time.length;
          while (from < to && time[from] < windowOf.lo) ++from;
          while (to > from && time[to - 1] > windowOf.hi) --to;
          const part = from > 0 || to < time.length;
          if (part) for (const c of shown) trace(plot, c, 0, time.length, 0.15);
          for (const c of shown) trace(plot, c, from, to, 1);
          ctx.restore();
        }],
        setScale: [(plot) => {
          const { x, y } = plot.scales;
          reset.hidden = !(x.min > rangeX[0] || x.max < rangeX[1] || y.min > rangeY[0] || y.max < rangeY[1]);
        }],
      },
    }, [rangeX, rangeY], host);
    reset.addEventListener("click", () => u.batch(() => {
      u.setScale("x", { min: rangeX[0], max: rangeX[1] });
      u.setScale("y", { min: rangeY[0], max: rangeY[1] });
    }));
    addPan(u, ["x", "y"]);
    const spots = shown.map((c) => {
      const spot = el("div", { class: "spot", style: `background:${color[c.cls]}` });
      u.over.append(spot);
      return { c, spot };
    });
    const loop = {
      u,
      mark(index) {
        for (const { c, spot } of spots) {
          const left = index === null ? -1 : u.valToPos(xs[index], "x");
          const top = index === null ? -1 : u.valToPos(c.y[index], "y");
          const inside = index !== null && left >= 0 && top >= 0 && left <= u.over.clientWidth && top <= u.over.clientHeight;
          spot.style.display = inside ? "block" : "none";
          spot.style.left = `${left}px`;
          spot.style.top = `${top}px`;
        }
      },
    };
    u.over.addEventListener("mousemove", (event) => {
      const box = u.over.getBoundingClientRect();
      const sx = u.over.clientWidth / (u.scales.x.max - u.scales.x.min);
      const sy = u.over.clientHeight / (u.scales.y.max - u.scales.y.min);
      const hx = u.posToVal(event.clientX - box.left, "x");
      const hy = u.posToVal(event.clientY - box.top, "y");
      let best = null;
      let distance = 900;  // 30 px
      const force = shown[0].y;
      for (let i = 0; i < xs.length; ++i) {
        if (time[i] < windowOf.lo || time[i] > windowOf.hi) continue;
        const d = ((xs[i] - hx) * sx) ** 2 + ((force[i] - hy) * sy) ** 2;
        if (d < distance) { distance = d; best = i; }
      }
      showAt(best);
    });
    u.over.addEventListener("mouseleave", () => showAt(null));
    loops.push(loop);
    plots.push(u);
  }

  timePlot(detail.hosts[0], `${capital(plotted.word)} against time`, plotted.label, 270, shown);
  // A motion against itself is no loop.
  for (const k of [1, 2]) detail.hosts[k].hidden = ofMotion;
  if (!ofMotion) {
    loopPlot(detail.hosts[1], channels.displacement);
    loopPlot(detail.hosts[2], channels.velocity);
  }
  timePlot(detail.hosts[3], "Residual (measured − simulated) against time", `Residual [${plotted.unit}]`, 220, residualCurves(r));
}

// Inverse of the standard normal distribution: Acklam's rational approximations, relative error below 1.2e-9.
function normalQuantile(p) {
  const ratio = (top, bottom, t) => top.reduce((sum, c) => sum * t + c, 0) / bottom.reduce((sum, c) => sum * t + c, 0);
  const tail = (q) => ratio([-7.784894002430293e-3, -0.3223964580411365, -2.400758277161838, -2.549732539343734, 4.374664141464968, 2.938163982698783],
    [7.784695709041462e-3, 0.3224671290700398, 2.445134137142996, 3.754408661907416, 1], Math.sqrt(-2 * Math.log(q)));
  if (p < 0.02425) return tail(p);
  if (p > 0.97575) return -tail(1 - p);
  const q = p - 0.5;
  return q * ratio([-39.69683028665376, 220.9460984245205, -275.9285104469687, 138.3577518672690, -30.66479806614716, 2.506628277459239],
    [-54.47609879822406, 161.5858368580409, -155.6989798598866, 66.80131188771972, -13.28068155288572, 1], q * q);
}

// How the residual of a recording is distributed, over its root mean square, beside a normal one. What it does not show
// is order: a residual may look normal here and still follow the motion.
function distributionCharts(r) {
  const values = residual(r).filter(isNumber);
  const rms = Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / values.length);
  if (values.length < 20 || !(rms > 0)) return [];
  const sorted = Float64Array.from(values, (v) => v / rms).sort();
  const reach = 4;
  const bins = Math.max(12, Math.min(40, Math.round(Math.sqrt(sorted.length))));
  const width = (2 * reach) / bins;
  const counts = new Array(bins).fill(0);
  for (const v of sorted) {
    const bin = Math.floor((v + reach) / width);
    if (bin >= 0 && bin < bins) ++counts[bin];
  }
  const steps = { x: [-reach], y: [0] };
  counts.forEach((n, k) => {
    const density = n / sorted.length / width;
    steps.x.push(-reach + k * width, -reach + (k + 1) * width);
    steps.y.push(density, density);
  });
  steps.x.push(reach);
  steps.y.push(0);
  const grid = Array.from({ length: 81 }, (_, k) => -reach + (k * reach) / 40);
  const bell = { x: grid, y: grid.map((v) => Math.exp(-0.5 * v * v) / Math.sqrt(2 * Math.PI)) };
  const wanted = Math.min(sorted.length, 200);
  const points = { x: [], y: [] };
  for (let k = 0; k < wanted; ++k) {
    // Evenly along the axis, so that the tails are drawn too.
    const at = Math.round(((1 - Math.cos((Math.PI * k) / (wanted - 1))) / 2) * (sorted.length - 1));
    points.x.push(normalQuantile((at + 0.5) / sorted.length));
    points.y.push(sorted[at]);
  }
  const size = { width: half(), height: 280, margin: [6, 10, 36, 46] };
  const range = padded(extent([points.x, points.y]));
  return [
    svgNode(chart({ ...size, title: `Histogram of the residual of ${nameOf(r)}; dashed: normal`, x: { label: "Residual / RMS", range: [-reach, reach] },
      y: { label: "Density", range: [0, 1.1 * Math.max(0.42, ...steps.y)] }, series: [{ ...bell, cls: "measured", dash: "5 4" }, { ...steps, cls: "residual" }] })),
    svgNode(chart({ ...size, title: `Normal quantile-quantile plot of the residual of ${nameOf(r)}; dashed: normal`, x: { label: "Normal quantile", range },
      y: { label: "Residual / RMS", range }, series: [{ x: range, y: range, cls: "measured", dash: "5 4" }, { ...points, cls: "residual" }] })),
  ].map((node) => el("figure", { class: "plot" }, node));
}

function detailView() {
  const chooser = el("select", { "aria-label": "Recording shown", onchange: (e) => select(Number(e.target.value)) },
    recordings.map((r, i) => el("option", { value: i }, `${nameOf(r)} (${roleOf(r)})`)));
  const previous = el("button", { type: "button", onclick: () => select(selected - 1) }, "Previous");
  const next = el("button", { type: "button", onclick: () => select(selected + 1) }, "Next");
  const touch = window.matchMedia("(hover: none)").matches;
  const hint = touch ? "" : `Drag to zoom, double click to reset, Shift and drag to pan.${ofMotion ? "" : " A zoom in time is carried to the loops."}`;
  const heading = el("h3", { id: "detail", tabindex: -1 });
  const readout = el("p", { class: "readout" }, hint);
  const hosts = [0, 1, 2, 3].map((i) => el("figure", { class: i === 0 || i === 3 ? "plot wide" : "plot" }));
  const printed = el("div", { class: "print-only" });
  const spread = el("div", { class: "plots" });
  detail = { chooser, previous, next, heading, readout, hosts, spread, printed, hint };
  const node = el("div", {}, heading,
    el("div", { class: "controls" }, el("label", {}, "Recording", chooser), previous, next), legend(true), readout,
    el("div", { class: "plots interactive" }, hosts), printed,
    el("h4", {}, "Distribution of the residual: histogram and normal quantile-quantile plot; dashed: normal"), spread);
  return node;
}

function markSelected() {
  for (const node of document.querySelectorAll("[data-index]")) {
    const on = Number(node.dataset.index) === selected;
    node.classList.toggle("selected", on);
    if (node.tagName === "TR") node.setAttribute("aria-selected", String(on));
    else node.setAttribute("aria-pressed", String(on));
  }
}

function select(index, scroll) {
  if (!recordings[index] || !detail) return;
  selected = index;
  const r = recordings[index];
  detail.chooser.value = String(index);
  detail.previous.disabled = index === 0;
  detail.next.disabled = index === recordings.length - 1;
  detail.heading.textContent = `${nameOf(r)}: ${roleOf(r)}, NRMSE ${fmt(r.nrmse, 3)}${partOf(r)}`;
  detail.readout.textContent = detail.hint;
  markSelected();
  buildPlots(r);
  detail.spread.replaceChildren(...distributionCharts(r));
  if (scroll) detail.heading.scrollIntoView();
}

// On paper the four plots of the selected recording are drawn as lines that stay sharp, whatever the screen's scheme.
function printDetail() {
  const r = recordings[selected];
  if (!r) return;
  const force = curves(r);
  const forceRange = padded(extent(force.map((c) => c.y)));
  const rests = residualCurves(r);
  const make = (wide, channel, label, lines, range, height) => svgNode(chart({
    width: wide ? 690 : 340, height, margin: [6, 8, 36, 58],
    title: `${label} against ${channel.label} of ${nameOf(r)}`,
    x: { label: channel.label, range: channel.key === "time" ? extent([r.time]) : padded(extent([r[channel.key]])) },
    y: { label, range },
    series: lines.map((c) => ({ x: list(r[channel.key]), y: c.y, cls: c.cls })),
  }));
  const cell = (wide, node) => el("figure", { class: wide ? "plot wide" : "plot" }, node);
  const grid = el("div", { class: "plots" },
    cell(true, make(true, channels.time, plotted.label, force, forceRange, 190)),
    ...(ofMotion ? [] : [channels.displacement, channels.velocity].map((channel) => cell(false, make(false, channel, plotted.label, force, forceRange, 230)))),
    cell(true, make(true, channels.time, `Residual [${plotted.unit}]`, rests, padded(extent(rests.map((c) => c.y))), 150)));
  detail.printed.replaceChildren(grid);
}

// ------------------------------------------------------------------------------------------------------------ parameters

// Where the value and its interval lie between the bounds; positive bounds far apart are shown on a log scale.
function withinBounds(p) {
  if (!isNumber(p.lower) || !isNumber(p.upper) || !(p.upper > p.lower) || !isNumber(p.value)) return "–";
  const log = p.lower > 0 && p.upper / p.lower > 50;
  const f = (v) => (log ? Math.log(Math.max(v, p.lower)) : v);
  const at = (v) => 6 + 98 * Math.min(1, Math.max(0, (f(v) - f(p.lower)) / (f(p.upper) - f(p.lower))));
  const interval = Array.isArray(p.ci95) && p.ci95.every(isNumber)
    ? `<path class="interval" d="M${at(p.ci95[0]).toFixed(1)} 9H${Math.max(at(p.ci95[1]), at(p.ci95[0]) + 1).toFixed(1)}"/>` : "";
  return svgNode(`<svg class="within" viewBox="0 0 110 18" role="img" aria-label="${esc(`between ${fmt(p.lower)} and ${fmt(p.upper)}${log ? ", log scale" : ""}`)}">` +
    `<rect class="box" x="6" y="6" width="98" height="6" rx="3"/>${interval}<circle class="dot" cx="${at(p.value).toFixed(1)}" cy="9" r="4"/></svg>`);
}

// As people write them: newtons per ampere are not "N/A", what is divided by twice has a power, and a law in a voltage is
// not one in a current.
function printedUnit(unit) {
  if (!/\/(A|V|Hz)$|^[^()/]*\/[^()/]*\/[^()]*$/.test(unit || "")) return unit || "–";
  const begin = unit.indexOf("/", unit.indexOf(")") + 1);
  const powers = new Map();
  for (const part of unit.slice(begin + 1).split("/")) {
    const [symbol, power] = part.split("^");
    powers.set(symbol, (powers.get(symbol) || 0) + Number(power || 1));
  }
  const head = unit.slice(0, begin).replace(/\^\d+/g, raised);
  return [head === "1" ? "" : head, ...[...powers].map(([symbol, power]) => symbol + superscript(-power))].filter(Boolean).join(" ");
}
// A unit as the program writes it, with raised powers; it may break before "per" only.
const unitWords = (unit) => String(unit || "").replace(/\^-?\d+/g, raised).replace(/ (?!per )/g, "\u00a0");
const printedTerm = (p) => (String(p.unit).includes("/V") ? p.name.replace("*i", "*u") : p.name);

// Without a finite derivative by any parameter, or interrupted: no errors, which says nothing of the data.
const withoutErrors = parameters.length > 0 && !parameters.some((p) => isNumber(p.std_error)) && !list(report.sensitivity).some((row) => isNumber(row.value));
const foundOpen = (p) => p.identifiable === false && !withoutErrors;
const whyWithoutErrors = () => (list(report.sensitivity).length ? "No standard error could be computed: the derivatives of the simulation are not finite at these values. How well the data determine the parameters is not known."
  : "No standard error could be computed. How well the data determine the parameters is not known.");

function parameterRemarks(p) {
  const flags = [];
  if (p.at_bound) flags.push(badge(`at ${p.at_bound} bound`, "flag"));
  if (foundOpen(p)) flags.push(badge("not identifiable from these data", "flag"));
  return flags.length ? el("span", {}, flags.flatMap((f, i) => (i ? [" ", f] : [f]))) : "";
}

function modelSection() {
  const model = report.model || {};
  const columns = [{ title: "Parameter", head: true }, { title: "Meaning and remarks", text: true }, { title: "Value", num: true }, { title: "Unit" },
    { title: "Std. error", num: true }, { title: "95 % interval", num: true, pair: true }, { title: "Bounds", num: true, pair: true }, { title: "Within bounds" }];
  const interval = (pair, texts) => (Array.isArray(pair) && pair.some(isNumber) ? texts(...pair).join("\u00a0… ").replace(/ × /g, "\u00a0×\u00a0") : "–");
  const rows = parameters.map((p) => [
    p.symbol && p.symbol !== p.name ? el("span", {}, el("code", {}, printedTerm(p)), ` ${p.symbol}`) : el("code", {}, printedTerm(p)),
    el("span", {}, p.meaning || "", " ", parameterRemarks(p)),
    fmt(p.value, 4), unitWords(p.unit_text || printedUnit(p.unit)), fmt(p.std_error, 2), interval(p.ci95, (low, high) => fmtEnds(low, high, 3)), interval([p.lower, p.upper], (low, high) => [brief(low), brief(high)]), withinBounds(p),
  ]);
  return section("model", "Model and parameters",
    el("p", {}, model.title || model.id || "", model.id && model.title ? [" (", el("code", {}, model.id), ")"] : ""),
    list(model.equations).length ? el("pre", { class: "equations", tabindex: 0, "aria-label": "Equations" }, model.equations.join("\n")) : null,
    list(report.effects).length ? el("p", {}, "Effects added to the model: ", report.effects.map((e, i) => [i ? ", " : "", el("code", {}, e)]).flat(), ".") : null,
    model.reference ? el("p", { class: "muted" }, "Source: ", model.reference) : null,
    parameters.length ? plainTable("Identified values. The bar shows the value and its interval between the search bounds (logarithmic where they are positive and far apart).", columns, rows) : null,
    withoutErrors ? el("p", { class: "warning" }, whyWithoutErrors()) : null,
    report.on_bounds ? el("p", {}, `${report.on_bounds}.`) : null);
}

// --------------------------------------------------------------------------------------------------------------- solvers

function convergenceChart(width) {
  const traced = solvers.filter((s) => list(s.trace).some(([n, c]) => n > 0 && c > 0));
  if (!traced.length) return null;
  const series = traced.map((s) => {
    const points = s.trace.filter(([n, c]) => n > 0 && isNumber(c) && c > 0);
    return {
      x: points.map((p) => p[0]), y: points.map((p) => p[1]), step: true, cls: s.chosen ? "chosen" : "",
      color: `var(--s${solvers.indexOf(s) % 7})`, dash: ["", "6 3", "2 2"][Math.floor(solvers.indexOf(s) / 7) % 3], label: `${s.id}  ${fmt(points[points.length - 1][1], 3)}`,
    };
  });
  const xr = extent(series.map((s) => s.x));
  // A diverged start costs orders of magnitude more than any model; it must not flatten the rest.
  const firsts = series.map((s) => s.y[0]);
  const yr = extent(series.map((s) => s.y));
  const ceiling = Math.min(yr[1], Math.max(100 * yr[0], Math.min(...firsts) * 3));
  for (const s of series) s.y = s.y.map((v) => Math.min(v, ceiling));
  const right = 24 + Math.max(...series.map((s) => s.label.length)) * 6.9;
  return svgNode(chart({
    width, height: Math.max(260, Math.min(360, width * 0.4), 90 + 15 * series.length), margin: [8, right, 38, 60],
    title: "Best cost against objective evaluations, one line per solver, both axes logarithmic",
    x: { label: "Objective evaluations", log: true, range: [xr[0], xr[1] > xr[0] ? xr[1] : xr[0] * 10] },
    y: { label: "Best cost so far", log: true, range: [yr[0] / 1.15, ceiling * 1.15] },
    series,
  }));
}

// Means with bands of two standard deviations, one small chart a parameter, for solvers that follow the data in time.
function trackFigures(s) {
  const track = s.track || {};
  const time = list(track.time);
  if (!time.length) return [];
  const charts = list(track.parameters).map((p) => {
    // The first instants know nothing; their bands must not flatten the rest.
    const settled = Math.floor(time.length / 4);
    const y = padded(extent([p.mean.slice(settled), p.lower.slice(settled), p.upper.slice(settled)]), 0.25);
    const inside = p.mean.map((v) => Math.min(Math.max(v, y[0]), y[1]));
    return el("div", { class: "track" }, el("b", {}, p.name), el("span", { class: "sub" },
      el("span", {}, unitText(p.unit)), el("strong", {}, `${fmt(p.mean[p.mean.length - 1], 4)} (${fmt(p.lower[p.lower.length - 1], 3)} … ${fmt(p.upper[p.upper.length - 1], 3)})`)),
    svgNode(chart({
      width: 240, height: 150, small: true, margin: [4, 4, 16, 46],
      title: `${withUnit(p)} against time, with a band of two standard deviations`,
      x: { label: "t [s]", range: extent([time]) }, y: { label: axisUnit(p.unit), range: y },
      band: { x: time, lower: p.lower, upper: p.upper },
      series: [{ x: time, y: inside, cls: "simulated" }],
    })));
  });
  return [el("h3", {}, "Parameters against time: ", el("code", {}, s.id)),
    el("p", { class: "muted" }, `Mean and band of two standard deviations over ${plural(list(track.recordings).length, "recording")}, one after another; values at the end.`),
    el("div", { class: "minis" }, charts)];
}

// Every run that started more than once, the final one too.
function startsOf() {
  const final = report.final ? [{ name: `${report.final.solver}, ${report.final.stage}`, starts: report.final.starts }] : [];
  return [...solvers.map((s) => ({ name: s.id, starts: s.starts })), ...final];
}

let drawConvergence = () => {};

function solverSection() {
  if (!solvers.length) return null;
  const columns = [{ title: "Solver", head: true }, { title: "Best cost", num: true }, { title: "NRMSE held out", num: true },
    { title: "Evaluations", num: true }, { title: "Budget", num: true }, { title: "Diverged", num: true }, { title: "Stopped by" }];
  const rows = solvers.map((s) => [
    el("span", {}, el("code", {}, s.id), s.title ? ` ${s.title} ` : " ", s.chosen ? badge("used here", "good") : ""), fmt(s.cost, 4), fmt(s.nrmse_heldout, 4), count(s.evaluations), count(s.budget),
    count(s.diverged), s.stopped || "–",
  ]);
  const host = el("figure", { "aria-label": "Convergence" });
  let drawn = 0;
  drawConvergence = (forced) => {
    const width = forced || Math.round(host.clientWidth);
    if (!width || width === drawn) return;
    drawn = width;
    const node = convergenceChart(Math.max(300, width));
    if (node) host.replaceChildren(node);
  };
  return section("solvers", "Search",
    plainTable("What each solver reached within its budget of objective evaluations; diverged counts candidates whose simulation blew up", columns, rows),
    el("h3", {}, "Convergence"), host, ...quality.waterfall(startsOf()), ...solvers.flatMap(trackFigures));
}

// ---------------------------------------------------------------------------------------------------------- two stages

// Values of the freely fitted conditions with bars of two standard errors, and both laws through them.
function lawFigure(p) {
  const bars = { x: [], y: [] };
  for (const f of list(p.free)) {
    const at = f[p.against];
    const half = isNumber(f.std_error) ? 2 * f.std_error : 0;
    bars.x.push(at, at, null);
    bars.y.push(f.value - half, f.value + half, null);
  }
  const dots = list(p.free).map((f) => f.value);
  const xr = padded(extent([list(p.free).map((f) => f[p.against])]), 0.06);
  const tick = (xr[1] - xr[0]) / 80;
  const dashes = { x: [], y: [] };
  for (const f of list(p.free)) {
    dashes.x.push(f[p.against] - tick, f[p.against] + tick, null);
    dashes.y.push(f.value, f.value, null);
  }
  const y = padded(extent([dots, p.curve.two_stages, p.curve.joint]), 0.15);
  bars.y = bars.y.map((v) => (v === null ? null : Math.min(Math.max(v, y[0]), y[1])));
  return el("div", { class: "track" }, el("b", {}, withUnit(p)),
    svgNode(chart({
      width: 240, height: 168, small: true, margin: [4, 4, 16, 46],
      title: `${withUnit(p)} against ${p.against}: free values, law in two stages, law of the joint fit`,
      x: { label: p.against === "drive" ? "drive" : "f [Hz]", range: xr }, y: { label: axisUnit(p.unit), range: y },
      series: [{ ...bars, cls: "residual" }, { ...dashes, cls: "measured" },
        { x: p.curve.at, y: p.curve.two_stages, cls: "simulated" }, { x: p.curve.at, y: p.curve.joint, cls: "baseline" }],
    })));
}

function stagesSection() {
  const s = report.stages;
  if (!s || typeof s !== "object") return null;
  const item = (cls, text, dashed) => el("li", {}, el("i", { style: `border-color:var(--${cls});border-top-style:${dashed ? "dashed" : "solid"}` }), text);
  const row = (name, x) => [name, fmt(x.nrmse_fit, 4), fmt(x.nrmse_heldout, 4), count(x.evaluations)];
  return section("stages", "Parameter laws in two stages and at once",
    s.predicts_better ? el("p", {}, s.predicts_better === "joint"
      ? "The joint fit predicts the held-out recordings better." : "The laws found in two stages predict the held-out recordings better.") : null,
    plainTable("NRMSE of the laws; both fitted to the same recordings", [{ title: "", head: true }, { title: "Fitted", num: true }, { title: "Held out", num: true }, { title: "Evaluations", num: true }],
      [["Every condition free (no law)", fmt(s.nrmse_free, 4), "–", "–"], row("Two stages", s.two_stages), row("Joint", s.joint)]),
    plainTable("Parameters in the order they were frozen; what was still free was fitted again each time",
      [{ title: "Parameter", head: true }, { title: "Law" }, { title: "Scatter about the law, share of the box", num: true }, { title: "NRMSE then", num: true }],
      list(s.parameters).map((p) => [el("code", {}, p.name), p.law, percent(p.scatter), fmt(p.nrmse_when_frozen, 4)])),
    el("ul", { class: "legend" }, item("measured", "one condition, all parameters free"), item("residual", "two standard errors"),
      item("simulated", "law, two stages"), item("baseline", "law, joint fit", true)),
    el("div", { class: "minis" }, list(s.parameters).map(lawFigure)));
}

// ------------------------------------------------------------------------------------------------------------- diagnosis

const verdictWords = {
  complete: "Complete: what is left cannot be told from noise.",
  "missing-physics": "Physics is missing from the base model.",
  ambiguous: "Ambiguous: something is missing, and these data cannot tell the candidates apart.",
  unattributed: "Unattributed: something is missing that no known effect explains.",
};
const grades = [["named", "Named", ""], ["established", "Established", "confidence from 95 %"], ["supported", "Supported", "confidence from 80 %"], ["suggested", "Suggested, not named", "confidence from 50 %"]];
const share = (v) => Math.max(0, Math.min(1, v));
const percent = (v) => (isNumber(v) ? `${fmt(100 * v, 3)} %` : "–");
const rounded = (v) => (isNumber(v) ? `${(100 * v).toFixed(0)} %` : "–");
// Rounded down, as src/core/probability_text.cpp does: none reads as of a higher grade than it has.
const probability = (v) => (!isNumber(v) ? "–" : 100 * v > 99 + 1e-9 && v < 1 ? "over 99 %" : `${Math.floor(100 * v + 1e-9)} %`);
const significant = (v, digits) => fmt(Number(v.toPrecision(digits)), digits);
const unitText = (unit) => printedUnit(unit).replace(/\^-?\d+/g, raised);
const axisUnit = (unit) => (unit === "1" ? "" : unitText(unit));
const withUnit = (p) => (p.unit === "1" ? p.name : `${p.name} [${unitText(p.unit)}]`);
const withError = (c) => `${significant(c.value, 3)} ± ${significant(c.std_error, 1)}${c.unit === "1" ? "" : `\u00a0${unitText(c.unit)}`}`;
const sameSign = (c) => (c.of_all ? `one value of all ${c.recordings}` : `${Math.round(c.consistency * c.recordings)} of ${c.recordings}`);
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
const zOf = (score) => (score && score.std_error > 0 ? score.mean / score.std_error : null);
// The signature contrast shows an effect at two standard errors in its sense, beyond 95 % of the placebos.
const shows = (c) => c.shown ?? (c.z_for >= 2 && c.placebo_quantile >= 0.95);
const overWords = { time: "Time [s]", displacement: "Displacement [mm]", velocity: "Velocity [mm/s]" };
// One meaning each, here and on the terminal.
const glossary = [
  ["residual", "Measured less simulated force. The misfit is its mean square; beyond the noise: less that of the noise."],
  ["explained", "The part of the misfit that is gone with an effect and comes back when it is taken out and the rest is refitted."],
  ["held-out", "Of recordings that nothing was fitted to."],
  ["shape that predicts better", "What the augmented model holds, and what is less likely than not the cause."],
  ["distinguishable", "Of two effects one predicts fitted recordings that are left out in turn better, by two standard errors."],
  ["related effect", "One that is mistaken for another on many motions, or is its limit."],
  ["noise floor", "The error that a perfect model would have, as far as the recordings show it. Where the motion does not repeat itself only white noise is seen (high-pass): the floor is at least this much, and slow noise may add to it."],
  ["share of the misfit", "Of an effect: what comes back when it is taken out. What several explain counts for each of them, so that their shares may add to more than 100 %. The part without a name is what stays and, of what all effects and shapes explain together, the part of the shapes, in proportion to their shares."],
  ["confidence, probability", "Cut off to whole percent, not rounded: 89.7 % reads 89 %, so that none reads as of a higher grade than it has."],
];

function diagnosisSection() {
  const d = report.diagnosis;
  if (!d || typeof d !== "object") return null;
  const base = d.baseline || {};
  const augmented = d.augmented || {};
  const named = [...list(d.effects), ...list(d.suggestions)];
  const parts = [];
  for (const [grade, heading, from] of grades) {
    const rows = named.filter((e) => (e.grade || "named") === grade);
    if (rows.length) parts.push(el("h3", {}, heading, el("span", { class: "muted" }, from ? ` (${from})` : "")), rows.map((e) => effectBlock(e, d)));
  }
  parts.push(shapesTable(augmented, named, Boolean(d.evidence && d.evidence.doubt_of_data)));
  const nrmse = [[`Base model, ${base.model || ""}`, base.nrmse_fit, base.nrmse_heldout]];
  if (d.augmented) nrmse.push([augmented.model && augmented.model !== base.model ? `Augmented model, ${augmented.model}` : "Augmented model", augmented.nrmse_fit, augmented.nrmse_heldout]);
  if (isNumber(base.noise_floor_nrmse)) nrmse.push(["Noise floor of the recordings", base.noise_floor_nrmse, base.noise_floor_heldout_nrmse ?? null]);
  parts.push(el("h3", {}, "Error before and after"), plainTable("NRMSE of the base and the augmented model", [{ title: "", head: true }, { title: "Fitted recordings", num: true }, { title: "Held-out recordings", num: true }],
    nrmse.map(([name, a, b]) => [name, fmt(a, 3), fmt(b, 3)])));
  if (isNumber(d.unknown_share) && d.verdict !== "complete" && !list(d.summary).length) parts.push(el("p", {}, `${rounded(d.unknown_share)} of the misfit beyond the noise is explained by nothing named or suggested.`));
  parts.push(placesTable("Where the misfit of the base model sits", d.locations), placesTable("Where the misfit of the augmented model sits", augmented.locations));
  parts.push(contenderTables(d), contrastTable(d.evidence), lawsTable(d.evidence), residualMaps(), driftCharts(d.drift));
  if (list(d.notes).length) parts.push(el("h3", {}, "Remarks"), el("ul", {}, d.notes.map((n) => el("li", {}, prose(n)))));
  if (list(d.rejected).length) {
    // Many effects share a reason: a row a reason, not an effect.
    const reasons = [...new Set(d.rejected.map((x) => x.reason || ""))];
    parts.push(el("h3", {}, "Examined and not named"), plainTable("Effects that were tried, with the reason why none is named",
      [{ title: "Reason", head: true }, { title: "Effects" }],
      reasons.map((reason) => [prose(reason), el("span", {}, d.rejected.filter((x) => (x.reason || "") === reason).flatMap((x, i) => [i ? ", " : "", el("code", { class: "nowrap" }, x.id)]))])));
  }
  if (list(d.not_observable).length) {
    parts.push(el("h3", {}, "Not observable in these data"), plainTable("Effects these recordings could not have shown", [{ title: "Effect", head: true }, { title: "Why, or the smallest size that would show" }],
      d.not_observable.map((x) => [x.id, prose(x.reason || x.detection_limit || "")])));
  }
  parts.push(aliasMap(d.alias_map));
  parts.push(el("h3", {}, "Words"), el("dl", { class: "facts" }, glossary.flatMap(([word, meaning]) => [el("dt", {}, word), el("dd", {}, meaning)])));
  return section("diagnosis", "Diagnosis", ...parts);
}

// What is named or suggested: what it is and how sure, then what speaks for and against it.
function effectBlock(e, d) {
  const candidate = list(d.evidence && d.evidence.candidates).find((c) => c.id === (e.in_place_of || e.id));
  const c = e.contrast;
  const facts = [];
  const add = (name, ...value) => facts.push(el("dt", {}, name), el("dd", {}, ...value));
  if (c === null) {
    add("Signature contrast", "None can be taken from these recordings.");
  } else if (c) {
    add("Signature contrast", `${capital(c.what)}: ${withError(c)}; z ${fmt(c.z, 2)}, beyond ${percent(c.placebo_quantile)} of the placebos, ${c.of_all ? "" : "the same sign in "}${sameSign(c)} recordings`,
      shows(c) ? "." : ". Not enough to show this effect by itself.");
  }
  if (!e.in_place_of && candidate) {
    const rival = e.nearest_rival;
    if (rival) add("Nearest rival", el("code", {}, rival.id), ` explains ${rounded(rival.share_of_gain)} of what it explains, in its place${rival.refitted ? "" : ", to first order"}.`);
    if (list(e.behind_other_laws).length) add("Behind other laws", `Keeps ${e.behind_other_laws.map((k) => `${rounded(share(k.share_of_gain))} of its gain behind ${k.model}`).join(", ")}.`);
    if (isNumber(e.robustness_value)) {
      const much = e.robustness_value > 0.995 && e.robustness_value < 1 ? "over 99 %" : rounded(e.robustness_value);
      add("Robustness value", `To explain it away, unmodelled physics would have to explain ${much} of what stays and share ${much} of its shape.`);
    }
  }
  const alike = list(e.indistinguishable_from);
  if (alike.length) add("Not distinguishable from", alike.map((id, i) => [i ? ", " : "", el("code", {}, id)]), isNumber(e.confidence_alone) ? `; the confidence that it is this one is ${probability(e.confidence_alone)}.` : ".");
  const lesser = list(e.less_likely);
  if (lesser.length) add("Less likely", lesser.map((id, i) => [i ? ", " : "", el("code", {}, id)]), " would do as well.");
  if (isNumber(e.share_of_misfit)) add("Share of the misfit", `${rounded(e.share_of_misfit)} comes back when it is taken out; held-out NRMSE ${fmt(e.nrmse_heldout_before, 3)} without it, ${fmt(e.nrmse_heldout_after, 3)} with it.`);
  if (e.experiment) add("Recording that would decide", `${capital(e.experiment)}.`);
  if (e.rig_cause) add("May also come from outside the damper", `${e.rig_cause}.`);
  return el("div", { class: `effect ${e.grade || ""}` },
    el("h4", {}, e.in_place_of ? "or " : "", el("code", {}, e.id), isNumber(e.confidence) ? `, confidence ${probability(e.confidence)}${list(e.indistinguishable_from).length ? ` that it is this or ${e.indistinguishable_from.join(" or ")}` : ""}` : "", e.family ? el("span", { class: "muted" }, `, family ${e.family}`) : ""),
    e.sentence ? el("p", {}, prose(e.sentence)) : null,
    list(e.parameters).length ? plainTable(`Parameters of ${e.id}; the intervals allow for physics that is left out`, [{ title: "Parameter", head: true }, { title: "Value", num: true }, { title: "Interval", num: true }, { title: "Unit" }],
      e.parameters.map((p) => [p.name, fmt(p.value, 4), Array.isArray(p.ci95) ? fmtEnds(p.ci95[0], p.ci95[1], 3).join(" … ") : "–", unitText(p.unit)])) : null,
    el("dl", { class: "facts" }, facts),
    el("div", { class: "plots" }, lookPlot(e, c), c ? contrastPlot(c) : null));
}

// The force where the contrast acts: what was measured, the base model on the same motion, what else the augmented model
// holds without this effect, the augmented model. Without another effect that is the law, its
// parameters by richer curves of the drive than the base model's.
function lookPlot(e, c) {
  const curve = (report.curves || {})[e.id];
  if (!curve || list(curve.x).length < 2) return null;
  const others = list(((report.diagnosis || {}).augmented || {}).effects).some((id) => id !== e.id && id !== e.in_place_of);
  const lines = [["force_n", "measured", "measured"], ["baseline_n", "baseline", "base model"],
    ["without_n", "without", others ? "other effects alone" : "law alone"], ["predicted_n", "simulated", `with ${e.id}`]]
    .filter(([key]) => list(curve[key]).length);
  const shown = lines.map(([key, cls]) => ({ x: curve.x, y: list(curve[key]), cls }));
  const label = overWords[curve.over] || "";
  return el("figure", { class: "plot contrast" }, el("figcaption", {}, `${curve.recording}: force over ${curve.over}${c ? ", where the contrast acts" : ""}`),
    svgNode(chart({ width: 360, height: 260, margin: [6, 10, 36, 58], title: `Force over ${curve.over} of ${curve.recording}: ${lines.map(([, , text]) => text).join(", ")}`,
      x: { label, range: curve.over === "time" ? extent([curve.x]) : padded(extent([curve.x])) }, y: { label: "Force [N]", range: padded(extent(shown.map((s) => s.y))) }, series: shown })),
    el("ul", { class: "legend" }, lines.map(([, cls, text]) => el("li", {}, el("i", { style: `border-color:var(--${cls});border-top-style:${{ baseline: "dashed", without: "dotted" }[cls] || "solid"}` }), text))));
}

// What the augmented model holds without a name. A probability is that of recordings without a fault.
function shapesTable(augmented, named, faulty) {
  const shapes = list(augmented.shapes);
  const others = list(augmented.effects).filter((id) => !named.some((e) => e.id === id));
  if (!shapes.length) {
    return others.length ? el("p", {}, "The augmented model also holds ", others.map((id, i) => [i ? ", " : "", el("code", {}, id)]), ": a shape that predicts better, not offered as a cause.") : null;
  }
  const sizes = (rows) => list(rows).map((p) => `${p.name} = ${significant(p.value, 2)}${p.unit === "1" ? "" : `\u00a0${unitText(p.unit)}`}`).join(", ");
  const told = faulty ? [] : [{ title: "Probability that it is the cause", num: true }];
  return [el("h3", {}, faulty ? "Not named" : "Not sure enough to name"), plainTable("Shapes with which the augmented model predicts better; none is offered as a cause",
    [{ title: "Shape", head: true }, ...told, { title: "Sizes", text: true, wide: true }],
    shapes.map((s) => [s.title ? `${capital(s.title)} (${s.id})` : s.id, ...(faulty ? [] : [probability(s.confidence)]), sizes(s.parameters) || "–"]))];
}

// The contrast of each recording as a dot, all together as the band of two standard errors.
function contrastPlot(c) {
  const rows = list(c.of_recordings).filter((r) => isNumber(r.value));
  if (rows.length < 2 || c.of_all) return null;
  const [pitch, top, left, right, width] = [17, 6, 112, 12, 360];
  const height = top + pitch * rows.length + 34;
  const low = c.value - 2 * c.std_error;
  const high = c.value + 2 * c.std_error;
  const [lo, hi] = padded(extent([rows.map((r) => r.value), [0, low, high]]));
  const at = (v) => (left + ((v - lo) / (hi - lo)) * (width - left - right)).toFixed(1);
  const bottom = top + pitch * rows.length;
  const ending = (/\.\w+$/.exec(rows[0].file) || [""])[0];
  const same = rows.every((r) => r.file.endsWith(ending));
  const label = (file) => (same && ending ? file.slice(0, -ending.length) : file);
  const cut = (name) => (name.length > 16 ? `…${name.slice(-15)}` : name);
  const marks = [
    `<rect class="band" x="${at(low)}" y="${top}" width="${Math.max(1, at(high) - at(low)).toFixed(1)}" height="${bottom - top}"/>`,
    ...linearTicks(lo, hi, 3).map(([v, text]) => `<path class="grid${v === 0 ? " zero" : ""}" d="M${at(v)} ${top}V${bottom}"/><text class="tick" x="${at(v)}" y="${bottom + 14}" text-anchor="middle">${esc(text)}</text>`),
    ...rows.map((r, k) => `<text x="${left - 8}" y="${top + (k + 0.5) * pitch}" dy="0.35em" text-anchor="end">${esc(cut(label(r.file)))}</text><circle class="dot" cx="${at(r.value)}" cy="${top + (k + 0.5) * pitch}" r="3.5"><title>${esc(r.file)}: ${fmt(r.value, 3)}</title></circle>`),
    `<text class="tick" x="${(left + width - right) / 2}" y="${height - 4}" text-anchor="middle">${esc(c.unit === "1" ? "share" : unitText(c.unit))}</text>`,
  ];
  return el("figure", { class: "plot contrast" }, el("figcaption", {}, `${capital(c.what)}, by recording; band: all together ± 2 standard errors`),
    svgNode(`<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${esc(`${c.what} by recording`)}">${marks.join("")}</svg>`));
}

function placesTable(title, places) {
  if (!list(places).length) return null;
  return [el("h3", {}, title), plainTable("Share of the misfit against share of the samples; each recording weighs the same in both",
    [{ title: "Where", head: true }, { title: "Variable" }, { title: "From", num: true }, { title: "To", num: true }, { title: "Unit" }, { title: "Share of misfit", num: true }, { title: "Share of samples", num: true }, { title: "Recordings" }],
    places.map((l) => [l.where || "", l.variable || "", fmt(l.from, 3), fmt(l.to, 3), l.unit || "–", percent(l.share_of_misfit), percent(l.share_of_samples), list(l.recordings).join(", ")]))];
}

// What was set in the place of each effect of the augmented model.
function contenderTables(d) {
  const candidates = list(d.evidence && d.evidence.candidates).filter((c) => list(c.contenders).length);
  if (!candidates.length) return null;
  const remark = (r) => [r.law ? "richer dependence on the drive" : r.kin ? "related effect" : "",
    r.holds_the_candidate ? "holds it as a limit" : "", r.held_by_the_candidate ? "is a limit of it" : "", r.ended_as ? "it ends as this" : ""].filter(Boolean).join(", ");
  return [
    el("h3", {}, "Contenders"),
    el("p", { class: "muted" }, "What else would explain of the gain of each effect of the augmented model, in its place. The block score compares both on recordings left out in turn: above 2 the effect predicts them better, below −2 the contender does. Shares to first order are of contenders that were not refitted."),
    candidates.map((c) => plainTable(`In the place of ${c.id}: block score z of the model with it over the model without it ${fmt(zOf(c.score), 2)}`,
      [{ title: "Contender", head: true }, { title: "Share of its gain", num: true }, { title: "How" }, { title: "Block score z", num: true }, { title: "Remark" }],
      [...c.contenders].sort((a, b) => b.share - a.share).slice(0, 8).map((r) => [r.law ? [...new Set(r.id.replace(/^law:/, "").split(","))].join(", ") : r.id, rounded(share(r.share)), r.refitted ? "refitted" : "first order",
        r.behind && r.behind.clusters ? fmt(zOf(r.behind), 2) : "–", remark(r) || "–"]))),
  ];
}

function contrastTable(evidence) {
  const rows = list(evidence && evidence.signatures);
  if (!rows.length) return null;
  return [
    el("h3", {}, "Signature contrasts"),
    el("p", { class: "muted" }, "What only one mechanism does to the force, read off the residual of the base model without fitting. z is the value over its standard error, taken as Student's t of so many recordings (of fewer than three: half-cycles) and turned into the value of a standard normal that is as rare: with few recordings far less than the ratio. The placebo quantile is the share of placebos, the same residual moved against the motion, that are smaller."),
    plainTable("Strongest first", [{ title: "Contrast", head: true }, { title: "Value ± standard error", num: true }, { title: "z", num: true }, { title: "Placebo quantile", num: true }, { title: "Same sign in recordings", num: true }, { title: "Speaks for" }],
      [...rows].sort((a, b) => Math.abs(b.z) - Math.abs(a.z)).map((c) => [c.what, withError(c), fmt(c.z, 2), percent(c.placebo_quantile), sameSign(c),
        list(c.speaks_for).map((id, i) => `${id}${c.sign[i] === 0 ? "" : c.sign[i] > 0 ? " (above 0)" : " (below 0)"}`).join(", ")])),
  ];
}

function lawsTable(evidence) {
  const rows = list(evidence && evidence.other_laws);
  if (!rows.length || !isNumber(evidence.base_compared)) return null;
  const root = (squares) => fmt(Math.sqrt(squares), 3);
  return [
    el("h3", {}, "Other laws without effects"),
    plainTable("NRMSE on the recordings and samples that hypotheses are compared on", [{ title: "Law", head: true }, { title: "NRMSE", num: true }, { title: "Has the effects of its own" }],
      [[`${evidence.model} (base)`, root(evidence.base_compared), "–"], [`${evidence.model}, augmented`, root(evidence.augmented_compared), "–"],
        ...rows.map((r) => [r.model, root(r.squares), r.has_what_was_found ? "yes" : "no"])]),
  ];
}

// Which effects look alike in these recordings: |cosine| of what they add to the force. Each stands beside the one of
// those left that it is most like, so that what is mistaken for one another stands together.
function aliasMap(map) {
  const names = list(map && map.effects);
  if (names.length < 2) return null;
  const order = [0];
  while (order.length < names.length) {
    const likeLast = map.cosine[order[order.length - 1]];
    const free = names.map((_, i) => i).filter((i) => !order.includes(i));
    order.push(free.reduce((a, b) => (likeLast[b] > likeLast[a] ? b : a)));
  }
  // Small enough for two dozen effects on a phone.
  const cell = 14;
  const left = Math.ceil(widest(names)) + 10;
  const top = left;
  const size = names.length * cell;
  const at = (k) => k * cell;
  const marks = order.flatMap((i, row) => [
    `<text x="${left - 6}" y="${top + at(row) + cell / 2}" dy="0.35em" text-anchor="end">${esc(names[i])}</text>`,
    `<text transform="translate(${left + at(row) + cell / 2},${top - 6}) rotate(-90)" dy="0.35em">${esc(names[i])}</text>`,
    ...order.map((j, column) => `<rect x="${left + at(column)}" y="${top + at(row)}" width="${cell - 1}" height="${cell - 1}" class="cell above" fill-opacity="${(map.cosine[i][j] ** 2).toFixed(3)}"><title>${esc(names[i])} and ${esc(names[j])}: ${fmt(map.cosine[i][j], 3)}</title></rect>`),
  ]);
  return [
    el("h3", {}, "Which effects look alike in these recordings"),
    el("p", { class: "muted" }, "What each effect adds to the force, less what the base model's parameters imitate of it, against what the others add: full colour where one is a multiple of the other (cosine 1; point at a field for its value), none where they have nothing in common. Recordings of another kind part what looks alike here."),
    el("figure", { class: "plot wide" }, el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Likeness of effects" },
      svgNode(`<svg viewBox="0 0 ${left + size} ${top + size}" style="max-width:${left + size}px;min-width:${Math.round(0.75 * (left + size))}px" role="img" aria-label="Likeness of effects">${marks.join("")}</svg>`))),
  ];
}

// What is left, of the base model and of the augmented model: over displacement and velocity, and since reversal.
// Residuals are shares of the largest force of their recording, so that all recordings speak together.

const twoLegend = () => el("ul", { class: "legend" },
  [["baseline", "base model", "dashed"], ["simulated", "augmented model", "solid"]].map(([cls, text, style]) =>
    el("li", {}, el("i", { style: `border-color:var(--${cls});border-top-style:${style}` }), text)));
const peakOf = (r) => Math.max(...extent([r.force_n]).map(Math.abs)) || 1;

// Mean of value(r, i) over a grid of columns x rows; null where no sample is.
function meanOnGrid(columns, rows, place, value) {
  const sum = new Float64Array(columns * rows);
  const count = new Float64Array(columns * rows);
  for (const r of recordings) {
    const n = list(r.force_n).length;
    for (let i = 0; i < n; ++i) {
      const at = place(r, i);
      const v = value(r, i);
      if (at === null || !isNumber(v)) continue;
      sum[at] += v;
      count[at] += 1;
    }
  }
  return Array.from(sum, (s, k) => (count[k] > 0 ? s / count[k] : null));
}

function residualMap(title, cells, columns, rows, limit, xRange, yRange) {
  const width = half();
  const height = Math.round(Math.min(380, 0.8 * width));
  const options = { width, height, title, margin: [6, 8, 36, 52], series: [],
    x: { label: channels.displacement.label, range: xRange }, y: { label: channels.velocity.label, range: yRange } };
  const [top, right, bottom, left] = margins(options);
  const frame = chart(options);
  const w = (width - left - right) / columns;
  const h = (height - top - bottom) / rows;
  const spots = cells.map((v, k) => {
    if (v === null) return "";
    const share = Math.min(Math.abs(v) / limit, 1);
    return `<rect x="${(left + (k % columns) * w).toFixed(1)}" y="${(height - bottom - (Math.floor(k / columns) + 1) * h).toFixed(1)}" width="${(w + 0.3).toFixed(1)}" height="${(h + 0.3).toFixed(1)}" class="cell ${v > 0 ? "above" : "below"}" fill-opacity="${(0.06 + 0.94 * share).toFixed(2)}"/>`;
  });
  return el("figure", { class: "plot" }, el("figcaption", {}, title), svgNode(frame.replace("</svg>", `${spots.join("")}</svg>`)));
}

// Per sample: direction of motion and the distance since the last reversal of more than 2 % of the stroke.
function sinceReversal(r) {
  const x = list(r.displacement_mm);
  const [lo, hi] = extent([x]);
  const least = 0.02 * (hi - lo);
  const direction = [];
  const distance = [];
  let sense = 0;
  let turn = x[0];
  let furthest = x[0];
  for (let i = 0; i < x.length; ++i) {
    if (sense === 0 && Math.abs(x[i] - turn) > least) { sense = Math.sign(x[i] - turn); furthest = x[i]; }
    if (sense !== 0) {
      if (sense * (x[i] - furthest) > 0) furthest = x[i];
      else if (sense * (furthest - x[i]) > least) { turn = furthest; sense = -sense; furthest = x[i]; }
    }
    direction.push(sense);
    distance.push(Math.abs(x[i] - turn));
  }
  return { direction, distance };
}

function residualMaps() {
  if (!hasBaseline || !recordings.length) return null;
  const [columns, rows] = [30, 24];
  const xRange = extent(recordings.map((r) => r.displacement_mm));
  const yRange = extent(recordings.map((r) => r.velocity_mm_s));
  const bin = (v, [lo, hi], count) => Math.min(count - 1, Math.max(0, Math.floor(((v - lo) / (hi - lo || 1)) * count)));
  const place = (r, i) => (isNumber(r.displacement_mm[i]) && isNumber(r.velocity_mm_s[i])
    ? bin(r.velocity_mm_s[i], yRange, rows) * columns + bin(r.displacement_mm[i], xRange, columns) : null);
  const lefts = [["Base model", new Map(recordings.map((r) => [r, baselineResidual(r)]))], ["Augmented model", new Map(recordings.map((r) => [r, residual(r)]))]];
  const peak = new Map(recordings.map((r) => [r, peakOf(r)]));
  const share = (left) => (r, i) => (left.get(r)[i] === null ? null : left.get(r)[i] / peak.get(r));
  const grids = lefts.map(([, left]) => meanOnGrid(columns, rows, place, share(left)));
  const sizes = grids[0].filter((v) => v !== null).map(Math.abs).sort((a, b) => a - b);
  const limit = sizes[Math.floor(0.97 * (sizes.length - 1))] || 1e-12;
  const since = new Map(recordings.map((r) => [r, sinceReversal(r)]));
  const bins = 30;
  const reach = Math.max(...recordings.map((r) => extent([since.get(r).distance])[1]));
  const far = (r, i) => (since.get(r).direction[i] === 0 ? null : bin(since.get(r).distance[i], [0, reach], bins));
  const along = lefts.map(([, left]) => meanOnGrid(bins, 1, far, (r, i) => {
    const v = share(left)(r, i);
    return v === null ? null : 100 * v * since.get(r).direction[i];
  }));
  const middles = Array.from({ length: bins }, (_, k) => ((k + 0.5) * reach) / bins);
  return [
    el("h3", {}, "What is left, over displacement and velocity"),
    el("p", { class: "muted" }, `Mean of measured − simulated over all recordings, in shares of each recording's largest force: `,
      el("span", { class: "swatch above" }), " measured above simulated, ", el("span", { class: "swatch below" }), ` below; full colour at ${fmt(100 * limit, 2)} %. Noise averages out, what repeats with the motion stays.`),
    el("div", { class: "plots" }, lefts.map(([name], k) => residualMap(name, grids[k], columns, rows, limit, xRange, yRange))),
    el("h3", {}, "What is left, since the last reversal"),
    el("p", { class: "muted" }, "The same mean, taken positive where the force against the motion is too small in the simulation."),
    twoLegend(),
    el("figure", { class: "plot wide" }, svgNode(chart({
      width: whole(), height: 260, margin: [6, 10, 36, 52], title: "Mean residual against distance since reversal",
      x: { label: "Distance since reversal [mm]", range: [0, reach] }, y: { label: "Mean residual [%]", range: padded(extent(along)) },
      series: [{ x: middles, y: along[0], cls: "baseline" }, { x: middles, y: along[1], cls: "simulated" }] }))),
  ];
}

function driftCharts(drift) {
  const at = list(drift && drift.recordings);
  if (at.length < 3) return null;
  const words = { amplitude: "half stroke [mm]", frequency: "frequency [Hz]", drive: "drive", order: "order of recording" };
  const value = (row, variable) => (variable === "amplitude" ? 1e3 * row.amplitude : variable === "order" ? row.order + 1 : row[variable]);
  const spread = (p) => { const [lo, hi] = extent([p.relative_change]); return hi - lo; };
  const after = new Map(list(drift.augmented).map((p) => [p.name, p]));
  const shown = list(drift.base).filter((p) => spread(p) > 0).sort((a, b) => spread(b) - spread(a)).slice(0, 6);
  if (!shown.length) return null;
  const charts = shown.map((p) => {
    const variable = p.follows || "order";
    const order = at.map((_, i) => i).sort((a, b) => value(at[a], variable) - value(at[b], variable) || a - b);
    const x = order.map((i) => value(at[i], variable));
    const change = (q) => order.map((i) => 100 * q.relative_change[i]);
    const series = [{ x, y: change(p), cls: "baseline" }];
    if (after.has(p.name)) series.push({ x, y: change(after.get(p.name)), cls: "simulated" });
    return el("div", { class: "track" }, el("b", {}, p.name), el("span", { class: "sub" }, el("span", {}, p.follows ? `follows the ${p.follows}` : "over the order of recording")),
      svgNode(chart({ width: 240, height: 150, small: true, margin: [4, 4, 16, 46], title: `Change of ${p.name} by recording`,
        x: { label: words[variable], range: padded(extent([x])) }, y: { label: "change [%]", range: padded(extent(series.map((s) => s.y)), 0.15) }, series })));
  });
  return [el("h3", {}, "Parameters, recording by recording"),
    el("p", { class: "muted" }, "By how much each fitted recording alone would change a parameter of the damper's law, the others held. Where that follows the motion or the drive, the law lacks something that depends on it."),
    twoLegend(), el("div", { class: "minis" }, charts)];
}

// ------------------------------------------------------------------------------------------------------------ provenance

const normalisations = {
  "max-abs": "NRMSE = RMSE / max |F|", range: "NRMSE = RMSE / (max F − min F)", std: "NRMSE = RMSE / standard deviation of F", "mean-abs": "NRMSE = RMSE / mean |F|",
};
const weightings = {
  "per-recording": "Overall figures are the root mean square of the recordings' NRMSE: each recording weighs the same, normalised by its own force.",
  pooled: "Overall figures pool the samples of all recordings: each sample weighs the same.",
};

function dataTable() {
  const table = plainTable("Data read", [{ title: "File", head: true }, { title: "SHA-256" }], []);
  const row = (d) => el("tr", {}, el("th", { scope: "row" }, d.file), el("td", { "data-title": "SHA-256" }, el("code", { class: "hash" }, d.sha256)));
  return [table, inParts(table.querySelector("tbody"), report.data, 200, "files", row)];
}

function provenanceSection() {
  const facts = [];
  const add = (name, ...value) => facts.push(el("dt", {}, name), el("dd", {}, ...value));
  if (report.command) add("Command", el("code", {}, report.command));
  if (report.version) add("Version", `hysteron ${report.version}`);
  if (report.seed !== undefined && report.seed !== null) add("Seed", String(report.seed));
  if (report.normalisation) add("Normalisation", `${normalisations[report.normalisation] || "NRMSE"} (${report.normalisation}), F the measured force`);
  if (report.weighting) add("Weighting", `${weightings[report.weighting] || ""} (${report.weighting})`);
  return section("provenance", "Provenance", el("dl", { class: "facts" }, facts),
    list(report.data).length ? dataTable() : null,
    list(report.notes).length && !report.diagnosis ? [el("h3", {}, "Notes"), el("ul", {}, report.notes.map((n) => el("li", {}, n)))] : []);
}

// ------------------------------------------------------------------------------------------------------------------ page

// The summary of a diagnosis: what is missing, what is known of it, sentence by sentence, and the next recording. A
// record without one has its verdict and names told.
function summaryLines() {
  const d = report.diagnosis;
  const sentences = list(d && d.summary);
  if (report.verdict || !d || !d.verdict) return el("p", { class: "verdict" }, verdictLine());
  if (!sentences.length) {
    const told = list(d.effects).length ? `${d.verdict === "ambiguous" ? "Candidates" : "Named"}: ${d.effects.map((e) => e.id).join(", ")}.` : "";
    return [el("p", { class: "verdict" }, `${verdictWords[d.verdict] || d.verdict} ${told}`),
      d.next_experiment ? el("p", { class: "verdict" }, `Next recording: ${d.next_experiment}.`) : null];
  }
  const [first, ...others] = sentences;
  const next = others.pop();
  return [el("p", { class: "verdict" }, el("strong", {}, prose(first))),
    others.length ? el("ul", { class: "verdict" }, others.map((sentence) => el("li", {}, prose(sentence)))) : null,
    next ? el("p", { class: "verdict" }, prose(next)) : null];
}

function verdictLine() {
  if (report.verdict) return report.verdict;
  const held = recordings.filter((r) => r.role === "validate").length;
  const checked = recordings.filter((r) => r.role === "checked").length;
  const fitted = recordings.length - held;
  const check = held ? ` and checked on ${held} held out`
    : checked ? `; the held-out error is that of a fit without ${checked} of them` : "; no recording was held out";
  const flagged = parameters.filter((p) => p.at_bound || foundOpen(p)).length;
  // Of a fit that was interrupted nobody knows.
  const open = parameters.some((p) => !isNumber(p.std_error) && !p.at_bound && !foundOpen(p));
  const model = report.model ? report.model.title || report.model.id : "Model";
  return `${model}: ${plural(parameters.length, "parameter")} fitted to ${plural(fitted, "recording")}` +
    `${check}; ` +
    `${flagged ? `${plural(flagged, "parameter")} to be taken with caution` : open ? "standard errors were not worked out" : "no parameter is at a bound or unidentifiable"}.`;
}

function page() {
  const sections = [
    diagnosisSection(),
    recordings.length ? overview() : null,
    recordings.length ? section("recordings", "Recordings", recordingTable(), detailView()) : null,
    report.model || parameters.length ? modelSection() : null,
    quality.parameters(report, plotted),
    quality.residual(report.residual, plotted),
    stagesSection(),
    solverSection(),
    provenanceSection(),
  ].filter(Boolean);
  const titles = { diagnosis: "Diagnosis", overview: "Overview", recordings: "Recordings", model: "Model", known: "Sensitivity and correlation", residual: "Residual", stages: "Two stages", solvers: "Search", provenance: "Provenance" };
  const warnings = list(report.warnings);
  document.getElementById("content").replaceChildren(
    el("header", {}, el("h1", {}, report.title || "Hysteron report"), report.subtitle ? el("p", { class: "subtitle" }, report.subtitle) : "",
      summaryLines(),
      el("dl", { class: "tiles" }, list(report.summary).map((t) => el("div", { class: "tile" }, el("dt", {}, t.label),
        el("dd", {}, el("div", { class: "value" }, String(t.value)), t.note ? el("div", { class: "note" }, t.note) : "")))),
      warnings.length ? el("div", { class: "warning", role: "note", "aria-label": "Warnings" }, el("strong", {}, warnings.length === 1 ? "Warning" : "Warnings"),
        el("ul", {}, warnings.map((w) => el("li", {}, w)))) : ""),
    el("nav", { "aria-label": "Sections" }, sections.map((s) => el("a", { href: `#${s.id}` }, titles[s.id]))),
    el("main", {}, sections),
    el("footer", {}, `Made by hysteron ${report.version || ""}. Plots: uPlot (MIT licence). This page loads nothing from the network.`));
}

page();
drawConvergence();
// Show first what most needs a look: the worst held-out recording, or the worst of all.
const candidates = recordings.map((r, i) => ({ r, i }));
const held = candidates.filter(({ r }) => r.role === "validate" || r.role === "checked");
const first = (held.length ? held : candidates).reduce((a, b) => ((b.r.nrmse ?? 0) > (a.r.nrmse ?? 0) ? b : a), (held.length ? held : candidates)[0]);
if (first) select(first.i);

if (detail && "ResizeObserver" in window) {
  let pending = 0;
  resizeWatch = new ResizeObserver(() => {
    cancelAnimationFrame(pending);
    pending = requestAnimationFrame(() => {
      for (const u of plots) {
        const width = u.root.parentElement.clientWidth;
        if (width < 50 || width === u.width) continue;
        u.setSize({ width, height: u.wideHeight || Math.round(Math.min(380, Math.max(250, width * 0.68))) });
      }
      drawConvergence();
    });
  });
  resizeWatch.observe(document.getElementById("content"));
}
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { if (selected >= 0) buildPlots(recordings[selected]); });
window.addEventListener("beforeprint", () => { printDetail(); drawConvergence(700); });
window.addEventListener("afterprint", () => drawConvergence());
window.hysteronReport = { report, select };
root.dataset.ready = "true";
})();
