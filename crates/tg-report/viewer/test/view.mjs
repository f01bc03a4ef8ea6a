/** Opens pages in a headless browser and uses them as a person would. See README.md for the variables it reads. */
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { launch, settle } from './browser.mjs';
import { equilibria, fill, malformed, prism, tower, truss } from './payloads.mjs';
import { decode, differingPixels, distinctColours } from './png.mjs';

const template = readFileSync(new URL('../dist/viewer.html', import.meta.url), 'utf8');
const given = process.env.TG_VIEW_HTML;
const folder = process.env.TG_VIEW_SHOTS;
const pageOf = (payload) => fill(template, JSON.stringify(payload), payload.title);

let browser;
before(async () => {
  browser = await launch();
  if (folder) mkdirSync(folder, { recursive: true });
});
after(() => browser?.close());

async function shoot(page, name) {
  if (folder) await page.screenshot({ path: join(folder, `${name}.png`) });
}

/** Opens a page, lets `use` work on it, and has no complaints left. */
async function visit(options, name, use) {
  const { page, complaints } = await browser.open(options);
  await use(page);
  await settle(page);
  await shoot(page, name);
  assert.deepEqual(complaints, [], 'no errors, no warnings, no requests');
  await page.close();
}

const time = (page) => page.evaluate(() => window.tgView.time());
const seek = (page, t) => page.evaluate((to) => window.tgView.seek(to), t).then(() => settle(page));

async function picture(page) {
  const pane = await page.$('.pane');
  return decode(Buffer.from(await pane.screenshot()));
}

async function drawn(page) {
  const colours = distinctColours(await picture(page));
  assert.ok(colours > 100, `the picture has ${colours} colours`);
}

/** Nothing may stick out sideways. */
async function fits(page) {
  const [inner, outer] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
  assert.ok(inner <= outer, `the page is ${inner} px wide in a window of ${outer}`);
}

async function playsAndScrubs(page) {
  await seek(page, -Infinity);
  const start = await time(page);
  const first = await picture(page);
  await page.keyboard.press('Space');
  await page.waitForFunction((from) => window.tgView.time() > from, { timeout: 5000 }, start);
  await page.keyboard.press('Space');
  const stopped = await time(page);
  await settle(page);
  assert.equal(await time(page), stopped, 'the second space stops it');

  await page.keyboard.press('End');
  const end = await time(page);
  assert.ok(end > start);
  await seek(page, start + 0.37 * (end - start));
  const changed = differingPixels(first, await picture(page));
  assert.ok(changed > 50, `${changed} pixels differ between two times`);
  await page.keyboard.press('Home');
  assert.equal(await time(page), start);
  await page.keyboard.press('ArrowRight');
  const next = await time(page);
  assert.ok(next > start, 'the right arrow goes on by a frame');
  await page.keyboard.press('ArrowLeft');
  assert.equal(await time(page), start);
  return [start, end];
}

async function clickingAPlotSeeks(page, [start, end]) {
  const over = await page.$('.u-over');
  const box = await over.boundingBox();
  await page.mouse.click(box.x + 0.7 * box.width, box.y + 0.5 * box.height);
  const at = ((await time(page)) - start) / (end - start);
  assert.ok(Math.abs(at - 0.7) < 0.02, `a click at 0.7 of the plot leads to ${at}`);
}

test('a file made by the program', { skip: !given }, async () => {
  await visit({ file: resolve(given) }, 'given', async (page) => {
    assert.ok(await page.$('h1'));
    assert.equal(await page.$('[role=alert]'), null, 'it is read without a fault');
    if (!(await page.$('.pane'))) return;
    if ((await time(page)) === null) return void (await drawn(page));
    const range = await playsAndScrubs(page);
    if (await page.$('.u-over')) await clickingAPlotSeeks(page, range);
  });
});

test('motion: plays, scrubs, seeks and zooms by its plots', { skip: Boolean(given) }, async () => {
  await visit({ html: pageOf(prism()) }, 'prism', async (page) => {
    assert.equal(await page.title(), 'Swaying prism');
    const range = await playsAndScrubs(page);
    await clickingAPlotSeeks(page, range);
    await drawn(page);

    const over = await page.$('.u-over');
    const box = await over.boundingBox();
    await page.mouse.move(box.x + 0.1 * box.width, box.y + 40);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.4 * box.width, box.y + 42, { steps: 4 });
    await page.mouse.up();
    const undo = () => page.$$eval('.card button.text', (all) => all.filter((b) => !b.hidden && b.textContent === 'Reset zoom').length);
    assert.ok((await undo()) > 1, 'dragging zooms all plots over time');
    await page.mouse.click(box.x + 0.5 * box.width, box.y + 40, { clickCount: 2 });
    assert.equal(await undo(), 0, 'a double click shows all again');
  });
});

test('motion: tells what is under the pointer, legends and folds work', { skip: Boolean(given) }, async () => {
  await visit({ html: pageOf(prism({ twoWay: true })), dark: true }, 'prism-dark', async (page) => {
    const pressed = () => page.$eval('.chip', (chip) => chip.getAttribute('aria-pressed'));
    assert.equal(await pressed(), 'true');
    await page.click('.chip');
    assert.equal(await pressed(), 'false');
    await page.click('.chip');
    await page.click('.fold');
    assert.equal(await page.$eval('.fold', (fold) => fold.getAttribute('aria-expanded')), 'false');
    await page.click('.fold');
    assert.match(await page.$eval('.colour-bar', (bar) => bar.textContent), /compression/);

    const pane = await (await page.$('.pane')).boundingBox();
    let found = '';
    for (let k = 0; k < 24 && !found; k++) {
      await page.mouse.move(pane.x + pane.width * (0.3 + 0.017 * k), pane.y + pane.height * 0.5);
      found = await page.$eval('.tooltip', (tip) => (tip.hidden ? '' : tip.textContent));
    }
    assert.match(found, /length/, 'hovering tells about a part');
  });
});

test('motion: a narrow screen', { skip: Boolean(given) }, async () => {
  await visit({ html: pageOf(prism()), width: 420, touch: true }, 'prism-narrow', async (page) => {
    await fits(page);
    await drawn(page);
  });
});

test('modes: every one can be chosen and moves', { skip: Boolean(given) }, async () => {
  await visit({ html: pageOf(truss()) }, 'truss', async (page) => {
    const inputs = await page.$$('.mode input');
    assert.equal(inputs.length, 8);
    await page.keyboard.press('Space');
    const pictures = [];
    for (const input of inputs) {
      await input.click();
      assert.ok(await input.evaluate((e) => e.checked));
      await settle(page);
      pictures.push(await picture(page));
    }
    assert.ok(differingPixels(pictures[0], pictures[1]) > 50, 'modes differ');
    const moving = await picture(page);
    await page.keyboard.press('Space');
    await new Promise((done) => setTimeout(done, 300));
    await page.keyboard.press('Space');
    await settle(page);
    assert.ok(differingPixels(moving, await picture(page)) > 20, 'the mode swings');
    await inputs[0].click();
  });
});

test('equilibria: all are shown, each enlarges', { skip: Boolean(given) }, async () => {
  await visit({ html: pageOf(equilibria(5)) }, 'equilibria', async (page) => {
    const cells = await page.$$('.cell');
    assert.equal(cells.length, 5);
    assert.equal((await page.$$('.cell.stable')).length, 2);
    const pictures = await page.$$('.picture');
    for (const cell of pictures) {
      const colours = distinctColours(decode(Buffer.from(await cell.screenshot())));
      assert.ok(colours > 40, `a cell has ${colours} colours`);
    }
    await (await cells[3].$('.cell-open')).click();
    await settle(page);
    assert.match(await page.$eval('.transport', (e) => e.textContent), /4.*stable/);
    await drawn(page);
    await page.keyboard.press('Escape');
    await settle(page);
    assert.equal((await page.$$('.cell')).length, 5);
  });
});

test('one shape is simply shown', { skip: Boolean(given) }, async () => {
  await visit({ html: pageOf(equilibria(1)) }, 'single', async (page) => {
    await drawn(page);
    assert.equal((await page.$$('.cell-open')).length, 1);
  });
});

test('a large run stays usable', { skip: Boolean(given) }, async () => {
  await visit({ html: pageOf(tower()) }, 'tower', async (page) => {
    await seek(page, 3);
    await drawn(page);
    const on = () => page.$eval('.series', (e) => e.querySelectorAll('.chip[aria-pressed=true]').length);
    assert.equal(await on(), 8, 'the first few of many series');
    await page.type('.series-tools input', 'cable 19');
    await page.$eval('.series-tools', (e) => [...e.querySelectorAll('button')].find((b) => b.textContent === 'Only').click());
    assert.equal(await on(), 12, 'cable 19, cable 119 and cables 190 to 199');
  });
});

test('faulty data gives a message', { skip: Boolean(given) }, async () => {
  for (const { name, text, word } of malformed) {
    const { page, complaints } = await browser.open({ html: name === 'empty template' ? template : fill(template, text, name) });
    const message = await page.$eval('[role=alert]', (e) => e.textContent);
    assert.ok(message.includes(word), `${name}: ${message}`);
    assert.deepEqual(complaints, []);
    await page.close();
  }
});

test('without WebGL the page says so and keeps its plots', { skip: Boolean(given) }, async () => {
  const withoutWebgl = () => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function getContext(kind, ...rest) {
      return kind.startsWith('webgl') ? null : get.call(this, kind, ...rest);
    };
  };
  await visit({ html: pageOf(prism()), before: withoutWebgl }, 'no-webgl', async (page) => {
    assert.match(await page.$eval('.pane', (e) => e.textContent), /WebGL/);
    await page.keyboard.press('ArrowRight');
    assert.ok((await time(page)) > 0);
    assert.ok(await page.$('.u-over'));
  });
});
