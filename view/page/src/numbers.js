// Numbers as text.

export function number(x, digits = 5) {
  if (x === null || x === undefined || Number.isNaN(x)) return "not determined";
  if (!Number.isFinite(x)) return "not known";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size < 1e-3 || size >= 1e5) return scientific(x, digits);
  return (size >= 10 ** digits ? x.toFixed(0) : x.toPrecision(digits)).replace("-", "\u2212");
}
function scientific(x, digits) {
  const [mantissa, power] = x.toExponential(digits - 1).split("e"), lead = mantissa.replace("-", "\u2212");
  const ten = "10" + (power.startsWith("-") ? "\u207b" : "") + raised(power.slice(1));
  return /^1(\.0*)?$/.test(lead) ? ten : `${lead}\u00b7${ten}`;
}
// Without zeros behind: marks of an axis, what a scale stands for.
export function short(x) {
  const size = Math.abs(x);
  if (x !== 0 && (size < 1e-3 || size >= 1e5)) {
    const [mantissa, power] = x.toExponential(3).split("e");
    return scientific(x, Math.max(1, String(Number(mantissa)).replace(/[-.]/g, "").length));
  }
  return String(Number(x.toPrecision(6))).replace("-", "\u2212");
}
function raised(digits) {
  return [...digits].map((d) => "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[d]).join("");
}

// As many digits as the error leaves, and one more.
export function digitsFor(value, error, most) {
  if (!(error > 0) || !Number.isFinite(error) || !(Math.abs(value) > 0)) return Math.min(7, most);
  return Math.max(2, Math.min(most, Math.ceil(Math.log10(Math.abs(value) / error)) + 2));
}
export function withError(value, error, unit, most) {
  if (Number.isNaN(value)) return "not determined";
  const behind = unit ? " " + unit : "";
  if (error === undefined) return number(value, Math.min(7, most)) + behind;
  if (!Number.isFinite(error)) return number(value, Math.min(7, most)) + behind + ", error not known";
  return `${number(value, digitsFor(value, error, most))} \u00b1 ${number(error, 2)}${behind}`;
}

// 1, 2 or 5 times a power of ten, not above x.
export function roundDown(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  const lead = x / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}
