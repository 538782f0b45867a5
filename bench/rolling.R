# rolling_table() against a dplyr pipeline as a teacher would write it, and against plain R.

rolling_g <- 9.80665

rolling_contenders <- function(objects, angle, sample_rows) {
  ours <- function() rotdyn::rolling_table(objects)
  frame <- as.data.frame(objects)
  plain <- function() {
    out <- frame
    out$acceleration_m_per_s2 <- rolling_g * sin(angle * pi / 180) / (1 + out$beta)
    out$final_speed_m_per_s <- sqrt(2 * rolling_g * 1 / (1 + out$beta))
    out$rotational_energy_fraction <- out$beta / (1 + out$beta)
    out$translational_energy_fraction <- 1 / (1 + out$beta)
    out
  }
  pipeline <- function() {
    objects |>
      dplyr::mutate(
        acceleration_m_per_s2 = rolling_g * sin(angle * pi / 180) / (1 + beta),
        final_speed_m_per_s = sqrt(2 * rolling_g * 1 / (1 + beta)),
        rotational_energy_fraction = beta / (1 + beta),
        translational_energy_fraction = 1 / (1 + beta)
      )
  }
  reference <- rolling_reference(
    objects$beta[sample_rows], if (length(angle) > 1) angle[sample_rows] else angle
  )
  judged <- function(name, run) {
    contender(name, run, rolling_error(run()[sample_rows, names(reference)], reference))
  }
  c(
    list(judged("rotdyn", ours)),
    if (has_package("dplyr")) list(judged("dplyr, mutate()", pipeline)),
    list(judged("base R", plain))
  )
}

rolling_reference <- function(beta, angle) {
  whole <- plus(rep(1, length(beta)), beta)
  drop <- times(two_prod(rolling_g, 2), 1)
  list(
    acceleration_m_per_s2 = over(times(sin_degrees(angle), rolling_g), whole),
    final_speed_m_per_s = root(over(drop, whole)),
    rotational_energy_fraction = over(beta, whole),
    translational_energy_fraction = over(rep(1, length(beta)), whole)
  )
}

# Largest relative difference over the four columns.
rolling_error <- function(rows, reference) {
  max(mapply(function(x, r) max(off_by(x, r) / abs(r$hi)), rows, reference))
}

run_rolling <- function(rounds) {
  set.seed(20)
  one <- function(case, n, angles = FALSE) {
    objects <- tibble::tibble(beta = stats::runif(n))
    if (angles) objects$incline_angle_deg <- stats::runif(n, 1, 60)
    large <- n > 1e6
    paired(
      "rolling", case,
      rolling_contenders(
        objects, if (angles) objects$incline_angle_deg else 20,
        sort(sample.int(n, min(n, 1e4)))
      ),
      rounds = if (large) max(3, rounds %/% 3) else rounds, batches = 3, collect = n >= 1e5
    )
  }
  rbind(
    one("1e3 rows", 1e3),
    one("1e5 rows", 1e5),
    one("1e5 rows, an angle each", 1e5, angles = TRUE),
    one("1e7 rows", 1e7)
  )
}
