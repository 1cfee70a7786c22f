// Forces of constraint as arrows from the points that they act on.
import { ConeGeometry, CylinderGeometry, Group, Mesh, TorusGeometry, Vector3 } from "three";

const up = new Vector3(0, 1, 0);
const shaftGeometry = new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0);
const headGeometry = new ConeGeometry(1, 1, 18).translate(0, 0.5, 0);
const arcGeometry = new TorusGeometry(1, 0.09, 8, 48, 1.5 * Math.PI);

// One arrow: its tail at the point, its length the force times the scale.
class Arrow {
  constructor(constraint, arrow, colour, look) {
    this.constraint = constraint;
    this.arrow = arrow;
    this.point = constraint.points[arrow.point];
    this.group = new Group();
    this.material = look.arrow(colour);
    this.shaft = new Mesh(shaftGeometry, this.material);
    this.heads = Array.from({ length: arrow.torque ? 2 : 1 }, () => new Mesh(headGeometry, this.material));
    this.group.add(this.shaft, ...this.heads);
    for (const mesh of this.group.children) mesh.renderOrder = 1; // before all else, so that a rod hides none
    this.tail = new Vector3();
    this.tip = new Vector3();
    this.force = new Vector3();
    this.known = true;
  }
  update(frame, scale, thick) {
    const { arrow } = this;
    const numbers = arrow.force.map((column) => frame.value(column));
    this.known = !numbers.some(Number.isNaN);
    this.tail.fromArray(frame.place(this.point));
    if (numbers.length === 1) this.force.set(0, 0, numbers[0]); // a torque in the plane
    else this.force.set(numbers[0], numbers[1], numbers[2] ?? 0);
    const length = this.force.length() * scale;
    this.group.visible = this.known && length > 0.25 * thick;
    this.tip.copy(this.tail);
    if (!this.group.visible) return;
    const direction = this.force.clone().normalize();
    this.tip.addScaledVector(direction, length);
    // A short arrow has a smaller head, and is still as long as its force.
    const head = Math.min(4.4 * thick, 0.6 * length), radius = Math.min(thick, 0.2 * length);
    this.group.position.copy(this.tail);
    this.group.quaternion.setFromUnitVectors(up, direction);
    this.shaft.scale.set(0.62 * radius, length - head, 0.62 * radius);
    this.heads.forEach((mesh, k) => {
      mesh.position.y = length - head * (1 + 0.7 * k);
      mesh.scale.set(1.8 * radius, head, 1.8 * radius);
    });
  }
}

// A torque in the plane: an arc around the point, whose angle stands for its size.
class Turn extends Arrow {
  constructor(constraint, arrow, colour, look) {
    super(constraint, arrow, colour, look);
    this.group.clear();
    this.arc = new Mesh(arcGeometry, this.material);
    this.group.add(this.arc, this.heads[0]);
    this.arc.renderOrder = 1;
  }
  update(frame, scale, thick) {
    super.update(frame, scale, thick);
    const length = this.force.length() * scale;
    this.group.visible = this.known && length > 0.25 * thick;
    if (!this.group.visible) return;
    const radius = Math.max(length / 2, 1.5 * thick), sign = Math.sign(this.force.z);
    this.group.quaternion.identity();
    this.arc.scale.set(radius, radius, radius);
    this.arc.rotation.set(sign > 0 ? 0 : Math.PI, 0, 0);
    this.heads[0].position.set(0, -sign * radius, 0);
    this.heads[0].quaternion.setFromUnitVectors(up, new Vector3(1, 0, 0));
    this.heads[0].scale.set(0.3 * radius, 0.6 * radius, 0.3 * radius);
    this.tip.copy(this.tail);
  }
}

export class Arrows {
  constructor(run, look, size) {
    this.run = run;
    this.size = size;
    this.root = new Group();
    this.all = [];
    // The more there are, the smaller.
    this.room = Math.min(1, Math.sqrt(5 / Math.max(1, run.constraints.length)));
    this.thick = 0.0085 * size * Math.max(0.55, this.room);
    this.hidden = new Set(); // constraints, by index
    this.selected = null;
    this.visible = true;
    run.constraints.forEach((constraint, k) => {
      constraint.colour = k;
      for (const arrow of constraint.arrows) {
        const point = constraint.points[arrow.point];
        if (point.rotor !== undefined) continue; // it has no place
        const Kind = arrow.torque && run.dimension === 2 ? Turn : Arrow;
        const one = new Kind(constraint, arrow, k, look);
        this.all.push(one);
        this.root.add(one.group);
      }
    });
    this.forceScale = this.scaleOf((one) => !one.arrow.torque);
    this.torqueScale = this.scaleOf((one) => one.arrow.torque);
    // Both of what acts at one place say the same: the second one's is shown.
    for (const constraint of run.constraints) {
      const own = this.all.filter((one) => one.constraint === constraint && !one.arrow.torque);
      if (["ball", "hinge", "slider", "weld"].includes(constraint.shape)) {
        own.slice(0, -1).forEach((one) => (one.opposite = true));
      }
    }
  }
  // Such that the largest one is at most a third of the scene's size, but where a few are much larger than all others.
  scaleOf(which) {
    const [usual, largest] = this.sizesOf(this.all.filter(which));
    if (!(largest > 0)) return 0;
    const scale = (0.33 * this.size * this.room) / Math.min(largest, 3 * usual);
    return scale * Math.max(0.3, Math.min(1, 0.5 / this.overlap(which, scale)));
  }
  // What 95 of 100 do not exceed, and the largest.
  sizesOf(arrows) {
    const sizes = [], every = Math.max(1, Math.floor(this.run.rows / 2000));
    for (const one of arrows) {
      for (let row = 0; row < this.run.rows; row += every) {
        const size = this.run.norm(one.arrow.force, row);
        if (Number.isFinite(size) && size > 0) sizes.push(size);
      }
    }
    sizes.sort((a, b) => a - b);
    return sizes.length === 0 ? [0, 0] : [sizes[Math.floor(0.95 * (sizes.length - 1))], sizes.at(-1)];
  }
  // The arrows at both ends of a rod cross where they are longer than half of it. How long they usually are, in lengths
  // of the rod, where they are longest.
  overlap(which, scale) {
    const ends = new Map(this.run.constraints.filter((c) => c.shape === "rod").map((c) => [c, []]));
    for (const one of this.all) if (which(one)) ends.get(one.constraint)?.push(one);
    const both = [...ends].filter(([, arrows]) => arrows.length === 2);
    return Math.max(0.5, ...both.map(([rod, arrows]) => (scale * this.sizesOf(arrows)[0]) / rod.sizes[0]));
  }
  update(frame) {
    for (const one of this.all) {
      one.update(frame, one.arrow.torque ? this.torqueScale : this.forceScale, this.thick);
      const selected = this.selected === one.constraint;
      if (!this.visible || this.hidden.has(one.constraint.index) || (one.opposite && !selected)) one.group.visible = false;
      const unique = this.unique(one.constraint, frame.row);
      one.material.opacity = (this.selected && !selected ? 0.35 : 1) * (unique ? 1 : 0.45);
    }
  }
  // Lets a box grow to the tips, but of the few that are much longer than all others.
  reach(frame, box) {
    this.update(frame);
    for (const one of this.all) {
      if (one.group.visible && one.tip.distanceTo(one.tail) < 0.34 * this.size) box.expandByPoint(one.tip);
    }
  }
  unique(constraint, row) {
    return !constraint.unique || constraint.unique.every((column) => this.run.at(column, row) !== 0);
  }
  // Those that are not determined, with their places.
  undetermined() {
    return this.visible ? this.all.filter((one) => !one.known && !one.arrow.torque) : [];
  }
}
