// What the page knows, once, and who wants to hear of it.

/** A store over plain keys: `state`, `set({key: value})`, `on(["key"], fn)`; fn(state) is called at once and after each change of a key. */
export function createStore(state) {
  const listeners = new Set();
  /** A part of the page that fails is reported, and the others hear of the change nevertheless. */
  function tell({fn}) { try { fn(state); } catch (error) { reportError(error); } }
  return {
    state,
    set(patch) {
      const changed = Object.keys(patch).filter(key => state[key] !== patch[key]);
      if (!changed.length) return;
      Object.assign(state, patch);
      for (const listener of [...listeners]) if (listener.keys.some(key => changed.includes(key))) tell(listener);
    },
    on(keys, fn) {
      const listener = {keys, fn};
      listeners.add(listener);
      fn(state);
      return () => listeners.delete(listener);
    },
  };
}
