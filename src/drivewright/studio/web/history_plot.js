// The course of a search: the best value so far over the designs tried, with axes and units.

import { powered, unitText } from "./numbers.js";
import { element, fixed } from "./player.js";
import { ticks } from "./plotting.js";
import { svgPart } from "./svg_parts.js";

const WIDE = 268, HIGH = 158, LEFT = 46, RIGHT = 8, TOP = 8, BOTTOM = 34;

const numberText = (value, decimals) => Math.abs(value) >= 1e5 || decimals > 5 ? powered(value, 1) : fixed(value, decimals);

/**
 * A stair over `history` [[number of designs, best value or null, violation]]; before a design meets the requirements, how far the best is
 * from them.  `objective` is {label, unit}, `total` the designs that the search tries at most.
 */
export function historyPlot(history, {label, unit}, t, total = 0) {
  const met = history.some(([, value]) => value !== null), points = history.map(([n, value, violation]) => [n, met ? value : violation]).filter(([, value]) => value !== null);
  const last = Math.max(history[history.length - 1][0], total, 1), values = points.map(([, value]) => value);
  const width = Math.max(...values) - Math.min(...values) || Math.abs(values[0]) * 0.1 || 1;
  const low = Math.min(...values) - 0.06 * width, high = Math.max(...values) + 0.06 * width;
  const x = n => LEFT + n / last * (WIDE - LEFT - RIGHT), y = value => TOP + (high - value) / (high - low) * (HIGH - TOP - BOTTOM);
  const sign = unitText(met ? unit : "").trim(), name = met ? t(label) : t("violation of the requirements"), title = sign ? `${name} [${sign}]` : name;
  const made = svgPart("svg", {viewBox: `0 0 ${WIDE} ${HIGH}`, class: "hp", role: "img", "aria-label": `${t("Best value over the designs tried")}: ${title}`, "data-testid": "history"});
  const up = ticks(low, high, 3, sign), across = ticks(0, last, 3, "");
  for (const value of up.values) made.append(svgPart("path", {class: "hp-grid", d: `M${LEFT} ${y(value).toFixed(1)}H${WIDE - RIGHT}`}),
    svgPart("text", {x: LEFT - 5, y: y(value).toFixed(1), class: "hp-up"}, numberText(value, up.decimals)));
  for (const value of across.values) made.append(svgPart("text", {x: x(value).toFixed(1), y: HIGH - BOTTOM + 13, class: "hp-across"}, numberText(value, 0)));
  const stair = points.map(([n, value], k) => k ? `H${x(n).toFixed(1)}V${y(value).toFixed(1)}` : `M${x(n).toFixed(1)} ${y(value).toFixed(1)}`).join("");
  made.append(svgPart("path", {class: "hp-frame", d: `M${LEFT} ${TOP}V${HIGH - BOTTOM}H${WIDE - RIGHT}`}),
    svgPart("path", {class: "hp-line", d: `${stair}H${x(history[history.length - 1][0]).toFixed(1)}`}),
    svgPart("text", {x: (LEFT + WIDE - RIGHT) / 2, y: HIGH - 4, class: "hp-across"}, t("designs tried")));
  return element("figure", {class: "hp-figure"}, element("figcaption", {}, title), made);
}
