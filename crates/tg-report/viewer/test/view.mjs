/**
 * Opens pages in a headless Chromium and uses them as a reader would. With TG_VIEW_HTML set to a page that the Rust
 * program wrote, that page is tested too. TG_VIEW_SHOTS names a folder for screenshots.
 */
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { after, before, test } from 'node:test';
import { launch, settle } from './browser.mjs';
import { decode, differingPixels, distinctColours } from './png.mjs';
import { equilibria, fill, malformed, prism, tower, truss } from './payloads.mjs';

const template = readFileSync(join(dirname(fileURLToPath(import.meta.url)), '..', 'dist', 'viewer.html'), 'utf8');
const shots = process.env.TG_VIEW_SHOTS;
if (shots) mkdirSync(shots, { recursive: true });

// Software WebGL is slow: fewer pixels where nobody looks.
const size = shots ? { width: 1280, height: 800 } : { width: 960, height: 600 };

let browser;
before(async () => (browser = await launch()));
after(() => browser.close());

const pageOf = (payload) => fill(template, JSON.stringify(payload), payload.title);

async function picture(page, selector = '.pane') {
  return decode(Buffer.from(await (await page.$(selector)).screenshot()));
}

async function save(page, name) {
  if (shots) writeFileSync(join(shots, `${name}.png`), await page.screenshot());
}

const time = (page) => page.evaluate(() => window.tgView.time());

async function seek(page, t) {
  await page.evaluate((at) => window.tgView.seek(at), t);
  await settle(page);
}

/** Opens, lets the body use the page, and asserts that the page complained of nothing. */
async function using(options, body) {
  const { page, complaints } = await browser.open({ ...size, ...options });
  try {
    await body(page);
    assert.deepEqual(complaints, []);
  } finally {
    await page.close();
  }
}

async function plays(page) {
  await seek(page, Infinity);
  const end = await time(page);
  await seek(page, -Infinity);
  const start = await time(page);
  const first = await picture(page);
  assert.ok(distinctColours(first) > 30, 'the canvas shows something');
  if (end === start) return;
  // Runs may be short, and then begin again before one looks.
  const later = start + Math.min(0.25, 0.2 * (end - start));
  await page.keyboard.press('Space');
  await page.waitForFunction((t) => window.tgView.time() > t, { timeout: 8000 }, later);
  await page.keyboard.press('Space');
  const paused = await time(page);
  await settle(page);
  assert.equal(await time(page), paused, 'space pauses');
  let moved = false;
  for (let part = 1; part < 8 && !moved; part++) {
    await seek(page, start + ((end - start) * part) / 8);
    moved = differingPixels(first, await picture(page)) > 50;
  }
  assert.ok(moved, 'the structure moves');
}

test('a motion plays, is scrubbed by keys and by its plots', async () => {
  const payload = prism();
  await using({ html: pageOf(payload) }, async (page) => {
    assert.equal(await page.title(), payload.title);
    await plays(page);

    await page.focus('input[aria-label=Time]');
    await page.keyboard.press('Home');
    assert.equal(await time(page), 0);
    await page.keyboard.press('ArrowRight');
    assert.ok(Math.abs((await time(page)) - 1 / 80) < 1e-9, 'one frame on');
    await page.keyboard.press('End');
    assert.equal(await time(page), 3);

    await (await page.$('.u-over')).click({ offset: { x: 100, y: 40 } });
    const clicked = await page.evaluate(() => 3 * 100 / document.querySelector('.u-over').clientWidth);
    assert.ok(Math.abs((await time(page)) - clicked) < 0.03, 'a click in a plot seeks');

    const over = await (await page.$('.u-over')).boundingBox();
    await page.mouse.move(over.x + 100, over.y + 40);
    await page.mouse.down();
    await page.mouse.move(over.x + 200, over.y + 40, { steps: 4 });
    await page.mouse.up();
    assert.ok(Math.abs((await time(page)) - 2 * clicked) < 0.03, 'pulling the time line seeks');

    await page.mouse.move(over.x + 20, over.y + 40);
    await page.mouse.down();
    await page.mouse.move(over.x + 90, over.y + 40, { steps: 4 });
    await page.mouse.up();
    const undo = await page.$$eval('.plot-head button', (all) => all.map((b) => !b.hidden));
    assert.deepEqual(undo, [true, true, true, true, false], 'plots over time zoom together, others do not');
    await page.click('.plot-head button');

    const chip = await page.$('.chip');
    await chip.click();
    assert.equal(await page.$eval('.chip', (c) => c.getAttribute('aria-pressed')), 'false');

    const pane = await (await page.$('.pane')).boundingBox();
    let named = '';
    for (let x = 0.2; x < 0.8 && !named; x += 0.03) {
      await page.mouse.move(pane.x + pane.width * x, pane.y + pane.height * 0.5);
      named = await page.$eval('.tooltip', (t) => (t.hidden ? '' : t.textContent));
    }
    assert.match(named, /^((base|top|side) \d ?tension(slack|[\d.]+\u202fN)|bar \d)length[\d.]+\u202fm$/);
    await seek(page, 0.9);
    await save(page, 'motion');
  });
});

test('modes are listed, each can be chosen and swings', async () => {
  await using({ html: pageOf(truss()), dark: true }, async (page) => {
    const count = await page.$$eval('.mode input', (all) => all.length);
    assert.equal(count, 8);
    await page.click('.play');
    let last = await picture(page);
    await save(page, 'modes-dark');
    for (let i = 1; i < count; i++) {
      await page.evaluate((n) => document.querySelectorAll('.mode input')[n].click(), i);
      await settle(page);
      const now = await picture(page);
      assert.ok(differingPixels(last, now) > 100, `mode ${i + 1} looks different`);
      last = now;
    }
    await page.click('.play');
    let swings = false;
    // It may pass the pose it paused in: look again.
    for (let look = 0; look < 8 && !swings; look++) swings = differingPixels(last, await picture(page)) > 100;
    assert.ok(swings, 'the mode swings');
    assert.match(await page.$eval('.colour-bar', (b) => b.textContent), /compression/);
  });
});

test('all equilibria are shown, stable ones told apart, one is enlarged', async () => {
  await using({ html: pageOf(equilibria()) }, async (page) => {
    const cells = await page.$$('.cell');
    assert.equal(cells.length, 5);
    assert.equal(await page.$$eval('.badge.stable', (all) => all.length), 2);
    for (const cell of cells) assert.ok(distinctColours(decode(Buffer.from(await cell.screenshot()))) > 30, 'the cell is not empty');
    await save(page, 'equilibria');
    await cells[3].click();
    await settle(page);
    assert.match(await page.$eval('.footer-slot', (f) => f.textContent), /4.*0\.18.*stable/);
    await save(page, 'equilibrium');
    await page.keyboard.press('ArrowRight');
    assert.match(await page.$eval('.footer-slot', (f) => f.textContent), /5.*unstable/);
    await page.keyboard.press('Escape');
    assert.equal((await page.$$('.cell')).length, 5);
  });
});

test('one equilibrium alone is simply shown', async () => {
  await using({ html: pageOf(equilibria(1)) }, async (page) => {
    assert.equal((await page.$$('.cells')).length, 0);
    assert.ok(distinctColours(await picture(page)) > 30);
  });
});

test('a big run stays usable on a narrow screen', async () => {
  await using({ html: pageOf(tower()), width: 420, touch: true }, async (page) => {
    await plays(page);
    const shown = () => page.$eval('.series-tools .note', (n) => n.textContent);
    assert.equal(await shown(), '8 shown');
    await page.type('.series-tools input', 'cable 17');
    await page.evaluate(() => document.querySelector('.series-tools button').click());
    assert.equal(await shown(), '12 shown');
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 420, 'nothing sticks out sideways');
    await page.evaluate(() => window.scrollTo(0, 0));
    await save(page, 'tower-narrow');
  });
});

test('malformed data gives a message', async () => {
  for (const { name, text, word } of malformed) {
    const html = name === 'empty template' ? template : fill(template, text, 'x');
    await using({ html }, async (page) => {
      assert.match(await page.$eval('[role=alert]', (m) => m.textContent), new RegExp(word), name);
      if (name === 'short array') await save(page, 'malformed');
    });
  }
});

test('without WebGL the page says so and keeps its plots', async () => {
  const before = () => (HTMLCanvasElement.prototype.getContext = new Proxy(HTMLCanvasElement.prototype.getContext, {
    apply: (get, canvas, [kind, ...rest]) => (kind === 'webgl2' ? null : Reflect.apply(get, canvas, [kind, ...rest])),
  }));
  await using({ html: pageOf(prism()), before }, async (page) => {
    assert.match(await page.$eval('.pane', (p) => p.textContent), /WebGL/);
    assert.ok((await page.$$('.u-over')).length > 3);
    await page.keyboard.press('ArrowRight');
    assert.ok((await time(page)) > 0);
  });
});

test('a page made by tg view', { skip: !process.env.TG_VIEW_HTML }, async () => {
  await using({ file: resolve(process.env.TG_VIEW_HTML) }, async (page) => {
    assert.equal(await page.$('[role=alert]'), null, 'the data is read');
    if (await page.$('.pane')) assert.ok(distinctColours(await picture(page)) > 30, 'the canvas shows something');
    if ((await time(page)) !== null) await plays(page);
    await save(page, 'tg-view');
  });
});
