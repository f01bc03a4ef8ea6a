import { buildPage } from './page.js';
import { h } from './dom.js';
import { readPayload } from './payload.js';

function fail(app, error) {
  app.replaceChildren(h('div', { class: 'message', role: 'alert' },
    h('h1', {}, 'The results cannot be shown'),
    h('p', {}, error.message || String(error)),
    h('p', { class: 'note' }, 'The file may be damaged or made by another version. Make it again with “tg view”.')));
}

const app = document.getElementById('app');
try {
  const data = document.getElementById('tg-data');
  // For tests and for scripts beside the page: `time()` and `seek(t)`.
  window.tgView = buildPage(app, readPayload(data?.textContent ?? ''));
} catch (error) {
  fail(app, error);
}
