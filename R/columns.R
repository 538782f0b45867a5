# The dictionary of columns: name, unit, meaning. A test asserts that it has all columns of all
# functions; the help pages take their tables from it.
column_list <- list(
  c("time_s", "s", "time"),
  c("theta_rad", "rad", "angle turned about the axle"),
  c("omega_rad_per_s", "rad/s", "angular velocity"),
  c("applied_torque_n_m", "N m", "torque of the torque law"),
  c("damping_torque_n_m", "N m", "torque of the resistance; at rest, of static friction"),
  c("net_torque_n_m", "N m", "applied + damping"),
  c("angular_momentum_kg_m2_per_s", "kg m^2/s", "angular momentum about the axle, I omega"),
  c("rotational_kinetic_energy_j", "J", "I omega^2 / 2"),
  c("moment_of_inertia_kg_m2", "kg m^2", "moment of inertia about the axis in use"),
  c(
    "max_angular_velocity_rad_per_s", "rad/s",
    "largest omega, signed: at most 0 for a body that turns backwards"
  ),
  c("max_angular_velocity_time_s", "s", "the first time at which omega is largest"),
  c("max_angular_momentum_kg_m2_per_s", "kg m^2/s", "largest angular momentum"),
  c("max_rotational_kinetic_energy_j", "J", "largest rotational kinetic energy"),
  c("max_rotational_kinetic_energy_time_s", "s", "the first time at which it is largest"),
  c("final_theta_rad", "rad", "angle at the end"),
  c("model", "", "name of the model, as in `models()`"),
  c("run", "", "name of the run"),
  c("accuracy", "1", "relative accuracy asked for"),
  c("error", "1", "relative error of the state: see `error_kind`"),
  c("error_kind", "", "\"bound\" or \"estimate\""),
  c("steps", "1", "accepted steps; pieces of the torque for a closed form"),
  c("rejected", "1", "steps tried and rejected"),
  c("step_s", "s", "length of a step, where it is fixed"),
  c("rhs_calls", "1", "calls of the right-hand side, or of an R torque function sampled first"),
  c("work_j", "J", "work of the applied torque since the first row"),
  c("dissipated_j", "J", "energy dissipated by the resistance, computed separately"),
  c("dissipated_viscous_j", "J", "its part by viscous resistance"),
  c("dissipated_quadratic_j", "J", "its part by quadratic drag"),
  c("dissipated_coulomb_j", "J", "its part by dry friction"),
  c("inertia_work_j", "J", "work of changing the moment of inertia"),
  c("final_omega_rad_per_s", "rad/s", "angular velocity at the end"),
  c("max_omega_rad_per_s", "rad/s", "largest omega during the motion, signed"),
  c("max_omega_time_s", "s", "the first time at which omega is largest"),
  c("min_omega_rad_per_s", "rad/s", "smallest omega during the motion, signed"),
  c("max_abs_omega_rad_per_s", "rad/s", "largest |omega| during the motion"),
  c("stop_time_s", "s", "time at which the body comes to rest finally; Inf if it never does"),
  c("stop_theta_rad", "rad", "angle at that time; the angle that it tends to where it never stops"),
  c("stop_x_m", "m", "path at that time; NaN where it never stops"),
  c("terminal_v_m_per_s", "m/s", "speed that it tends to"),
  c("terminal_omega_rad_per_s", "rad/s", "limit of omega under the last torque"),
  c("final_omega_1_rad_per_s", "rad/s", "angular velocity of body 1 at the end"),
  c("final_omega_2_rad_per_s", "rad/s", "angular velocity of body 2 at the end"),
  c(
    "potential_energy_j", "J",
    "energy of springs and height: 0 at the rest angle, the pivot of a body, or x = 0"
  ),
  c("period_s", "s", "time after which the motion repeats, or of a cycle"),
  c("amplitude_rad", "rad", "largest angle from the rest angle"),
  c("amplitude_ratio", "1", "amplitude after a cycle over that before"),
  c("power_w", "W", "power of the applied torque"),
  c("direction", "", "\"up\", \"down\", or \"reached\""),
  c("event", "", "event: \"stick\", \"slip\", \"reverse\", ..."),
  c("torque_impulse_n_m_s", "N m s", "time integral of the applied torque since the first row"),
  c("damping_impulse_n_m_s", "N m s", "time integral of the damping torque since the first row"),
  c(
    "verdict", "",
    "of an audit \"balanced\" where the residuals are explained, of a check \"holds\"; ..."
  ),
  c("balance", "", "the quantity that is balanced: energy, angular_momentum, ..."),
  c("about", "", "the point or axis of a momentum; NA for an energy"),
  c("change", "", "last value minus first; unit in the column `unit`"),
  c("supplied", "", "amount supplied from outside, in the same unit"),
  c("dissipated", "", "amount dissipated by the resistance, computed separately, in the same unit"),
  c("residual", "", "change - supplied + dissipated, in the same unit"),
  c("rounding", "", "the part explained by rounding and the stated error, in the same unit"),
  c("terms", "", "the terms of the balance, a tibble; text in a file"),
  c("term", "", "the term in words"),
  c("role", "", "\"supplied\", \"dissipated\" (by mechanism) or \"change\""),
  c("constraint", "", "constraint of the bodies: axle, ..."),
  c("equations", "", "equations that the model solves"),
  c("assumptions", "", "physical assumptions"),
  c("limits", "", "limits of validity"),
  c("requires", "", "requirements on the scene"),
  c("source", "", "source of the equations"),
  c("applies", "", "whether the model fits the scene and reaches the accuracy"),
  c("reason", "", "the reason"),
  c("chosen", "", "TRUE for the model with the least predicted time of those that apply"),
  c("principal_moment_kg_m2", "kg m^2", "principal moment of inertia"),
  c("second_moment_kg_m2", "kg m^2", "second moment along the principal axis"),
  c("x", "1", "x component of the unit vector along the axis, in the own axes"),
  c("y", "1", "its y component"),
  c("z", "1", "its z component"),
  c("unique", "", "FALSE if the axis is not unique, since moments are equal"),
  c("object", "", "name of the object"),
  c("beta", "1", "I/(m r^2) of the rolling object"),
  c("acceleration_m_per_s2", "m/s^2", "acceleration down the incline, rolling without slipping"),
  c("final_speed_m_per_s", "m/s", "speed after the drop, from rest"),
  c("rotational_energy_fraction", "1", "share of the kinetic energy that is rotation"),
  c("translational_energy_fraction", "1", "share of the kinetic energy that is translation"),
  c("incline_angle_deg", "degree", "angle of the incline"),
  c("height_drop_m", "m", "height lost"),
  c("gravity_m_per_s2", "m/s^2", "acceleration of gravity"),
  c("mass_kg", "kg", "mass"),
  c("radius_m", "m", "radius"),
  c("length_m", "m", "length"),
  c("outer_radius_m", "m", "outer radius"),
  c("inner_radius_m", "m", "inner radius"),
  c("base_radius_m", "m", "radius of the base"),
  c("top_radius_m", "m", "radius of the top"),
  c("ring_radius_m", "m", "radius of a ring, to the middle of its tube"),
  c("tube_radius_m", "m", "radius of the tube of a ring"),
  c("semi_x_m", "m", "half axis along x"),
  c("semi_y_m", "m", "half axis along y"),
  c("semi_z_m", "m", "half axis along z"),
  c("width_m", "m", "width"),
  c("height_m", "m", "height; of a hanging mass over that where theta is 0"),
  c("edge_m", "m", "edge"),
  c("base_m", "m", "base of a triangle"),
  c("apex_m", "m", "x of the apex of a triangle"),
  c("sides", "1", "number of sides"),
  c("ixx_kg_m2", "kg m^2", "moment of inertia about own x through the centre of mass"),
  c("iyy_kg_m2", "kg m^2", "the same about own y"),
  c("izz_kg_m2", "kg m^2", "the same about own z"),
  c("shape", "", "name of the shape"),
  c("family", "", "family of shapes"),
  c("constructor", "", "function that makes a body of it"),
  c("dimension", "1", "3: solid, 2: plate or shell, 1: line, 0: point"),
  c("sizes", "", "its sizes, with their letters in the formulas"),
  c("ixx_formula", "", "moment of inertia about own x through the centre of mass"),
  c("iyy_formula", "", "the same about own y"),
  c("izz_formula", "", "the same about own z"),
  c("centre_formula", "", "centre of mass in the own axes"),
  c("origin", "", "origin of the own axes"),
  c("beta_formula", "", "I/(m r^2) for rolling on the outer radius"),
  c("measure_formula", "", "volume, area or length; the mass is its product with the density"),
  c("speed_m_per_s", "m/s", "speed of the centre"),
  c("translational_kinetic_energy_j", "J", "m v^2 / 2"),
  c("total_kinetic_energy_j", "J", "translational + rotational"),
  c("radius_of_gyration_m", "m", "sqrt(I/m)"),
  c("axis", "", "the axis of the moment of inertia"),
  c("formula", "", "the moment of inertia as a formula"),
  c("name", "", "name: of a column, of an exercise"),
  c("unit", "", "its unit; empty for text, 1 for a pure number"),
  c("meaning", "", "its meaning"),
  # measuring
  c("omega0_rad_per_s", "rad/s", "angular velocity at the start"),
  c("alpha_rad_per_s2", "rad/s^2", "angular acceleration"),
  c("row", "1", "row of the arguments"),
  c("root", "1", "1 or 2, the smaller time first; NA without a unique motion"),
  c("tangential_speed_m_per_s", "m/s", "omega r: along the tangent, with its sign"),
  c("tangential_acceleration_m_per_s2", "m/s^2", "alpha r: along the tangent, with its sign"),
  c("centripetal_acceleration_m_per_s2", "m/s^2", "omega^2 r: towards the axle"),
  c("total_acceleration_m_per_s2", "m/s^2", "size of the acceleration"),
  c("acceleration_angle_rad", "rad", "from the inward radius to the acceleration"),
  c("method", "", "\"closed form\", the name of an integrator, or \"peer\""),
  c("theta_error", "1", "true error of theta, relative to the largest |theta|"),
  c("omega_error", "1", "true error of omega, relative to the largest |omega|"),
  c("true_error", "1", "the larger of both"),
  c("floor", "", "TRUE where the true error is below 3 x reference_error: not resolved"),
  c("covered", "", "TRUE if the error reported is at least the true one"),
  c("reference", "", "reference for the true error"),
  c("reference_error", "1", "relative error of the reference itself"),
  c("cost_s", "s", "processor time of one run: predicted, or that of the fastest batch"),
  c("cost_median_s", "s", "processor time of one run: the median of the batches"),
  c("energy_residual", "1", "energy residual of the audit, relative to the largest energy"),
  c("rotor", "1", "number of the rotor along the shaft, from 1"),
  c("shaft_torque_n_m", "N m", "torque of the shaft on the next rotor; NA for the last"),
  c("mode", "1", "number of the mode, slowest first"),
  c("natural_rad_per_s", "rad/s", "angular frequency without damping"),
  c("theta_1_rad", "rad", "angle of body 1"),
  c("omega_1_rad_per_s", "rad/s", "angular velocity of body 1"),
  c("theta_2_rad", "rad", "angle of body 2; of shaft 2 of a gear train (3, 4, ... likewise)"),
  c("omega_2_rad_per_s", "rad/s", "its angular velocity"),
  c("clutch_torque_n_m", "N m", "torque of the clutch on body 2; opposite on body 1"),
  c("heat_j", "J", "heat since the start: of a clutch, or of a rotor's resistance and brake"),
  c(
    "coupling_heat_j", "J",
    "heat of the coupling behind the rotor since the start; NA for the last"
  ),
  c(
    "coupling_torque_n_m", "N m",
    "torque of the coupling behind the rotor, on the next before ratio and loss; NA for the last"
  ),
  c("x_m", "m", "x in the own axes; of a motion, the path down the slope"),
  c("v_m_per_s", "m/s", "velocity of the centre of mass, positive down the slope"),
  c("slip_speed_m_per_s", "m/s", "v - R omega: speed of the contact over the slope"),
  c("friction_force_n", "N", "friction on the body, positive down the slope"),
  c("slip_heat_j", "J", "heat of friction since the start"),
  c("rolling_heat_j", "J", "heat of rolling resistance since the start"),
  c("rolling", "", "whether the contact sticks"),
  c("roll_time_s", "s", "first time at which slip ends and rolling begins; NA if none"),
  c("drag_force_n", "N", "air drag on the body, positive down the slope"),
  c("applied_force_n", "N", "force on the body besides gravity, friction and drag"),
  c("drag_heat_j", "J", "heat of air drag since the start"),
  c(
    "max_v_m_per_s", "m/s", "largest velocity, signed: at most 0 for a body that only moves upwards"
  ),
  c("max_v_time_s", "s", "the first time at which the velocity is largest"),
  c("highest_x_m", "m", "path where the body is highest up the slope: the least x"),
  c("highest_x_time_s", "s", "the first time at which it is there"),
  c("final_x_m", "m", "path at the end"),
  c("lane", "", "number of the body in the race, from 1"),
  c("finished", "", "whether the body has arrived"),
  c("place", "", "place in the race, from 1; NA where the body does not arrive"),
  c("finish_time_s", "s", "time of the arrival; Inf where there is none"),
  c("static_friction", "1", "coefficient of static friction"),
  c("critical_angle_deg", "degree", "steepest angle at which it rolls"),
  c("from_rest", "", "what the body does from rest: \"rolls\", \"slides\", \"rests\""),
  c("final_v_m_per_s", "m/s", "velocity at the end"),
  c("vx_m_per_s", "m/s", "velocity along x; along the floor, after"),
  c("vy_m_per_s", "m/s", "velocity along y; away from the floor, after"),
  c("normal_impulse_n_s", "N s", "impulse of the contact along its normal"),
  c("friction_impulse_n_s", "N s", "impulse of friction, on a floor along it"),
  c("normal_loss_j", "J", "energy lost by the restitution"),
  c("friction_loss_j", "J", "energy lost by friction"),
  c("sticks", "", "whether the contact does not slip when it ends"),
  c("particle_v_m_per_s", "m/s", "velocity of the particle, after"),
  c("east_m", "m", "way to the east"),
  c("north_m", "m", "way to the north"),
  c("up_m", "m", "way up"),
  c("east_m_per_s", "m/s", "velocity to the east, over the ground"),
  c("north_m_per_s", "m/s", "velocity to the north, over the ground"),
  c("up_m_per_s", "m/s", "velocity upward"),
  c("deflection_east_m", "m", "what the rotation adds to the way to the east, exact"),
  c("deflection_north_m", "m", "the same to the north"),
  c("deflection_up_m", "m", "the same upward"),
  c("first_order_east_m", "m", "deflection to the east, to the first order in the rotation"),
  c("first_order_north_m", "m", "the same to the north"),
  c("first_order_up_m", "m", "the same upward"),
  c("first_order_error_m", "m", "what the first order lacks at most, as a length"),
  c("fall_time_s", "s", "time of the fall"),
  c("first_order_error", "1", "what the first order lacks at most, relative to it"),
  c("swing_period_s", "s", "period of the swing"),
  c("plane_rate_rad_per_s", "rad/s", "rate at which the plane of the swing turns, from above"),
  c("plane_turn_s", "s", "time of a whole turn of that plane"),
  c("ellipse_rate_rad_per_s", "rad/s", "what an elliptic swing adds to that rate"),
  c("centrifugal_x_m_per_s2", "m/s^2", "centrifugal acceleration, -omega x (omega x r)"),
  c("centrifugal_y_m_per_s2", "m/s^2", "the same along y"),
  c("centrifugal_z_m_per_s2", "m/s^2", "the same along z"),
  c("coriolis_x_m_per_s2", "m/s^2", "Coriolis acceleration, -2 omega x v"),
  c("coriolis_y_m_per_s2", "m/s^2", "the same along y"),
  c("coriolis_z_m_per_s2", "m/s^2", "the same along z"),
  c("euler_x_m_per_s2", "m/s^2", "Euler acceleration, -alpha x r"),
  c("euler_y_m_per_s2", "m/s^2", "the same along y"),
  c("euler_z_m_per_s2", "m/s^2", "the same along z"),
  c("contact_x_m", "m", "x of the point of contact"),
  c("contact_y_m", "m", "y of the point of contact"),
  c("lean_rad", "rad", "angle of a disk from upright"),
  c("min_speed_m_per_s", "m/s", "least stable speed of straight upright rolling"),
  c("min_spin_rad_per_s", "rad/s", "angular velocity at that speed"),
  c("circle_x_m", "m", "centre of the circle on which the ball runs"),
  c("circle_y_m", "m", "the same along y"),
  c("circle_radius_m", "m", "its radius"),
  c("circle_period_s", "s", "time of a turn on it"),
  c("kinetic_energy_j", "J", "kinetic energy"),
  c("energy_residual_j", "J", "change of the kinetic energy less the work: rounding"),
  c("axis_x", "1", "component along x of space of the unit vector along the axis"),
  c("axis_y", "1", "the same along y"),
  c("axis_z", "1", "the same along z, upward"),
  c("axis_inclination_rad", "rad", "angle from upward to the axis"),
  c("axis_azimuth_rad", "rad", "angle of the axis about the vertical, from x, counterclockwise"),
  c("inclination_rad", "rad", "angle from upward to the line from the point to the centre of mass"),
  c("gravity_torque_n_m", "N m", "torque of gravity about the fixed point, m g l sin(angle)"),
  c("spin_angular_momentum_kg_m2_per_s", "kg m^2/s", "angular momentum of the spin, I3 omega3"),
  c("precession_rad_per_s", "rad/s", "rate of precession by the fast-top formula"),
  c("precession_period_s", "s", "time of a turn of the axis at that rate"),
  c("formula_error", "1", "what that formula lacks of the slow steady rate, relative to it"),
  c("slow_precession_rad_per_s", "rad/s", "rate of slow steady precession, exact"),
  c("fast_precession_rad_per_s", "rad/s", "rate of fast steady precession, exact"),
  c("nutation_period_s", "s", "released at rest: time between two rests of the axis"),
  c("sleeping_spin_rad_per_s", "rad/s",
    "least spin at which it stands upright stably; 0: it hangs"),
  c("lowest_angle_deg", "degree", "released at rest: angle from the upward vertical, turned back"),
  c("mean_precession_rad_per_s", "rad/s", "released at rest: mean rate of precession"),
  c("impulse_n_s", "N s", "impulse on the body"),
  c("vx_1_m_per_s", "m/s", "velocity of the centre of mass of body 1, after, along x"),
  c("vy_1_m_per_s", "m/s", "the same along y"),
  c("vz_1_m_per_s", "m/s", "the same along z"),
  c("omega_x_1_rad_per_s", "rad/s", "angular velocity of body 1, after, along x"),
  c("omega_y_1_rad_per_s", "rad/s", "the same along y"),
  c("omega_z_1_rad_per_s", "rad/s", "the same along z"),
  c("vx_2_m_per_s", "m/s", "velocity of the centre of mass of body 2, after, along x"),
  c("vy_2_m_per_s", "m/s", "the same along y"),
  c("vz_2_m_per_s", "m/s", "the same along z"),
  c("omega_x_2_rad_per_s", "rad/s", "angular velocity of body 2, after, along x"),
  c("omega_y_2_rad_per_s", "rad/s", "the same along y"),
  c("omega_z_2_rad_per_s", "rad/s", "the same along z"),
  c("impulse_x_n_s", "N s", "impulse on body 1, along x; the opposite on body 2"),
  c("impulse_y_n_s", "N s", "the same along y"),
  c("impulse_z_n_s", "N s", "the same along z"),
  c("creates_energy", "", "TRUE where the coefficient ends with more energy than there was"),
  c("angular_impulse_n_m_s", "N m s", "angular impulse; of disks that lock, on disk 1"),
  c("angular_impulse_error_n_m_s", "N m s", "bound of its error, or estimate for an R function"),
  c("omega_change_rad_per_s", "rad/s", "change of the angular velocity of a free body"),
  c("from_s", "s", "start of the span"),
  c("to_s", "s", "end of the span"),
  c("before", "", "value before, in the unit of the row"),
  c("after", "", "value after, in the unit of the row"),
  c("quantity", "", "momentum_x, angular_momentum, energy, ..."),
  c("conserved", "", "whether the quantity keeps its value; NA where this depends on the motion"),
  c("why", "", "the reason"),
  c("hinge_impulse_n_s", "N s", "impulse of the hinge on the body, along that of the particle"),
  c("where", "", "where it happens: \"rotor 1\", \"coupling 1\", ..."),
  c("locked", "", "whether the clutch is locked"),
  c(
    "lock_time_s", "s",
    "time until the clutch locks; Inf if it never does, of a motion NA if not in its rows"
  ),
  c("common_omega_rad_per_s", "rad/s", "angular velocity of both bodies when it locks"),
  c("locked_torque_n_m", "N m", "torque transmitted by the locked clutch"),
  c("shaft", "1", "number of the shaft, from 1"),
  c("ratio_to_first", "1", "angular velocity of the first shaft over that of this one"),
  c("reflected_inertia_kg_m2", "kg m^2", "moment of inertia reflected to the first shaft"),
  c("reflected_viscous_n_m_s", "N m s", "viscous coefficient reflected to the first shaft"),
  c("reflected_torque_n_m", "N m", "torque reflected to the first shaft, with losses"),
  c("condition", "", "the condition"),
  c("count", "1", "number found; NA where not checked"),
  c("record", "", "name of the record"),
  c("linear", "1", "distance in standard errors"),
  c("rooted", "1", "distance by the root of the growth of a sum of squares"),
  c("unknown", "", "path of the unknown, or offset, factor, clock of an observed column"),
  c("loss", "", "Coulomb, viscous or quadratic loss, or what else was fitted"),
  c("standard_error", "", "standard error of the fit without bounds"),
  c("candidate", "", "name of a record that may be measured"),
  c("planned_error", "", "standard error that a fit with one more record would have"),
  c("lower", "", "lower end of the interval"),
  c("upper", "", "upper end of the interval"),
  c("status", "", "what the record shows: acts, at most, not separable from ..."),
  c("u_inertia", "", "standard uncertainty by that of the inertia, a factor common to all"),
  c("share", "1", "share of the energy lost"),
  c("energy_j", "J", "energy lost by it"),
  c("energy_over_inertia", "(rad/s)^2", "energy lost by it over the moment of inertia"),
  c("retarding_torque_n_m", "N m", "sum of the losses"),
  c("deceleration_rad_per_s2", "rad/s^2", "sum of the losses over the moment of inertia"),
  c("law", "", "the losses that act, or the fit"),
  c("parameters", "1", "number of parameters fitted"),
  c("aicc_difference", "1", "AICc above the smallest"),
  c("sigma", "", "standard deviation of the residuals, in the unit measured"),
  c("relative_residual", "1", "standard deviation of the residuals, by the noise of the best law"),
  c("test", "", "what is tested"),
  c("statistic", "", "its statistic: twice the log likelihood gained, correlation time, F, ratio"),
  c("p_value", "1", "chance of such a value or a larger one"),
  c("finding", "", "what it says"),
  c("value", "", "value found, in the unit of the condition"),
  c("limit", "", "limit, in the same unit"),
  c("margin", "1", "relative margin; negative outside the limit"),
  c("suggestion", "", "smallest repairs that make every condition hold"),
  c("repair", "1", "number of the repair, the smallest first"),
  c("size", "1", "size of the repair: see the help of `check_inertia()`"),
  c("kind", "", "kind: of a motion, of the error that a repair corrects"),
  c("entry", "", "the number that changes"),
  c("from", "", "old value"),
  c("to", "", "new value"),
  c("link", "", "name of the link"),
  c("y_m", "m", "y in the own axes"),
  c("z_m", "m", "z in the own axes"),
  c("qw", "1", "attitude as a unit quaternion, body to space: its scalar part"),
  c("qx", "1", "its x component"),
  c("qy", "1", "its y component"),
  c("qz", "1", "its z component"),
  c("r11", "1", "element of the rotation matrix, row 1, column 1; r12, ..., r33 likewise"),
  c("rx_rad", "rad", "x of the rotation vector; ry_rad and rz_rad likewise"),
  c("px", "1", "x of the modified Rodrigues parameters; py and pz likewise"),
  c("angle_rad", "rad", "angle of the rotation"),
  c("angle_1_rad", "rad", "first angle of the sequence"),
  c("angle_2_rad", "rad", "second angle of the sequence"),
  c("angle_3_rad", "rad", "third angle of the sequence"),
  c("omega_x_rad_per_s", "rad/s", "angular velocity, component along the own x axis"),
  c("omega_y_rad_per_s", "rad/s", "angular velocity, component along the own y axis"),
  c("omega_z_rad_per_s", "rad/s", "angular velocity, component along the own z axis"),
  c("omega_space_x_rad_per_s", "rad/s", "the same along x of space"),
  c("omega_space_y_rad_per_s", "rad/s", "the same along y of space"),
  c("omega_space_z_rad_per_s", "rad/s", "the same along z of space"),
  c("angular_momentum_x_kg_m2_per_s", "kg m^2/s", "angular momentum along x of space"),
  c("angular_momentum_y_kg_m2_per_s", "kg m^2/s", "angular momentum along y of space"),
  c("angular_momentum_z_kg_m2_per_s", "kg m^2/s", "angular momentum along z of space"),
  c("torque_impulse_x_n_m_s", "N m s", "impulse of the torque along x of space"),
  c("torque_impulse_y_n_m_s", "N m s", "impulse of the torque along y of space"),
  c("torque_impulse_z_n_m_s", "N m s", "impulse of the torque along z of space"),
  c("damping_impulse_x_n_m_s", "N m s", "impulse of the damping along x of space"),
  c("damping_impulse_y_n_m_s", "N m s", "impulse of the damping along y of space"),
  c("damping_impulse_z_n_m_s", "N m s", "impulse of the damping along z of space"),
  c(
    "rotor_1_omega_rad_per_s", "rad/s",
    "angular velocity of rotor 1 relative to the body (2, 3, ... likewise)"
  ),
  c(
    "rotor_1_angular_momentum_kg_m2_per_s", "kg m^2/s",
    "its angular momentum about its axis, J (W + a omega)"
  ),
  c("motor_work_j", "J", "work of the motors of rotors"),
  c("stability", "", "of a spin about the axis: \"stable\", \"unstable\" or \"neutral\""),
  c("growth_per_omega", "1", "growth rate of a disturbance over the spin; 0: none"),
  c("wobble_per_omega", "1", "angular frequency of the wobble over the spin; 0: none"),
  c("flip_time_s", "s", "time between two flips: 2 K/lambda; Inf for a steady spin"),
  c("attitude_error", "1", "true error of the attitude, an angle in rad"),
  c("angular_momentum_error", "1", "true error of the angular momentum, relative to the largest"),
  c("final_qw", "1", "attitude at the end as a quaternion: its scalar part"),
  c("final_qx", "1", "its x component"),
  c("final_qy", "1", "its y component"),
  c("final_qz", "1", "its z component"),
  c("final_omega_x_rad_per_s", "rad/s", "angular velocity at the end along the own x axis"),
  c("final_omega_y_rad_per_s", "rad/s", "angular velocity at the end along the own y axis"),
  c("final_omega_z_rad_per_s", "rad/s", "angular velocity at the end along the own z axis"),
  c("gimbal_lock", "", "TRUE where the first and the third angle are not unique"),
  c("centre_x_m", "m", "x of the centre of mass"),
  c("centre_y_m", "m", "y of the centre of mass"),
  c("centre_z_m", "m", "z of the centre of mass"),
  c("reach_m", "m", "distance from the centre of mass to the farthest point; NA if unknown"),
  c("body", "", "the body, or NULL"),
  c("fault", "", "the condition that fails; NA if none"),
  c("load", "", "name of the load"),
  c("support", "", "name of the support"),
  c("fx_n", "N", "force along x"),
  c("fy_n", "N", "force along y"),
  c("fz_n", "N", "force along z"),
  c("torque_n_m", "N m", "couple, counter-clockwise; of a resultant, its torque about the point"),
  c("torque_x_n_m", "N m", "x component of the couple or torque"),
  c("torque_y_n_m", "N m", "its y component"),
  c("torque_z_n_m", "N m", "its z component"),
  c("torque_about_n_m", "N m", "torque about the point, counter-clockwise"),
  c("torque_about_x_n_m", "N m", "x component of the torque about the point"),
  c("torque_about_y_n_m", "N m", "its y component"),
  c("torque_about_z_n_m", "N m", "its z component"),
  c("lever_arm_m", "m", "distance of the force's line of action from the point; NA without force"),
  c("force_n", "N", "size of the force"),
  c("axis_x_m", "m", "x of the central axis where it is nearest to the point of reference"),
  c("axis_y_m", "m", "its y"),
  c("axis_z_m", "m", "its z"),
  c("couple_n_m", "N m", "the couple along the central axis, positive along the force"),
  c("pitch_m", "m", "couple/force of the wrench"),
  c("force_error_n", "N", "bound of the force's error, for half an ulp of each number given"),
  c("torque_error_n_m", "N m", "the same of the torque"),
  c("normal_x", "1", "x of the unit vector along which a surface or roller pushes"),
  c("normal_y", "1", "its y"),
  c("normal_z", "1", "its z"),
  c("normal_n", "N", "push along the normal; pull of a cable or rod"),
  c("friction_n", "N", "friction of the support"),
  c("friction_needed", "1", "friction over push: the least coefficient that holds"),
  c("sliding_margin", "1", "1 - friction needed/coefficient: 0 where it slides"),
  c("tipping_margin_n", "N", "least push of a surface or pull of a cable: 0 where it tips"),
  c("determined", "", "whether equilibrium determines the reaction"),
  c("error_n", "N", "error of the forces: a bound for half an ulp of each number given"),
  c("error_n_m", "N m", "the same of the couples"),
  c("state", "", "of a support: \"holds\", \"lifts\", \"slack\" or \"slides\""),
  c("unknowns", "1", "number of unknown reactions"),
  c("rank", "1", "number of independent equations"),
  c("redundant", "1", "unknowns - rank"),
  c("free_motions", "1", "number of independent motions that no support prevents"),
  c("condition_number", "1", "largest over smallest singular value that is not 0"),
  c("motion", "", "the motion that begins or is free; NA if none"),
  c("residual_force_n", "N", "sum of all forces"),
  c("residual_torque_n_m", "N m", "sum of all torques about the first support"),
  c("component", "", "the reaction: along an axis, normal or tension"),
  c("lowest", "", "the least value with which the body can rest, in the same unit"),
  c("highest", "", "the largest"),
  c("lowest_factor", "1", "least factor on the load with which the body can rest"),
  c("highest_factor", "1", "the largest"),
  c("below", "", "verdict below the least factor"),
  c("above", "", "verdict above the largest"),
  c("path_m", "m", "length of the path since the start"),
  c("tension_n", "N", "tension of the string or rope"),
  c("tension_1_n", "N", "tension on the side of the first mass"),
  c("tension_2_n", "N", "tension on the side of the second mass"),
  c("height_1_m", "m", "height of the first mass over that where theta is 0"),
  c("height_2_m", "m", "height of the second mass over that where theta is 0"),
  c("mass_kinetic_energy_j", "J", "m v^2 / 2 of the hanging mass"),
  c("mass_potential_energy_j", "J", "m g height of the hanging mass"),
  c("mass_1_kinetic_energy_j", "J", "m v^2 / 2 of the first mass"),
  c("mass_1_potential_energy_j", "J", "m g height of the first mass"),
  c("mass_2_kinetic_energy_j", "J", "m v^2 / 2 of the second mass"),
  c("mass_2_potential_energy_j", "J", "m g height of the second mass"),
  c("tip_acceleration_m_per_s2", "m/s^2", "size of the acceleration of the tip"),
  c("tip_fall_m_per_s2", "m/s^2", "acceleration of the tip, down: it may be above g"),
  c("hinge_along_n", "N", "force of the hinge on the rod, along the rod towards its tip"),
  c("hinge_across_n", "N", "force of the hinge across the rod, against the fall"),
  c("bending_moment_n_m", "N m", "largest bending moment in the rod"),
  c("break_at_m", "m", "its place, from the hinge"),
  c("finest", "1", "features narrower than this share of the span may be missed; NA: more are"),
  c("min_normal_n", "N", "least push of the track"),
  c("period0_s", "s", "period reduced to small swings"),
  c("used", "", "whether it is part of the result"),
  c("group", "", "who timed"),
  c("readings", "1", "number of readings"),
  c("u_s", "s", "standard uncertainty of a time"),
  c("ratio", "1", "ratio to the median"),
  c("distance_m", "m", "distance from the centre of mass"),
  c("gravity_alone_m_per_s2", "m/s^2", "acceleration of gravity from this pivot alone"),
  c("output", "", "the quantity computed"),
  c("input", "", "the quantity that contributes"),
  c("domain", "", "numbers that it takes"),
  c("rows_done", "1", "rows computed and committed"),
  c("rows", "1", "number of rows"),
  c("chunks_done", "1", "chunks computed and committed"),
  c("chunks", "1", "number of chunks"),
  c("time_left_s", "s", "time that the others take in one thread"),
  c("writing", "1", "files that are being written"),
  c("owner", "", "host and process that coordinate"),
  c("chunk", "1", "number of the chunk"),
  c("kept", "1", "rows kept"),
  c("bytes", "1", "size of the file of rows, in bytes"),
  c("seconds", "s", "time that it took"),
  c("mean_error", "1", "standard error of the mean, in the unit of the row"),
  c("sd", "", "standard deviation"),
  c("min", "", "least value"),
  c("min_row", "1", "the first row with it"),
  c("max", "", "largest value"),
  c("max_row", "1", "the first row with it"),
  c("finite", "1", "rows with a finite value"),
  c("infinite", "1", "rows with an infinite one"),
  c("p", "1", "probability"),
  c("low", "", "lower bound"),
  c("high", "", "upper bound"),
  c("first", "1", "share of the variance that the input explains alone"),
  c("first_error", "1", "its standard error"),
  c("total", "1", "share of the variance that involves the input"),
  c("total_error", "1", "its standard error"),
  c("other", "", "the model that it is compared with"),
  c("difference", "1", "difference of two results"),
  c("u", "", "standard uncertainty, in the unit of the value"),
  c("dof", "1", "degrees of freedom"),
  c("sensitivity", "", "change of the output for that of the input"),
  c("contribution", "", "sensitivity times standard uncertainty, with its sign"),
  c("u_error", "", "standard error of a drawn standard uncertainty"),
  c("mean", "", "mean of the draws"),
  c("agrees", "", "whether the draws have the standard uncertainty of the formula"),
  c("pulses", "1", "running number of pulses"),
  c("segment", "", "number of the run, from 1: segments share nothing but the instrument"),
  c("check", "", "result of check_inertia(); NULL without inertia"),
  c("theta_se_rad", "rad", "its standard error"),
  c("theta_low_rad", "rad", "lower end of its interval"),
  c("theta_high_rad", "rad", "upper end of its interval"),
  c("omega_se_rad_per_s", "rad/s", "its standard error"),
  c("omega_low_rad_per_s", "rad/s", "lower end of its interval"),
  c("omega_high_rad_per_s", "rad/s", "upper end of its interval"),
  c("alpha_se_rad_per_s2", "rad/s^2", "its standard error"),
  c("alpha_low_rad_per_s2", "rad/s^2", "lower end of its interval"),
  c("alpha_high_rad_per_s2", "rad/s^2", "upper end of its interval"),
  c("net_torque_se_n_m", "N m", "its standard error"),
  c("net_torque_low_n_m", "N m", "lower end of its interval"),
  c("net_torque_high_n_m", "N m", "upper end of its interval"),
  c("applied_torque_se_n_m", "N m", "its standard error"),
  c("applied_torque_low_n_m", "N m", "lower end of its interval"),
  c("applied_torque_high_n_m", "N m", "upper end of its interval"),
  c("power_se_w", "W", "its standard error"),
  c("power_low_w", "W", "lower end of its interval"),
  c("power_high_w", "W", "upper end of its interval"),
  c("rotational_kinetic_energy_se_j", "J", "its standard error"),
  c("rotational_kinetic_energy_low_j", "J", "lower end of its interval, at least 0"),
  c("rotational_kinetic_energy_high_j", "J", "upper end of its interval"),
  c(
    "flag", "",
    "\"\", \"outlier\" (left out), \"break\" (beside one), \"gap\" (beside one), \"no sample\""
  ),
  c("theta_sample_rad", "rad", "measured angle"),
  c("theta_residual", "1", "leave-one-out residual of the angle over its standard deviation"),
  c("omega_sample_rad_per_s", "rad/s", "measured angular velocity"),
  c("omega_residual", "1", "leave-one-out residual of the rate over its standard deviation"),
  c("samples", "1", "samples in use"),
  c("outliers", "1", "samples left out"),
  c("breaks", "1", "breaks found or given"),
  c("order", "1", "order of the process"),
  c("correlation_time_s", "s", "correlation time of the errors, 0 where they are white"),
  c("white_share", "1", "share of the errors' variance that is white; > 1: anticorrelated"),
  c("log10_smoothness", "1", "log10 of q h^(2p-1)/sigma^2, with the mean spacing h"),
  c(
    "smoothness", "",
    "\"within range\", \"polynomial\" (one fits), \"joins the samples\" (too few of them)"
  ),
  c("theta_scatter_rad", "rad", "standard deviation of a measured angle"),
  c("omega_scatter_rad_per_s", "rad/s", "standard deviation of a measured rate"),
  c("degrees", "1", "degrees of freedom"),
  c("level", "1", "coverage of the intervals"),
  c("energy_loss_j", "J", "kinetic energy at the beginning less that at the end"),
  c("energy_loss_se_j", "J", "its standard error"),
  c("energy_loss_low_j", "J", "lower end of its interval"),
  c("energy_loss_high_j", "J", "upper end of its interval"),
  c("time_se_s", "s", "standard error of the time"),
  c("omega_jump_rad_per_s", "rad/s", "omega behind the break less that before it"),
  c("omega_jump_se_rad_per_s", "rad/s", "its standard error"),
  c("alpha_jump_rad_per_s2", "rad/s^2", "angular acceleration behind the break less that before"),
  c("alpha_jump_se_rad_per_s2", "rad/s^2", "its standard error")
)

# With the columns that a constraint's file adds: lists of this form, named `<topic>_column_words`.
column_table <- function() {
  if (is.null(columns_read$table)) {
    here <- environment(column_table)
    more <- mget(ls(here, pattern = "^[a-z]+_column_words$"), envir = here)
    table <- as.data.frame(do.call(rbind, c(column_list, unlist(unname(more), recursive = FALSE))))
    names(table) <- c("name", "unit", "meaning")
    columns_read$table <- table
  }
  columns_read$table
}

# What stands for units in the names of columns and arguments: "rad_per_s", "per_s".
unit_suffix <- function(units) {
  words <- gsub("^", "", gsub("/", "_per_", units, fixed = TRUE), fixed = TRUE)
  ifelse(units == "degree", "deg", sub("^1_", "", tolower(gsub("[ *]", "_", words))))
}

# "theta_rad" of "theta_rad[2]".
without_place <- function(paths) sub("\\[[0-9]+\\]$", "", paths)

# "rad/s" of `spin_rad_per_s`, by the columns whose names end alike, "1/s" of `decay_per_s`;
# else "1".
unit_in_name <- function(names) {
  # Of no column, but of an argument of resistance().
  known <- union(stats::na.omit(column_table()$unit), "N m s^2")
  known <- known[nzchar(known) & !startsWith(known, "1")]
  suffix <- unit_suffix(known)
  vapply(names, function(name) {
    fits <- endsWith(name, paste0("_", suffix))
    if (!any(fits)) return("1")
    best <- which(fits)[which.max(nchar(suffix[fits]))]
    before <- substr(name, 1L, nchar(name) - nchar(suffix[best]) - 1L)
    if (!endsWith(before, "_per")) return(known[best])
    paste0(unit_in_name(sub("_per$", "", before)), "/", known[best])
  }, "", USE.NAMES = FALSE)
}

# The words of a name before its unit.
words_in_name <- function(name, unit = unit_in_name(name)) {
  if (unit != "1") name <- substr(name, 1L, nchar(name) - nchar(unit_suffix(unit)) - 1L)
  gsub("_", " ", name)
}
columns_read <- new.env(parent = emptyenv())

# For the help pages: an itemized list of columns. `meanings`: those of this page, by name.
describe_columns <- function(names, meanings = NULL) {
  table <- column_table()
  unknown <- setdiff(names, table$name)
  # Else the page would say NA.
  if (length(unknown)) stop("not in the dictionary of columns: ", toString(unknown))
  rows <- table[match(names, table$name), ]
  meanings <- meanings[names(meanings) %in% rows$name]
  rows$meaning[match(names(meanings), rows$name)] <- meanings
  unit <- ifelse(rows$unit %in% c("", "1"), "", paste0(" (", rows$unit, ")"))
  paste0(
    "\\itemize{\n",
    paste0(
      "\\item \\code{", rows$name, "}", unit, ": ", gsub("`", "", rows$meaning),
      collapse = "\n"
    ),
    "\n}"
  )
}

with_errors <- function(stems, units) {
  unlist(Map(function(stem, unit) {
    paste0(stem, c("", "_se", "_low", "_high"), "_", unit)
  }, stems, units), use.names = FALSE)
}
estimate_columns <- c(
  "time_s", with_errors(c("theta", "omega", "alpha"), c("rad", "rad_per_s", "rad_per_s2")),
  "segment", "flag"
)
estimate_torque_columns <- with_errors(
  c("net_torque", "applied_torque", "power", "rotational_kinetic_energy"), c("n_m", "n_m", "w", "j")
)
estimate_glance_columns <- c(
  "samples", "outliers", "breaks", "order", "log10_smoothness", "smoothness", "theta_scatter_rad",
  "omega_scatter_rad_per_s", "correlation_time_s", "white_share", "degrees", "level"
)
energy_loss_columns <- c("from_s", "to_s", with_errors("energy_loss", "j"))
estimate_event_columns <- c(
  "time_s", "time_se_s", "event", "omega_jump_rad_per_s", "omega_jump_se_rad_per_s",
  "alpha_jump_rad_per_s2", "alpha_jump_se_rad_per_s2", "segment"
)
trajectory_columns <- c(
  "time_s", "theta_rad", "omega_rad_per_s", "applied_torque_n_m", "damping_torque_n_m",
  "net_torque_n_m", "angular_momentum_kg_m2_per_s", "rotational_kinetic_energy_j"
)
summary_columns <- c(
  "moment_of_inertia_kg_m2", "max_angular_velocity_rad_per_s", "max_angular_velocity_time_s",
  "max_angular_momentum_kg_m2_per_s", "max_rotational_kinetic_energy_j",
  "max_rotational_kinetic_energy_time_s", "final_theta_rad", "model", "accuracy", "error",
  "error_kind", "steps", "rhs_calls"
)
spin_up_table_columns <- c(
  "final_theta_rad", "final_omega_rad_per_s", "max_omega_rad_per_s", "max_omega_time_s",
  "min_omega_rad_per_s", "max_abs_omega_rad_per_s", "error"
)
augment_columns <- c(
  "power_w", "work_j", "dissipated_j", "dissipated_viscous_j", "dissipated_quadratic_j",
  "dissipated_coulomb_j", "inertia_work_j", "torque_impulse_n_m_s", "damping_impulse_n_m_s"
)
audit_columns <- c(
  "balance", "about", "unit", "change", "supplied", "dissipated", "residual", "rounding",
  "conserved", "verdict"
)
period_columns <- c("period_s", "kind", "amplitude_rad", "amplitude_ratio")
clutch_summary_columns <- c(
  "final_omega_1_rad_per_s", "final_omega_2_rad_per_s", "heat_j", "lock_time_s"
)
rolling_columns <- c(
  "acceleration_m_per_s2", "final_speed_m_per_s", "rotational_energy_fraction",
  "translational_energy_fraction"
)
energy_columns <- c(
  "moment_of_inertia_kg_m2", "omega_rad_per_s", "translational_kinetic_energy_j",
  "rotational_kinetic_energy_j", "total_kinetic_energy_j", "rotational_energy_fraction",
  "translational_energy_fraction"
)
inertia_columns <- c(
  "moment_of_inertia_kg_m2", "axis", "ixx_kg_m2", "iyy_kg_m2", "izz_kg_m2", "beta",
  "radius_of_gyration_m", "formula"
)
shape_columns <- c(
  "shape", "family", "constructor", "dimension", "sizes", "ixx_formula", "iyy_formula",
  "izz_formula", "centre_formula", "origin", "beta_formula", "measure_formula", "axis", "formula",
  "source"
)
model_columns <- c(
  "model", "constraint", "equations", "assumptions", "limits", "requires", "error", "error_kind",
  "source"
)
motion_columns <- c(
  "row", "root", "theta_rad", "omega0_rad_per_s", "omega_rad_per_s", "alpha_rad_per_s2", "time_s"
)
point_columns <- c(
  "tangential_speed_m_per_s", "tangential_acceleration_m_per_s2",
  "centripetal_acceleration_m_per_s2", "total_acceleration_m_per_s2", "acceleration_angle_rad"
)
work_precision_columns <- c(
  "model", "method", "accuracy", "theta_error", "omega_error", "true_error", "floor", "error",
  "error_kind", "covered", "cost_s", "cost_median_s", "rhs_calls", "steps", "rejected",
  "energy_residual", "reference", "reference_error"
)
incline_table_columns <- c(
  "final_x_m", "final_v_m_per_s", "final_theta_rad", "final_omega_rad_per_s", "slip_heat_j",
  "rolling_heat_j", "roll_time_s", "rolling", "error"
)
friction_columns <- c(
  "friction_needed", "static_friction", "critical_angle_deg", "from_rest", "acceleration_m_per_s2",
  "alpha_rad_per_s2"
)
race_columns <- c(
  "lane", "time_s", "x_m", "v_m_per_s", "theta_rad", "omega_rad_per_s", "finished"
)
race_summary_columns <- c(
  "place", "acceleration_m_per_s2", "finish_time_s", "final_speed_m_per_s", "friction_needed",
  "from_rest"
)
bounce_columns <- c(
  "vx_m_per_s", "vy_m_per_s", "omega_rad_per_s", "normal_impulse_n_s", "friction_impulse_n_s",
  "normal_loss_j", "friction_loss_j", "sticks"
)
hinged_columns <- c(
  "omega_rad_per_s", "particle_v_m_per_s", "impulse_n_s", "hinge_impulse_n_s", "normal_loss_j"
)
precession_columns <- c(
  "gravity_torque_n_m", "spin_angular_momentum_kg_m2_per_s", "precession_rad_per_s",
  "precession_period_s", "formula_error"
)
nutation_columns <- c(
  "slow_precession_rad_per_s", "fast_precession_rad_per_s", "nutation_period_s",
  "lowest_angle_deg", "mean_precession_rad_per_s", "sleeping_spin_rad_per_s"
)
projectile_columns <- c(
  "east_m", "north_m", "up_m", "east_m_per_s", "north_m_per_s", "up_m_per_s", "deflection_east_m",
  "deflection_north_m", "deflection_up_m", "first_order_east_m", "first_order_north_m",
  "first_order_up_m", "first_order_error_m"
)
drop_columns <- c(
  "fall_time_s", "deflection_east_m", "deflection_north_m", "first_order_east_m",
  "first_order_error"
)
foucault_columns <- c(
  "east_m", "north_m", "east_m_per_s", "north_m_per_s", "plane_rate_rad_per_s", "swing_period_s",
  "plane_turn_s", "ellipse_rate_rad_per_s"
)
frame_term_columns <- c(
  "centrifugal_x_m_per_s2", "centrifugal_y_m_per_s2", "centrifugal_z_m_per_s2",
  "coriolis_x_m_per_s2", "coriolis_y_m_per_s2", "coriolis_z_m_per_s2", "euler_x_m_per_s2",
  "euler_y_m_per_s2", "euler_z_m_per_s2"
)
tumbling_columns <- c(
  "final_qw", "final_qx", "final_qy", "final_qz", "final_omega_x_rad_per_s",
  "final_omega_y_rad_per_s", "final_omega_z_rad_per_s", "error"
)
stability_columns <- c(
  "axis", "principal_moment_kg_m2", "x", "y", "z", "stability", "growth_per_omega",
  "wobble_per_omega"
)
roll_disk_columns <- c(
  "time_s", "x_m", "y_m", "z_m", "contact_x_m", "contact_y_m", "qw", "qx", "qy", "qz",
  "omega_space_x_rad_per_s", "omega_space_y_rad_per_s", "omega_space_z_rad_per_s", "lean_rad",
  "kinetic_energy_j", "potential_energy_j", "normal_n", "friction_needed"
)
roll_disk_meanings <- c(
  x_m = "x of the centre, from below its start", y_m = "y of the centre",
  z_m = "height of the centre over the floor",
  qw = "attitude, the disk's axis being the body's z: scalar part of the quaternion",
  normal_n = "push of the floor; below 0 the disk would lift off",
  friction_needed = "coefficient of friction without which it slips"
)
disk_speed_columns <- c("min_speed_m_per_s", "min_spin_rad_per_s")
turntable_columns <- c(
  "time_s", "x_m", "y_m", "vx_m_per_s", "vy_m_per_s", "omega_x_rad_per_s", "omega_y_rad_per_s",
  "omega_z_rad_per_s", "circle_x_m", "circle_y_m", "circle_radius_m", "circle_period_s",
  "kinetic_energy_j", "work_j", "energy_residual_j"
)
turntable_meanings <- c(
  x_m = "x of the centre, from the table's axis", y_m = "y of the centre",
  vx_m_per_s = "its velocity over the ground", vy_m_per_s = "the same along y",
  omega_x_rad_per_s = "angular velocity of the ball, axes of the ground",
  work_j = "work of the friction on the ball since the start"
)
axis_path_columns <- c(
  "axis_x", "axis_y", "axis_z", "axis_inclination_rad", "axis_azimuth_rad"
)
quaternion_columns <- c("qw", "qx", "qy", "qz")
collide_columns <- c(
  "vx_1_m_per_s", "vy_1_m_per_s", "vz_1_m_per_s", "omega_x_1_rad_per_s", "omega_y_1_rad_per_s",
  "omega_z_1_rad_per_s", "vx_2_m_per_s", "vy_2_m_per_s", "vz_2_m_per_s", "omega_x_2_rad_per_s",
  "omega_y_2_rad_per_s", "omega_z_2_rad_per_s", "impulse_x_n_s", "impulse_y_n_s",
  "impulse_z_n_s", "normal_impulse_n_s", "friction_impulse_n_s", "normal_loss_j",
  "friction_loss_j", "sticks", "creates_energy"
)
lock_columns <- c("common_omega_rad_per_s", "angular_impulse_n_m_s", "friction_loss_j")
rims_columns <- c(
  "omega_1_rad_per_s", "omega_2_rad_per_s", "impulse_n_s", "friction_loss_j", "locked"
)
ledger_columns <- c(
  "balance", "about", "unit", "before", "after", "change", "supplied", "dissipated", "residual",
  "rounding", "verdict"
)
conserved_columns <- c("quantity", "about", "conserved", "why")
impulse_columns <- c(
  "from_s", "to_s", "angular_impulse_n_m_s", "angular_impulse_error_n_m_s",
  "omega_change_rad_per_s"
)
principal_columns <- c(
  "axis", "principal_moment_kg_m2", "second_moment_kg_m2", "x", "y", "z", "unique"
)
engagement_columns <- c("lock_time_s", "common_omega_rad_per_s", "heat_j", "locked_torque_n_m")
gear_columns <- c(
  "shaft", "ratio_to_first", "moment_of_inertia_kg_m2", "reflected_inertia_kg_m2",
  "reflected_viscous_n_m_s", "reflected_torque_n_m"
)
resultant_columns <- c(
  "force_n", "axis_x_m", "axis_y_m", "axis_z_m", "couple_n_m", "pitch_m", "force_error_n",
  "torque_error_n_m"
)
equilibrium_columns <- c(
  "support", "kind", "force_n", "normal_n", "friction_n", "friction_needed", "sliding_margin",
  "determined", "error_n", "error_n_m", "state"
)
equilibrium_summary_columns <- c(
  "verdict", "unknowns", "rank", "redundant", "free_motions", "condition_number",
  "tipping_margin_n", "sliding_margin", "motion", "residual_force_n", "residual_torque_n_m"
)
reaction_columns <- c(
  "support", "component", "value", "unit", "determined", "lowest", "highest", "error"
)
load_factor_columns <- c("load", "lowest_factor", "highest_factor", "below", "above")
curve_columns <- c(
  "time_s", "x_m", "y_m", "path_m", "v_m_per_s", "omega_rad_per_s", "normal_n",
  "friction_force_n", "friction_needed", "event"
)
curve_summary_columns <- c(
  "event", "time_s", "x_m", "y_m", "path_m", "v_m_per_s", "min_normal_n", "friction_needed",
  "error", "error_kind", "finest"
)
curve_meanings <- c(
  x_m = "x of the centre", y_m = "its y, up", v_m_per_s = "speed of the centre",
  omega_rad_per_s = "angular velocity v/r; NA for a number instead of a body",
  normal_n = "push of the track on the body",
  friction_force_n = "friction on the body, positive in the direction of the motion",
  time_s = "time since the start",
  event = "how the motion ends", error = "relative error of the time"
)
curve_meant <- setdiff(
  names(curve_meanings), c("omega_rad_per_s", "normal_n", "friction_force_n")
)
curve_shown <- setdiff(names(curve_meanings), "error")
spool_columns <- c(
  "acceleration_m_per_s2", "alpha_rad_per_s2", "friction_force_n", "normal_n", "friction_needed",
  "critical_angle_deg", "motion"
)
spool_meanings <- c(
  acceleration_m_per_s2 = "of the centre, positive towards the pull",
  alpha_rad_per_s2 = "angular acceleration, positive as it rolls towards the pull",
  friction_force_n = "friction on the spool, positive towards the pull",
  normal_n = "push of the floor",
  critical_angle_deg = "angle of the pull at which the spool stays",
  motion = "\"rolls towards the pull\", \"rolls away\", \"stays\", \"slips\" or \"lifts\""
)
yo_yo_columns <- c("acceleration_m_per_s2", "alpha_rad_per_s2", "tension_n")
yo_yo_meanings <- c(acceleration_m_per_s2 = "of the centre, down")
atwood_columns <- c("acceleration_m_per_s2", "tension_1_n", "tension_2_n", "motion")
atwood_meanings <- c(
  acceleration_m_per_s2 = "of the first mass, down",
  motion = "\"1 goes down\", \"2 goes down\" or \"stays\""
)
falling_rod_columns <- c(
  "omega_rad_per_s", "alpha_rad_per_s2", "tip_acceleration_m_per_s2", "tip_fall_m_per_s2",
  "hinge_along_n", "hinge_across_n", "bending_moment_n_m", "break_at_m"
)
falling_rod_meanings <- c(omega_rad_per_s = "angular velocity of the fall")

free_rates <- function(of) paste0("omega_", of, c("x", "y", "z"), "_rad_per_s")

free_momenta <- paste0("angular_momentum_", c("x", "y", "z"), "_kg_m2_per_s")

# ---- units of names -----------------------------------------------------------------------------

# The unit in which a name ends, as this package writes units: `theta_rad`, `v_m_per_s`; "1": none.
unit_of_name <- function(name) {
  found <- spelled_units()
  ends <- endsWith(name, paste0("_", names(found)))
  if (any(ends)) found[ends][[which.max(nchar(names(found)[ends]))]] else "1"
}

# Names without their units.
without_unit <- function(names) {
  words <- names(spelled_units())
  vapply(names, function(name) {
    ends <- words[endsWith(name, paste0("_", words))]
    if (length(ends)) substr(name, 1L, nchar(name) - max(nchar(ends)) - 1L) else name
  }, "", USE.NAMES = FALSE)
}

# The units of the dictionary by their spelling in names.
spelled_units <- function() {
  units <- unique(column_table()$unit)
  units <- units[!units %in% c("", "1", "degree")]
  words <- gsub("[ .]", "_", gsub("/", "_per_", gsub("^", "", tolower(units), fixed = TRUE)))
  stats::setNames(c(units, "degree"), c(words, "deg"))
}
fit_columns <- c(
  "unknown", "record", "value", "standard_error", "lower", "upper", "unit", "status"
)
fit_meanings <- c(
  record = "the record that has it for itself; NA: all", value = "the fitted value",
  standard_error = "NaN: not determined, or at an edge",
  status = "determined, not determined, at its lower or upper limit, not converged"
)
profile_columns <- c("unknown", "value", "linear", "rooted")
profile_meanings <- c(
  value = "at which it is held",
  linear = "its distance from the fit in standard errors (of the logarithm, where that is fitted)",
  rooted = "the same by the growth of the sum of squares: equal where the problem is linear"
)
design_columns <- c("candidate", "unknown", "standard_error", "planned_error", "ratio")
design_meanings <- c(
  candidate = "its name", standard_error = "of the fit; NaN: not determined, or at an edge",
  planned_error = "with the further record; NaN: not determined then either",
  ratio = "of both; 0: what is not determined now would be"
)
sweep_inputs_columns <- c("input", "unit", "value", "domain", "meaning")
sweep_inputs_meanings <- c(
  input = "its path", value = "in the scene; NaN where it follows from others, or is an object",
  meaning = "in words"
)
sweep_outputs_columns <- c("output", "unit", "meaning")
sweep_outputs_meanings <- c(output = "its name", meaning = "in words")
sweep_status_columns <- c(
  "rows_done", "rows", "chunks_done", "chunks", "time_left_s", "writing", "owner"
)
sweep_status_meanings <- c(rows = "of the sweep")
sweep_receipt_columns <- c("chunk", "rows", "kept", "bytes", "seconds")
sweep_receipt_meanings <- c(rows = "computed")
sweep_check_columns <- c("chunk", "fault")
sweep_check_meanings <- c(fault = "what is wrong")
sweep_summary_columns <- c(
  "output", "unit", "mean", "mean_error", "sd", "min", "min_row", "max", "max_row", "finite",
  "infinite"
)
sweep_summary_meanings <- c(
  output = "its name",
  mean = "of the finite values", sd = "their standard deviation, n - 1 in the denominator"
)
sweep_quantile_columns <- c("output", "p", "value", "low", "high")
sweep_quantile_meanings <- c(
  output = "its name",
  value = "the middle of the interval", low = "lower bound of the quantile",
  high = "upper bound of the quantile"
)
sweep_index_columns <- c("output", "input", "first", "first_error", "total", "total_error")
sweep_index_meanings <- c(output = "its name", input = "the input of the design")
sweep_audit_columns <- c("row", "model", "other", "verdict", "difference")
sweep_audit_meanings <- c(
  row = "number of the row", verdict = "of its audit",
  difference = "at the end, over what both errors allow"
)
