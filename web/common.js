// What the scripts of the pages share: numbers as text, elements, ticks.
const common = (function () {
"use strict";

const root = document.documentElement;

const isNumber = (v) => typeof v === "number" && Number.isFinite(v);

function superscript(n) {
  return String(n).replace(/[-\d]/g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]));
}

function fmt(v, digits = 4) {
  if (!isNumber(v)) return "–";
  if (v === 0) return "0";
  const [mantissa, exponent] = v.toExponential(digits - 1).split("e");
  const e = Number(exponent);
  const text = e >= -4 && e < 6 ? v.toFixed(Math.max(0, digits - 1 - e)) : `${mantissa} × 10${superscript(e)}`;
  return text.replace("-", "−");
}

// The two ends of an interval, with as many more digits as tell them apart.
function fmtEnds(low, high, digits) {
  if (!isNumber(low) || !isNumber(high)) return [fmt(low, digits), fmt(high, digits)];
  while (low < high && digits < 17 && fmt(low, digits) === fmt(high, digits)) ++digits;
  return [fmt(low, digits), fmt(high, digits)];
}

const esc = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);

function el(tag, attributes, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child !== null && child !== undefined && child !== "") node.append(child);
  }
  return node;
}

function section(id, title, ...children) {
  return el("section", { id, "aria-labelledby": `${id}-title` }, el("h2", { id: `${id}-title` }, title), ...children);
}

// Decimals that show a step exactly: 0 for 5, 1 for 2.5, 2 for 0.01.
function decimalsOf(step) {
  let decimals = 0;
  while (decimals < 10 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6 * step * 10 ** decimals) ++decimals;
  return decimals;
}

// A value on an axis with such steps: as many digits as tell it from its neighbours.
function tickText(value, step) {
  const plain = Math.abs(value) < 1e6 && step >= 1e-4;
  if (plain) return value.toFixed(decimalsOf(step)).replace(/^-(?=.*[1-9])/, "−").replace(/^-/, "");
  if (Math.abs(value) < 1e-9 * step) return "0";
  const power = (v) => Math.floor(Math.log10(v) + 1e-9);
  const halves = Math.abs(step / 10 ** power(step) - 2.5) < 1e-6 ? 1 : 0;
  return fmt(value, Math.max(1, power(Math.abs(value)) - power(step) + 1 + halves));
}

function linearTicks(lo, hi, wanted) {
  // A range that is only rounding of one number has no steps: counting them would not end.
  if (!(hi - lo > 1e-12 * Math.max(Math.abs(lo), Math.abs(hi)))) return [[lo, fmt(lo, 4)]];
  const raw = (hi - lo) / Math.max(1, wanted);
  const power = 10 ** Math.floor(Math.log10(raw));
  const steps = [1, 2, 5, 10].map((s) => s * power);
  const ticksOf = (s) => Math.floor(hi / s + 1e-9) - Math.ceil(lo / s - 1e-9) + 1;
  let k = steps.findIndex((s) => s >= raw * 0.999);
  while (k > 0 && ticksOf(steps[k]) < 2) --k;  // one tick alone gives no scale
  const step = steps[k];
  const ticks = [];
  for (let i = Math.ceil(lo / step - 1e-9); i * step <= hi + step * 1e-9; ++i) {
    const value = i * step;
    ticks.push([value, tickText(value, step)]);
  }
  return ticks;
}

// Pairs of value and label.
function logTicks(lo, hi) {
  const decades = Math.log10(hi / lo);
  const factors = decades < 1.2 ? [1, 2, 3, 5, 7] : decades < 3 ? [1, 2, 5] : [1];
  const ticks = [];
  for (let e = Math.floor(Math.log10(lo)) - 1; e <= Math.log10(hi); ++e) {
    for (const f of factors) {
      const value = f * 10 ** e;
      if (value < lo * 0.9999 || value > hi * 1.0001) continue;
      const plain = e >= -3 && e < 6;
      ticks.push([value, plain ? String(Number(value.toPrecision(2))) : (f === 1 ? "" : `${f}·`) + `10${superscript(e)}`]);
    }
  }
  return ticks.length > 1 ? ticks : linearTicks(lo, hi, 4);
}

const css = (name) => getComputedStyle(root).getPropertyValue(name).trim();

return { root, isNumber, superscript, fmt, fmtEnds, esc, el, section, css, tickText, linearTicks, logTicks };
})();
