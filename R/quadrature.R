# Integrals of several functions over panels of time: Gauss-Kronrod rules, panels halved where the
# two rules differ.

# Nodes and weights on [-1, 1], 15 of Kronrod around 7 of Gauss (Piessens et al. 1983, QUADPACK).
kronrod_node <- c(
  0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
  0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
  0.586087235467691130294144691693557, 0.405845151377397166906606412076961,
  0.207784955007898467600689403773245, 0
)
kronrod_weight <- c(
  0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
  0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
  0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
  0.204432940075298892414161999234649, 0.209482141084727828012999174891714
)
gauss_weight <- c(
  0, 0.129484966168869693270611432679082, 0, 0.279705391489276667901467771423780, 0,
  0.381830050505118944950369775488975, 0, 0.417959183673469387755102040816327
)

mirror <- function(x, sign) c(sign * x, rev(x[-8]))

# Integrals over each panel [from, to]: list(value, size, error), a row for each panel, a column for
# each integrand. `size` is the integral of the absolute value.
panel_integrals <- function(rates, from, to) {
  half <- (to - from) / 2
  middle <- from + half
  x <- mirror(kronrod_node, -1)
  t <- outer(half, x) + middle
  f <- rates(as.vector(t))
  n <- length(from)
  weigh <- function(y, w) rowSums(matrix(y, n) * rep(w, each = n)) * half
  kronrod <- mirror(kronrod_weight, 1)
  gauss <- mirror(gauss_weight, 1)
  value <- apply(f, 2, weigh, kronrod)
  size <- apply(abs(f), 2, weigh, kronrod)
  # Piessens' rule: the difference is the error of the Gauss rule; Kronrod's is far less.
  difference <- abs(value - apply(f, 2, weigh, gauss))
  shape <- function(y) matrix(y, n)
  value <- shape(value)
  size <- shape(size)
  difference <- shape(difference)
  error <- ifelse(size > 0, size * pmin(1, (200 * difference / pmax(size, 1e-300))^1.5), difference)
  storage.mode(error) <- "double" # also where all are missing
  # The times of the nodes are rounded: that counts by how much the integrand varies.
  late <- .Machine$double.eps * pmax(abs(from), abs(to))
  vary <- apply(f, 2, function(y) {
    y <- matrix(y, n)
    rowSums(abs(y[, -1, drop = FALSE] - y[, -length(x), drop = FALSE]))
  })
  list(value = value, size = size, error = error, noise = shape(vary) * late)
}

# Panels evaluated beyond four for each at the start: some seconds, and 300 MB at a time.
max_panels <- 2e5
panels_at_once <- 5e4

# The same over panels halved until the error is below rounding, 24 halvings are done, or the budget
# is used up (`spent`): then the error says so. A panel whose integral is not finite is not halved.
# The error includes that of the times. `least`: the size of what the integrands are added to, below
# whose rounding nothing is halved. `rough`: integrands that are errors, known to a digit, for which
# nothing is halved. `unresolved`: the panels that 24 halvings did not resolve.
integrate_panels <- function(rates, from, to, minimum = 0, rough = integer()) {
  left <- max_panels + 4 * length(from)
  n <- length(from)
  owner <- seq_len(n)
  total <- NULL
  spent <- FALSE
  unresolved <- list(from = double(), to = double())
  for (halving in 0:24) {
    panels <- panel_integrals(rates, from, to)
    if (is.null(total)) {
      total <- pmax(colSums(panels$size), minimum)
      total[is.na(total)] <- Inf # not finite: no halving helps
      value <- size <- error <- matrix(0, n, length(total))
    }
    allowed <- 1e-15 * rep(total, each = length(from))
    dim(allowed) <- c(length(from), length(total))
    allowed[, rough] <- Inf
    left <- left - length(from)
    good <- !is.finite(rowSums(panels$value)) |
      rowSums(panels$error > allowed | is.na(panels$error)) == 0 |
      (to - from) < 4 * .Machine$double.eps * pmax(abs(from), abs(to))
    if (halving == 24L) {
      unresolved <- list(from = from[!good], to = to[!good])
      good[] <- TRUE
    }
    more <- 2 * sum(!good)
    if (more > left || (more > panels_at_once && more > 4 * n)) {
      spent <- TRUE
      good[] <- TRUE
    }
    add <- function(sum, x) {
      part <- rowsum(x[good, , drop = FALSE], owner[good])
      at <- as.integer(rownames(part))
      sum[at, ] <- sum[at, ] + part
      sum
    }
    if (any(good)) {
      value <- add(value, panels$value)
      size <- add(size, panels$size)
      error <- add(error, panels$error + panels$noise)
    }
    if (all(good)) break
    middle <- (from + (to - from) / 2)[!good]
    owner <- rep(owner[!good], 2L)
    to <- c(middle, to[!good])
    from <- c(from[!good], middle)
  }
  list(value = value, size = size, error = error, spent = spent, unresolved = unresolved)
}
