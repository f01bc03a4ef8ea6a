import { Color, DirectionalLight, HemisphereLight, Scene, Vector3 } from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { Segments } from './cable-lines.js';

/** One picture: a scene with its lights, the page element it fills, and the structure one may point at. */
export class SceneView {
  constructor(element, structure) {
    this.element = element;
    this.structure = structure;
    this.scene = new Scene();
    this.sky = new HemisphereLight(0xffffff, 0x8c95a3, 1.9);
    this.sun = new DirectionalLight(0xffffff, 1.7);
    this.scene.add(this.sky, this.sun, structure.group);
    this.markMaterial = new LineMaterial({ linewidth: 9, transparent: true, opacity: 0.4, depthTest: false, depthWrite: false });
    this.mark = new Segments(Math.max(1, structure.assembly.edges.length), this.markMaterial);
    this.mark.object.renderOrder = 2;
    this.scene.add(this.mark.object);
    this.picked = null;
    this.mark.finish();
  }

  /** The light comes over the viewer's shoulder, so that no side of the structure is ever black. */
  lightFrom(camera, up) {
    const right = new Vector3(1, 0, 0).applyQuaternion(camera.quaternion);
    const back = new Vector3(0, 0, 1).applyQuaternion(camera.quaternion);
    this.sun.position.copy(back).addScaledVector(right, -0.7).addScaledVector(up, 0.9);
    this.sky.position.copy(up);
  }

  paint(theme) {
    this.markMaterial.color = new Color(theme.colour('accent'));
  }

  /** Marks the picked part, at where it is now. */
  pick(picked) {
    this.picked = picked;
    this.refreshMark();
  }

  refreshMark() {
    const { picked, structure } = this;
    this.mark.clear();
    if (picked?.kind === 'cable') this.mark.add(structure.state.ends, 6 * picked.index);
    if (picked?.kind === 'member') {
      const { vertices } = structure.state;
      for (const { member, a, b } of structure.assembly.edges) {
        if (member !== picked.index) continue;
        this.mark.add([...vertices.subarray(3 * a, 3 * a + 3), ...vertices.subarray(3 * b, 3 * b + 3)], 0);
      }
    }
    this.mark.finish();
  }
}
