// Numbers as people type them and read them.

const TYPED = /^\s*([-+−]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)\s*(.*?)\s*$/i;
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** [number, unit] of a typed text as "60 rpm", or null. */
export function quantityOf(text) {
  const found = TYPED.exec(text);
  return found && [Number(found[1].replace("−", "-")), found[2]];
}

/** The number of a text as results have it: "−1.25×10⁻³ mm", "12 500". */
export function numberOf(text) {
  const [, mantissa, power] = text.replace(/[\u202f,]/g, "").replaceAll("−", "-").match(/^([+-]?[\d.]+)(?:×10(\S+?))?(?![\d.])/) || [];
  const exponent = [...power || ""].map(c => RAISED.includes(c) ? RAISED.indexOf(c) : c === "⁻" ? "-" : "").join("");
  return mantissa === undefined ? NaN : Number(mantissa) * 10 ** Number(exponent);
}

/** Decimals that a multiple of `step` needs. */
export const decimals = step => Math.min(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), 12);

/** "60 rpm", as it is typed into a box. */
export const withUnit = (number, unit) => unit ? `${number} ${unit}` : String(number);

const POWERS = {"^2": "²", "^3": "³", "^-1": "⁻¹", "^-2": "⁻²", "^-3": "⁻³"}, TYPED_POWERS = Object.fromEntries(Object.entries(POWERS).map(([a, b]) => [b, a]));

/** A typed quantity as it is read: "3 kg m^2" is "3 kg·m²". */
export const unitsRead = text => text.replace(/\^-?[23](?!\d)|\^-1(?!\d)/g, power => POWERS[power] || power).replace(/(?<=[A-Za-zµ²³]) (?=[A-Za-zµ])/g, "·");

/** A quantity that is too long for a box, "36.62853743027 mm", to six digits. */
export function shortened(text, room) {
  const found = text.length > room && quantityOf(text), short = found && withUnit(Number(found[0].toPrecision(6)), found[1]);
  return short && short.length < text.length ? short : text;
}

/** And back, as a spec has it. */
export const unitsTyped = text => text.replace(/⁻?[¹²³]/g, power => TYPED_POWERS[power] || power).replace(/\s*·\s*/g, " ");

/** What stands behind a number that is shown. */
export const unitText = unit => !unit || unit === "-" ? "" : unit === "deg" ? "°" : unit.startsWith("°") ? unit : `\u00a0${unit}`;

/** A result with its interval, "10.2 (8.1 to 12.4) mm"; `low` is "" where it says nothing. */
export const withInterval = ({shown, number, low, high, unit}, t) => low ? `${t("* (* to *)", number, low, high)}${unitText(unit)}` : shown;

/** The number of the design compared with, and how far this one is from it, as the server tells it. */
export const withDifference = (text, difference) => difference ? `${text} · ${difference}` : text;

/** A number with the digits that an interval [low, high] supports: to the second digit of half its width, five at most. */
export function supported(value, [low, high]) {
  const half = (high - low) / 2, place = half > 0 ? Math.floor(Math.log10(Number(half.toPrecision(2)))) - 1 : -Infinity;
  const digits = value === 0 ? 1 : Math.floor(Math.log10(Math.abs(value))) - place + 1;
  return digits < 1 ? "0" : figure(value, Math.min(digits, 5));
}

/** How the interval of a result was made, "95 %, ensemble"; "" where it has none. */
export const intervalHint = ({interval}, t) => interval ? t("95 % interval: *", t(interval)) : "";

/** A number with its power of ten: "1.5e−7". */
export const powered = (value, places) => value.toExponential(places).replace("e+", "e").replace(/-/g, "−");

/** A number to so many digits, with its power of ten where it is very large or small. */
export function figure(value, digits = 4) {
  if (value !== 0 && (Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4)) return powered(value, digits - 1);
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}
