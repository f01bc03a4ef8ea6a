import { accessSync, constants, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { delimiter, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';

function executable() {
  if (process.env.CHROMIUM) return process.env.CHROMIUM;
  for (const name of ['chromium', 'chromium-browser', 'google-chrome']) {
    for (const folder of (process.env.PATH ?? '').split(delimiter)) {
      try {
        accessSync(join(folder, name), constants.X_OK);
        return join(folder, name);
      } catch {
        // Not there: look on.
      }
    }
  }
  throw new Error('No Chromium: set CHROMIUM or install chromium.');
}

/** A headless browser that draws WebGL in software. */
export async function launch() {
  const browser = await puppeteer.launch({
    executablePath: executable(),
    headless: true,
    args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--hide-scrollbars'],
  });
  const folder = mkdtempSync(join(tmpdir(), 'tg-view-'));
  let files = 0;
  return {
    /**
     * Opens a page and collects all it complains about. Whatever it asks of the network is refused and counted.
     * @param {{html?: string, file?: string, width?: number, height?: number, dark?: boolean, touch?: boolean, before?: Function}} options
     */
    async open({ html, file, width = 1280, height = 800, dark = false, touch = false, before }) {
      const path = file ?? join(folder, `${files++}.html`);
      if (!file) writeFileSync(path, html);
      const page = await browser.newPage();
      const complaints = [];
      page.on('console', (message) => {
        if (['error', 'warn', 'warning', 'assert'].includes(message.type())) complaints.push(`${message.type()}: ${message.text()}`);
      });
      page.on('pageerror', (error) => complaints.push(`exception: ${error.message}`));
      await page.setRequestInterception(true);
      page.on('request', (request) => {
        const own = request.url() === pathToFileURL(path).href || /^(data|blob):/.test(request.url());
        if (own) request.continue();
        else {
          complaints.push(`network: ${request.url()}`);
          request.abort();
        }
      });
      await page.setViewport({ width, height, hasTouch: touch });
      await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }]);
      if (before) await page.evaluateOnNewDocument(before);
      await page.goto(pathToFileURL(path).href, { waitUntil: 'load' });
      await settle(page);
      return { page, complaints };
    },
    async close() {
      await browser.close();
      rmSync(folder, { recursive: true, force: true });
    },
  };
}

/** Waits for what was asked to be drawn. */
export const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(() => done())))));
