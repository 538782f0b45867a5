# Rscript paper/build.R [FOLDER]: computes each number of paper.md with the installed package and
# bench/results.csv, draws the figure, and writes paper.md (filled), error.svg and, by pandoc,
# paper.html into FOLDER (default: paper/built). Nothing is loaded from elsewhere. Status 1: a
# number is missing, or the text has more than 1,000 words.

library(rotdyn)
here <- dirname(sub("^--file=", "", grep("^--file=", commandArgs(), value = TRUE)))
target <- c(commandArgs(TRUE), file.path(here, "built"))[1L]
dir.create(target, FALSE, TRUE)

# ---- the bench ----------------------------------------------------------------------------------

bench <- utils::read.csv(file.path(here, "..", "bench", "results.csv"))
wanted <- c("spin-up", "rolling", "sweep", "function-torque")
rows <- bench[bench$comparison %in% wanted & !grepl("^rotdyn", bench$contender) &
                is.finite(bench$ratio_median), ]
rows <- rows[order(match(rows$comparison, wanted), -rows$ratio_median), ]
table <- c(
  "| comparison | case | contender | time / rotdyn's | its error |", "|---|---|---|---|---|",
  sprintf("| %s | %s | %s | %s | %s |", rows$comparison, rows$case, rows$contender,
          format(signif(rows$ratio_median, 2), scientific = FALSE, trim = TRUE,
                 drop0trailing = TRUE),
          ifelse(is.na(rows$error), "", formatC(rows$error, digits = 1, format = "e")))
)

# ---- errors -------------------------------------------------------------------------------------

set.seed(20260101)
scenes <- 100L
accuracy <- 1e-6
time_s <- seq(0, 8, length.out = 41)
one <- function(i) {
  scene <- scene_axle(
    body_disk(mass_kg = runif(1, 0.5, 4), radius_m = runif(1, 0.1, 0.5)),
    torque_knots(time_s = c(0, sort(runif(3, 0.5, 7.5)), 8), torque_n_m = runif(5, -1, 1)),
    resistance(viscous_n_m_s = runif(1, 0, 0.1)), omega0_rad_per_s = runif(1, -8, 8)
  )
  exact <- trajectory(scene, time_s)
  motion <- trajectory(scene, time_s, accuracy, model = "axle_rk8pd")
  error <- max(vapply(c("theta_rad", "omega_rad_per_s"), function(column) {
    max(abs(motion[[column]] - exact[[column]])) / max(abs(exact[[column]]))
  }, 0))
  wrong <- motion
  last <- nrow(wrong)
  wrong$omega_rad_per_s[last] <- 1.01 * wrong$omega_rad_per_s[last]
  energy <- "rotational_kinetic_energy_j"
  wrong[[energy]][last] <- 1.01^2 * wrong[[energy]][last]
  c(
    error = error, figure = glance(motion)$error,
    balanced = !any(audit(motion)$verdict %in% "unbalanced"),
    caught = any(audit(wrong)$verdict %in% "unbalanced")
  )
}
found <- as.data.frame(t(vapply(seq_len(scenes), one, numeric(4))))

grDevices::svg(file.path(target, "error.svg"), width = 6, height = 3.2)
graphics::par(mar = c(4, 4.5, 0.5, 0.5))
ratio <- pmax(found$error / found$figure, 1e-6)
graphics::plot(sort(ratio), log = "y", pch = 20, xlab = "scene, in order", las = 1,
               ylab = "true error / figure", ylim = range(ratio, 2))
graphics::abline(h = 1)
invisible(grDevices::dev.off())

# ---- the text -----------------------------------------------------------------------------------

values <- list(
  version = as.character(utils::packageVersion("rotdyn")), models = nrow(models()),
  constructors = length(grep("^scene_", getNamespaceExports("rotdyn"))),
  table = paste(table, collapse = "\n"), scenes = scenes, accuracy = format(accuracy),
  rows = length(time_s), covered = sum(found$error <= found$figure),
  beyond = sum(found$error > accuracy), balanced = sum(found$balanced), caught = sum(found$caught)
)
text <- readLines(file.path(here, "paper.md"))
for (name in names(values)) {
  if (!any(grepl(paste0("{", name, "}"), text, fixed = TRUE))) stop("paper.md has no {", name, "}")
  text <- gsub(paste0("{", name, "}"), values[[name]], text, fixed = TRUE)
}
left <- grep("[{][a-z_]+[}]", text, value = TRUE)
if (length(left)) stop("no value for: ", left[1])
writeLines(text, file.path(target, "paper.md"))
body <- text[!grepl("^[|]", text)]
words <- length(grep("[[:alnum:]]", unlist(strsplit(body, "[[:space:]]+"))))
cat(sprintf("paper: %d words, %d of %d errors covered, %d balanced, %d caught\n", words,
            values$covered, scenes, values$balanced, values$caught))
if (nzchar(Sys.which("pandoc"))) {
  # Older versions call the option by another name.
  embed <- if (any(grepl("--embed-resources", system2("pandoc", "--help", stdout = TRUE)))) {
    "--embed-resources"
  } else {
    "--self-contained"
  }
  status <- system2("pandoc", c("--standalone", embed, "--metadata", "lang=en",
                                paste0("--resource-path=", shQuote(target)), "-o",
                                shQuote(file.path(target, "paper.html")),
                                shQuote(file.path(target, "paper.md"))))
  if (status != 0L) quit(status = 1L)
}
quit(status = words > 1000L)
