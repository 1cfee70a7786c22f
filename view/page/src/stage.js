// The picture: a camera that one drags, lights, shapes, arrows and trails.
import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, GridHelper, Line,
  LineBasicMaterial, MeshBasicMaterial, MeshLambertMaterial, MOUSE, OrthographicCamera, PerspectiveCamera, Scene,
  TOUCH, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { Arrows } from "./arrows.js";
import { Frame } from "./run.js";
import { Shapes, vector } from "./shapes.js";

export const palettes = {
  light: {
    colours: ["#c2410c", "#0369a1", "#15803d", "#a21caf", "#b45309", "#0f766e", "#6d28d9", "#be123c"],
    background: "#ffffff", ink: "#1f2937", rod: "#64748b", mass: "#334155", body: "#94a3b8", arm: "#94a3b8",
    edge: "#475569", spring: "#7c8aa0", link: "#94a3b8", joint: "#475569", mark: "#eab308", ground: "#9aa5b4",
    grid: "#cbd5e1", surface: "#93b4d8", outline: "#8aa3c0", floor: "#e2e8f0",
  },
  dark: {
    colours: ["#fb923c", "#38bdf8", "#4ade80", "#e879f9", "#fbbf24", "#2dd4bf", "#a78bfa", "#fb7185"],
    background: "#0f151d", ink: "#e5e9f0", rod: "#94a3b8", mass: "#d7dee8", body: "#64748b", arm: "#7c8aa0",
    edge: "#a8b3c4", spring: "#93a1b5", link: "#7c8aa0", joint: "#cbd5e1", mark: "#facc15", ground: "#6b7788",
    grid: "#334155", surface: "#3f5f86", outline: "#5d7fa8", floor: "#1e293b",
  },
};

// The materials of all shapes, which a change of theme recolours.
class Look {
  constructor(spatial) {
    const solid = (more = {}) => new MeshLambertMaterial(more);
    const clear = (opacity) => ({ transparent: true, opacity, side: DoubleSide, depthWrite: false });
    this.named = {
      rod: solid(), mass: solid(), spring: solid(), link: solid(), joint: solid(), mark: solid(), ground: solid(),
      arm: solid(), outline: solid(),
      groundFlat: new MeshBasicMaterial({ side: DoubleSide }),
      body: solid({ transparent: true, opacity: spatial ? 0.42 : 0.45, side: DoubleSide, depthWrite: false }),
      surface: solid(clear(0.22)), floor: new MeshBasicMaterial(clear(0.35)),
      edge: new LineBasicMaterial(), grid: new LineBasicMaterial(),
    };
    Object.assign(this, this.named);
    this.arrows = [];
  }
  arrow(colour) {
    const material = new MeshLambertMaterial({ transparent: true, depthTest: false, depthWrite: false });
    this.arrows.push({ material, colour });
    return material;
  }
  recolour(palette) {
    for (const [name, material] of Object.entries(this.named)) {
      material.color.set(palette[name === "groundFlat" ? "ground" : name]);
      if (material.emissive) material.emissive.set(palette[name] ?? palette.ground).multiplyScalar(0.18);
    }
    for (const { material, colour } of this.arrows) {
      material.color.set(palette.colours[colour % palette.colours.length]);
      material.emissive.copy(material.color).multiplyScalar(0.35);
    }
  }
}

// Everywhere the motion comes to, and the fixed places.
function boxOf(run) {
  const box = new Box3(), p = new Vector3(), every = Math.max(1, Math.floor(run.rows / 3000));
  for (const particle of run.particles) {
    for (let row = 0; row < run.rows; row += every) {
      p.set(...[0, 1, 2].map((k) => (k < run.dimension ? run.at(particle.position[k], row) : 0)));
      box.expandByPoint(p);
    }
  }
  const frame = new Frame(run);
  for (const row of [0, Math.floor(run.rows / 3), Math.floor((2 * run.rows) / 3), run.rows - 1]) {
    frame.set(run.times[row], row);
    const places = [...run.constraints, ...run.forces].flatMap((e) => e.points ?? []);
    for (const point of [...places, ...run.bodies.flatMap((b) => b.touched)]) {
      if (!point.direction && point.rotor === undefined) box.expandByPoint(vector(frame.place(point)));
    }
    for (const body of run.bodies) {
      const centre = vector(frame.place(body.places[0]));
      for (const axis of body.axes) {
        const half = vector(frame.place(axis));
        box.expandByPoint(centre.clone().add(half));
        box.expandByPoint(centre.clone().sub(half));
      }
    }
  }
  for (const element of run.constraints) {
    const radius = { wheel: 0, "upright wheel": 0, disk: 0, sphere: run.dimension }[element.shape];
    if (radius === undefined) continue;
    if (element.shape === "sphere" && !element.pose) {
      const s = element.sizes, c = new Vector3(s[0], s[1], run.dimension === 3 ? s[2] : 0);
      box.expandByPoint(c.clone().addScalar(s[radius]));
      box.expandByPoint(c.clone().addScalar(-s[radius]));
    } else if (element.shape !== "sphere") box.expandByScalar(element.sizes[0]);
  }
  if (run.dimension === 2 && !run.spatial) box.min.z = box.max.z = 0;
  return box;
}

export class Stage {
  constructor(run, canvas) {
    this.run = run;
    this.canvas = canvas;
    run.spatial ||= run.constraints.some((c) => c.shape === "upright wheel");
    this.box = boxOf(run);
    this.size = this.box.getSize(new Vector3()).length() || 1;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.scene = new Scene();
    this.look = new Look(run.spatial);
    this.shapes = new Shapes(run, this.look, this.size, this.box);
    this.arrows = new Arrows(run, this.look, this.size);
    this.scene.add(this.shapes.root, this.arrows.root);
    this.shapes.bodies();
    this.shapes.particles();
    this.elements();
    this.addLights();
    this.addTrails();
    this.addCamera();
    this.frame = new Frame(run);
    this.trailWindow = null;
  }
  // A particle on two planes runs on their line.
  elements() {
    const planes = new Map();
    for (const c of this.run.constraints) {
      if (c.shape !== "plane" || this.run.dimension !== 3 || c.pose || c.oneSided !== undefined) continue;
      const key = JSON.stringify(c.points);
      planes.set(key, [...(planes.get(key) ?? []), c]);
    }
    const onLine = new Set();
    for (const pair of planes.values()) {
      if (pair.length !== 2) continue;
      pair.forEach((c) => onLine.add(c));
      const [a, b] = pair.map((c) => ({ p: vector(c.sizes), n: vector(c.sizes.slice(3)).normalize() }));
      const e = a.n.clone().cross(b.n);
      const da = a.p.dot(a.n), db = b.p.dot(b.n), square = e.lengthSq();
      const point = b.n.clone().cross(e).multiplyScalar(da).add(e.clone().cross(a.n).multiplyScalar(db));
      this.shapes.axis({ sizes: [...point.divideScalar(square).toArray(), ...e.toArray()] });
    }
    for (const c of this.run.constraints) if (!onLine.has(c)) this.shapes.element(c);
    for (const f of this.run.forces) this.shapes.element(f);
    this.addGround();
  }
  // In space something to see depth against, unless a plane is there already.
  addGround() {
    const has = this.run.constraints.some((c) => c.shape === "disk" || (c.shape === "plane" && c.oneSided !== undefined));
    if (!this.run.spatial || has) return;
    this.ground = new GridHelper(1.2 * this.size, 10, "#888888", "#888888");
    this.ground.rotation.x = Math.PI / 2;
    const centre = this.box.getCenter(new Vector3());
    const upright = this.run.dimension === 2;
    this.ground.position.set(centre.x, centre.y, upright ? 0 : this.box.min.z - 0.06 * this.size);
    this.ground.material.transparent = true;
    this.ground.material.opacity = 0.28;
    this.scene.add(this.ground);
  }
  addLights() {
    this.scene.add(new AmbientLight("#ffffff", 1.5));
    const sun = new DirectionalLight("#ffffff", 1.9);
    this.sun = sun;
    this.scene.add(sun, sun.target);
  }
  addTrails() {
    this.trailsOn = this.run.particles.length <= 24;
    const inBody = new Set(this.run.bodies.flatMap((body) => body.particles));
    const points = [];
    this.run.particles.forEach((p, k) => {
      if (!inBody.has(k)) points.push({ coordinates: p.position.map((_, i) => p.coordinate + i) });
    });
    for (const body of this.run.bodies) points.push(body.places[0]);
    const most = 500;
    this.trails = points.slice(0, 60).map((point) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * most), 3));
      geometry.setAttribute("color", new BufferAttribute(new Float32Array(4 * most), 4));
      const line = new Line(geometry, new LineBasicMaterial({ vertexColors: true, transparent: true }));
      line.frustumCulled = false;
      this.scene.add(line);
      return { point, line, most };
    });
    this.past = new Frame(this.run);
  }
  updateTrails(window) {
    const { run } = this, until = this.frame.t, from = Math.max(run.start, until - window);
    const colour = new Color(this.palette.ink);
    const show = this.trailsOn && until > from;
    for (const trail of this.trails) trail.line.visible = show;
    if (!show) return;
    const firstRow = run.rowAt(from), rows = this.frame.row - firstRow;
    const every = Math.max(1, Math.ceil(rows / 440));
    // Rows of fixed numbers, so that a trail does not tremble; between coarse ones some instants more.
    const between = rows < 60 ? Math.min(8, Math.floor(440 / Math.max(1, rows))) : 1;
    const instants = [];
    for (let row = Math.ceil(firstRow / every) * every; row < this.frame.row + 1 && instants.length < 480; row += every) {
      for (let k = 0; k < between; ++k) {
        const next = Math.min(row + 1, run.rows - 1);
        const t = run.times[row] + ((run.times[next] - run.times[row]) * k) / between;
        if (t <= until && t >= from) instants.push(k === 0 ? [t, row] : [t, null]);
      }
    }
    instants.push([until, this.frame.part > 0 ? null : this.frame.row]);
    instants.forEach(([t, row], k) => {
      this.past.set(t, row);
      for (const { point, line } of this.trails) {
        const place = this.past.place(point), strength = (k + 1) / instants.length;
        line.geometry.attributes.position.setXYZ(k, ...place);
        line.geometry.attributes.color.setXYZW(k, colour.r, colour.g, colour.b, 0.6 * strength);
      }
    });
    for (const { line } of this.trails) {
      line.geometry.setDrawRange(0, instants.length);
      line.geometry.attributes.position.needsUpdate = line.geometry.attributes.color.needsUpdate = true;
    }
  }

  addCamera() {
    const flat = !this.run.spatial;
    this.camera = flat ? new OrthographicCamera(-1, 1, 1, -1, -100 * this.size, 100 * this.size)
                       : new PerspectiveCamera(32, 1, 0.01 * this.size, 100 * this.size);
    this.camera.up.set(0, flat ? 1 : 0, flat ? 0 : 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableRotate = !flat;
    this.controls.zoomToCursor = true;
    if (flat) {
      this.controls.mouseButtons = { LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
      this.controls.touches = { ONE: TOUCH.PAN, TWO: TOUCH.DOLLY_PAN };
    }
    this.controls.addEventListener("change", () => this.onView?.());
  }
  // All of the motion, and where its arrows reach.
  boxWithArrows() {
    const box = this.box.clone(), { rows, times } = this.run, every = Math.max(1, Math.floor(rows / 600));
    for (let row = 0; row < rows; row += every) {
      this.past.set(times[row], row);
      this.arrows.reach(this.past, box);
    }
    return box;
  }
  fit() {
    this.whole ??= this.boxWithArrows();
    const centre = this.whole.getCenter(new Vector3()), extent = this.whole.getSize(new Vector3());
    const width = this.canvas.clientWidth || 1, height = this.canvas.clientHeight || 1, aspect = width / height;
    const room = 0.06 * this.size;
    this.controls.target.copy(centre);
    if (this.camera.isOrthographicCamera) {
      const legend = 40 / Math.max(200, height); // the part of the height that it takes, at the bottom
      const half = Math.max((extent.y / 2 + room) / (1 - legend), (extent.x / 2 + room) / aspect);
      centre.y -= legend * half;
      this.controls.target.copy(centre);
      this.halfHeight = half;
      this.camera.zoom = 1;
      this.camera.position.set(centre.x, centre.y, this.size);
    } else {
      const radius = 0.5 * extent.length() + 0.5 * room;
      const angle = (this.camera.fov * Math.PI) / 360;
      const distance = radius / Math.sin(Math.min(angle, Math.atan(Math.tan(angle) * aspect)));
      const direction = new Vector3(1.0, -1.35, this.run.dimension === 2 ? 1.1 : 0.62).normalize();
      this.camera.position.copy(centre).addScaledVector(direction, distance);
    }
    this.resize();
    this.controls.update();
  }
  resize() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    const aspect = width / height;
    if (this.camera.isOrthographicCamera) {
      const half = this.halfHeight ?? this.size;
      Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half, bottom: -half });
    } else this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }
  setTheme(name) {
    this.palette = palettes[name];
    this.look.recolour(this.palette);
    this.renderer.setClearColor(this.palette.background);
  }
  // How many pixels a length has in the middle of the view.
  pixels(length) {
    const height = this.canvas.clientHeight;
    if (this.camera.isOrthographicCamera) return (length * height * this.camera.zoom) / (2 * this.halfHeight);
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (length * height) / (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360));
  }
  project(place) {
    const p = place.clone().project(this.camera);
    return [(0.5 + 0.5 * p.x) * this.canvas.clientWidth, (0.5 - 0.5 * p.y) * this.canvas.clientHeight];
  }
  // The arrow that is nearest to a place on the screen, within so many pixels.
  arrowAt(x, y, within) {
    let best = null, least = within;
    for (const one of this.arrows.all) {
      if (!one.group.visible) continue;
      const [ax, ay] = this.project(one.tail), [bx, by] = this.project(one.tip);
      const dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
      const s = square > 0 ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
      const distance = Math.hypot(x - ax - s * dx, y - ay - s * dy);
      if (distance < least) [best, least] = [one, distance];
    }
    return best;
  }
  set(t, row) {
    this.frame.set(t, row);
    this.shapes.update(this.frame);
    this.arrows.update(this.frame);
  }
  draw(trailWindow) {
    this.updateTrails(trailWindow);
    this.sun.position.copy(this.camera.position).add(new Vector3(-0.4, 0.6, 0.8).multiplyScalar(this.size));
    this.sun.target.position.copy(this.controls.target);
    this.renderer.render(this.scene, this.camera);
  }
}
