// Many wheels under one torque, a row each: ./sweep [time_s [inertia_kg_m2...]]
use std::os::raw::{c_char, c_int, c_void};
use std::ptr::null;

#[repr(C)]
struct Axle {
    size: usize,
    inertia_kg_m2: f64,
    start_s: f64, theta0_rad: f64, omega0_rad_per_s: f64,
    viscous_n_m_s: f64, quadratic_n_m_s2: f64, coulomb_n_m: f64, static_n_m: f64,
    motor_n_m_s: f64,
    n_knots: usize, knot_time_s: *const f64, knot_torque_n_m: *const f64,
    before_n_m: f64, after_n_m: f64,
    // The rest is 0: a struct may end early, its size says where.
}

#[repr(C)]
struct Column { values: *const f64, step: usize }

const NONE: Column = Column { values: null(), step: 0 };

#[repr(C)]
struct SweepIn {
    size: usize,
    time_s: Column, inertia_kg_m2: Column, viscous_n_m_s: Column, omega0_rad_per_s: Column,
    theta0_rad: Column, torque_scale: Column,
}

#[repr(C)]
struct SweepOut {
    size: usize,
    theta_rad: *mut f64, omega_rad_per_s: *mut f64, omega_max: *mut f64,
}

#[link(name = "rotdyn")]
extern "C" {
    fn rotdyn_axle_sweep(axle: *const Axle, n: usize, input: *const SweepIn,
                         options: *const c_void, out: *const SweepOut, info: *mut c_void) -> c_int;
    fn rotdyn_status_text(status: c_int) -> *const c_char;
}

fn main() {
    let numbers: Vec<f64> = std::env::args().skip(1)
        .map(|a| a.parse().unwrap_or_else(|_| { eprintln!("{a}: not a number"); std::process::exit(2) }))
        .collect();
    let time_s = *numbers.first().unwrap_or(&8.0);
    let inertia: Vec<f64> = if numbers.len() > 1 { numbers[1..].to_vec() }
        else { (1..=20).map(|i| 0.0625 * i as f64).collect() };
    let (knots, torque) = ([0.0, 1.0, 4.0, 6.0, 8.0], [0.0, 0.8, 0.8, 0.0, 0.0]);
    let n = inertia.len();
    let (mut theta, mut omega, mut most) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let axle = Axle {
        size: std::mem::size_of::<Axle>(), inertia_kg_m2: 1.0, start_s: 0.0, theta0_rad: 0.0,
        omega0_rad_per_s: 0.0, viscous_n_m_s: 0.03, quadratic_n_m_s2: 0.0, coulomb_n_m: 0.0,
        static_n_m: 0.0, motor_n_m_s: 0.0, n_knots: 5, knot_time_s: knots.as_ptr(),
        knot_torque_n_m: torque.as_ptr(), before_n_m: 0.0, after_n_m: 0.0,
    };
    let input = SweepIn {
        size: std::mem::size_of::<SweepIn>(), time_s: Column { values: &time_s, step: 0 },
        inertia_kg_m2: Column { values: inertia.as_ptr(), step: 1 }, viscous_n_m_s: NONE,
        omega0_rad_per_s: NONE, theta0_rad: NONE, torque_scale: NONE,
    };
    let out = SweepOut {
        size: std::mem::size_of::<SweepOut>(), theta_rad: theta.as_mut_ptr(),
        omega_rad_per_s: omega.as_mut_ptr(), omega_max: most.as_mut_ptr(),
    };
    let status = unsafe {
        rotdyn_axle_sweep(&axle, n, &input, null(), &out, std::ptr::null_mut())
    };
    if status != 0 {
        let text = unsafe { std::ffi::CStr::from_ptr(rotdyn_status_text(status)) };
        eprintln!("{}", text.to_string_lossy());
        std::process::exit(1);
    }
    println!("moment_of_inertia_kg_m2,final_theta_rad,final_omega_rad_per_s,max_omega_rad_per_s");
    for i in 0..n {
        println!("{:?},{:?},{:?},{:?}", inertia[i], theta[i], omega[i], most[i]);
    }
}
