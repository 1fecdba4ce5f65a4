// A plot as a file: SVG for paper, CSV of its numbers.

import { element, useFont } from "./player.js";
import { layout, paintPanel } from "./plotting.js";

const SIZE = {width: 720, height: 400}, HEAD = 46, ROW = 18, DIGITS = 7;  // px; digits of a float32
const ROLES = ["surface", "line", "grid", "grid-strong", "ink", "muted", "bad", "raised", "steel", "blue", "orange", "green", "violet", "run-1", "run-2", "run-3", "run-4"];
const ALIGN = {left: "start", center: "middle", right: "end"}, SHIFT = {top: 0.8, middle: 0.35, bottom: -0.2};

const escaped = text => String(text).replace(/[&<>"]/g, sign => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", "\"": "&quot;"})[sign]);
const short = number => +number.toFixed(2);

/** The light colours of the page, whatever its theme: a file is read on paper. */
function paperColours() {
  const rules = [...document.styleSheets].flatMap(sheet => [...sheet.cssRules]).filter(rule => rule.selectorText === ":root");
  const value = role => rules.map(rule => rule.style.getPropertyValue(`--${role}`).trim()).find(Boolean) || "#777";
  return Object.fromEntries(ROLES.map(role => [role, value(role)]));
}

/** As much of a canvas as paintPanel uses; `parts` are the elements drawn so far. */
function createSvgContext() {
  const parts = [], ruler = document.createElement("canvas").getContext("2d");
  let path = "", dash = [], clips = 0, open = 0;
  const context = {
    strokeStyle: "#000", fillStyle: "#000", lineWidth: 1, globalAlpha: 1, font: "11px sans-serif", textAlign: "left", textBaseline: "top", lineJoin: "round", parts,
    beginPath() { path = ""; },
    moveTo(x, y) { path += `M${short(x)} ${short(y)}`; },
    lineTo(x, y) { path += `${path ? "L" : "M"}${short(x)} ${short(y)}`; },
    rect(x, y, w, h) { path += `M${short(x)} ${short(y)}h${short(w)}v${short(h)}h${short(-w)}Z`; },
    arc(x, y, r) { path += `M${short(x - r)} ${short(y)}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0Z`; },
    stroke() {
      if (path) parts.push(`<path d="${path}" fill="none" stroke="${context.strokeStyle}" stroke-width="${context.lineWidth}"${dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : ""}${alpha()}/>`);
    },
    fill() { if (path) parts.push(`<path d="${path}" fill="${context.fillStyle}"${alpha()}/>`); },
    fillRect(x, y, w, h) { parts.push(`<rect x="${short(x)}" y="${short(y)}" width="${short(w)}" height="${short(h)}" fill="${context.fillStyle}"${alpha()}/>`); },
    fillText(text, x, y) {
      const size = parseFloat(context.font.match(/[\d.]+(?=px)/)), shift = (SHIFT[context.textBaseline] ?? 0) * size;
      parts.push(`<text x="${short(x)}" y="${short(y + shift)}" font-size="${size}" text-anchor="${ALIGN[context.textAlign]}"${context.font.includes("600") ? ' font-weight="600"' : ""} fill="${context.fillStyle}"${alpha()}>${escaped(text)}</text>`);
    },
    measureText(text) { ruler.font = context.font; return ruler.measureText(text); },
    setLineDash(list) { dash = list; },
    save() {}, restore() { while (open) { parts.push("</g>"); open--; } },
    clip() { clips++; open++; parts.push(`<clipPath id="clip${clips}"><path d="${path}"/></clipPath><g clip-path="url(#clip${clips})">`); },
  };
  const alpha = () => context.globalAlpha < 1 ? ` opacity="${context.globalAlpha}"` : "";
  return context;
}

/** A panel as the text of an SVG file: title, axes with units, a legend of its lines and of the runs behind. */
export function svgText({panel, axis, behind}, design) {
  const colours = paperColours(), context = createSvgContext(), entries = legend({panel, behind});
  const head = HEAD + ROW * Math.ceil(entries.length / 3), margin = {left: 62, right: 20, top: head, bottom: 40}, height = SIZE.height + head;
  context.fillStyle = colours.surface; context.fillRect(0, 0, SIZE.width, height);
  context.textBaseline = "top"; context.fillStyle = colours.ink; useFont(context, "600 15px sans-serif");
  context.fillText(panel.title, margin.left, 10);
  useFont(context, "11px sans-serif"); context.fillStyle = colours.muted; context.textAlign = "right";
  context.fillText(design || "", SIZE.width - margin.right, 13);
  context.textAlign = "left";
  entries.forEach(([role, dash, label], n) => {
    const x = margin.left + (n % 3) * (SIZE.width - margin.left - margin.right) / 3, y = 34 + ROW * Math.floor(n / 3);
    context.strokeStyle = colours[role]; context.lineWidth = 2; context.setLineDash(dash);
    context.beginPath(); context.moveTo(x, y + 6); context.lineTo(x + 22, y + 6); context.stroke();
    context.setLineDash([]);
    context.fillStyle = colours.ink; context.fillText(label, x + 28, y);
  });
  paintPanel(context, panel, axis, behind, layout(panel, axis, behind, {width: SIZE.width, height, margin}), colours);
  return `<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" width="${SIZE.width}" height="${height}" viewBox="0 0 ${SIZE.width} ${height}" `
    + `font-family="system-ui, Arial, 'Noto Sans CJK SC', sans-serif">\n<title>${escaped(panel.title)}</title>\n${context.parts.join("\n")}\n</svg>\n`;
}

const named = (label, unit) => `${label}${unit ? ` [${unit}]` : ""}`;

/** [role, dashes, words] of every line: those of the panel, then those of each run. */
function legend({panel, behind}) {
  const own = panel.series.map(line => [line.role, line.dashed ? [5, 3] : [], named(line.label, line.unit)]);
  return [...own, ...behind.filter(run => run.lines.some(Boolean)).map(run => [run.colour, run.dash, run.name || "–"])];
}

/** A panel as comma-separated columns with their units; a line over places of its own has a column for them. */
export function csvText({panel, axis, behind}) {
  const place = u => axis.names ? axis.names[u] ?? "" : axis.start + u * axis.scale, x = named(axis.label, axis.unit), columns = [];
  const add = (head, values, read = value => value) => columns.push([head, Array.from(values, read)]);
  add(x, panel.u, place);
  for (const line of panel.series) {
    if (line.x) add(named(`${axis.label}, ${line.label}`, axis.unit), line.x, place);
    add(named(line.label, line.unit), line.values);
    if (line.ends.length) line.ends.forEach((end, n) => add(named(`${line.label}, ${n ? "high" : "low"}`, line.unit), end));
  }
  for (const run of behind) panel.series.forEach((line, n) => {
    if (!run.lines[n]) return;
    add(named(`${axis.label} · ${run.name}`, axis.unit), run.lines[n].u, place);
    add(named(`${line.label} · ${run.name}`, line.unit), run.lines[n].values);
  });
  const cell = value => typeof value === "number" ? (Number.isFinite(value) ? String(+value.toPrecision(DIGITS)) : "") : `"${String(value ?? "").replace(/"/g, '""')}"`;
  const rows = Array.from({length: Math.max(...columns.map(([, values]) => values.length))}, (_, n) => columns.map(([, values]) => n < values.length ? cell(values[n]) : "").join(","));
  return `${[columns.map(([head]) => cell(head)).join(","), ...rows].join("\r\n")}\r\n`;
}

/** A text as a file of the reader. */
export function saveText(name, type, text) {
  const url = URL.createObjectURL(new Blob([text], {type: `${type};charset=utf-8`})), link = element("a", {href: url, download: name.replace(/[^\w.-]+/g, "_")});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}
