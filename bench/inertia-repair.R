# How often the repair that check_inertia() suggests is the right one. Random bodies; the decimal
# point of one moment is moved one or two places, either way, so that no body is left.
#
#   Rscript bench/inertia-repair.R [number of bodies] [seed]
#
# Bodies: 5 to 60 equal masses in a box with sides of 1 : 10^u : 10^v (u, v uniform in -1..0),
# turned at random in half of the cases. Printed: how many were broken; how often the true repair
# is listed; how often it is among the smallest; how often the suggestion is that repair alone.

suppressPackageStartupMessages(library(rotdyn))

arguments <- as.numeric(commandArgs(trailingOnly = TRUE))
bodies <- if (length(arguments) > 0L) arguments[1L] else 4000
set.seed(if (length(arguments) > 1L) arguments[2L] else 1)

random_rotation <- function() {
  turn <- qr.Q(qr(matrix(rnorm(9), 3)))
  turn * sign(det(turn))
}

random_body <- function(turned) {
  n <- sample(5:60, 1)
  x <- matrix(runif(3 * n, -1, 1), n) %*% diag(c(1, 10^runif(2, -1, 0)))
  if (turned) x <- x %*% random_rotation()
  x <- sweep(x, 2, colMeans(x))
  second <- crossprod(x) / n
  tensor <- sum(diag(second)) * diag(3) - second
  six <- tensor[cbind(c(1, 2, 3, 1, 1, 2), c(1, 2, 3, 2, 3, 3))]
  names(six) <- c("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
  list(six = signif(six, 6), reach = sqrt(max(rowSums(x^2))))
}

tried <- list()
for (b in seq_len(bodies)) {
  turned <- b %% 2 == 0
  body <- random_body(turned)
  places <- sample(c(-2, -1, 1, 2), 1)
  entry <- sample(1:3, 1)
  broken <- body$six
  broken[entry] <- broken[entry] * 10^places
  if (all(check_inertia(body$six)$verdict != "fails") &&
    any(check_inertia(broken)$verdict == "fails")) {
    for (known in c(FALSE, TRUE)) {
      check <- if (known) {
        check_inertia(broken, mass_kg = 1, size_m = body$reach)
      } else {
        check_inertia(broken)
      }
      repairs <- inertia_repairs(check)
      first <- repairs[repairs$size == min(repairs$size, Inf), ]
      true <- function(found) {
        found$entry == names(broken)[entry] & abs(found$to / body$six[entry] - 1) < 1e-9
      }
      tried <- c(tried, list(data.frame(
        known, turned, places, listed = any(true(repairs)), smallest = any(true(first)),
        alone = nrow(first) == 1L && all(true(first))
      )))
    }
  }
}
tried <- do.call(rbind, tried)

describe <- function(x, label) {
  cat(sprintf(
    "%-34s %5d   listed %5.1f %%   smallest %5.1f %%   alone %5.1f %%\n",
    label, nrow(x), 100 * mean(x$listed), 100 * mean(x$smallest), 100 * mean(x$alone)
  ))
}
for (known in c(FALSE, TRUE)) {
  cat(if (known) "mass and size known\n" else "tensor alone\n")
  part <- tried[tried$known == known, ]
  describe(part, "all")
  for (places in c(1, 2, -1, -2)) {
    describe(part[part$places == places, ], sprintf("10^%d times the true moment", places))
  }
  describe(part[!part$turned, ], "products near 0")
  describe(part[part$turned, ], "turned")
}
