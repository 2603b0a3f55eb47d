// Line charts of the pages as SVG, and what their axes share with those that uPlot draws.
const charts = (function () {
"use strict";

const { root, isNumber, esc, linearTicks, logTicks } = common;

const font = "12px system-ui, -apple-system, 'Segoe UI', Roboto, 'Liberation Sans', Arial, sans-serif";
const probe = document.createElement("canvas").getContext("2d");
// Of the widest of some texts, in pixels of a letter size.
function widest(texts, size = 12) {
  probe.font = font;
  return Math.max(0, ...texts.map((text) => probe.measureText(text).width)) * (size / 12);
}

// Width of a chart that fills the page, or half of it where two stand side by side: drawn so wide, its writing keeps its
// size. On a phone both are as wide as the screen.
const whole = () => Math.max(280, Math.min(1144, root.clientWidth - 56));
const half = () => (root.clientWidth > 720 ? Math.min(560, (whole() - 28) / 2) : Math.max(280, root.clientWidth - 42));

// Width of an upright axis of uPlot: as wide as its labels ask for, so that its title stands beside them.
const axisWidth = (least) => (u, values, k, cycle) =>
  cycle > 1 ? u.axes[k]._size : Math.max(least, Math.ceil(widest((values || []).map(String))) + 12);

// Our own chart markup; the texts in it have gone through esc().
function svgNode(markup) {
  const holder = document.createElement("div");
  holder.innerHTML = markup;
  return holder.firstElementChild;
}

function extent(arrays) {
  let lo = Infinity;
  let hi = -Infinity;
  for (const array of arrays) {
    for (const v of array || []) {
      if (!isNumber(v)) continue;
      if (v < lo) lo = v;
      if (v > hi) hi = v;
    }
  }
  return lo <= hi ? [lo, hi] : [0, 1];
}

function padded([lo, hi], share = 0.05) {
  // What differs by its rounding only is one value.
  const size = Math.max(Math.abs(lo), Math.abs(hi));
  const gap = hi - lo > 1e-9 * size ? (hi - lo) * share : size * 0.1 || 1;
  return [lo - gap, hi + gap];
}

const ticksOf = (axis, wanted) => (axis.log ? logTicks(...axis.range) : linearTicks(...axis.range, wanted)).filter(([v]) => !axis.whole || Number.isInteger(v));
const upright = ({ height, small, y, margin: [top, , bottom] }) => ticksOf(y, small ? 3 : Math.max(2, (height - top - bottom) / 40));

// The margins of a chart: on the left as wide as the labels there ask for, and the title of the axis beside them.
function margins(options) {
  const [top, right, bottom, left] = options.margin;
  const labels = widest(upright(options).map(([, text]) => text), options.small ? 10.5 : 12);
  return [top, right, bottom, Math.max(left, Math.ceil(labels) + (options.small ? 8 : 28))];
}

// options: width, height, small, title (for screen readers), x and y {label, range, log, whole (numbers
// only)}, margin [top, right, bottom,
// left at least], band {x, lower, upper} (optional), series [{x, y, cls, color, dash, step, dots, limit, label}]
function chart(options) {
  const { width, height, x, y } = options;
  const [top, right, bottom, left] = margins(options);
  const forward = (axis) => (axis.log ? Math.log10 : (v) => v);
  const fx = forward(x);
  const fy = forward(y);
  const [x0, x1] = x.range.map(fx);
  const [y0, y1] = y.range.map(fy);
  const px = (v) => left + ((fx(v) - x0) / (x1 - x0)) * (width - left - right);
  const py = (v) => height - bottom - ((fy(v) - y0) / (y1 - y0)) * (height - top - bottom);
  const out = [`<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${esc(options.title)}" class="${options.small ? "small" : ""}">`];
  const xticks = ticksOf(x, options.small ? 3 : Math.max(2, (width - left - right) / 90));
  const yticks = upright(options);
  const grid = (value, path) => `<path class="grid${value === 0 ? " zero" : ""}" d="${path}"/>`;
  let lastRight = -Infinity;
  for (const [value, text] of xticks) {
    const at = px(value).toFixed(1);
    out.push(grid(value, `M${at} ${top}V${height - bottom}`));
    const half = widest([text], options.small ? 10.5 : 12) / 2;
    if (at - half < lastRight + 4) continue;  // labels must not touch
    lastRight = Number(at) + half;
    out.push(`<text class="tick" x="${at}" y="${height - bottom + (options.small ? 12 : 16)}" text-anchor="middle">${esc(text)}</text>`);
  }
  for (const [value, text] of yticks) {
    const at = py(value).toFixed(1);
    out.push(grid(value, `M${left} ${at}H${width - right}`));
    out.push(`<text class="tick" x="${left - 5}" y="${at}" dy="0.35em" text-anchor="end">${esc(text)}</text>`);
  }
  out.push(`<rect class="frame" x="${left}" y="${top}" width="${width - left - right}" height="${height - top - bottom}"/>`);
  if (options.band) {
    const { x: at, lower, upper } = options.band;
    const inside = (v) => Math.min(Math.max(v, y.range[0]), y.range[1]);
    const edge = (values) => at.map((v, i) => `${px(v).toFixed(1)} ${py(inside(values[i])).toFixed(1)}`);
    if (at.length > 1) out.push(`<path class="band" d="M${[...edge(upper), ...edge(lower).reverse()].join("L")}Z"/>`);
  }
  for (const s of options.series) {
    const n = Math.min(s.x.length, s.y.length);
    const stride = s.limit ? Math.max(1, Math.floor(n / s.limit)) : 1;
    let path = "";
    let pen = false;
    for (let i = 0; i < n; i += stride) {
      if (!isNumber(s.x[i]) || !isNumber(s.y[i]) || (x.log && s.x[i] <= 0) || (y.log && s.y[i] <= 0)) {
        pen = false;
        continue;
      }
      const h = px(s.x[i]).toFixed(1);
      const v = py(s.y[i]).toFixed(1);
      if (s.dots) out.push(`<circle class="dot" cx="${h}" cy="${v}" r="3"/>`);
      path += !pen ? `M${h} ${v}` : s.step ? `H${h}V${v}` : `L${h} ${v}`;
      pen = true;
    }
    out.push(`<path class="curve ${s.cls || ""}" ${s.color ? `style="stroke:${s.color}"` : ""} ${s.dash ? `stroke-dasharray="${s.dash}"` : ""} d="${path}"/>`);
  }
  const labelled = options.series.filter((s) => s.label && s.y.length);
  if (labelled.length) {
    // Labels stand beside the ends of their lines and are pushed apart where the lines end together.
    const spots = labelled.map((s) => ({ s, want: py(s.y[s.y.length - 1]), x: px(s.x[s.x.length - 1]) }));
    spots.sort((a, b) => a.want - b.want);
    const step = 15;
    spots.forEach((spot, i) => { spot.at = i === 0 ? Math.max(spot.want, top + 6) : Math.max(spot.want, spots[i - 1].at + step); });
    for (let i = spots.length - 1, floor = height - bottom - 2; i >= 0; --i) {
      spots[i].at = Math.min(spots[i].at, floor);
      floor = spots[i].at - step;
    }
    for (const { s, want, x: end, at } of spots) {
      const color = s.color || "currentColor";
      out.push(`<path style="stroke:${color}" fill="none" stroke-width="0.8" stroke-dasharray="2 2" d="M${(end + 2).toFixed(1)} ${want.toFixed(1)}L${width - right + 3} ${want.toFixed(1)}L${width - right + 10} ${at.toFixed(1)}"/>`);
      out.push(`<text x="${width - right + 13}" y="${at.toFixed(1)}" dy="0.35em" style="fill:${color};font-weight:${s.cls === "chosen" ? 700 : 500}">${esc(s.label)}</text>`);
    }
  }
  if (options.small) {
    // Inside, where there is no room beside the labels.
    out.push(`<text class="over" x="${width - right - 4}" y="${height - bottom - 5}" text-anchor="end">${esc(x.label)}</text>`);
    out.push(`<text class="over" x="${left + 4}" y="${top + 11}">${esc(y.label)}</text>`);
  } else {
    out.push(`<text x="${(left + width - right) / 2}" y="${height - 4}" text-anchor="middle">${esc(x.label)}</text>`);
    out.push(`<text transform="translate(13 ${(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">${esc(y.label)}</text>`);
  }
  out.push("</svg>");
  return out.join("");
}

return { font, widest, whole, half, axisWidth, svgNode, extent, padded, margins, chart };
})();
