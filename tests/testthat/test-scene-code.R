# R code of scenes and bodies: what it makes, for scenes of every constructor, and what has none.

again <- function(x) eval(parse(text = scene_code(x), keep.source = FALSE), asNamespace("rotdyn"))

test_that("the code of every kind of scene makes the same scene, number by number", {
  set.seed(2)
  makers <- list(
    random_axle, random_pendulum, random_hanging, random_gears, random_rotors, random_clutch,
    random_drive, random_free, random_pivot,
    function() scene_incline(body_sphere(1, 0.1), 20, static_friction = 0.3, force = 2),
    function() scene_hoop(1, 0.5, 6, theta0_rad = 0.3, static_friction = 0.1),
    function() scene_chain(c(1, 2), c(0.5, 0.4), theta0_rad = c(1, -0.5), links = "rods")
  )
  written <- 0L
  for (make in makers) for (i in seq_len(or_long(4L, 20L))) {
    scene <- suppressMessages(make())
    code <- tryCatch(scene_code(scene), rotdyn_error_scene = function(e) NULL)
    if (is.null(code)) next # laws and bodies that are no calls
    written <- written + 1L
    expect_identical(scene_hash(suppressMessages(again(scene))), scene_hash(scene), info = code)
  }
  expect_gt(written, or_long(36L, 180L))
})

test_that("the code of a body makes the same body", {
  for (body in list(
    body_disk(2, 0.25), body_annulus(1, 0.3, 0.1), place_body(body_rod(1, 2), c(0, 0, 1)),
    join_bodies(body_disk(1, 0.2), place_body(body_sphere(1, 0.1), c(0.3, 0, 0)), name = "a \"b\""),
    cut_body(body_disk(2, 0.5), place_body(body_disk(1, 0.1), c(0.2, 0, 0)))
  )) {
    expect_identical(again(body), body)
  }
})

test_that("numbers have the digits that bring the same bits back", {
  scene <- scene_axle(1 / 3, torque_knots(c(0, 0.1, 0.7), c(0.1 + 0.2, -1e-300, 1e22)),
                      omega0_rad_per_s = sqrt(2))
  expect_identical(again(scene), scene)
  expect_match(scene_code(scene), "0.30000000000000004", fixed = TRUE)
  wheel <- scene_axle(body_disk(2, 0.25), 0.8)
  expect_identical(
    scene_code(wheel), "scene_axle(body = body_disk(mass_kg = 2, radius_m = 0.25), torque = 0.8)"
  )
})

test_that("R's parser reads each number, where its long doubles meet the middle of two as well", {
  set.seed(5)
  n <- or_long(20000L, 500000L)
  for (torque_n_m in list(runif(n), runif(n, 1, 10), 10^runif(n, -300, 300), round(runif(n), 3))) {
    scene <- scene_axle(1, torque_knots(seq_len(n), c(3.645301013417239, torque_n_m[-1])))
    expect_identical(again(scene), scene)
  }
})

test_that("steps have code, of any number and added to other laws", {
  set.seed(4)
  for (n in 1:5) {
    steps <- torque_steps(sort(runif(n, -5, 5)), rnorm(n))
    for (law in list(steps, steps + torque_spring(2), 3 * steps)) {
      scene <- scene_axle(1, law)
      expect_identical(eval(parse(text = scene_code(scene))), scene)
    }
  }
})

test_that("every law that arithmetic makes has code, or is refused", {
  laws <- list(
    torque_steps(1, 2), torque_steps(c(0, 1, 2), c(1, 2, 0)), torque_constant(2),
    torque_knots(c(0, 1, 3), c(1, 2, 0), outside = "hold"), torque_pulse(0.1, 0.2, 3),
    torque_spring(2, 0.3), torque_gravity(0.3, 0.7, 0.2), torque_sinusoid(2.1, 3, 0.1, to_s = 2),
    torque_exponential(2, 3, from_s = 1), torque_polynomial(c(0, 1, 2), rbind(1:3, 2:4)),
    torque_polynomial(c(0, 1), 2), torque_curve(c(0, 1, 4), c(3, 1, 0.5))
  )
  made <- list(
    function(x) 3 + x, function(x) -x, function(x) 2 * x, function(x) x / 3, function(x) 3 - x,
    function(x) 0 * x, function(x) x - x, function(x) -0.7 * (3 + x), function(x) 5e-324 * x
  )
  for (law in laws) for (make in made) {
    scene <- scene_axle(1, make(law))
    expect_identical(scene_hash(again(scene)), scene_hash(scene), info = scene_code(scene))
  }
  # The numbers of the product: those of the law by R's arithmetic.
  at <- function(law, theta) {
    trajectory(scene_axle(1e9, law, theta0_rad = theta), 0)$applied_torque_n_m
  }
  expect_equal(
    at(-0.7 * torque_gravity(0.3, 0.7, 0.2), 1.5), 0.7 * 0.3 * 0.7 * 9.80665 * sin(1.3),
    tolerance = 1e-15
  )
  expect_equal(at(-torque_spring(2, 0.3), 1.5), 2.4, tolerance = 1e-15)
  # A torque that rises with the speed is no motor's.
  expect_error(3 - torque_motor(3, 100), "torque_motor(-3, -100)", fixed = TRUE,
               class = "rotdyn_error_value")
  expect_identical(0.5 * torque_motor(3, 100), torque_motor(1.5, 100))
})

test_that("a body of a tensor has code, placed and joined as well", {
  tensor <- matrix(c(0.05, -0.01, 0.002, -0.01, 0.06, 0, 0.002, 0, 0.07), 3)
  bodies <- list(
    body_tensor(2, c(1, 2, 2.5)), body_tensor(2, tensor, c(0.1, 0, 0.3), reach_m = 3, name = "x"),
    body_tensor(2, tensor, products = "positive"), body_tensor(2, body_disk(2, 0.3))
  )
  bodies <- c(bodies, lapply(bodies, place_body, c(1, 0, 2)), list(do.call(join_bodies, bodies)))
  for (body in bodies) {
    expect_identical(scene_hash(again(body)), scene_hash(body), info = scene_code(body))
    expect_identical(scene_hash(read_scene(write_scene(body))), scene_hash(body))
  }
})

test_that("an attitude given once more is the same, to the last bit", {
  set.seed(2)
  for (i in 1:200) {
    given <- attitude_from(runif(3, -3, 3), "rotation_vector")
    scene <- scene_free(c(1, 2, 3), c(1, 0, 0), attitude0 = given)
    expect_identical(eval(parse(text = scene_code(scene))), scene)
  }
})

test_that("what no such code makes is refused", {
  law <- scene_axle(1, function(time_s) time_s)
  expect_error(scene_code(law), "R function", class = "rotdyn_error_scene")
  weights <- body_tensor(1, c(1, 1, 1), c(0.1, 0, 0), about = "origin")
  expect_error(scene_code(weights), "makes this body", class = "rotdyn_error_scene")
  expect_error(scene_code(scene_free(weights, c(0, 0, 1))), "makes this scene",
               class = "rotdyn_error_scene")
  expect_error(scene_code(3), class = "rotdyn_error_type")
  expect_error(scene_code(), class = "rotdyn_error_missing")
  expect_error(scene_code(law, code = 1), class = "rotdyn_error_argument")
})

test_that("what has no numbers is numeric(), which the constructors take", {
  for (scene in list(scene_gears(1, numeric()), scene_rotors(1, numeric()))) {
    expect_identical(scene_hash(eval(parse(text = scene_code(scene)))), scene_hash(scene))
  }
})
