// Map of the correlations of parameters, on the pages of fits and of studies.
const correlation = (function () {
"use strict";

const { esc } = common;
const { svgNode, widest } = charts;

// `values` of the whole matrix, of which the lower triangle is drawn; two decimals, a leading zero left out.
function map(names, values) {
  const cell = 38;
  const top = 8;
  const size = names.length * cell;
  const label = widest(names);
  const left = Math.ceil(label) + 14;
  // Names below stand at 45 degrees and end at their columns.
  const reach = Math.ceil(label * Math.SQRT1_2);
  const start = Math.max(left, reach - cell / 2 + 8);
  const [width, height] = [start + size + 8, top + size + reach + 20];
  const out = [`<svg class="map" viewBox="0 0 ${width} ${height}" style="max-width:${width}px;min-width:${Math.round(0.82 * width)}px" role="img" aria-label="Correlations of the parameters">`];
  values.forEach((row, i) => {
    const y = top + i * cell;
    out.push(`<text x="${start - 6}" y="${y + cell / 2}" dy="0.35em" text-anchor="end">${esc(names[i])}</text>`);
    row.slice(0, i + 1).forEach((value, j) => {
      const x = start + j * cell;
      const filled = i === j ? 'class="box"' : `class="cell ${value < 0 ? "below" : "above"}" fill-opacity="${(0.75 * Math.min(1, Math.abs(value))).toFixed(3)}"`;
      const text = Math.abs(value) < 0.005 ? "0" : value.toFixed(2).replace("0.", ".").replace("-", "−");
      out.push(`<rect ${filled} x="${x + 1}" y="${y + 1}" width="${cell - 2}" height="${cell - 2}"><title>${esc(names[i])} and ${esc(names[j])}: ${value.toFixed(4)}</title></rect>`);
      if (i !== j) out.push(`<text class="number" x="${x + cell / 2}" y="${y + cell / 2}" dy="0.35em" text-anchor="middle">${text}</text>`);
    });
    out.push(`<text transform="translate(${start + (i + 0.5) * cell} ${top + size + 10}) rotate(-45)" text-anchor="end">${esc(names[i])}</text>`);
  });
  out.push("</svg>");
  return svgNode(out.join(""));
}

return { map };
})();
