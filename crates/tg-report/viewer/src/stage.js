import { Color, MOUSE, OrthographicCamera, PerspectiveCamera, TOUCH, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { h, iconButton } from './dom.js';
import { fit } from './fit.js';
import { pick } from './picker.js';
import { ScaleBar } from './scale-bar.js';
import { Triad } from './triad.js';

const FIELD = 28;

/** A WebGL context, or null: asking first keeps three.js from writing errors where there is none. */
function context(canvas) {
  try {
    return canvas.getContext('webgl2', { antialias: true, alpha: false, powerPreference: 'default' });
  } catch {
    return null;
  }
}

/** The 3D pane: one canvas and one camera for all pictures in it. */
export class Stage {
  constructor({ loop, plane, space, size, tooltip }) {
    Object.assign(this, { loop, plane, space, size, tooltip });
    this.canvas = h('canvas', { 'aria-label': 'The structure; drag to turn, scroll to zoom', role: 'img' });
    this.layer = h('div', { class: 'layer' });
    this.triad = new Triad(plane);
    this.scaleBar = new ScaleBar();
    this.resetButton = h('div', { class: 'pane-tools' }, iconButton('fit', 'Reset the view (F)', () => this.reset()));
    this.element = h('div', { class: 'pane' }, this.canvas, this.layer, this.triad.element, this.scaleBar.element, this.resetButton, tooltip.element);
    this.views = [];
    this.points = [];
    this.moved = false;
    const gl = context(this.canvas);
    this.available = Boolean(gl);
    if (!gl) {
      this.element.replaceChildren(h('p', { class: 'message' }, 'This browser offers no WebGL, so the structure cannot be drawn. The rest of the page works without it.'));
      return;
    }
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context: gl, antialias: true });
    this.renderer.setScissorTest(true);
    this.makeCamera();
    this.listen();
  }

  makeCamera() {
    const { plane, space, element } = this;
    this.camera = plane ? new OrthographicCamera() : new PerspectiveCamera(FIELD);
    // The controls read the camera's up once, when made.
    this.camera.up.copy(space.up);
    const controls = new OrbitControls(this.camera, element);
    controls.zoomToCursor = true;
    controls.enableDamping = true;
    controls.dampingFactor = 0.18;
    if (plane) {
      controls.enableRotate = false;
      controls.mouseButtons.LEFT = MOUSE.PAN;
      controls.touches.ONE = TOUCH.PAN;
    }
    controls.addEventListener('start', () => (this.moved = true));
    controls.addEventListener('change', () => this.request());
    this.controls = controls;
  }

  listen() {
    const { element } = this;
    new ResizeObserver(() => this.resize()).observe(element);
    this.resetButton.addEventListener('pointerdown', (e) => e.stopPropagation());
    element.addEventListener('wheel', () => (this.moved = this.moved || this.controls.enableZoom), { passive: true });
    element.addEventListener('pointermove', (e) => this.hover(e));
    element.addEventListener('pointerdown', (e) => {
      this.press = [e.clientX, e.clientY];
      if (e.pointerType === 'touch') this.hover(e);
    });
    element.addEventListener('pointerup', (e) => {
      const still = this.press && Math.hypot(e.clientX - this.press[0], e.clientY - this.press[1]) < 5;
      this.press = null;
      if (still) this.onTap?.(this.viewAt(e.clientX, e.clientY), e);
    });
    element.addEventListener('pointerleave', () => this.point(null));
    this.layer.addEventListener('scroll', () => this.request(), { passive: true });
    this.loop.add(() => {
      if (!this.dirty) return false;
      this.dirty = false;
      this.controls.update();
      this.render();
      return this.dirty;
    });
  }

  request() {
    this.dirty = true;
    this.loop.request();
  }

  /** Shows these pictures; several make a grid, which scrolls where one picture zooms. */
  setViews(views, points) {
    this.views = views;
    this.points = points;
    if (!this.available) return;
    const grid = views.length > 1;
    this.element.classList.toggle('many', grid);
    this.controls.enableZoom = !grid;
    this.controls.enablePan = !grid;
    this.element.style.touchAction = grid ? 'pan-y' : 'none';
    this.point(null);
    this.reset();
  }

  reset() {
    this.moved = false;
    this.frameAll();
    this.request();
  }

  rectangle(view) {
    const pane = this.element.getBoundingClientRect();
    const r = view.element.getBoundingClientRect();
    return { left: r.left - pane.left, top: r.top - pane.top, width: r.width, height: r.height };
  }

  frameAll() {
    if (!this.views.length || !this.points.length) return;
    const { width, height } = this.rectangle(this.views[0]);
    if (!width || !height) return;
    // Overlays at the pane's edges need some air.
    const margin = this.views.length > 1 ? 1.3 : 1.22;
    const f = fit(this.points, this.space.view, this.space.up, width / height, FIELD, margin);
    this.halfHeight = Math.max(f.halfHeight, this.size * 0.05);
    const distance = this.plane ? 10 * this.halfHeight : Math.max(f.distance, this.size * 0.1);
    const target = this.plane ? f.flatTarget : f.target;
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(this.space.view, distance);
    this.camera.zoom = 1;
    this.controls.update();
    this.home = distance;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height, false);
    this.onResize?.();
    if (!this.moved) this.frameAll();
    this.render();
  }

  shapeCamera(width, height) {
    const { camera } = this;
    const distance = camera.position.distanceTo(this.controls.target);
    const reach = Math.max(this.home ?? distance, distance);
    camera.near = this.plane ? 0 : Math.max(distance * 0.01, distance - 6 * reach);
    camera.far = distance + 6 * reach;
    if (this.plane) {
      camera.top = this.halfHeight;
      camera.bottom = -this.halfHeight;
      camera.right = (this.halfHeight * width) / height;
      camera.left = -camera.right;
    } else camera.aspect = width / height;
    camera.updateProjectionMatrix();
    const metres = this.plane ? (2 * this.halfHeight) / camera.zoom : 2 * distance * Math.tan((FIELD * Math.PI) / 360);
    return height / metres;
  }

  render() {
    if (!this.views.length) return;
    const { renderer, camera } = this;
    const height = this.element.clientHeight;
    renderer.setScissorTest(false);
    renderer.clear();
    renderer.setScissorTest(true);
    this.views.forEach((view, i) => {
      const r = this.rectangle(view);
      if (r.width < 2 || r.height < 2 || r.top > height || r.top + r.height < 0) return;
      const pixelsPerMetre = this.shapeCamera(r.width, r.height);
      if (i === 0) this.scaleBar.update(pixelsPerMetre);
      view.lightFrom(camera, this.space.up);
      renderer.setViewport(r.left, height - r.top - r.height, r.width, r.height);
      renderer.setScissor(r.left, height - r.top - r.height, r.width, r.height);
      renderer.render(view.scene, camera);
    });
    this.triad.update(camera);
  }

  paint(theme) {
    if (!this.available) return;
    this.renderer.setClearColor(new Color(theme.colour('stage')));
    this.request();
  }

  viewAt(clientX, clientY) {
    return this.views.find((view) => {
      const r = view.element.getBoundingClientRect();
      return clientX >= r.left && clientX < r.right && clientY >= r.top && clientY < r.bottom;
    });
  }

  hover(event) {
    if (event.buttons && event.pointerType !== 'touch') return this.point(null);
    const view = this.viewAt(event.clientX, event.clientY);
    if (!view) return this.point(null);
    const r = view.element.getBoundingClientRect();
    this.shapeCamera(r.width, r.height);
    const picked = pick(view, this.camera, r.width, r.height, event.clientX - r.left, event.clientY - r.top);
    const pane = this.element.getBoundingClientRect();
    return this.point(picked && { view, picked, x: event.clientX - pane.left, y: event.clientY - pane.top });
  }

  /** Moves the mark and the tooltip to what is pointed at, or takes them away. */
  point(at) {
    if (!at && !this.pointed) return;
    if (this.pointed && this.pointed.view !== at?.view) this.pointed.view.pick(null);
    this.pointed = at;
    this.canvas.style.cursor = at ? 'pointer' : '';
    at?.view.pick(at.picked);
    this.refreshPointed();
    this.request();
  }

  /** Keeps the tooltip true while the structure moves under it. */
  refreshPointed() {
    if (!this.pointed) return this.tooltip.hide();
    const { view, x, y } = this.pointed;
    view.refreshMark();
    return this.tooltip.show(view, x, y, this.element.clientWidth, this.element.clientHeight);
  }
}
