# What a long run does to the energy and the angular momentum: the splitting, the exact models and
# the classical Runge-Kutta method, over many periods. Prints a table, and plots the drift where
# ggplot2 is installed. The figures are the largest deviations from the start, relative, in the
# first and in the last hundredth of the span: a method that drifts has a ratio of 100.
#
#   Rscript bench/drift.R [PERIODS [FILE.png]]        1e5 periods; drift.png
suppressMessages(library(rotdyn))

args <- commandArgs(trailingOnly = TRUE)
periods <- if (length(args)) as.double(args[1]) else 1e5
file <- if (length(args) > 1L) args[2] else "drift.png"

tumbling <- scene_free(c(1, 2, 3), c(0.3, 2, 0.4))
tilted <- attitude_from(c(1, 0, 0, 0.6), "axis_angle")
heavy_top <- scene_pivot(
  c(1, 1, 1.6), c(0, 0, 3), mass_kg = 1, centre_m = c(0, 0, 1), gravity_m_per_s2 = 1,
  attitude0 = tilted
)
asymmetric_top <- scene_pivot(
  c(1, 1.4, 2.2), c(0.3, 0.2, 2), mass_kg = 1, centre_m = c(0.2, 0, 1), gravity_m_per_s2 = 1
)
# Periods in s: of the tumbling and of the nutation; the last top's is that of its first swing.
cases <- list(
  list("free, I = (1, 2, 3)", tumbling, 2 * flip_time(c(1, 2, 3), c(0.3, 2, 0.4)),
       c("free_exact", "free_split", "free_rk4")),
  list("heavy symmetric top", heavy_top,
       summary(trajectory(heavy_top, 0:1))$nutation_period_s,
       c("pivot_top", "pivot_split", "pivot_rk4")),
  list("asymmetric top, hard driven", asymmetric_top, 5.9, c("pivot_split", "pivot_rk4"))
)

energy <- function(x) {
  e <- x$rotational_kinetic_energy_j
  if (!is.null(x[["potential_energy_j"]])) e <- e + x$potential_energy_j
  e
}

deviation <- function(x) {
  e <- energy(x)
  lz <- x$angular_momentum_z_kg_m2_per_s
  data.frame(
    time_s = x$time_s, energy = abs(e - e[1]) / max(x$rotational_kinetic_energy_j),
    lz = abs(lz - lz[1]) / max(abs(lz))
  )
}

drift <- function(case, model) {
  span <- periods * case[[3]]
  # Rows that no period of the motion hides, dense at both ends and in the steps of a logarithm.
  even <- (seq_len(400) * 0.6180339887498949) %% 1
  t <- sort(unique(c(
    0, span, span * even / 100, span * (1 - even / 100), span * 10^seq(-log10(periods), 0, 0.01)
  )))
  cpu <- system.time(
    x <- suppressWarnings(
      trajectory(case[[2]], t, model = model, accuracy = 1, max_steps = 1e12),
      "rotdyn_warning_accuracy"
    )
  )[["user.self"]]
  off <- deviation(x)
  off$scene <- case[[1]]
  off$model <- model
  off$period <- off$time_s / case[[3]]
  early <- off$period <= periods / 100
  late <- off$period >= periods * 0.99
  info <- attr(x, "run")$info
  cat(sprintf(
    "%-28s %-12s %9.1e %9.1e %9.1e %10.1e %8.2f\n", case[[1]], model, max(off$energy[early]),
    max(off$energy[late]), max(off$lz), info$errors[["attitude"]], cpu
  ))
  off
}

cat(format(periods), "periods\n")
cat(sprintf(
  "%-28s %-12s %9s %9s %9s %10s %8s\n", "", "", "dE/E", "dE/E", "dLz/Lz", "attitude", ""
))
cat(sprintf(
  "%-28s %-12s %9s %9s %9s %10s %8s\n", "scene", "model", "early", "late", "largest", "bar, rad",
  "cpu, s"
))
all <- do.call(rbind, lapply(cases, function(case) {
  do.call(rbind, lapply(case[[4]], function(model) drift(case, model)))
}))

if (requireNamespace("ggplot2", quietly = TRUE)) {
  all$highest <- stats::ave(all$energy, all$scene, all$model, FUN = cummax)
  all <- all[all$period > 0, ]
  all$method <- sub("^[a-z]+_", "", sub("pivot_top|free_exact", "a_exact", all$model))
  plot <- ggplot2::ggplot(
    all, ggplot2::aes(period, pmax(highest, 1e-17), colour = method)
  ) +
    ggplot2::geom_line(linewidth = 0.8) +
    ggplot2::facet_wrap(~scene) +
    ggplot2::scale_x_log10() +
    ggplot2::scale_y_log10() +
    ggplot2::scale_colour_manual(
      values = c(exact = "#1f6feb", split = "#2da44e", rk4 = "#cf222e")
    ) +
    ggplot2::labs(
      x = "periods", y = "largest |dE/E| so far", colour = NULL
    ) +
    ggplot2::theme_minimal(base_size = 11) +
    ggplot2::theme(legend.position = "top", panel.spacing.x = ggplot2::unit(1.5, "lines"),
                   plot.margin = ggplot2::margin(6, 18, 6, 6))
  ggplot2::ggsave(file, plot, width = 9, height = 3.6, dpi = 130, bg = "white")
  cat("picture:", file, "\n")
}
