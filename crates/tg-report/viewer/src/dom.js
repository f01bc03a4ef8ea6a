/** Makes an element: attributes, `on…` listeners and children, in one readable call. */
export function h(tag, props = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (value === null || value === undefined) continue;
    // States of ARIA are words: "false" is said, not left out.
    if (key.startsWith('aria-')) element.setAttribute(key, value);
    else if (value === false) continue;
    else if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else if (key === 'class') element.className = value;
    else element.setAttribute(key, value === true ? '' : value);
  }
  element.append(...children.flat(Infinity).filter((c) => c !== null && c !== undefined));
  return element;
}

const SVG = 'http://www.w3.org/2000/svg';

export function svg(tag, props = {}, ...children) {
  const element = document.createElementNS(SVG, tag);
  for (const [key, value] of Object.entries(props)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

const paths = {
  play: 'M5 3.2v9.6a.6.6 0 0 0 .92.5l7.4-4.8a.6.6 0 0 0 0-1L5.92 2.7A.6.6 0 0 0 5 3.2z',
  pause: 'M4 3h2.8v10H4zM9.2 3H12v10H9.2z',
  loop: 'M11 1.5 13.5 4 11 6.5V4.9H5.2A1.7 1.7 0 0 0 3.5 6.6V8H1.9V6.6a3.3 3.3 0 0 1 3.3-3.3H11zM5 14.5 2.5 12 5 9.5v1.6h5.8a1.7 1.7 0 0 0 1.7-1.7V8h1.6v1.4a3.3 3.3 0 0 1-3.3 3.3H5z',
  fit: 'M2 2h4.4v1.5H3.5v2.9H2zm7.6 0H14v4.4h-1.5V3.5H9.6zM2 9.6h1.5v2.9h2.9V14H2zm10.5 0H14V14H9.6v-1.5h2.9zM6 6h4v4H6z',
  grid: 'M2 2h5v5H2zm7 0h5v5H9zM2 9h5v5H2zm7 0h5v5H9z',
  previous: 'M10.5 2.8 5.3 8l5.2 5.2 1.1-1.1L7.5 8l4.1-4.1z',
  next: 'M5.5 2.8 10.7 8l-5.2 5.2-1.1-1.1L8.5 8 4.4 3.9z',
};

export function icon(name) {
  return svg('svg', { viewBox: '0 0 16 16', width: 16, height: 16, 'aria-hidden': 'true' }, svg('path', { d: paths[name] }));
}

export function iconButton(name, label, onclick) {
  return h('button', { type: 'button', class: 'icon', 'aria-label': label, title: label, onclick }, icon(name));
}

/** A mouse click must not leave the focus on a button, where the space bar would press it again instead of playing. */
export function releaseFocusAfterPointer(root) {
  root.addEventListener('click', (event) => {
    const button = event.target.closest?.('button');
    if (button && event.detail > 0) button.blur();
  });
}
