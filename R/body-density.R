#' A body from a density field
#'
#' Mass, centre of mass and second moment of a body whose density is a function of position, by
#' quadrature if the domain has a map, otherwise from random points:
#' \deqn{m = \int \rho\,dV,\quad g = \frac{1}{m}\int \rho\,x\,dV,\quad
#'   C = \int \rho\,(x - g)(x - g)^T dV}{
#'   m = int rho dV,  g = int rho x dV / m,  C = int rho (x - g)(x - g)' dV}
#'
#' @section Quadrature: Gauss-Legendre nodes in each parameter of the domain, evenly spaced nodes
#'   for a periodic angle. The number of nodes grows by half, in the parameter that changes the
#'   result most, until the changes are below `accuracy`; then two more nodes in each parameter (at
#'   least 16) must agree. Smooth densities take some thousand evaluations for ten digits, and the
#'   reported error covers the true one for 99 of 100 random densities.
#'
#'   A discontinuity or a kink inside the domain uses all evaluations and leaves two to five digits;
#'   the reported error then covers the true one in nine of ten cases or more. It is better to split
#'   the domain there, make a body of each part and [join_bodies()].
#'
#'   Features between the nodes are not seen: a region smaller than a tenth of the domain needs a
#'   domain of its own.
#' @section Random points: One point in each cell of a grid of equal cells, in 16 independent grids.
#'   `error` is the standard error of the second moment (the largest of its six components, relative
#'   to the trace) by the jackknife over the grids. It is not a bound: for a torus the error of the
#'   worst component was larger in half of 660 runs, and more than four times as large in one; that
#'   of the mass was larger in a third. It decreases as the number of points to the power -2/3
#'   (without cells: -1/2): for the torus 4e-3 at 2e4 points, 1.7e-4 at 2e6.
#'
#' @param f Density in kg/m^3: one number, or a function of three vectors `x_m`, `y_m`, `z_m` that
#'   returns a vector of the same length. With `mass_kg`, density up to a factor.
#' @param domain See [domains]. `f` gets coordinates in the axes of the domain.
#' @param ... Not used; names after it must be given in full.
#' @param mass_kg Total mass, to which the density is scaled.
#' @param accuracy Accepted error: of the second moment relative to its trace, of the mass, of the
#'   centre relative to the radius of gyration. If it is not given, `max_evaluations` random points
#'   are used.
#' @param max_evaluations Largest number of evaluations of `f`.
#' @param method `"auto"`: quadrature if the domain has a map.
#' @param seed Seed of the random points, a whole number of at least 0. R's random numbers are not
#'   affected.
#' @param name Name of the body.
#' @return A `rot_body` in the axes of the domain. `error` is an estimate; `detail` has the `nodes`
#'   of each parameter (or the number of `points`, of those `inside`, and `seed`), the number of
#'   `evaluations`, the relative `mass_error` (0 for a given mass) and `centre_error_m`.
#' @section Errors: `rotdyn_error_density` for an `f` (or map, Jacobian, inside) that does not
#'   return a finite number of at least 0 for each point, and for a body without mass;
#'   `rotdyn_error_model` for quadrature without a map; `rotdyn_error_type`, `rotdyn_error_size`,
#'   `rotdyn_error_value`, `rotdyn_error_unit`, `rotdyn_error_range`. An error in `f` keeps its
#'   class. A warning `rotdyn_warning_accuracy` if `accuracy` was not reached; the body has the
#'   error reached.
#' @source Davis and Rabinowitz, Methods of Numerical Integration, 2nd ed. (1984), chapters 2 and 5;
#'   Efron and Stein, Annals of Statistics 9 (1981) 586, for the jackknife.
#' @seealso [domains], [body_points()]
#' @concept custom shape
#' @concept density
#' @concept integral
#' @concept moment of inertia
#' @examples
#' # A planet twice as dense at the centre as at the surface.
#' planet <- body_density(
#'   function(x_m, y_m, z_m) 8000 - 4000 * sqrt(x_m^2 + y_m^2 + z_m^2) / 6.4e6,
#'   domain_ball(radius_m = 6.4e6)
#' )
#' planet
#' moment_of_inertia(planet, "z") / (planet$mass_kg * 6.4e6^2) # below 0.4
#'
#' # Uniform density: a number. The centre of this quarter of a disk is at 4 r/(3 pi).
#' body_density(1000, domain_cylinder(0.3, 0.02, angle_rad = c(0, pi / 2)))$centre_m
#'
#' # A domain defined by a predicate.
#' body_density(
#'   1000,
#'   domain_inside(function(x, y, z) x^4 + y^4 + z^4 < 1, c(-1, -1, -1), c(1, 1, 1)),
#'   max_evaluations = 1e4
#' )
#' @export
body_density <- function(f, domain, ..., mass_kg = NULL, accuracy = 1e-10,
                         max_evaluations = 1e6, method = c("auto", "quadrature", "monte_carlo"),
                         seed = 1, name = "density") {
  call <- check_no_dots(...)
  check_supplied(c("f", "domain"), call)
  remedy <- "Make one with {.fn domain_box} or another constructor."
  check_class(domain, "rot_domain", "domain", remedy, call)
  check_form(domain, domain_form, "domain", "domain", call)
  name <- check_name(name, "name", call)
  if (!is.null(mass_kg)) mass_kg <- check_number(mass_kg, "mass_kg", "kg", call, lower = 0)
  method <- density_method(method, domain, call)
  run <- list(
    domain = domain,
    density = density_function(f, call),
    mass_kg = mass_kg,
    accuracy = if (method == "quadrature" || !missing(accuracy)) check_accuracy(accuracy, call),
    budget = check_number(max_evaluations, "max_evaluations", "1", call, 1000, 2^50),
    seed = check_seed(seed, call),
    progress = progress_bar("density"),
    call = call
  )
  found <- if (method == "quadrature") density_quadrature(run) else density_random(run)
  if (!is.null(run$accuracy) && !(max(found$errors) <= run$accuracy)) {
    warn_missed_accuracy(found, run, method)
  }
  density_body(found, run, method, name)
}

density_method <- function(method, domain, call) {
  method <- check_choice(method, "method", c("auto", "quadrature", "monte_carlo"), call)
  mapped <- domain$kind != "inside"
  if (method == "quadrature" && !mapped) {
    abort_rotdyn(c(
      "Quadrature needs a domain with a map.",
      x = "{.fn domain_inside} has no map.",
      i = "Use {.code method = \"monte_carlo\"}, or {.fn domain_map}."
    ), "model", call)
  }
  if (method == "auto") return(if (mapped) "quadrature" else "monte_carlo")
  method
}

density_function <- function(f, call) {
  if (is.function(f)) {
    check_field_function(f, "f", call)
    return(function(places) {
      check_field(f(places[[1]], places[[2]], places[[3]]), "f", places, call, place_columns)
    })
  }
  rho <- check_number(f, "f", "kg/m^3", call, lower = 0)
  function(places) rep(rho, length(places[[1]]))
}

# The seed of the random streams of the core.
check_seed <- function(seed, call) {
  seed <- check_number(seed, "seed", "1", call, lower = 0, upper = 2^32 - 1)
  if (seed != round(seed)) {
    abort_rotdyn("{.arg seed} must be a whole number: it is {format(seed)}.", "value", call)
  }
  seed
}

warn_missed_accuracy <- function(found, run, method) {
  reached <- max(found$errors)
  remedy <- if (reached < 1e-13) {
    "This is the limit of double precision."
  } else if (method == "quadrature") {
    "If the density has a discontinuity or a kink, split the domain there and use
     {.fn join_bodies}; otherwise increase {.arg max_evaluations}."
  } else {
    "Increase {.arg max_evaluations}: eight times as many reduce the error to a quarter."
  }
  warn_rotdyn(c(
    "The requested accuracy was not reached.",
    x = "The error is about {format(reached, digits = 2)} after
         {format(found$evaluations, big.mark = ',')} evaluations;
         {format(run$accuracy)} was requested.",
    i = remedy
  ), "accuracy", run$call)
}

density_body <- function(found, run, method, name) {
  moments <- found$moments
  second <- moments_second(moments)
  mass <- moments[["mass"]]
  if (!is.null(run$mass_kg)) {
    second <- second / mass * run$mass_kg
    mass <- run$mass_kg
  }
  trace <- moments_trace(moments)
  gyration <- if (trace > 0) sqrt(trace / moments[["mass"]]) else 0
  centre <- moments_centre(moments)
  place <- run$domain$centre_m + centre
  new_body(
    name, mass, second, place, run$domain$size_m,
    reach_m = domain_reach(run$domain, place),
    formula = "integral of rho (x - g)(x - g)'",
    source = "the density given",
    provenance = method,
    detail = c(
      found$detail,
      list(
        evaluations = found$evaluations,
        mass_error = if (is.null(run$mass_kg)) found$errors[["mass"]] else 0,
        centre_error_m = found$errors[["centre"]] * gyration + moments_centre_error(moments) +
          .Machine$double.eps * max(abs(place))
      )
    ),
    error = found$errors[["second"]],
    error_kind = "estimate",
    call = run$call
  )
}

# ---- sums over nodes ----------------------------------------------------------------------------

# Nodes of a chunk, between checks for interrupts: a multiple of the cells of a random stream.
chunk_nodes <- 65536

# Moments of the density over `total` nodes, in chunks from nodes(from, count). Coordinates are
# relative to the centre of the domain; those of a map are not.
density_moments <- function(run, nodes, total, done) {
  moments <- NULL
  hits <- 0
  for (from in seq(0, total - 1, by = chunk_nodes)) {
    count <- min(chunk_nodes, total - from)
    at <- density_places(run, nodes(from, count))
    hits <- hits + length(at$w)
    if (length(at$w)) {
      mass <- at$w * run$density(at$places)
      if (!all(mass < Inf)) abort_rotdyn("The mass exceeds double precision.", "range", run$call)
      here <- points_moments(mass, at$x, at$y, at$z, run$call, run$domain$exponent, NULL)
      moments <- join_moments(moments, here)
    }
    run$progress(min(1, (done + from + count) / run$budget))
  }
  list(moments = moments, hits = hits)
}

# x, y, z relative to the centre of the domain, weights, and the points as the user's functions get
# them.
density_places <- function(run, at) {
  domain <- run$domain
  middle <- domain$centre_m
  if (domain$kind == "map") {
    p <- domain$parameter
    u <- at$x + p[1]
    v <- at$y + p[2]
    w <- at$z + p[3]
    places <- map_places(domain, u, v, w, run$call)
    weight <- at$w * map_jacobian(domain, u, v, w, run$call)
    return(list(x = places[[1]], y = places[[2]], z = places[[3]], w = weight, places = places))
  }
  at$places <- list(at$x + middle[1], at$y + middle[2], at$z + middle[3])
  if (domain$kind == "inside") {
    keep <- domain$inside(at$places[[1]], at$places[[2]], at$places[[3]])
    keep <- check_inside(keep, at, run$call)
    at <- list(
      x = at$x[keep], y = at$y[keep], z = at$z[keep], w = at$w[keep],
      places = lapply(at$places, function(p) p[keep])
    )
  }
  at
}

check_inside <- function(keep, at, call) {
  n <- length(at$x)
  if (!is.logical(keep) || length(keep) != n || anyNA(keep)) {
    abort_rotdyn(c(
      "{.arg inside} must return TRUE or FALSE for each of the points it is given.",
      x = if (is.logical(keep) && length(keep) == n) {
        "It returned NA for {sum(is.na(keep))} of {n} point{?s}."
      } else {
        "For {n} point{?s} it returned {describe_value(keep)}."
      },
      i = if (n > 1 && length(keep) == 1L) {
        "If it takes one point at a time, wrap it: {.code Vectorize(inside)}."
      }
    ), "density", call)
  }
  keep
}

abort_no_mass <- function(evaluations, hits, call) {
  abort_rotdyn(c(
    "The body has no mass.",
    x = if (hits) {
      "The density is 0 at all {format(evaluations, big.mark = ',')} points."
    } else {
      "None of {format(evaluations, big.mark = ',')} points is inside."
    }
  ), "density", call)
}

# The difference of two results: second moment relative to the trace (for a given mass, per mass),
# mass relative to itself, centre relative to the radius of gyration.
moments_change <- function(a, b, given_mass) {
  if (a[["mass"]] == 0 || b[["mass"]] == 0) {
    return(c(second = max_change, mass = max_change, centre = max_change))
  }
  trace <- moments_trace(b)
  scale <- if (given_mass) b[["mass"]] / a[["mass"]] else 1
  gyration <- sqrt(trace / b[["mass"]])
  c(
    second = ratio_or_zero(max(abs(moments_second(a) * scale - moments_second(b))), trace),
    mass = if (given_mass) 0 else ratio_or_zero(abs(a[["mass"]] - b[["mass"]]), b[["mass"]]),
    centre = ratio_or_zero(max(abs(a[2:4] - b[2:4] + (a[5:7] - b[5:7]))), gyration)
  )
}

# Upper limit of a relative change; a single node has none.
max_change <- 10

ratio_or_zero <- function(a, b) {
  if (is.nan(a)) max_change else if (a == 0) 0 else min(a / b, max_change)
}

# The rounding error of the sums, weights and points, a lower limit of the error.
moments_floor <- function(moments) {
  moments[["error"]] + 4 * .Machine$double.eps
}

# ---- quadrature ---------------------------------------------------------------------------------

density_quadrature <- function(run) {
  even <- run$domain$periodic
  given <- !is.null(run$mass_kg)
  spent <- 0
  rules <- list()
  rule <- function(n, k) {
    key <- paste(n, even[k])
    if (is.null(rules[[key]])) {
      rules[[key]] <<- unname(.Call(ffi_density_rule, n, as.double(even[k])))
    }
    rules[[key]]
  }
  evaluate <- function(n) {
    three <- lapply(1:3, function(k) rule(n[k], k))
    nodes <- function(from, count) {
      .Call(ffi_density_nodes, run$domain$chart, three, as.double(from), as.double(count))
    }
    sums <- density_moments(run, nodes, prod(n), spent)
    spent <<- spent + prod(n)
    check_moments_fit(sums$moments, run$call)
    sums$moments
  }
  affordable <- function(n) spent + prod(n) <= run$budget
  more <- function(n, k, add) {
    n[k] <- if (even[k]) n[k] + add else .Call(ffi_density_size, n[k] + add)
    n
  }
  more_of_all <- function(n, add) more(more(more(n, 1, add[1]), 2, add[2]), 3, add[3])
  n <- ifelse(even, 8, 6)
  now <- evaluate(n)
  while (now[["mass"]] == 0 && affordable(more_of_all(n, n))) {
    n <- more_of_all(n, n)
    now <- evaluate(n)
  }
  changes <- rep(list(list()), 3)
  errors <- density_errors(changes, NULL)
  repeat {
    guess <- vapply(changes, expected_change, double(3))
    target <- max(run$accuracy - moments_floor(now), moments_floor(now) / 2)
    # If the numbers of nodes seem sufficient, two more in each parameter (at least 16) must agree.
    # Otherwise half as many more in the parameter that changes the result most.
    agree <- max(rowSums(guess)) <= target
    worst <- if (agree) 1:3 else which.max(apply(guess, 2, max))
    wider <- if (agree) more_of_all(n, pmax(2, 16 - n)) else more(n, worst, ceiling(n[worst] / 2))
    if (agree && !affordable(wider)) wider <- more_of_all(n, c(2, 2, 2))
    if (!affordable(wider)) break
    before <- now
    now <- evaluate(wider)
    n <- wider
    change <- moments_change(before, now, given)
    shares <- if (agree) change_shares(changes) else 1
    changes[worst] <- Map(function(x, share) c(x, list(share * change)), changes[worst], shares)
    errors <- density_errors(changes, if (agree) change)
    if (agree && max(errors) <= target) break
  }
  if (now[["mass"]] == 0) abort_no_mass(spent, 1, run$call)
  list(
    moments = now, errors = errors + moments_floor(now), evaluations = spent,
    detail = list(nodes = n)
  )
}

# Fast convergence: each change is at most a tenth of the one before (of the whole for the first);
# the last change is then the error of the previous rule. Otherwise a small change may be chance,
# and twice the larger of the last two is used (bench/density-coverage.R).
changes_quickly <- function(changes) {
  j <- length(changes)
  fall <- function(i) changes[[i]] <= 0.1 * changes[[i - 1L]] | changes[[i]] < 1e-15
  if (j < 2L) changes[[j]] <= 0.1 else fall(j) & (if (j > 2L) fall(j - 1L) else TRUE)
}

# The shares of the parameters in a change made in all three: in proportion to their last changes.
change_shares <- function(changes) {
  last <- vapply(changes, function(x) max(x[[length(x)]]), double(1)) + .Machine$double.eps
  last / sum(last)
}

largest_change <- function(changes) {
  j <- length(changes)
  if (j < 2L) changes[[j]] else 2 * pmax(changes[[j]], changes[[j - 1L]])
}

# The expected change by two more nodes: a hundredth of the last change, if convergence is fast.
expected_change <- function(changes) {
  if (!length(changes)) return(c(second = Inf, mass = Inf, centre = Inf))
  ifelse(changes_quickly(changes), 0.01 * changes[[length(changes)]], largest_change(changes))
}

# The error after the last changes. `last` is the change by two more nodes in every parameter, if
# made: then a hundredth of the other changes remains where convergence is fast.
density_errors <- function(changes, last) {
  share <- if (is.null(last)) 1 else 0.01
  left <- vapply(changes, function(x) {
    if (!length(x)) return(c(second = Inf, mass = Inf, centre = Inf))
    ifelse(changes_quickly(x), share * x[[length(x)]], largest_change(x))
  }, double(3))
  errors <- rowSums(left)
  if (is.null(last)) errors else pmax(errors, last)
}

# ---- random points ------------------------------------------------------------------------------

replicates <- 16

density_random <- function(run) {
  given <- !is.null(run$mass_kg)
  spent <- 0
  one <- function(side, replicate) {
    nodes <- function(from, count) {
      .Call(
        ffi_density_strata, run$domain$chart, side, c(run$seed, replicate), as.double(from),
        as.double(count)
      )
    }
    sums <- density_moments(run, nodes, side^3, spent)
    spent <<- spent + side^3
    sums
  }
  side <- floor((run$budget / replicates)^(1 / 3) + 1e-9)
  # With a requested accuracy: few points first, to predict the number needed.
  try_side <- if (is.null(run$accuracy)) side else min(8, side)
  repeat {
    parts <- lapply(seq_len(replicates), function(i) one(try_side, i))
    hits <- sum(vapply(parts, function(p) p$hits, double(1)))
    found <- jackknife(lapply(parts, function(p) p$moments), given)
    enough <- is.null(run$accuracy) || isTRUE(max(found$errors) <= run$accuracy)
    room <- floor(((run$budget - spent) / replicates)^(1 / 3) + 1e-9)
    if (enough || room <= try_side) break
    short <- if (is.null(found)) 8 else max(found$errors) / run$accuracy
    # The width of the cells is proportional to the square root of the error; with a safety factor.
    try_side <- min(room, ceiling(1.15 * try_side * max(1.2, sqrt(short))))
  }
  if (is.null(found)) abort_no_mass(spent, hits, run$call)
  check_moments_fit(found$moments, run$call)
  found$errors <- found$errors + moments_floor(found$moments)
  c(
    found,
    list(
      evaluations = spent,
      detail = list(points = replicates * try_side^3, inside = hits, seed = run$seed)
    )
  )
}

# The mean of the replicates and the standard error of its moments, each left out once. NULL without
# mass; an infinite error if only one replicate has mass.
jackknife <- function(parts, given_mass) {
  parts <- Filter(function(m) !is.null(m) && m[["mass"]] > 0, parts)
  if (!length(parts)) return(NULL)
  whole <- Reduce(join_moments, parts)
  n <- replicates
  spread <- function(a) sqrt((n - 1) / n * rowSums(a^2))
  changes <- lapply(seq_along(parts), function(i) {
    rest <- Reduce(join_moments, parts[-i])
    if (is.null(rest)) return(NULL)
    pieces_change(per_replicate(rest, n - 1), per_replicate(whole, n), given_mass)
  })
  mean <- per_replicate(whole, n)
  if (any(vapply(changes, is.null, NA))) {
    return(list(moments = mean, errors = c(second = Inf, mass = Inf, centre = Inf)))
  }
  # Omitting a replicate without mass changes only the count.
  empty <- pieces_change(per_replicate(whole, n - 1), mean, given_mass)
  changes <- c(changes, rep(list(empty), n - length(parts)))
  each <- spread(do.call(cbind, changes))
  list(
    moments = mean, errors = c(second = max(each[1:6]), mass = each[[7]], centre = max(each[8:10]))
  )
}

# The mean of the moments of n replicates.
per_replicate <- function(moments, n) {
  summed <- c("mass", "xx", "yy", "zz", "xy", "xz", "yz")
  replace(moments, summed, moments[summed] / n)
}

# The ten components of moments_change().
pieces_change <- function(a, b, given_mass) {
  trace <- moments_trace(b)
  scale <- if (given_mass) b[["mass"]] / a[["mass"]] else 1
  c(
    (moments_second(a) * scale - moments_second(b)) / trace,
    if (given_mass) 0 else a[["mass"]] / b[["mass"]] - 1,
    (a[2:4] - b[2:4] + (a[5:7] - b[5:7])) / sqrt(trace / b[["mass"]])
  )
}
