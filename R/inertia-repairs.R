# Typing errors that would explain a tensor that is not physical. Each candidate changes one thing
# and is kept if every condition then holds. Entries have the user's sign convention, so that
# messages quote the user's own numbers.

# A radius of gyration above `size_m` or below `size_m`/100 suggests a wrong unit. It is usually
# 0.33 (cube) to 1 (dumbbell) of the reach, so the right unit must give such a ratio.
radius_too_small <- 100
radius_usual <- c(0.2, 1)

# Units other than kg m^2, relative to it.
inertia_units <- c(
  "g m^2" = 1e-3, "kg cm^2" = 1e-4, "kg mm^2" = 1e-6, "g cm^2" = 1e-7, "g mm^2" = 1e-9,
  "kg um^2" = 1e-12
)

# A moment without its decimal point is off by up to nine places. Products are shifted less, since
# any product is legal if it is small enough.
decimal_places <- list(moment = 1:9, product = 1:3)

check_columns <- c(
  "row", "object", "condition", "value", "limit", "margin", "verdict", "meaning", "suggestion"
)
repair_columns <- c("row", "repair", "size", "kind", "entry", "from", "to")

# Measured by `Rscript bench/inertia-repair.R 4000 1`.
repair_figures <- paste(
  "Of 3938 such slips, the true repair was always listed; it was among the smallest for 97.8 %,",
  "and the one smallest for 88.5 %, or for 92.7 % where mass and size were known."
)

repairs_of <- function(tensor, mass_kg, size_m, sign, judged) {
  failed <- judged$condition[judged$verdict == "fails"]
  small <- is_too_small(judged, size_m)
  if (!length(failed) && !small || "finite" %in% failed) return(list())
  now <- list(six = to_given(tensor_to_six(tensor), sign), mass_kg = mass_kg, size_m = size_m)
  candidates <- if (small) {
    too_small_candidates(now, judged)
  } else if (identical(failed, "mass")) {
    mass_candidates(now)
  } else if ("symmetric" %in% failed) {
    asymmetry_candidates(tensor, now, sign)
  } else if ("mass" %in% failed) {
    list()
  } else {
    c(
      digit_candidates(now), decimal_candidates(now), sign_candidates(now),
      copy_candidates(now), swap_candidates(now),
      if (identical(failed, "size")) unit_candidates(now, judged)
    )
  }
  keep_legal(candidates, now, sign)
}

# Between the tensor's sign convention and the user's; its own inverse.
to_given <- function(six, sign) {
  c(six[1:3], sign * six[4:6])
}

is_too_small <- function(judged, size_m) {
  at <- match("size", judged$condition)
  if (is.na(at) || any(judged$verdict == "fails")) return(FALSE)
  judged$value[at] > 0 && judged$value[at] < size_m / radius_too_small
}

# A candidate: the entries and their old and new values; `size` of the repair.
new_repair <- function(kind, size, entry, from, to) {
  list(kind = kind, size = size, entry = entry, from = from, to = to)
}

keep_legal <- function(candidates, now, sign) {
  if (!length(candidates)) return(list())
  sizes <- vapply(candidates, `[[`, 0, "size")
  candidates <- candidates[order(sizes)]
  sizes <- sort(sizes)
  smallest <- Inf
  kept <- list()
  for (i in seq_along(candidates)) {
    if (sizes[i] > smallest + 1) break
    if (is_legal(apply_repair(now, candidates[[i]]), sign)) {
      kept <- c(kept, candidates[i])
      smallest <- min(smallest, sizes[i])
    }
  }
  kept
}

apply_repair <- function(now, repair) {
  at <- match(repair$entry, inertia_entries)
  inside <- !is.na(at)
  now$six[at[inside]] <- repair$to[inside]
  for (name in repair$entry[!inside]) {
    now[[name]] <- repair$to[repair$entry == name]
  }
  now
}

is_legal <- function(now, sign) {
  six <- to_given(now$six, sign)
  largest <- max(abs(six))
  if (!is.finite(largest)) return(FALSE)
  # The inequalities of the diagonal are necessary, and cheap.
  if (largest > 0) {
    diagonal <- six[1:3] / largest
    if (min(diagonal) < margin_of_legality ||
      sum(diagonal) - 2 * max(diagonal) < margin_of_legality) {
      return(FALSE)
    }
  }
  # Without tolerance: a product that is made small enough would pass.
  judged <- judge_tensor(six_to_tensor(six), now$mass_kg, now$size_m)
  all(judged$margin[judged$condition != "symmetric"] >= margin_of_rounding)
}

# ---- candidates -----------------------------------------------------------------------------

# One unit of the last decimal digit, for numbers of at least two digits.
digit_candidates <- function(now) {
  found <- list()
  for (i in which(now$six != 0)) {
    x <- now$six[i]
    digits <- printed_digits(x)
    step <- 10^(floor(log10(abs(x))) + 1 - digits)
    if (digits < 2L || digits > 12L || !is.finite(step) || step == 0) next
    to <- signif(c(x - step, x + step), digits + 1L)
    found <- c(found, lapply(to, function(to) {
      new_repair("last digit", 1, inertia_entries[i], x, to)
    }))
  }
  found
}

# Number of digits of the shortest decimal representation of x.
printed_digits <- function(x) {
  for (digits in 1:16) {
    if (as.numeric(sprintf("%.*e", digits - 1L, x)) == x) return(digits)
  }
  17L
}

decimal_candidates <- function(now) {
  values <- now$six
  names(values) <- inertia_entries
  if (is_positive(now$mass_kg) && is_positive(now$size_m)) {
    values <- c(values, mass_kg = now$mass_kg)
  }
  found <- list()
  for (entry in names(values)[values != 0]) {
    x <- values[[entry]]
    is_product <- entry %in% inertia_entries[4:6]
    for (places in decimal_places[[if (is_product) "product" else "moment"]]) {
      found <- c(found, list(
        new_repair("decimal point", 1 + places, entry, x, x / 10^places),
        new_repair("decimal point", 1 + places, entry, x, x * 10^places)
      ))
    }
  }
  found
}

is_positive <- function(x) {
  !is.na(x) && is.finite(x) && x > 0
}

# Changing the sign of one product has the same effect as changing all three: the eigenvalues depend
# only on the product of the three.
sign_candidates <- function(now) {
  found <- lapply(which(now$six[1:3] < 0), function(i) {
    new_repair("sign of a moment", 2, inertia_entries[i], now$six[i], -now$six[i])
  })
  if (all(now$six[4:6] != 0)) {
    found <- c(
      found,
      lapply(4:6, function(i) {
        new_repair("sign of a product", 2, inertia_entries[i], now$six[i], -now$six[i])
      }),
      list(new_repair(
        "sign convention of the products", 2, inertia_entries[4:6], now$six[4:6], -now$six[4:6]
      ))
    )
  }
  found
}

# A product equal to a moment is taken for a copy of it.
copy_candidates <- function(now) {
  rows_per_time <- 3L + which(now$six[4:6] != 0 & abs(now$six[4:6]) %in% abs(now$six[1:3]))
  lapply(rows_per_time, function(i) {
    new_repair("repetition of a moment", 2, inertia_entries[i], now$six[i], 0)
  })
}

# Two entries exchanged, at least one of them a product: exchanging moments has no effect on the
# inequalities of the diagonal.
swap_candidates <- function(now) {
  found <- list()
  for (i in 4:6) {
    for (j in seq_len(i - 1L)) {
      if (now$six[i] != now$six[j]) {
        at <- c(j, i)
        found <- c(found, list(
          new_repair("entries swapped", 3, inertia_entries[at], now$six[at], now$six[rev(at)])
        ))
      }
    }
  }
  found
}

# All entries in another unit, if that gives a usual radius of gyration.
unit_candidates <- function(now, judged) {
  at <- match("size", judged$condition)
  radius <- judged$value[at] / judged$limit[at] * sqrt(inertia_units)
  usual <- radius >= radius_usual[1L] & radius <= radius_usual[2L]
  if (!any(usual)) usual <- radius <= 1 & radius == max(radius[radius <= 1], 0)
  present <- now$six != 0
  lapply(which(usual), function(i) {
    from <- now$six[present]
    new_repair(
      paste0("unit (", names(inertia_units)[i], ")"), 2, inertia_entries[present], from,
      from * inertia_units[[i]]
    )
  })
}

too_small_candidates <- function(now, judged) {
  at <- match("size", judged$condition)
  radius <- judged$value[at] / judged$limit[at]
  found <- list(
    new_repair("unit (mm)", 2, "size_m", now$size_m, now$size_m / 1e3),
    new_repair("unit (um)", 2, "size_m", now$size_m, now$size_m / 1e6),
    new_repair("unit (g)", 2, "mass_kg", now$mass_kg, now$mass_kg / 1e3)
  )
  after <- radius * c(1e3, 1e6, sqrt(1e3))
  found[after >= radius_usual[1L] & after <= radius_usual[2L]]
}

mass_candidates <- function(now) {
  if (is.finite(now$mass_kg) && now$mass_kg < 0) {
    list(new_repair("sign of the mass", 2, "mass_kg", now$mass_kg, -now$mass_kg))
  } else {
    list()
  }
}

# If the triangles of a matrix differ, one of them is right: candidates are the upper and the lower.
asymmetry_candidates <- function(tensor, now, sign) {
  upper <- to_given(tensor[entry_places], sign)
  lower <- to_given(t(tensor)[entry_places], sign)
  differs <- which(abs(upper - lower) > asymmetry_allowed * max(abs(tensor)))
  readings <- if (length(differs) > 1L && all(lower[differs] == 0)) {
    list(upper)
  } else if (length(differs) > 1L && all(upper[differs] == 0)) {
    list(lower)
  } else {
    list(upper, lower)
  }
  lapply(readings, function(reading) {
    other <- if (identical(reading, upper)) lower else upper
    new_repair(
      asymmetry_kind(reading[differs], other[differs]), 2, inertia_entries[differs],
      other[differs], reading[differs]
    )
  })
}

asymmetry_kind <- function(a, b) {
  if (length(a) > 1L) return("triangle of the matrix")
  places <- if (a * b > 0) log10(a / b) else NA
  if (a == -b) {
    "sign of a product"
  } else if (!is.na(places) && abs(places - round(places)) < 1e-9) {
    "decimal point"
  } else {
    "entry across the diagonal"
  }
}

# ---- in words -------------------------------------------------------------------------------

bind_repairs <- function(repairs) {
  changes <- lapply(repairs, function(of_row) lengths(lapply(of_row, `[[`, "entry")))
  gather <- function(what, kind) {
    parts <- lapply(repairs, function(of_row) lapply(of_row, `[[`, what))
    as.vector(unlist(parts), mode = kind)
  }
  each <- as.integer(unlist(changes))
  new_table(list(
    row = rep(seq_along(repairs), vapply(changes, sum, 0)),
    repair = rep(as.integer(unlist(lapply(changes, seq_along))), each),
    size = rep(gather("size", "double"), each),
    kind = rep(gather("kind", "character"), each),
    entry = gather("entry", "character"),
    from = gather("from", "double"),
    to = gather("to", "double")
  ))
}

# The suggestion at the first condition that fails, NA elsewhere.
suggestion_of <- function(judged, repairs) {
  text <- rep(NA_character_, length(judged$condition))
  at <- which(judged$verdict == "fails")
  if (length(repairs)) {
    at <- if (length(at)) at[1L] else match("size", judged$condition)
    text[at] <- repairs_in_words(repairs, legal = all(judged$verdict != "fails"))
  }
  text
}

repairs_in_words <- function(repairs, legal = FALSE) {
  sizes <- vapply(repairs, `[[`, 0, "size")
  smallest <- repairs[sizes == min(sizes)]
  words <- vapply(smallest, repair_in_words, "")
  # The sign of any one product, or of all: these four are equivalent.
  signs <- startsWith(vapply(smallest, `[[`, "", "kind"), "sign of a product") |
    startsWith(vapply(smallest, `[[`, "", "kind"), "sign convention")
  if (sum(signs) == 4L) {
    words <- c(
      "the other sign of one product, or of all three (the other convention)", words[!signs]
    )
  }
  goal <- if (legal) "would be usual" else "would make every condition hold"
  larger <- sum(sizes > min(sizes))
  more <- if (larger) paste0(" (inertia_repairs() lists ", larger, " larger)") else ""
  if (length(words) == 1L) return(paste0(words, " ", goal, more))
  shown <- words[seq_len(min(length(words), 5L))]
  if (length(words) > 5L) shown <- c(shown, paste(length(words) - 5L, "more"))
  paste0(
    "each of these ", goal, "; which is right is unknown: ", paste(shown, collapse = "; or "), more
  )
}

repair_in_words <- function(repair) {
  if (startsWith(repair$kind, "unit (") && !repair$entry[1L] %in% c("mass_kg", "size_m")) {
    factor <- inertia_units[[sub("^unit \\((.*)\\)$", "\\1", repair$kind)]]
    return(paste0("every entry times ", format(factor, scientific = TRUE), " (", repair$kind, ")"))
  }
  kind <- repair$kind
  if (kind == "decimal point" && repair$size > 2) {
    kind <- paste0("decimal point, ", repair$size - 1, " places")
  }
  # Ten digits, or 17 where those are equal.
  digits <- if (any(format_number(repair$to) == format_number(repair$from))) 17 else 10
  changes <- paste(
    repair$entry, "=", format_number(repair$to, digits), "instead of",
    format_number(repair$from, digits)
  )
  paste0(paste(changes, collapse = ", "), " (", kind, ")")
}
