# `make demo`: the main job on the shipped data, in a terminal 100 columns wide, with pictures in
# demo-output/. Run from the top folder, after the package is installed.
#
#   Rscript tools/demo.R            tables, model choice, audit, measured cart, pictures
#   Rscript tools/demo.R --readme   the README's picture alone, in man/figures/

library(rotdyn)
options(width = 100, pillar.width = Inf, digits = 7)
have_ggplot2 <- requireNamespace("ggplot2", quietly = TRUE)

extdata <- function(file) {
  read.csv(system.file("extdata", file, package = "rotdyn", mustWork = TRUE))
}

heading <- function(text) {
  cat("\n", text, "\n", strrep("-", nchar(text)), "\n", sep = "")
}

# 8 x 4.5 inches at 240 dots an inch fill a slide of 1920 x 1080.
picture <- function(file, plot, width = 8, height = 4.5, dpi = 240) {
  dir.create(dirname(file), showWarnings = FALSE, recursive = TRUE)
  ggplot2::ggsave(file, plot, width = width, height = height, dpi = dpi, bg = "white")
  cat("picture: ", file, "\n", sep = "")
}

# ---- the two main jobs --------------------------------------------------------------------------

cases <- extdata("rolling_cases.csv")
constants <- metadata()$constants
race <- rolling_table(cases, gravity_m_per_s2 = constants$value[constants$symbol == "g"])

profile <- extdata("torque_profile.csv")
wheel <- extdata("spin_up_disk.csv")
scene <- scene_axle(
  body_disk(wheel$mass_kg, wheel$radius_m),
  torque_knots(profile$time_s, profile$torque_n_m),
  resistance(viscous_n_m_s = wheel$viscous_n_m_s)
)
time_s <- seq(0, 8, length.out = 1000)
motion <- trajectory(scene, time_s)

if ("--readme" %in% commandArgs(trailingOnly = TRUE)) {
  if (!have_ggplot2) {
    stop("the README's picture needs the package ggplot2", call. = FALSE)
  }
  source("vignettes/pictures.R")
  drawn <- tempfile(fileext = ".svg")
  plot <- ggplot2::autoplot(motion)
  ggplot2::ggsave(drawn, plot, width = 7.5, height = 4.6, fix_text_size = FALSE)
  svg <- svg_in_page(drawn, ggplot2::get_alt_text(plot))
  # A file of its own, legible on a dark page, too.
  head <- paste(
    "<svg xmlns=\"http://www.w3.org/2000/svg\" font-family=\"Helvetica,Arial,sans-serif\"",
    "style=\"background:#fff\" "
  )
  svg <- sub("margin:1em auto;", "", sub("<svg ", head, svg, fixed = TRUE), fixed = TRUE)
  writeLines(svg, "man/figures/README-spin-up.svg")
  quit(save = "no")
}

heading("Rolling down an incline: rolling_table(), fastest first")
print(tibble::as_tibble(race[order(-race$final_speed_m_per_s), ]))

heading("Moments of inertia: inertia_table()")
print(inertia_table(cases[c("object", "mass_kg", "radius_m", "beta")]))

heading("Damped spin-up: the scene")
print(scene)

heading("Damped spin-up: choose_model()")
choice <- choose_model(scene, time_s)
print(choice[c("model", "applies", "error", "error_kind", "cost_s", "chosen")])
writeLines(strwrap(paste0(choice$model, ": ", choice$reason), 96, indent = 2, exdent = 4))

heading("Damped spin-up: trajectory(), the first rows, and predict() at the knots of the torque")
print(motion, n = 4)
print(predict(motion, profile$time_s))

heading("Damped spin-up: summary()")
print(summary(motion))

heading("Damped spin-up: audit()")
print(audit(motion))

heading("Damped spin-up: the same, integrated with model = \"axle_rk8pd\"")
integrated <- trajectory(scene, time_s, model = "axle_rk8pd")
difference <- max(abs(integrated$omega_rad_per_s - motion$omega_rad_per_s))
cat(
  "steps ", summary(integrated)$steps,
  ", largest difference of omega to the exact model ", format(difference, digits = 2), " rad/s\n",
  "audit: ", toString(unique(audit(integrated)$verdict)), "\n",
  sep = ""
)

# ---- bodies -------------------------------------------------------------------------------------

heading("A body made of bodies: a rod and two balls")
rod <- body_rod(mass_kg = 0.5, length_m = 1)
ball <- body_sphere(mass_kg = 2, radius_m = 0.1)
dumbbell <- join_bodies(
  rod, place_body(ball, c(0.6, 0, 0)), place_body(ball, c(-0.6, 0, 0)), name = "dumbbell"
)
leaning <- place_body(dumbbell, rotation = rotation_about("z", angle_deg = 30))
print(leaning)

heading("A robot arm, its links checked: read_links()")
if (requireNamespace("xml2", quietly = TRUE)) {
  links <- read_links(system.file("extdata", "arm.urdf", package = "rotdyn", mustWork = TRUE))
  print(links[c("link", "mass_kg", "reach_m", "verdict", "suggestion")])
} else {
  cat("not read: the package xml2 is not installed\n")
}

# ---- the measured cart --------------------------------------------------------------------------

heading("A measured cart: big wheels free, or locked to the axle")
cat(
  "D. Angemi and others, University of Catania, 2021, CC BY 4.0. 20 runs each.",
  "Locked wheels turn; the extra time is the energy that went into turning them.\n",
  sep = "\n"
)

cart <- extdata("measured_cart.csv")
value <- setNames(cart$value, cart$quantity)
spread <- setNames(cart$uncertainty, cart$quantity)
mass_kg <- sum(value[c("mass_cart_kg", "mass_wheel_left_kg", "mass_wheel_right_kg")])
r_m <- value[["diameter_small_m"]] / 2

# beta = (t_locked/t_free)^2 - 1 and I = beta M r^2/2 for each of two wheels; the uncertainty is
# that of the two means and of the radius.
ratio <- value[["time_locked_s"]] / value[["time_free_s"]]
beta <- ratio^2 - 1
inertia <- beta * mass_kg * r_m^2 / 2
relative <- function(name) spread[[name]] / value[[name]]
u_beta <- 2 * ratio^2 * sqrt(
  (relative("time_free_s")^2 + relative("time_locked_s")^2) / value[["runs"]]
)
u_inertia <- inertia * sqrt((u_beta / beta)^2 + (2 * relative("diameter_small_m"))^2)

wheel_kg <- mean(value[c("mass_wheel_left_kg", "mass_wheel_right_kg")])
disk <- body_disk(wheel_kg, value[["diameter_big_m"]] / 2)$inertia_kg_m2["z", "z"]

row <- function(what, ...) cat(sprintf("  %-46s %s\n", what, paste0(...)))
row("time, wheels free", sprintf(
  "%.5f s  (sd of one run %.5f s)", value[["time_free_s"]], spread[["time_free_s"]]
))
row("time, wheels locked", sprintf(
  "%.5f s  (sd of one run %.5f s)", value[["time_locked_s"]], spread[["time_locked_s"]]
))
row("beta of the cart, wheels locked", sprintf("%.4f +- %.4f", beta, u_beta))
row("share of the energy in rotation",
  sprintf("%.4f", energy_partition(beta, 1)$rotational_energy_fraction))
row("moment of inertia of a wheel, from the times", sprintf(
  "(%.4f +- %.4f) e-3 kg m^2", 1000 * inertia, 1000 * u_inertia
))
row("moment of inertia of a wheel, m R^2/2", sprintf("%.4f e-3 kg m^2", 1000 * disk))
row("difference", sprintf(
  "%.2f %%, %.1f of its uncertainty", 100 * (inertia / disk - 1), abs(inertia - disk) / u_inertia
))
cat("  What this does and does not show: vignette(\"measured-cart\", package = \"rotdyn\").\n")

# The raw runs, where they lie beside the repository.
shared <- Sys.getenv("ROTDYN_SHARED", "../shared")
runs_file <- file.path(
  shared, "data", "measured", "catania_exp1_cart_free_vs_locked_wheels.csv"
)
if (file.exists(runs_file)) {
  runs <- read.csv(runs_file)
  again <- function(t, name) {
    same <- isTRUE(all.equal(mean(t), value[[name]], tolerance = 1e-7)) &&
      isTRUE(all.equal(sd(t), spread[[name]], tolerance = 1e-6)) && length(t) == value[["runs"]]
    row(
      paste("raw runs:", name),
      sprintf("%.5f s  (sd %.5f s), ", mean(t), sd(t)),
      if (same) "as in the shipped file" else "NOT as in the shipped file"
    )
  }
  again(runs$t1, "time_free_s")
  again(runs$t2, "time_locked_s")
} else {
  cat("  The raw runs are not here; their means and spreads above are from the shipped file.\n")
}

# ---- pictures -----------------------------------------------------------------------------------

heading("Pictures")
if (have_ggplot2) {
  picture("demo-output/rolling.png", ggplot2::autoplot(race))
  picture("demo-output/spin-up.png", ggplot2::autoplot(motion))
  picture("demo-output/body.png", ggplot2::autoplot(leaning))
} else {
  cat("none: the package ggplot2 is not installed\n")
}

# ---- lessons ------------------------------------------------------------------------------------

heading("Lessons")
if (nzchar(system.file("doc", "first-motion.html", package = "rotdyn"))) {
  cat("vignette(\"kinematics\", package = \"rotdyn\") opens lesson 1 in R.\n")
} else {
  cat("not installed: they need knitr, rmarkdown and pandoc\n")
}
