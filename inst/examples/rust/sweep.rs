// Many wheels under one torque, a row each: ./sweep [time_s [inertia_kg_m2...]]
use std::ffi::{CStr, CString};
use std::os::raw::{c_char, c_int, c_void};
use std::ptr::null;

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
    fn rotdyn_object_new(constructor: *const c_char) -> *mut c_void;
    fn rotdyn_object_free(object: *mut c_void);
    fn rotdyn_set_number(object: *mut c_void, input: *const c_char, value: f64) -> c_int;
    fn rotdyn_set_numbers(object: *mut c_void, input: *const c_char, n: usize,
                          values: *const f64) -> c_int;
    fn rotdyn_set_object(object: *mut c_void, input: *const c_char, value: *const c_void) -> c_int;
    fn rotdyn_axle_sweep(scene: *const c_void, n: usize, input: *const SweepIn,
                         options: *const c_void, out: *const SweepOut,
                         report: *mut c_void) -> c_int;
    fn rotdyn_status_text(status: c_int) -> *const c_char;
}

/// An object by the name of its constructor, freed at its end.
struct Object(*mut c_void);

impl Object {
    fn new(constructor: &str) -> Object {
        Object(unsafe { rotdyn_object_new(text(constructor).as_ptr()) })
    }
    fn number(self, input: &str, x: f64) -> Object {
        done(input, unsafe { rotdyn_set_number(self.0, text(input).as_ptr(), x) });
        self
    }
    fn numbers(self, input: &str, x: &[f64]) -> Object {
        let name = text(input);
        done(input, unsafe { rotdyn_set_numbers(self.0, name.as_ptr(), x.len(), x.as_ptr()) });
        self
    }
    fn object(self, input: &str, x: Object) -> Object {
        done(input, unsafe { rotdyn_set_object(self.0, text(input).as_ptr(), x.0) });
        self
    }
}

impl Drop for Object {
    fn drop(&mut self) { unsafe { rotdyn_object_free(self.0) } }
}

fn text(x: &str) -> CString { CString::new(x).unwrap() }

fn done(what: &str, status: c_int) {
    if status != 0 {
        let words = unsafe { CStr::from_ptr(rotdyn_status_text(status)) };
        eprintln!("{what}: {}", words.to_string_lossy());
        std::process::exit(1);
    }
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
    let law = Object::new("torque_knots").numbers("time_s", &knots).numbers("torque_n_m", &torque);
    let axle = Object::new("scene_axle")
        .number("body", 1.0)
        .object("torque", law)
        .object("resistance", Object::new("resistance").number("viscous_n_m_s", 0.03));
    let input = SweepIn {
        size: std::mem::size_of::<SweepIn>(), time_s: Column { values: &time_s, step: 0 },
        inertia_kg_m2: Column { values: inertia.as_ptr(), step: 1 }, viscous_n_m_s: NONE,
        omega0_rad_per_s: NONE, theta0_rad: NONE, torque_scale: NONE,
    };
    let out = SweepOut {
        size: std::mem::size_of::<SweepOut>(), theta_rad: theta.as_mut_ptr(),
        omega_rad_per_s: omega.as_mut_ptr(), omega_max: most.as_mut_ptr(),
    };
    done("sweep", unsafe {
        rotdyn_axle_sweep(axle.0, n, &input, null(), &out, std::ptr::null_mut())
    });
    println!("moment_of_inertia_kg_m2,final_theta_rad,final_omega_rad_per_s,max_omega_rad_per_s");
    for i in 0..n {
        println!("{:?},{:?},{:?},{:?}", inertia[i], theta[i], omega[i], most[i]);
    }
}
