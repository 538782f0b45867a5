// Pictures of scenes that move: marks in the plane, from the columns of a row and the sizes of the
// scene. A picture is a function of (look, row) that returns marks; `look` has the inputs, what the
// core says of the scene, and the view; `row(name, k)` is a column, of the k-th of several rows.
import { svg } from "./dom.js";

const mark = (type, points, style) => ({ type, points, style });
const line = (points, style = "body") => mark("line", points, style);
const arrow = (from, to, style) => mark("arrow", [from, to], style);
const fill = (points, style = "body") => mark("fill", points, style);
const disc = (x, y, r, style = "body") => ({ type: "disc", x, y, r, style });
const turned = (x, y, r, angle) => [x + r * Math.cos(angle), y + r * Math.sin(angle)];

// An arc with an arrow at its end: the sense of a torque or of a turn.
const sense = (x, y, r, value, style, from = 0.6) => {
  if (!value || !Number.isFinite(value)) return [];
  const sweep = Math.sign(value) * 1.5, points = [];
  for (let k = 0; k <= 16; k++) points.push(turned(x, y, r, from + sweep * k / 16));
  return [mark("arrow", points, style)];
};

// A wheel with spokes, one of them marked.
const wheel = (x, y, r, angle) => [
  disc(x, y, r),
  ...[1, 2, 3, 4, 5].map((k) => {
    const at = angle + k * Math.PI / 3;
    return line([turned(x, y, 0.12 * r, at), turned(x, y, 0.94 * r, at)], "shaft");
  }),
  line([[x, y], turned(x, y, r, angle)], "marked"), disc(x, y, 0.08 * r, "shaft")
];

const box = (x, y, width, height) =>
  [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];

function drawWheel(look, row) {
  return { box: [-1.5, 1.5, -1.5, 1.5], marks: [
    ...wheel(0, 0, 1, row("theta_rad")),
    ...sense(0, 0, 1.32, row("applied_torque_n_m"), "torque"),
    ...sense(0, 0, 1.16, row("omega_rad_per_s"), "speed", 2.2)
  ] };
}

function drawPendulum(look, row) {
  const theta = row("theta_rad"), at = [Math.sin(theta), -Math.cos(theta)];
  const ghost = [];
  for (let k = 0; k <= 32; k++) ghost.push(turned(0, 0, 1, -Math.PI / 2 + theta * k / 32));
  return { box: [-1.3, 1.3, -1.3, 1.3], marks: [
    line([[0, 0], [0, -1.1]], "thin"), line(ghost, "thin"), line([[0, 0], at], "marked"),
    fill(box(-0.2, 0, 0.4, 0.07), "fixed"), disc(0, 0, 0.04, "shaft"), disc(...at, 0.11),
    arrow(at, [at[0], at[1] - 0.3], "weight"),
    ...(row("omega_rad_per_s") ? [arrow(at, [
      at[0] + 0.45 * Math.cos(theta) * look.relative("omega_rad_per_s", row),
      at[1] + 0.45 * Math.sin(theta) * look.relative("omega_rad_per_s", row)
    ], "speed")] : [])
  ] };
}

function drawHanging(look, row) {
  const first = row("height_1_m") ?? row("height_m"), second = row("height_2_m");
  const span = look.largest(["height_1_m", "height_m", "height_2_m"]) || 1;
  const place = (height) => -1.15 + 0.75 * height / span;
  const weight = (x, height) => [
    line([[x, 0], [x, place(height)]], "spring"),
    fill(box(x - 0.16, place(height) - 0.3, 0.32, 0.3))
  ];
  return { box: [-1.3, 1.3, -2.3, 0.7], marks: [
    ...weight(-0.5, first ?? 0), ...(second === undefined ? [] : weight(0.5, second)),
    ...wheel(0, 0, 0.5, row("theta_rad"))
  ] };
}

// Rotors in a row, each seen along the shaft.
function drawRotors(look, row) {
  const n = look.said.rows_per_time, marks = [], locked = look.has("locked");
  marks.push(line([[0, 0], [2.6 * (n - 1), 0]], "shaft"));
  for (let k = 0; k < n; k++) {
    marks.push(...wheel(2.6 * k, 0, 1, row("theta_rad", k)));
    marks.push(...sense(2.6 * k, 0, 1.16, row("omega_rad_per_s", k), "speed", 2.2));
    if (locked && k < n - 1 && row("locked", k) === 1) {
      marks.push(line([[2.6 * k + 1, 0], [2.6 * k + 1.6, 0]], "marked"));
    }
  }
  return { box: [-1.4, 2.6 * (n - 1) + 1.4, -1.5, 1.5], marks };
}

function drawClutch(look, row) {
  const marks = [line([[0, 0], [2.6, 0]], row("locked") === 1 ? "marked" : "thin")];
  [1, 2].forEach((k, i) => {
    marks.push(...wheel(2.6 * i, 0, 1, row(`theta_${k}_rad`)));
    marks.push(...sense(2.6 * i, 0, 1.16, row(`omega_${k}_rad_per_s`), "speed", 2.2));
  });
  return { box: [-1.4, 4, -1.5, 1.5], marks };
}

// The slope to scale; the picture follows the body.
function drawIncline(look, row) {
  const angle = -(look.number("incline_angle_deg") ?? 0) * Math.PI / 180;
  const radius = look.radius ?? 1, x = row("x_m") / radius;
  const along = (s, up = 0) =>
    [s * Math.cos(angle) - up * Math.sin(angle), s * Math.sin(angle) + up * Math.cos(angle)];
  const centre = along(x, 1), shift = ([a, b]) => [a - centre[0], b - centre[1]];
  const marks = [], from = x - 6, to = x + 6;
  marks.push(fill([along(from), along(to), along(to, -0.35), along(from, -0.35)].map(shift),
    "fixed"));
  for (let s = Math.ceil(from); s <= to; s++) {
    marks.push(line([along(s), along(s, -0.2)].map(shift), s === 0 ? "marked" : "shaft"));
  }
  // Down the slope is to the right: a positive angle turns clockwise.
  marks.push(...wheel(0, 0, 1, angle - row("theta_rad")));
  const speed = 1.6 * look.relative("v_m_per_s", row);
  if (speed) marks.push(arrow([0, 0], along(speed), "speed"));
  const friction = -1.2 * look.relative("friction_force_n", row) *
    -1;
  if (friction) {
    marks.push(arrow(shift(along(x)), shift(along(x + friction)), "resistance"));
  }
  marks.push(arrow([0, 0], [0, -0.9], "weight"));
  return { box: [-3, 3, -2.2, 2.2], marks };
}

function drawHoop(look, row) {
  const at = turned(0, 0, 1, row("theta_rad") - Math.PI / 2);
  return { box: [-1.4, 1.4, -1.4, 1.4], marks: [
    line([[0, -1.35], [0, 1.35]], "thin"),
    line(Array.from({ length: 65 }, (_, k) => turned(0, 0, 1, k * Math.PI / 32)), "body"),
    arrow(at, [at[0], at[1] - 0.3], "weight"), disc(...at, 0.09, "torque"),
    ...sense(0, 1.18, 0.12, look.number("hoop_omega_rad_per_s"), "speed")
  ] };
}

function drawChain(look, row) {
  const n = look.said.rows_per_time, lengths = look.numbers("length_m", n);
  const marks = [fill(box(-0.2, 0, 0.4, 0.06).map(([x, y]) => [x * look.size, y * look.size]),
    "fixed")];
  let at = [0, 0], size = lengths.reduce((a, b) => a + b, 0);
  for (let k = 0; k < n; k++) {
    const theta = row("theta_rad", k);
    const to = [at[0] + lengths[k] * Math.sin(theta), at[1] - lengths[k] * Math.cos(theta)];
    marks.push(line([at, to], "marked"), disc(...at, 0.035 * size, "shaft"),
      disc(...to, 0.05 * size));
    at = to;
  }
  return { box: [-1.1 * size, 1.1 * size, -1.1 * size, 1.1 * size], marks };
}

// ---- in space ----

const rotate = (q, v) => {
  const [w, x, y, z] = q;
  const t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])];
  return [
    v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
    v[2] + w * t[2] + x * t[1] - y * t[0]
  ];
};
const length = (v) => Math.hypot(...v);
const scaled = (v, f) => v.map((x) => x * f);
const added = (a, b) => a.map((x, i) => x + b[i]);

// Orthographic: right and up of the picture, and depth towards the reader.
const project = (view, [x, y, z]) => {
  const a = view.beside, b = view.above;
  const right = -Math.sin(a) * x + Math.cos(a) * y, away = Math.cos(a) * x + Math.sin(a) * y;
  return [right, -Math.sin(b) * away + Math.cos(b) * z, Math.cos(b) * away + Math.sin(b) * z];
};

const faces = [[0, 1], [0, -1], [1, 1], [1, -1], [2, 1], [2, -1]];

// The box with the body's moments, its angular velocity and momentum.
function drawSpace(look, row) {
  const q = ["qw", "qx", "qy", "qz"].map((name) => row(name));
  const axes = look.said.axes, lever = look.said.lever_n_m ?? [0, 0, 0];
  const toSpace = (v) => rotate(q, axes ? rotate(axes, v) : v);
  const hangs = length(lever) > 0, towards = hangs ? scaled(lever, 1 / length(lever)) : lever;
  const size = hangs ? 0.55 : 1, away = scaled(towards, hangs ? 1 : 0);
  const half = (look.said.box ?? [1, 1, 1]).map((x) => size * Math.max(x, 0.03));
  const see = (v) => project(look.view, v);
  const sides = [];
  for (const [axis, sign] of faces) {
    const others = [0, 1, 2].filter((k) => k !== axis);
    const corners = [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([a, b]) => {
      const v = [0, 0, 0];
      v[axis] = sign * half[axis];
      v[others[0]] = a * half[others[0]];
      v[others[1]] = b * half[others[1]];
      return see(added(toSpace(added(v, away)), [0, 0, 0]));
    });
    const depth = corners.reduce((sum, one) => sum + one[2], 0);
    sides.push({ depth, one: fill(corners, `side-${2 * axis + (sign > 0 ? 1 : 2)}`) });
  }
  sides.sort((a, b) => a.depth - b.depth);
  const marks = [];
  const floor = hangs ? -1.7 : -1.6, ring = hangs ? 0.8 : 1;
  marks.push(line(Array.from({ length: 65 }, (_, k) =>
    see([ring * Math.cos(k * Math.PI / 32), ring * Math.sin(k * Math.PI / 32), floor])), "thin"));
  if (hangs) {
    marks.push(line([see([0, 0, floor]), see([0, 0, 0])], "shaft"));
    marks.push(line([see([0, 0, 0]), see(toSpace(away))], "marked"));
  }
  marks.push(...sides.map((side) => side.one));
  const vector = (stem, end, style) => {
    const v = ["x", "y", "z"].map((k) => row(`${stem}_${k}${end}`));
    const largest = look.largestVector(stem, end);
    if (largest > 0 && v.every(Number.isFinite)) {
      marks.push(arrow(see([0, 0, 0]), see(scaled(v, 1.5 / largest)), style));
    }
  };
  vector("angular_momentum", "_kg_m2_per_s", "torque");
  vector("omega_space", "_rad_per_s", "speed");
  if (look.trail) {
    marks.push(line(look.trail(half).map((at) => see(at)), "path"));
  }
  return { box: [-1.9, 1.9, -1.9, 1.9], marks };
}

const pictures = {
  axle: (look) => look.said.constructor === "scene_pendulum" ? drawPendulum :
    look.said.constructor === "scene_hanging_mass" ? drawHanging : drawWheel,
  rotors: () => drawRotors, drive: () => drawRotors, clutch: () => drawClutch,
  incline: () => drawIncline, hoop: () => drawHoop, chain: () => drawChain,
  free: () => drawSpace, pivot: () => drawSpace
};

const inSpace = (constraint) => constraint === "free" || constraint === "pivot";

// The head of an arrow, in pixels.
const head = ([ax, ay], [bx, by], size) => {
  const d = Math.hypot(bx - ax, by - ay) || 1, ux = (bx - ax) / d, uy = (by - ay) / d;
  return `M${bx} ${by}L${bx - size * ux - size / 2 * uy} ${by - size * uy + size / 2 * ux}` +
    `L${bx - size * ux + size / 2 * uy} ${by - size * uy - size / 2 * ux}Z`;
};

// Draws marks into an svg of this size.
function paint(picture, { box: [x0, x1, y0, y1], marks }, width, height) {
  const unit = Math.min(width / (x1 - x0), height / (y1 - y0));
  const px = ([x, y]) => [
    Number((width / 2 + unit * (x - (x0 + x1) / 2)).toFixed(1)),
    Number((height / 2 - unit * (y - (y0 + y1) / 2)).toFixed(1))
  ];
  const path = (points) => "M" + points.map((one) => px(one).join(" ")).join("L");
  const parts = [];
  for (const one of marks) {
    if (one.type === "disc") {
      const [cx, cy] = px([one.x, one.y]);
      parts.push(svg("circle", { class: `fill ${one.style}`, cx, cy, r: unit * one.r }));
    } else if (one.type === "fill") {
      parts.push(svg("path", { class: `fill ${one.style}`, d: path(one.points) + "Z" }));
    } else {
      parts.push(svg("path", { class: `stroke ${one.style}`, d: path(one.points) }));
      if (one.type === "arrow") {
        const [a, b] = one.points.slice(-2).map(px);
        if (Math.hypot(b[0] - a[0], b[1] - a[1]) > 0.5) {
          parts.push(svg("path", { class: `head ${one.style}`, d: head(a, b, 11) }));
        }
      }
    }
  }
  picture.setAttribute("width", width);
  picture.setAttribute("height", height);
  picture.replaceChildren(...parts);
}

export { inSpace, paint, pictures };
