// Random scenes of every constructor that needs no law of the caller, from a seed.
export function generator(seed) {
  let state = BigInt(seed) * 2654435761n + 88172645463325252n & 0xFFFFFFFFFFFFFFFFn;
  const uniform = () => {
    state ^= state << 13n & 0xFFFFFFFFFFFFFFFFn;
    state ^= state >> 7n;
    state ^= state << 17n & 0xFFFFFFFFFFFFFFFFn;
    return Number(state >> 11n) / 2 ** 53;
  };
  const r = {
    uniform,
    between: (low, high) => low + (high - low) * uniform(),
    scale: (low, high) => low * (high / low) ** uniform(),
    sign: (x) => uniform() < 0.5 ? -x : x,
    chance: (p) => uniform() < p,
    whole: (low, high) => low + Math.floor((high - low + 1) * uniform()),
    of: (list) => list[Math.floor(list.length * uniform())],
    many: (n, make) => Array.from({ length: n }, make)
  };
  return r;
}

const body = (r) => r.of([
  () => ({ body_disk: { mass_kg: r.scale(0.1, 10), radius_m: r.scale(0.05, 2) } }),
  () => ({ body_cylinder: { mass_kg: r.scale(0.1, 10), radius_m: r.scale(0.05, 1),
    length_m: r.scale(0.05, 2) } }),
  () => ({ body_sphere: { mass_kg: r.scale(0.1, 10), radius_m: r.scale(0.05, 1) } }),
  () => ({ body_hoop: { mass_kg: r.scale(0.1, 10), radius_m: r.scale(0.05, 1) } })
])();
const moment = (r) => r.scale(0.05, 5);
const resistance = (r, names) => Object.fromEntries(names.filter(() => r.chance(0.6))
  .map((name) => [name, name === "static_n_m" ? 1 : r.scale(0.005, 0.5)]));
const knots = (r) => {
  const n = r.whole(2, 5), time_s = r.many(n, () => r.between(0, 6)).sort((a, b) => a - b);
  return { torque_knots: { time_s, torque_n_m: r.many(n, () => r.between(-2, 2)) } };
};
const torque = (r) => r.of([
  () => r.between(-3, 3), () => knots(r),
  () => ({ torque_motor: { stall_torque_n_m: r.scale(0.5, 5),
    no_load_omega_rad_per_s: r.scale(5, 80) } }),
  () => ({ torque_spring: { stiffness_n_m_per_rad: r.scale(0.1, 10) } }),
  () => ({ torque_sinusoid: { amplitude_n_m: r.scale(0.1, 3),
    angular_frequency_rad_per_s: r.scale(0.5, 8), phase_rad: r.between(-3, 3) } }),
  () => ({ torque_sum: { laws: [{ torque_spring: { stiffness_n_m_per_rad: r.scale(0.1, 10) } },
    r.between(-1, 1)] } })
])();
const moments = (r) => {
  const [a, b, c] = r.many(3, () => r.scale(0.1, 2));
  return [b + c, a + c, a + b];
};
const attitude = (r) => {
  const q = r.many(4, () => r.between(-1, 1)), size = Math.hypot(...q);
  return q.map((x) => x / size);
};

const makers = {
  scene_axle: (r) => ({ body: r.chance(0.5) ? moment(r) : body(r), torque: torque(r),
    resistance: resistance(r, ["viscous_n_m_s", "quadratic_n_m_s2", "coulomb_n_m"]),
    theta0_rad: r.between(-2, 2), omega0_rad_per_s: r.between(-20, 20) }),
  scene_pendulum: (r) => ({ body: body(r), distance_m: r.scale(0.05, 2),
    resistance: r.chance(0.5) ? resistance(r, ["viscous_n_m_s", "coulomb_n_m"]) : {},
    theta0_rad: r.between(-3, 3), omega0_rad_per_s: r.between(-3, 3) }),
  scene_hanging_mass: (r) => ({ body: body(r), mass_kg: r.scale(0.1, 5), radius_m: r.scale(0.05, 1),
    counter_mass_kg: r.chance(0.5) ? r.scale(0.1, 5) : 0,
    resistance: resistance(r, ["viscous_n_m_s"]) }),
  scene_gears: (r) => {
    const n = r.whole(2, 4);
    return { bodies: r.many(n, () => moment(r)),
      ratios: r.many(n - 1, () => r.sign(r.scale(0.3, 5))), efficiency: r.between(0.7, 1),
      torque: r.many(n, () => r.between(-2, 2)), omega0_rad_per_s: r.between(-10, 10) };
  },
  scene_rotors: (r) => {
    const n = r.whole(2, 5);
    return { bodies: r.many(n, () => moment(r)),
      stiffness_n_m_per_rad: r.many(n - 1, () => r.scale(1, 200)),
      damping_n_m_s: r.chance(0.5) ? r.scale(0.001, 0.3) : 0,
      torque: r.many(n, () => r.between(-2, 2)),
      omega0_rad_per_s: r.many(n, () => r.between(-5, 5)) };
  },
  scene_clutch: (r) => ({ body_1: moment(r), body_2: moment(r), capacity_n_m: r.scale(0.5, 10),
    torque: [r.between(-3, 3), r.chance(0.5) ? { torque_steps: { time_s: [0, 1, 2.5],
      torque_n_m: r.many(3, () => r.between(-3, 3)) } } : r.between(-3, 3)],
    omega0_rad_per_s: [r.between(-10, 10), r.between(-10, 10)] }),
  scene_drive: (r) => ({ bodies: [moment(r), moment(r)], couplings: r.of([
    () => ({ coupling_clutch: { capacity_n_m: r.scale(0.5, 10) } }),
    () => ({ coupling_shaft: { stiffness_n_m_per_rad: r.scale(5, 100),
      damping_n_m_s: r.scale(0.01, 0.5) } }),
    () => ({ coupling_gear: { ratio: r.sign(r.scale(0.3, 4)) } })
  ])(), torque: [torque(r), null], resistance: [{ viscous_n_m_s: r.scale(0.01, 0.3) }, null],
  omega0_rad_per_s: r.between(-5, 5) }),
  scene_incline: (r) => ({ body: body(r), incline_angle_deg: r.between(-40, 60),
    static_friction: r.scale(0.02, 1), kinetic_friction: r.scale(0.01, 0.02),
    rolling_arm_m: r.chance(0.3) ? r.scale(1e-4, 5e-3) : 0, v0_m_per_s: r.between(-3, 3),
    ...(r.chance(0.4) ? { resistance: { drag_n_s_per_m: r.scale(0.01, 1) } } : {}) }),
  scene_free: (r) => ({ body: moments(r), omega0_rad_per_s: r.many(3, () => r.between(-4, 4)),
    attitude0: attitude(r), ...r.of([
      () => ({}), () => ({}), () => ({ resistance: { damping_per_s: r.scale(0.01, 0.5) } }),
      () => ({ torque: r.many(3, () => r.between(-1, 1)), torque_axes: r.of(["body", "space"]) }),
      () => ({ rotors: { rotor: { axis: r.many(3, () => r.between(-1, 1)), moment_of_inertia_kg_m2: 0.02,
        omega_rad_per_s: r.between(-50, 50) } } })
    ])() }),
  scene_pivot: (r) => {
    const across = r.scale(0.02, 0.2);
    return { body: [across, across, across * r.between(0.3, 1.9)], mass_kg: r.scale(0.3, 3),
      centre_m: [0, 0, r.between(0.02, 0.2)],
      omega0_rad_per_s: [r.between(-1, 1), r.between(-1, 1), r.between(-80, 80)],
      attitude0: attitude(r) };
  },
  scene_hoop: (r) => ({ mass_kg: r.scale(0.05, 2), radius_m: r.scale(0.1, 2),
    hoop_omega_rad_per_s: r.between(-10, 10), theta0_rad: r.between(-2, 2),
    omega0_rad_per_s: r.between(-2, 2),
    ...(r.chance(0.4) ? { static_friction: r.scale(0.05, 0.5), kinetic_friction: 0.04 } : {}),
    ...(r.chance(0.4) ? { resistance: { drag_n_s_per_m: r.scale(0.01, 0.5) } } : {}) }),
  scene_chain: (r) => {
    const n = r.whole(1, 3);
    return { length_m: r.many(n, () => r.scale(0.2, 2)), mass_kg: r.many(n, () => r.scale(0.2, 2)),
      links: r.of(["rods", "points"]), theta0_rad: r.many(n, () => r.between(-1, 1)),
      omega0_rad_per_s: r.many(n, () => r.between(-1, 1)),
      resistance: r.chance(0.4) ? r.many(n, () => r.scale(0.01, 0.3)) : 0 };
  }
};

export const constructors = Object.keys(makers);

export function randomScene(r, constructor) {
  const inputs = makers[constructor](r);
  // An empty resistance is none.
  if (inputs.resistance && !Array.isArray(inputs.resistance) &&
    typeof inputs.resistance === "object" && !Object.keys(inputs.resistance).length) {
    delete inputs.resistance;
  }
  return { [constructor]: inputs };
}

// A text with some bytes changed, lost, doubled or put in.
export function mutated(r, text) {
  const bytes = [...text];
  for (let k = r.whole(1, 4); k > 0; k--) {
    const at = r.whole(0, bytes.length - 1);
    const other = r.of([..."{}[]\",:-+.eE0123456789 \\uInfNa\u0001é<>/&", "1e308", "NaN", "null"]);
    r.of([() => { bytes[at] = other; }, () => bytes.splice(at, 1),
      () => bytes.splice(at, 0, other), () => bytes.splice(at, 0, bytes[at]),
      () => bytes.splice(at, r.whole(1, 12))])();
    if (!bytes.length) bytes.push("{");
  }
  return bytes.join("");
}
