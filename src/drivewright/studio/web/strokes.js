// Strokes, colours and texts on a canvas.

/** Colour 0..1 along a scale of five. */
export function shade(scale, part) {
  const at = Math.min(Math.max(part, 0), 1) * (scale.length - 1), n = Math.min(Math.floor(at), scale.length - 2), f = at - n;
  const pair = [scale[n], scale[n + 1]].map(hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16)));
  return `rgb(${[0, 1, 2].map(k => Math.round(pair[0][k] + f * (pair[1][k] - pair[0][k]))).join(" ")})`;
}

/** A text that is too wide loses its middle words, not its unit. */
export function shortened(context, text, wide) {
  const [, words, unit] = text.match(/^(.*?)(\s\[[^\]]*\])?$/);
  let shown = words;
  while (shown.length > 4 && context.measureText(`${shown}…${unit || ""}`).width > wide) shown = shown.slice(0, -1).trimEnd();
  return context.measureText(text).width > wide ? `${shown}…${unit || ""}` : text;
}

/** Begins a path that is a circle. */
export function circle(context, x, y, radius) { context.beginPath(); context.arc(x, y, radius, 0, 2 * Math.PI); }

/** A line as thin as it can be. */
export function rule(context, x0, y0, x1, y1) {
  context.beginPath();
  context.moveTo(Math.round(x0) + 0.5, Math.round(y0) + 0.5); context.lineTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
  context.stroke();
}

/** A cross with a ring. */
export function cross(context, x, y, colour) {
  context.strokeStyle = colour; context.lineWidth = 2;
  circle(context, x, y, 6);
  for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) { context.moveTo(x + 3 * dx, y + 3 * dy); context.lineTo(x + 12 * dx, y + 12 * dy); }
  context.stroke();
}
