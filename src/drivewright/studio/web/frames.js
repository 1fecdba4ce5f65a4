// One drawing a frame: what comes in between would be computed for nothing, and the frame after it would have none.

/** `take(message)` shows what the page is called with, at most once a frame; of those that come meanwhile the newest is next. */
export function createPace(take) {
  let shown = false, next = null;
  return function pace(message) {
    if (shown) { next = message; return; }
    shown = true;
    take(message);
    requestAnimationFrame(() => {
      const waiting = next;
      shown = false; next = null;
      if (waiting) pace(waiting);
    });
  };
}
