import assert from 'node:assert/strict';
import { test } from 'node:test';
import { number, tick } from '../src/format.js';

test('ticks show as many decimals as tell them apart', () => {
  const texts = (spacing, count) => Array.from({ length: count }, (_, k) => tick(k * spacing, spacing, (count - 1) * spacing));
  assert.deepEqual(texts(2.5, 4), ['0', '2.5', '5.0', '7.5']);
  assert.deepEqual(texts(0.25, 3), ['0', '0.25', '0.50']);
  assert.deepEqual(texts(20, 3), ['0', '20', '40']);
  assert.deepEqual(texts(2.5e-6, 3), ['0', '2.5·10⁻⁶', '5.0·10⁻⁶']);
});

test('numbers have the digits asked for', () => {
  assert.deepEqual([number(0), number(-1.2345), number(1.5e-9), number(NaN)], ['0', '\u22121.23', '1.5·10⁻⁹', '–']);
});
