# Of vectors of numbers: the largest, the last, differences of squares.

# NA where there are no values.
largest <- function(values) if (length(values)) max(values) else NA_real_

last <- function(values) if (length(values)) values[[length(values)]] else NA_real_
