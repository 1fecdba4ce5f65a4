// What a test looks for in a page as it stands: controls that cannot be reached, panels and texts that lie over each other or are cut off,
// and colours that do not stand out.  Each function gives a list of sentences, empty where nothing is wrong.
(() => {
  const CONTROLS = 'button, input, select, textarea, summary, a[href], [tabindex]';
  const LEAST = 24;  // px of a target for a finger
  // A handle lies where its point is, which may be under another one.  The canvas of the drawing and lists that scroll carry others.
  const CARRIERS = '.hd, .sd-scroll, .dw-canvas, .mf-layer > *, [type=file], .dw-mark, .so-face';

  const name = node => node.dataset?.testid || node.getAttribute?.('aria-label') || `${node.tagName.toLowerCase()}.${String(node.className.baseVal ?? node.className).replace(/ /g, '.')}`;
  const rendered = node => node.checkVisibility({visibilityProperty: true, opacityProperty: true}) && node.getClientRects().length > 0;
  const inScope = (node, scope) => !scope || node.closest(scope);
  const lessThan = (a, b) => a < b - 0.5;

  /** The box that a finger may hit: a label stands for its box. */
  function target(node) {
    const own = node.closest('label'), label = own?.control === node && node.type !== 'range' ? own : null;
    const boxes = [node.getBoundingClientRect(), ...(label ? [label.getBoundingClientRect()] : [])];
    return {width: Math.max(...boxes.map(box => box.width)), height: Math.max(...boxes.map(box => box.height))};
  }

  /** Controls that something covers, that leave the window, or that are too small for a finger where `touch`. */
  function controls(scope, touch) {
    const wrong = [];
    for (const node of document.querySelectorAll(CONTROLS)) {
      if (!rendered(node) || node.disabled || !inScope(node, scope) || node.matches(CARRIERS)) continue;
      node.scrollIntoView({block: 'center', inline: 'center', behavior: 'instant'});
      const box = node.getBoundingClientRect(), x = box.x + box.width / 2, y = box.y + box.height / 2, hit = document.elementFromPoint(x, y);
      if (!hit || !(node === hit || node.contains(hit) || hit.closest('label')?.contains(node))) wrong.push(`${name(node)} is covered by ${hit ? name(hit) : 'the edge'} at ${x | 0},${y | 0}`);
      if (box.left < -0.5 || lessThan(innerWidth, box.right) && box.width < innerWidth) wrong.push(`${name(node)} leaves the window: ${box.left | 0} ... ${box.right | 0}`);
      const {width, height} = target(node);
      if (touch && (lessThan(width, LEAST) || lessThan(height, LEAST))) wrong.push(`${name(node)} is ${width.toFixed(0)} x ${height.toFixed(0)}`);
    }
    return wrong;
  }

  /** The part of a node's box that what scrolls around it leaves to be seen. */
  function seen(node) {
    let {left, top, right, bottom} = node.getBoundingClientRect();
    for (let up = node.parentElement; up; up = up.parentElement) {
      if (getComputedStyle(up).overflow === 'visible') continue;
      const box = up.getBoundingClientRect();
      left = Math.max(left, box.left); right = Math.min(right, box.right); top = Math.max(top, box.top); bottom = Math.min(bottom, box.bottom);
    }
    return {left, top, right, bottom};
  }
  /** Panels that lie over each other, and areas wider than their room. */
  function panels() {
    const PANELS = '.st > *, .dw-top, .dw-bar, .ms, .bd-panel, .so-bar, .so-cube-place, .so-name, .dg, .vw-tabs, .mf-bar, .mf-stage, .mf-status';
    const SCROLLING = '.st-bar, .st-panes, .st-scroll, .sd-scroll, .st-plots, .sd-exports, .dw-bar, .vw-tabs, .ms, .sf, .mf, .bt-list, .st-popover, .st-extra, .bt-scroll, .so-bar';
    const shown = [...document.querySelectorAll(PANELS)].filter(rendered), wrong = [];
    shown.forEach((one, n) => shown.slice(n + 1).forEach(other => {
      if (one.contains(other) || other.contains(one)) return;
      const a = seen(one), b = seen(other);
      const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (wide > 1 && high > 1) wrong.push(`${name(one)} and ${name(other)} lie over each other`);
    }));
    for (const one of [document.scrollingElement, ...document.querySelectorAll(SCROLLING)])
      if (one.scrollWidth > one.clientWidth + 1 && rendered(one) && !one.matches('[data-sideways]')) wrong.push(`${name(one)} is ${one.scrollWidth} in ${one.clientWidth}`);
    for (const one of document.querySelectorAll('.st > *')) {
      const box = one.getBoundingClientRect();
      if (rendered(one) && (lessThan(innerWidth, box.right) || lessThan(innerHeight, box.bottom))) wrong.push(`${name(one)} leaves the window`);
    }
    return wrong;
  }

  // ---- texts
  /** The visible texts: [{node, text}], node the element that a text stands in. */
  function texts(scope) {
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), found = [];
    for (let one = walker.nextNode(); one; one = walker.nextNode()) {
      const node = one.parentElement;
      if (!one.data.trim() || node.closest('script, style, option, noscript, .so-face') || !rendered(node) || !inScope(node, scope)) continue;
      found.push({node, one, text: one.data.trim()});
    }
    return found;
  }
  const clips = style => /hidden|clip/.test(style);
  const isShortened = node => { if (getComputedStyle(node).clipPath !== 'none') return true; for (let up = node; up && up !== document.body; up = up.parentElement) if (getComputedStyle(up).textOverflow === 'ellipsis' && clips(getComputedStyle(up).overflowX)) return true; return false; };

  /** Texts that something cuts off without saying so. */
  function cut(scope) {
    const wrong = [], range = document.createRange();
    for (const {node, one, text} of texts(scope)) {
      range.selectNodeContents(one);
      const box = range.getBoundingClientRect();
      if (!box.width || isShortened(node)) continue;
      for (let up = node; up && up !== document.documentElement; up = up.parentElement) {
        const style = getComputedStyle(up), edge = up.getBoundingClientRect();
        if (/auto|scroll/.test(style.overflowX) || /auto|scroll/.test(style.overflowY)) break;  // it can be scrolled to
        if (clips(style.overflowX) && (box.right > edge.right + 1.5 || box.left < edge.left - 1.5)) { wrong.push(`"${text.slice(0, 50)}" in ${name(node)} is cut off by ${name(up)}`); break; }
        if (clips(style.overflowY) && (box.bottom > edge.bottom + 3 || box.top < edge.top - 3)) { wrong.push(`"${text.slice(0, 50)}" in ${name(node)} is cut off below or above by ${name(up)}`); break; }
        if (style.position === 'fixed') break;
      }
    }
    for (const box of document.querySelectorAll('.st input[type=text], .st select')) {
      if (!rendered(box) || !inScope(box, scope) || box.matches('.st-link')) continue;
      if (box.tagName === 'INPUT' && box.scrollWidth > box.clientWidth + 1 && getComputedStyle(box).textOverflow !== 'ellipsis') wrong.push(`"${box.value}" does not fit ${name(box)}`);
    }
    return wrong;
  }

  // ---- colours
  const canvas = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  /** [r, g, b, alpha] of any colour of CSS. */
  const seenColours = new Map();
  function rgba(colour) {
    if (!seenColours.has(colour)) {
      canvas.clearRect(0, 0, 1, 1); canvas.fillStyle = '#000'; canvas.fillStyle = colour; canvas.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
      seenColours.set(colour, [r, g, b, a / 255]);
    }
    return seenColours.get(colour);
  }
  const over = ([r, g, b, a], [R, G, B]) => [r * a + R * (1 - a), g * a + G * (1 - a), b * a + B * (1 - a), 1];
  /** What is seen of a node's background, and how opaque the node is drawn upon it. */
  function ground(node) {
    const up = [];
    for (let one = node; one; one = one.parentElement) up.unshift(one);
    let colour = [255, 255, 255, 1];
    for (const one of up) {
      const style = getComputedStyle(one);
      colour = over(rgba(style.backgroundColor), colour);
    }
    return colour;
  }
  function opacity(node) { let all = 1; for (let one = node; one; one = one.parentElement) all *= Number(getComputedStyle(one).opacity); return all; }
  const light = ([r, g, b]) => [r, g, b].map(x => { const s = x / 255; return s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4; }).reduce((sum, x, n) => sum + x * [0.2126, 0.7152, 0.0722][n], 0);
  function ratio(colour, back) { const [a, b] = [light(colour), light(back)].sort((x, y) => y - x); return (a + 0.05) / (b + 0.05); }
  const isDisabled = node => node.closest(':disabled, [aria-disabled=true]') !== null;

  function contrast(scope) {
    const wrong = new Set();
    const look = (node, colour, least, what) => {
      const back = ground(node), [r, g, b, a] = rgba(colour), seen = over([r, g, b, a * opacity(node)], back), got = ratio(seen, back);
      if (got < least - 0.01) wrong.add(`${what} ${got.toFixed(2)} < ${least}: ${seen.slice(0, 3).map(x => x | 0)} on ${back.slice(0, 3).map(x => x | 0)}`);
    };
    const classOf = node => `${node.tagName.toLowerCase()}.${String(node.className.baseVal ?? node.className).replace(/ /g, '.')} in ${node.parentElement.className}`;
    for (const {node, text} of texts(scope)) {
      if (isDisabled(node)) continue;
      const style = getComputedStyle(node), size = parseFloat(style.fontSize), large = size >= 24 || size >= 18.66 && style.fontWeight >= 700;
      look(node, node.namespaceURI.endsWith('svg') ? style.fill : style.color, large ? 3 : 4.5, `"${text.slice(0, 30)}" ${classOf(node)}`);
    }
    for (const node of document.querySelectorAll('.st input[type=text], .st select, .st textarea'))
      if (rendered(node) && !isDisabled(node) && inScope(node, scope)) look(node, getComputedStyle(node).color, 4.5, `box ${classOf(node)}`);
    for (const node of document.querySelectorAll('.st button svg')) {
      if (!rendered(node) || isDisabled(node) || !inScope(node, scope)) continue;
      const style = getComputedStyle(node), drawn = style.stroke !== 'none' ? style.stroke : style.fill;
      look(node, drawn, 3, `sign ${name(node.closest('button'))}`);
    }
    return [...wrong];
  }

  /** Colours of the page in pairs, [what is seen, upon what, least contrast], that do not stand out: what is drawn on a canvas and not written. */
  function colours(pairs) {
    const style = getComputedStyle(document.querySelector('.st')), of = name => { const told = style.getPropertyValue(`--${name}`).trim(); if (!told) throw new Error(`no colour ${name}`); return rgba(told); };
    return pairs.map(([front, back, least]) => [front, back, least, ratio(of(front), of(back))]).filter(([, , least, got]) => got < least).map(([front, back, least, got]) => `${front} on ${back} ${got.toFixed(2)} < ${least}`);
  }

  /** English words where the page is Chinese: texts and names without a Chinese letter. */
  function english(scope) {
    const wrong = new Set(), isPlain = text => /[A-Za-z]{3,}/.test(text) && !/[\u4e00-\u9fff]/.test(text);
    for (const {node, text} of texts(scope)) if (isPlain(text)) wrong.add(`"${text.slice(0, 60)}" ${name(node)}`);
    for (const node of document.querySelectorAll('.st [aria-label], .st [title], .st [placeholder], .st [alt], .st option, .st optgroup'))
      if (inScope(node, scope) && (rendered(node) || node.closest('select')))
        for (const what of ['aria-label', 'title', 'placeholder', 'alt', 'aria-valuetext']) {
          const text = node.getAttribute(what) || '';
          if (isPlain(text)) wrong.add(`${what} "${text.slice(0, 60)}" ${name(node).slice(0, 40)}`);
        }
    for (const node of document.querySelectorAll('.st option')) if (node.closest('select') && rendered(node.closest('select')) && isPlain(node.textContent)) wrong.add(`option "${node.textContent.slice(0, 60)}" of ${name(node.closest('select'))}`);
    return [...wrong];
  }
  /** Controls that a screen reader has no name for. */
  function nameless(scope) {
    const wrong = [];
    for (const node of document.querySelectorAll(CONTROLS)) {
      if (!rendered(node) || !inScope(node, scope) || node.matches('.sd-scroll')) continue;
      const said = node.getAttribute('aria-label') || node.getAttribute('aria-labelledby') || node.closest('label')?.textContent || node.textContent.trim() || node.title || node.placeholder;
      if (!said?.trim()) wrong.push(`${name(node)} has no name`);
    }
    return wrong;
  }
  return {controls, panels, cut, contrast, colours, english, nameless};
})()
