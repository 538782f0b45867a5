# The pages that tools/animations.mjs drives: Rscript tools/animations.R FOLDER. Beside each page is
# <name>.csv, the numbers of the last row that the last frame must show, and `both.html`, a document
# of R Markdown with two of them.
library(rotdyn)
folder <- commandArgs(trailingOnly = TRUE)[1]

top <- scene_pivot(
  place_body(body_disk(2, 0.15), c(0, 0, 0.15)), c(0, 0, 60),
  attitude0 = attitude_from(c(1, 0, 0, pi / 3), "axis_angle")
)
race <- roll_race(c("hoop", "disk", "sphere"), incline_angle_deg = 20, length_m = 1)
bounce <- ball_bounce(body_sphere(0.06, 0.033), 20, -5, -300, restitution = 0.75, friction = 0.5)
pendulum <- trajectory(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1), seq(0, 2, 0.25))
chain <- trajectory(scene_chain(c(1, 1), c(1, 1), theta0_rad = c(2, 2)), seq(0, 2, 0.25))
spin <- trajectory(top, seq(0, 1.5, 0.25))

last <- function(x, columns) vapply(columns, function(name) x[[name]][nrow(x)], 0)
cases <- list(
  race = list(race, rep(1, 3)),
  collision = list(bounce, c(sqrt(bounce$vx_m_per_s^2 + bounce$vy_m_per_s^2),
                             -bounce$omega_rad_per_s)),
  pendulum = list(pendulum, last(pendulum, c("theta_rad", "omega_rad_per_s"))),
  chain = list(chain, utils::tail(chain$theta_rad, 2)),
  gyroscope = list(spin, last(spin, "inclination_rad"))
)
for (name in names(cases)) {
  animate_motion(cases[[name]][[1]], file.path(folder, paste0(name, ".html")))
  writeLines(format(cases[[name]][[2]], digits = 15), file.path(folder, paste0(name, ".csv")))
}

writeLines(c(
  "---", "title: Two animations", "lang: en", "output: html_document", "---", "",
  "```{r, include = FALSE}", "library(rotdyn)", "```", "",
  "```{r, echo = FALSE}",
  "animate_motion(roll_race(c(\"hoop\", \"sphere\")), frames_per_s = 10)", "```", "",
  "```{r, echo = FALSE}",
  "animate_motion(trajectory(scene_pendulum(body_rod(0.1, 1), 0.5, theta0_rad = 1), c(0, 2)))",
  "```"
), file.path(folder, "both.Rmd"))
if (requireNamespace("rmarkdown", quietly = TRUE) && rmarkdown::pandoc_available()) {
  rmarkdown::render(
    file.path(folder, "both.Rmd"), rmarkdown::html_fragment(), output_file = "part.html",
    quiet = TRUE
  )
  part <- readLines(file.path(folder, "part.html"), encoding = "UTF-8")
  writeLines(c(
    "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>Two</title>",
    "<link rel=\"icon\" href=\"data:,\"></head><body><main><h1>Two animations</h1>", part,
    "</main></body></html>"
  ), file.path(folder, "both.html"))
}
