# Of vectors of numbers: the largest, the last, differences of squares.

# NA where there are no values.
largest <- function(values) if (length(values)) max(values) else NA_real_

last <- function(values) if (length(values)) values[[length(values)]] else NA_real_

# The difference of squares as a product keeps the digits of a small change of a large energy.
kinetic_change <- function(inertia, from, to) sum(0.5 * inertia * (to - from) * (to + from))
