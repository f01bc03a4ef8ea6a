import { assemble, configurationState } from './assembly.js';
import { AnimationLoop } from './animation-loop.js';
import { colourBar } from './colour-bar.js';
import { directions } from './directions.js';
import { h, releaseFocusAfterPointer } from './dom.js';
import { Extent } from './extent.js';
import { Ground } from './ground.js';
import { bindKeys } from './keyboard.js';
import { ModesView } from './modes-view.js';
import { MotionView } from './motion-view.js';
import { PlotCard } from './plot-card.js';
import { PlotLink } from './plot-link.js';
import { SceneView } from './scene-view.js';
import { ShapesView } from './shapes-view.js';
import { Stage } from './stage.js';
import { Structure, drawnRadii, looks } from './structure.js';
import { TensionScale } from './tension-scale.js';
import { Tooltip } from './tooltip.js';
import { onThemeChange, theme } from './theme.js';

const OPEN_PLOTS = 5;

/** The size of the structure itself, whatever way it travels. */
function structureSize(assembly, payload, counts) {
  const { motion, modes, shapes } = payload;
  const first = motion
    ? { poses: motion.poses.subarray(0, counts.members * 7), ends: motion.ends.subarray(0, counts.cables * 6) }
    : (modes?.reference ?? shapes.list[0]);
  const state = configurationState(assembly, first);
  return new Extent().add(state.vertices).add(state.ends).diagonal || 1;
}

/** All views of the structure that the payload allows, with what they share. */
function makeViews(payload, loop) {
  const assembly = assemble(payload.members);
  const counts = { members: payload.members.length, cables: payload.cables.length };
  if (!counts.members && !counts.cables) return null;
  if (!payload.motion && !payload.modes && !payload.shapes) return null;
  const size = structureSize(assembly, payload, counts);
  const radii = drawnRadii(assembly, size);
  const space = directions(payload.up, payload.plane);
  const stage = new Stage({ loop, plane: payload.plane, space, size, tooltip: new Tooltip(payload) });
  const makeStructure = (look) => new Structure(assembly, counts.cables, radii, size, looks[look]);
  const pending = [];
  const makeView = (element, look) => {
    const view = new SceneView(element, makeStructure(look));
    pending.push(view);
    return view;
  };
  const shared = { assembly, payload, counts, size, stage, makeView, makeStructure };
  const kinds = [['motion', MotionView], ['modes', ModesView], ['shapes', ShapesView]];
  const views = [];
  const grounds = [];
  for (const [part, View] of kinds) {
    if (!payload[part]) continue;
    const view = new View(shared);
    const ground = new Ground(view.extent, space, payload.plane);
    for (const scene of pending.splice(0)) scene.scene.add(ground.object());
    view.spacing = ground.spacing;
    grounds.push(ground);
    views.push(view);
  }
  return { stage, views, grounds };
}

/** Switches between the views and keeps the colours right. */
function presentViews({ stage, views, grounds }, loop) {
  const legend = h('div', { class: 'legend-slot' });
  const footer = h('div', { class: 'footer-slot' });
  let current = null;
  const paint = () => {
    const now = theme();
    stage.paint(now);
    grounds.forEach((g) => g.paint(now));
    for (const view of views) {
      const scale = new TensionScale(view.tensions, now.name);
      view.paint(now, scale);
      if (view === current) legend.replaceChildren(colourBar(scale));
    }
  };
  const tabs = views.map((view) => h('button', { type: 'button', class: 'tab', role: 'tab', onclick: () => choose(view) }, view.name));
  const choose = (view) => {
    current?.leave();
    current = view;
    tabs.forEach((tab, i) => tab.setAttribute('aria-selected', views[i] === view));
    for (const other of views) if (other.panel) other.panel.hidden = other !== view;
    footer.replaceChildren(...(view.footer ? [view.footer] : []));
    paint();
    stage.scaleBar.setGrid(view.spacing);
    view.enter();
  };
  loop.add((seconds) => current.step(seconds));
  onThemeChange(paint);
  const bar = h('div', { class: 'bar' }, views.length > 1 ? h('div', { class: 'tabs', role: 'tablist' }, tabs) : null, legend);
  const element = h('div', { class: 'stage' }, bar, stage.element, footer);
  return { element, start: () => choose(views[0]), current: () => current };
}

function facts({ members, cables }) {
  const count = (n, one, many) => (n ? `${n}\u00a0${n === 1 ? one : many}` : null);
  const of = (kind) => members.filter((m) => m.kind === kind).length;
  return [count(of('bar'), 'bar', 'bars'), count(of('body'), 'body', 'bodies'), count(of('particle'), 'particle', 'particles'), count(cables.length, 'cable', 'cables')]
    .filter(Boolean).join(' · ');
}

/** Builds the page for a payload. */
export function buildPage(app, payload) {
  const loop = new AnimationLoop();
  const made = makeViews(payload, loop);
  const clock = made?.views.find((v) => v.clock)?.clock ?? null;
  const link = new PlotLink(clock);
  const cards = payload.plots.map((plot, i) => new PlotCard(plot, link, i < OPEN_PLOTS));
  onThemeChange(() => cards.forEach((card) => card.repaint()));
  const presented = made && presentViews(made, loop);
  const panels = made?.views.map((v) => v.panel).filter(Boolean) ?? [];
  const side = h('aside', { class: 'side', 'aria-label': 'Plots' }, panels, cards.map((c) => c.element));
  const header = h('header', {},
    h('div', {}, h('h1', {}, payload.title || 'Results'), payload.subtitle ? h('p', { class: 'subtitle' }, payload.subtitle) : null),
    h('p', { class: 'facts' }, facts(payload)));
  const empty = !presented && !cards.length;
  app.replaceChildren(header, h('main', { class: `${presented ? 'with-stage' : ''} ${cards.length || panels.length ? 'with-side' : ''}` },
    presented?.element, side, empty ? h('p', { class: 'message' }, 'The result holds nothing to show.') : null));
  releaseFocusAfterPointer(app);
  presented?.start();
  if (clock) clock.listen(() => loop.request());
  bindKeys(() => presented?.current(), () => made?.stage.available && made.stage.reset());
  return {
    /** The time shown, or null without a motion. */
    time: () => clock?.time ?? null,
    seek: (t) => clock?.seek(t),
  };
}
