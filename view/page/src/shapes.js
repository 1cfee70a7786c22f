// What a picture is made of: each shape makes its objects once and places them in each frame.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CatmullRomCurve3, CircleGeometry, ConeGeometry, CylinderGeometry,
  EdgesGeometry, Group, LineSegments, Matrix4, Mesh, OctahedronGeometry, PlaneGeometry, SphereGeometry, TorusGeometry,
  TubeGeometry, Vector3,
} from "three";

import { Frame } from "./run.js";

const up = new Vector3(0, 1, 0), forward = new Vector3(0, 0, 1);
const tubeGeometry = new CylinderGeometry(1, 1, 1, 14);
const ballGeometry = new SphereGeometry(1, 24, 16);
const boxGeometry = new BoxGeometry(1, 1, 1);
const boxEdges = new EdgesGeometry(boxGeometry);
const ringGeometry = new TorusGeometry(1, 0.16, 10, 40);
const helix = (() => {
  const points = [], coils = 7, ends = 0.08;
  const long = 12; // of its radius, at which its wire is round
  points.push(new Vector3(0, -long / 2, 0));
  for (let i = 0; i <= coils * 16; ++i) {
    const s = i / (coils * 16), phi = 2 * Math.PI * coils * s;
    points.push(new Vector3(Math.cos(phi), long * (-0.5 + ends + s * (1 - 2 * ends)), Math.sin(phi)));
  }
  points.push(new Vector3(0, long / 2, 0));
  return new TubeGeometry(new CatmullRomCurve3(points), coils * 24, 0.16, 6).scale(1, 1 / long, 1);
})();

export const vector = (p) => new Vector3(p[0], p[1], p[2]);

// Puts an object of unit length along y between two places.
export function span(object, a, b, radius) {
  const d = b.clone().sub(a), length = d.length();
  object.position.copy(a).addScaledVector(d, 0.5);
  object.quaternion.setFromUnitVectors(up, length > 0 ? d.divideScalar(length) : up);
  object.scale.set(radius, Math.max(length, 1e-12), radius);
}

export class Shapes {
  // `look` has the materials, `size` the size of the scene.
  constructor(run, look, size, box) {
    this.run = run;
    this.look = look;
    this.size = size;
    this.box = box;
    this.root = new Group();
    this.updates = [];
    this.thick = 0.007 * size;
    this.flat = run.dimension === 2;
  }
  update(frame) {
    for (const f of this.updates) f(frame);
  }

  tube(material, geometry = tubeGeometry) {
    const mesh = new Mesh(geometry, material);
    this.root.add(mesh);
    return mesh;
  }
  tubeBetween(from, to, material, radius) {
    const mesh = this.tube(material);
    this.updates.push((frame) => span(mesh, vector(from(frame)), vector(to(frame)), radius));
    return mesh;
  }
  ballAt(point, material, radius) {
    const mesh = this.tube(material, ballGeometry);
    mesh.scale.setScalar(radius);
    this.updates.push((frame) => mesh.position.copy(vector(point(frame))));
    return mesh;
  }
  ringAt(point, material, radius, axis = null) {
    const mesh = this.tube(material, ringGeometry);
    mesh.scale.setScalar(radius);
    this.updates.push((frame) => {
      mesh.position.copy(vector(point(frame)));
      if (axis) mesh.quaternion.setFromUnitVectors(forward, vector(axis(frame)).normalize());
    });
    return mesh;
  }

  particles() {
    const run = this.run, inBody = new Set(run.bodies.flatMap((body) => body.particles));
    const heaviest = Math.max(...run.particles.map((p) => p.mass), 1e-300);
    const rods = run.constraints.filter((c) => c.shape === "rod").map((c) => c.sizes[0]);
    const largest = Math.min(0.027 * this.size, 0.22 * Math.min(Infinity, ...rods));
    // A wheel is drawn as such, not as the particle in its centre.
    const centres = new Set(run.constraints.filter((c) => ["wheel", "upright wheel", "disk"].includes(c.shape))
      .map((c) => c.points[0].coordinates?.[0]));
    run.particles.forEach((particle, index) => {
      if (inBody.has(index)) return;
      const centre = centres.has(particle.coordinate);
      const radius = centre ? 1.5 * this.thick : Math.max(0.4, Math.cbrt(particle.mass / heaviest)) * largest;
      const coordinates = particle.position.map((_, k) => particle.coordinate + k);
      this.ballAt((frame) => frame.place({ coordinates }), this.look.mass, radius);
    });
  }

  bodies() {
    for (const body of this.run.bodies) {
      const group = new Group();
      group.matrixAutoUpdate = false;
      group.add(new Mesh(boxGeometry, this.look.body), new LineSegments(boxEdges, this.look.edge));
      this.root.add(group);
      const centre = body.places[0], thin = new Vector3();
      this.updates.push((frame) => {
        const axes = body.axes.map((axis) => vector(frame.place(axis)).multiplyScalar(2));
        // What has no extent in some direction is drawn as thick as a rod.
        while (axes.length < 3) {
          if (axes.length === 0) axes.push(new Vector3(2 * this.thick, 0, 0));
          else if (axes.length === 1) {
            thin.set(-axes[0].y, axes[0].x, 0);
            if (thin.lengthSq() < 1e-24 * axes[0].lengthSq()) thin.set(1, 0, 0);
            axes.push(thin.clone().setLength(3 * this.thick));
          } else axes.push(axes[0].clone().cross(axes[1]).setLength(3 * this.thick));
        }
        if (axes[0].clone().cross(axes[1]).dot(axes[2]) < 0) axes[2].negate();
        group.matrix.makeBasis(...axes).setPosition(vector(frame.place(centre)));
        group.matrixWorldNeedsUpdate = true;
      });
      const seen = new Set(), first = new Frame(this.run);
      const inside = (touched) => {
        const r = vector(first.place(touched)).sub(vector(first.place(centre)));
        for (const axis of body.axes) {
          const half = vector(first.place(axis)), along = r.dot(half) / half.lengthSq();
          if (Math.abs(along) > 1.001) return false;
          r.addScaledVector(half, -along);
        }
        return r.length() < 3 * this.thick;
      };
      for (const touched of body.touched) {
        if (inside(touched)) continue;
        const key = JSON.stringify(touched.map.map((x) => x.toPrecision(8)));
        if (seen.has(key)) continue;
        seen.add(key);
        this.tubeBetween((f) => f.place(centre), (f) => f.place(touched), this.look.arm, 0.7 * this.thick);
      }
    }
  }

  // All of a constraint or force.
  element(element) {
    const outer = this.root, group = new Group();
    outer.add(group);
    this.root = group;
    const make = this[element.shape.replace(/ (.)/, (_, c) => c.toUpperCase())];
    const places = (element.points ?? []).filter((p) => !p.direction && p.rotor === undefined);
    if (typeof make === "function") make.call(this, element, places.map((p) => (frame) => frame.place(p)), places);
    // What an event takes out of force is not there any more.
    if (element.released !== undefined) {
      this.updates.push((f) => (group.visible = this.run.at(element.released, f.row) === 0));
    }
    this.root = outer;
    if (["rod", "string", "spring", "damper", "ball", "lines"].includes(element.shape)) this.supports(places);
    if (element.oneSided !== undefined && places.length > 0 && element.shape !== "string" && element.shape !== "rod") {
      this.contact(element, places[0]);
    }
  }
  none() {}
  lines(element, places) {
    for (let k = 1; k < places.length; ++k) {
      this.tubeBetween(places[k - 1], places[k], this.look.link, 0.5 * this.thick);
    }
  }
  rod(element, places) {
    if (element.oneSided === -1) return this.string(element, places);
    this.tubeBetween(places[0], places[1], this.look.rod, this.thick);
  }
  spring(element, places) {
    const mesh = this.tube(this.look.spring, helix);
    this.updates.push((f) => span(mesh, vector(places[0](f)), vector(places[1](f)), 0.022 * this.size));
  }
  damper(element, places) {
    this.tubeBetween(places[0], places[1], this.look.link, 0.5 * this.thick);
    const part = (s) => (f) => {
      const a = vector(places[0](f)), b = vector(places[1](f));
      return a.lerp(b, s).toArray();
    };
    this.tubeBetween(part(0.35), part(0.65), this.look.spring, 2 * this.thick);
  }
  // Slack, it hangs as a parabola of its length.
  string(element, places) {
    const pieces = 18, length = element.sizes[0];
    const meshes = Array.from({ length: pieces }, () => this.tube(this.look.link));
    this.updates.push((f) => {
      const a = vector(places[0](f)), b = vector(places[1](f)), d = a.distanceTo(b);
      const sag = d < length * (1 - 1e-6) ? Math.sqrt((3 / 8) * length * (length - d)) : 0;
      const down = this.flat ? new Vector3(0, -1, 0) : new Vector3(0, 0, -1);
      const point = (s) => a.clone().lerp(b, s).addScaledVector(down, 4 * sag * s * (1 - s));
      meshes.forEach((mesh, k) => {
        mesh.visible = sag > 0 || k === 0;
        if (sag > 0) span(mesh, point(k / pieces), point((k + 1) / pieces), 0.45 * this.thick);
        else span(mesh, a, b, 0.45 * this.thick);
      });
    });
  }
  ball(element, places) {
    if (this.flat) this.ringAt(places.at(-1), this.look.joint, 1.7 * this.thick);
    else this.ballAt(places.at(-1), this.look.joint, 2 * this.thick);
  }
  axisOf(element) {
    const axis = element.points.filter((p) => p.direction).at(-1);
    return axis ? (frame) => vector(frame.place(axis)).normalize() : null;
  }
  hinge(element, places) {
    if (this.flat) return this.ringAt(places.at(-1), this.look.joint, 1.9 * this.thick);
    const axis = this.axisOf(element), half = 0.035 * this.size;
    const end = (sign) => (f) => vector(places.at(-1)(f)).addScaledVector(axis(f), sign * half).toArray();
    this.tubeBetween(end(-1), end(1), this.look.joint, 1.7 * this.thick);
  }
  slider(element, places) {
    const axis = this.axisOf(element), half = 0.045 * this.size;
    const end = (sign, long) => (f) =>
      vector(places.at(-1)(f)).addScaledVector(axis(f), sign * long * half).toArray();
    this.tubeBetween(end(-1, 1), end(1, 1), this.look.joint, 2.2 * this.thick);
    this.tubeBetween(end(-1, 4), end(1, 4), this.look.link, 0.6 * this.thick);
  }
  weld(element, places) {
    const mesh = this.tube(this.look.joint, boxGeometry);
    mesh.scale.setScalar(4 * this.thick);
    this.updates.push((f) => mesh.position.copy(vector(places.at(-1)(f))));
  }
  wheel(element, places) {
    const radius = element.sizes[0], rotor = element.points.find((p) => p.rotor !== undefined);
    this.circle(places[0], radius, () => [new Vector3(1, 0, 0), new Vector3(0, 1, 0)], (f) => f.angle(rotor));
    this.track(element, places);
  }
  // A circle with a spoke at an angle from the first of two directions to the second.
  circle(centre, radius, directions, angle) {
    const rim = this.tube(this.look.rod, new TorusGeometry(radius, this.thick, 10, 72));
    const face = this.tube(this.look.surface, new CircleGeometry(radius, 72));
    const basis = new Matrix4();
    this.updates.push((f) => {
      const [x, y] = directions(f);
      basis.makeBasis(x, y, x.clone().cross(y));
      for (const mesh of [rim, face]) {
        mesh.position.copy(vector(centre(f)));
        mesh.quaternion.setFromRotationMatrix(basis);
      }
    });
    const end = (sign) => (f) => {
      const [x, y] = directions(f), phi = angle(f), c = vector(centre(f));
      return c.addScaledVector(x, sign * radius * Math.cos(phi)).addScaledVector(y, sign * radius * Math.sin(phi));
    };
    this.tubeBetween((f) => centre(f), (f) => end(1)(f).toArray(), this.look.rod, 0.8 * this.thick);
    this.tubeBetween((f) => centre(f), (f) => end(-1)(f).toArray(), this.look.link, 0.5 * this.thick);
    this.ballAt((f) => end(1)(f).toArray(), this.look.mark, 2 * this.thick);
  }
  uprightWheel(element, places) {
    const radius = element.sizes[0], [heading, spin] = element.points.filter((p) => p.rotor !== undefined);
    const above = (f) => {
      const c = places[0](f);
      return [c[0], c[1], radius];
    };
    const ahead = (f) => new Vector3(Math.cos(f.angle(heading)), Math.sin(f.angle(heading)), 0);
    // It turns forward: its upper rim goes ahead, from z towards the heading.
    this.circle(above, radius, (f) => [new Vector3(0, 0, 1), ahead(f)], (f) => f.angle(spin));
    this.ballAt((f) => places[0](f), this.look.joint, 1.2 * this.thick);
  }
  gear(element, places) {
    const turned = element.points.filter((p) => p.direction);
    places.forEach((centre, k) => {
      const x = turned[2 * k], y = turned[2 * k + 1];
      this.circle(centre, element.sizes[k], (f) => [x, y].map((p) => vector(f.place(p)).normalize()), () => 0);
    });
  }
  disk(element, places) {
    const directions = (f) => {
      const c = vector(places[0](f)), x = vector(places[1](f)).sub(c).normalize();
      const y = vector(places[2](f)).sub(c);
      return [x, y.addScaledVector(x, -y.dot(x)).normalize()];
    };
    if (element.kind !== "DiskRolling") this.floor(vector(element.sizes.slice(1, 4)), vector(element.sizes.slice(4, 7)), this.root);
    else return;
    this.circle(places[0], element.sizes[0], directions, () => 0);
  }
  track(element, places) {
    const [a, b] = places.slice(1);
    const far = (sign) => (f) => {
      const p = vector(a(f)), q = vector(b(f)), e = q.clone().sub(p).normalize();
      const middle = this.box.getCenter(new Vector3());
      const foot = p.clone().addScaledVector(e, middle.sub(p).dot(e));
      return foot.addScaledVector(e, sign * 0.75 * this.size).toArray();
    };
    this.tubeBetween(far(-1), far(1), this.look.ground, 0.5 * this.thick);
  }

  // Curves and surfaces, which a motion may carry.
  surface(element) {
    const group = new Group();
    this.root.add(group);
    if (element.pose) {
      group.matrixAutoUpdate = false;
      this.updates.push((f) => {
        group.matrix.set(...element.pose.map((column) => f.value(column)), 0, 0, 0, 1);
        group.matrixWorldNeedsUpdate = true;
      });
    }
    return group;
  }
  floor(point, normal, group) {
    const n = normal.clone().normalize(), centre = this.box.getCenter(new Vector3());
    centre.addScaledVector(n, point.clone().sub(centre).dot(n));
    const side = 1.05 * this.size, cells = 10;
    const patch = new Group();
    patch.add(new Mesh(new PlaneGeometry(side, side), this.look.floor));
    const lines = [];
    for (let k = 0; k <= cells; ++k) {
      const s = side * (k / cells - 0.5);
      lines.push(s, -side / 2, 0, s, side / 2, 0, -side / 2, s, 0, side / 2, s, 0);
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(lines), 3));
    patch.add(new LineSegments(geometry, this.look.grid));
    patch.position.copy(centre);
    patch.quaternion.setFromUnitVectors(forward, n);
    group.add(patch);
  }
  plane(element) {
    const s = element.sizes, group = this.surface(element);
    if (!this.flat) return this.floor(vector(s.slice(0, 3)), vector(s.slice(3, 6)), group);
    const n = new Vector3(s[2], s[3], 0).normalize(), along = new Vector3(-n.y, n.x, 0);
    const foot = new Vector3(s[0], s[1], 0), centre = this.box.getCenter(new Vector3());
    foot.addScaledVector(along, centre.sub(foot).dot(along));
    this.hatchedLine(group, foot, along, n);
  }
  // A line whose other side is hatched.
  hatchedLine(group, foot, along, n) {
    const half = 0.75 * this.size, line = new Mesh(tubeGeometry, this.look.ground);
    span(line, foot.clone().addScaledVector(along, -half), foot.clone().addScaledVector(along, half), 0.5 * this.thick);
    group.add(line);
    const strokes = [], step = 0.03 * this.size;
    for (let s = -half; s <= half; s += step) {
      const a = foot.clone().addScaledVector(along, s);
      const b = a.clone().addScaledVector(along, -0.6 * step).addScaledVector(n, -0.6 * step);
      strokes.push(...a.toArray(), ...b.toArray());
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(strokes), 3));
    group.add(new LineSegments(geometry, this.look.grid));
  }
  sphere(element) {
    const s = element.sizes, group = this.surface(element), D = this.run.dimension, radius = s[D];
    const mesh = this.flat ? new Mesh(new TorusGeometry(radius, 0.5 * this.thick, 8, 120), this.look.ground)
                           : new Mesh(new SphereGeometry(radius, 48, 32), this.look.surface);
    mesh.position.fromArray(this.flat ? [s[0], s[1], 0] : s);
    group.add(mesh);
    if (!this.flat) {
      for (const turn of [[Math.PI / 2, 0, 0], [0, 0, 0], [0, Math.PI / 2, 0]]) {
        const rim = new Mesh(new TorusGeometry(radius, 0.2 * this.thick, 6, 96), this.look.outline);
        rim.position.copy(mesh.position);
        rim.rotation.set(...turn);
        group.add(rim);
      }
    }
  }
  // A surface of revolution about an axis through a point, with radii r0, r1 at heights h0, h1.
  revolved(group, point, axis, h0, r0, h1, r1) {
    const mesh = new Mesh(new CylinderGeometry(r1, r0, h1 - h0, 72, 1, true), this.look.surface);
    mesh.position.copy(point).addScaledVector(axis, (h0 + h1) / 2);
    mesh.quaternion.setFromUnitVectors(up, axis);
    group.add(mesh);
    for (const [h, r] of [[h0, r0], [h1, r1], [(h0 + h1) / 2, (r0 + r1) / 2]]) {
      if (r < 1e-9 * this.size) continue;
      const rim = new Mesh(new TorusGeometry(r, 0.25 * this.thick, 6, 96), this.look.outline);
      rim.position.copy(point).addScaledVector(axis, h);
      rim.quaternion.setFromUnitVectors(forward, axis);
      group.add(rim);
    }
  }
  // Between which heights along an axis the motion is.
  heights(point, axis) {
    const corners = [], { min, max } = this.box;
    for (const x of [min.x, max.x]) for (const y of [min.y, max.y]) for (const z of [min.z, max.z]) {
      corners.push(new Vector3(x, y, z).sub(point).dot(axis));
    }
    return [Math.min(...corners), Math.max(...corners)];
  }
  cylinder(element) {
    const s = element.sizes, point = vector(s), axis = vector(s.slice(3)).normalize();
    const [low, high] = this.heights(point, axis), more = 0.1 * (high - low) + 0.05 * this.size;
    this.revolved(this.surface(element), point, axis, low - more, s[6], high + more, s[6]);
  }
  cone(element) {
    const s = element.sizes, apex = vector(s), axis = vector(s.slice(3)).normalize();
    const high = Math.max(this.heights(apex, axis)[1], 0.1 * this.size) * 1.12, slope = Math.tan(s[6]);
    this.revolved(this.surface(element), apex, axis, 0, 0, high, high * slope);
  }
  axis(element) {
    const s = element.sizes, point = vector(s), axis = vector(s.slice(3)).normalize();
    const key = s.join();
    this.axes ??= new Set();
    if (this.axes.has(key)) return;
    this.axes.add(key);
    const [low, high] = this.heights(point, axis), more = 0.15 * this.size;
    this.dashed(point.clone().addScaledVector(axis, low - more), point.clone().addScaledVector(axis, high + more));
  }
  dashed(a, b) {
    const count = 25;
    for (let k = 0; k < count; k += 2) {
      const mesh = this.tube(this.look.ground);
      span(mesh, a.clone().lerp(b, k / count), a.clone().lerp(b, (k + 1) / count), 0.35 * this.thick);
    }
  }
  // Where a user's own equation is 0: a band along its segments, or its triangles.
  implicit(element) {
    if (!element.levelSet) return;
    const group = this.surface(element), places = element.levelSet, numbers = [];
    if (this.flat) {
      const half = 0.5 * this.thick;
      for (let k = 0; k < places.length; k += 4) {
        const [ax, ay, bx, by] = places.slice(k, k + 4), d = Math.hypot(bx - ax, by - ay) || 1;
        const nx = (-(by - ay) / d) * half, ny = ((bx - ax) / d) * half;
        numbers.push(ax + nx, ay + ny, 0, ax - nx, ay - ny, 0, bx + nx, by + ny, 0);
        numbers.push(bx + nx, by + ny, 0, ax - nx, ay - ny, 0, bx - nx, by - ny, 0);
      }
    } else numbers.push(...places);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3));
    geometry.computeVertexNormals();
    group.add(new Mesh(geometry, this.flat ? this.look.groundFlat : this.look.surface));
  }

  // A small support for each fixed place, a ring for each driven one.
  supports(points) {
    this.supported ??= new Set();
    for (const point of points) {
      if (!point.at && !point.path) continue;
      const key = (point.at ?? point.path).join();
      if (this.supported.has(key)) continue;
      this.supported.add(key);
      const size = 0.03 * this.size;
      if (point.path) {
        this.ringAt((f) => f.place(point), this.look.mark, 2.4 * this.thick);
      } else if (this.flat) {
        const mesh = this.tube(this.look.ground, new ConeGeometry(0.75 * size, 1.2 * size, 3));
        mesh.geometry.rotateY(Math.PI / 6);
        mesh.position.set(point.at[0], point.at[1] + 0.6 * size, -2 * this.thick);
        mesh.rotation.z = Math.PI;
        mesh.scale.z = 0.1;
      } else {
        const mesh = this.tube(this.look.ground, new OctahedronGeometry(0.6 * size));
        mesh.position.fromArray(point.at);
      }
    }
  }
  // Filled while it is closed.
  contact(element, point) {
    const open = this.ringAt((f) => f.place(point), this.look.joint, 1.8 * this.thick);
    const closed = this.ballAt((f) => f.place(point), this.look.mark, 1.8 * this.thick);
    this.updates.push((f) => {
      closed.visible = this.run.at(element.lambda[0], f.row) !== 0;
      open.visible = !closed.visible;
    });
  }
}
