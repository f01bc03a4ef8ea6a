/** Makes dist/viewer.html, one file for tg-report to embed; with --check it only compares. */
import { readFile, writeFile, mkdir } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const read = (...path) => readFile(join(here, ...path), 'utf8');

const packages = [
  { name: 'three', title: 'three.js' },
  { name: 'uplot', title: 'uPlot' },
];

async function bundle() {
  const result = await build({
    absWorkingDir: here,
    entryPoints: ['src/main.js'],
    bundle: true,
    minify: true,
    treeShaking: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    charset: 'utf8',
    legalComments: 'none',
    logLevel: 'warning',
  });
  // Neither may end the element that holds the script.
  return result.outputFiles[0].text.trim().replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
}

async function styles() {
  const result = await build({
    absWorkingDir: here,
    stdin: { contents: '@import "uplot/dist/uPlot.min.css"; @import "./src/style.css";', loader: 'css', resolveDir: here },
    bundle: true,
    minify: true,
    write: false,
    charset: 'utf8',
    legalComments: 'none',
    logLevel: 'warning',
  });
  return result.outputFiles[0].text.trim();
}

async function licences() {
  const parts = await Promise.all(packages.map(async ({ name, title }) => {
    const { version } = JSON.parse(await read('node_modules', name, 'package.json'));
    const text = (await read('node_modules', name, 'LICENSE')).trim();
    return { notice: `${title} ${version}`, copyright: text.match(/^Copyright.*$/m)[0], text };
  }));
  return {
    comment: `<!-- Contains ${parts.map((p) => `${p.notice} (MIT, ${p.copyright})`).join(' and ')}; full texts in LICENSES.txt beside the source of this page. -->`,
    file: `viewer.html contains these packages.\n${parts.map((p) => `\n${'='.repeat(72)}\n${p.notice}\n${'='.repeat(72)}\n\n${p.text}\n`).join('')}`,
  };
}

function fill(template, marks) {
  return Object.entries(marks).reduce((page, [mark, text]) => {
    const parts = page.split(mark);
    if (parts.length !== 2) throw new Error(`${mark} stands ${parts.length - 1} times in the template`);
    return parts.join(text);
  }, template);
}

const legal = await licences();
const page = fill(await read('src', 'index.html'), {
  '<!--BUILD:LICENCE-->': legal.comment,
  '/*BUILD:CSS*/': await styles(),
  '/*BUILD:JS*/': await bundle(),
});
for (const mark of ['__TG_VIEW_DATA__', '__TG_TITLE__']) {
  if (page.split(mark).length !== 2) throw new Error(`${mark} must stand exactly once in the page`);
}

const outputs = { 'viewer.html': page, 'LICENSES.txt': legal.file };
if (process.argv.includes('--check')) {
  for (const [name, text] of Object.entries(outputs)) {
    const found = await read('dist', name).catch(() => null);
    if (found !== text) {
      console.error(`dist/${name} is not what the sources give: run "npm run build" and commit it.`);
      process.exitCode = 1;
    }
  }
} else {
  await mkdir(join(here, 'dist'), { recursive: true });
  for (const [name, text] of Object.entries(outputs)) await writeFile(join(here, 'dist', name), text);
  console.log(`dist/viewer.html: ${(Buffer.byteLength(page) / 1024).toFixed(0)} KiB`);
}
