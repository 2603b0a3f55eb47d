// Critical difference diagram of a study: mean ranks, solvers that are not told apart joined by bars.
const ranks = (function () {
"use strict";

const { fmt, esc } = common;
const { widest } = charts;

const bar = (path, width) => `<path d="${path}" style="stroke:var(--ink);stroke-width:${width};fill:none;stroke-linecap:round"/>`;
const label = (row) => `${row.name} (${row.mean_rank.toFixed(2)})`;

function axis(px, k, y) {
  // Every rank has its mark, as many have their number as there is room for.
  const stride = Math.ceil(22 / Math.max(1, Math.abs(px(2) - px(1))));
  const out = [`<path class="frame" d="M${px(1)} ${y}H${px(k)}"/>`];
  for (let r = 1; r <= k; ++r) {
    out.push(`<path class="frame" d="M${px(r)} ${y - 5}V${y}"/>`);
    if ((r - 1) % stride === 0) out.push(`<text class="tick" x="${px(r)}" y="${y - 9}" text-anchor="middle">${r}</text>`);
  }
  return out;
}

function scale(px, k, difference) {
  if (!(difference > 0 && difference < k - 1)) return [];
  const end = px(1 + difference);
  const words = `critical difference ${fmt(difference, 3)}`;
  return [`<path d="M${px(1)} 20H${end}M${px(1)} 16V24M${end} 16V24" style="stroke:var(--ink);fill:none;stroke-width:1.5"/>`,
    end + 8 + widest([words]) < px(k) ? `<text x="${end + 6}" y="24">${esc(words)}</text>` : `<text x="${px(1)}" y="11">${esc(words)}</text>`];
}

// Names to both sides, lines from them up to the axis.
function sideways(rows, cliques, difference, width, color) {
  const k = rows.length;
  const side = Math.ceil(widest(rows.map(label))) + 38;
  const top = 54;
  const step = 19;
  const half = Math.ceil(k / 2);
  const barTop = top + 14;
  const textTop = barTop + cliques.length * 9 + 18;
  const px = (rank) => side + ((rank - 1) / (k - 1)) * (width - 2 * side);
  const out = [...axis(px, k, top), ...scale(px, k, difference)];
  cliques.forEach(([a, b], i) => out.push(bar(`M${px(rows[a].mean_rank) - 4} ${barTop + i * 9}H${px(rows[b].mean_rank) + 4}`, 4.5)));
  rows.forEach((row, i) => {
    const left = i < half;
    const y = textTop + (left ? i : k - 1 - i) * step;
    const end = left ? side - 24 : width - side + 24;
    out.push(`<path d="M${px(row.mean_rank)} ${top}V${y}H${end}" style="stroke:${color(row.solver)};fill:none;stroke-width:1.3"/>`);
    out.push(`<text x="${left ? end - 6 : end + 6}" y="${y}" dy="0.35em" text-anchor="${left ? "end" : "start"}">${esc(label(row))}</text>`);
  });
  return [out, textTop + half * step + 8];
}

// A row a solver, the best on top; bars stand upright on the left.
function stacked(rows, cliques, difference, width, color) {
  const k = rows.length;
  const top = 54;
  const step = 34;
  const left = 12 + cliques.length * 9;
  const right = 12;
  const px = (rank) => left + 8 + ((rank - 1) / (k - 1)) * (width - left - 8 - right);
  const at = (i) => top + 34 + i * step;
  const out = [...axis(px, k, top), ...scale(px, k, difference)];
  cliques.forEach(([a, b], i) => out.push(bar(`M${8 + i * 9} ${at(a) - 4}V${at(b) + 4}`, 4.5)));
  rows.forEach((row, i) => {
    out.push(`<text x="${left + 2}" y="${at(i) - 9}">${esc(label(row))}</text>`);
    out.push(`<path d="M${px(1)} ${at(i)}H${px(k)}" class="grid"/><path d="M${px(1)} ${at(i)}H${px(row.mean_rank)}" style="stroke:${color(row.solver)};fill:none;stroke-width:1.6"/>`);
    out.push(`<circle cx="${px(row.mean_rank)}" cy="${at(i)}" r="4.5" style="fill:${color(row.solver)}"/>`);
  });
  return [out, at(k - 1) + 14];
}

// rows: [{name, solver, mean_rank}], the best first; `cliques` pairs of first and last row; color(solver).
function diagram(rows, cliques, difference, width, color) {
  // Beside the names an axis of half the width must be left.
  const wide = 4 * (widest(rows.map(label)) + 38) <= width;
  const [out, height] = (wide ? sideways : stacked)(rows, cliques, difference, width, color);
  return `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="Mean ranks; solvers joined by a bar are not told apart">${out.join("")}</svg>`;
}

return { diagram };
})();
