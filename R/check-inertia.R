# Which tensors are inertia tensors: I = tr(C) 1 - C, where C = int x x^T dm is positive
# semidefinite. With the principal moments I1 <= I2 <= I3 the smallest eigenvalue of C is (I1 + I2 -
# I3)/2; a body exists if and only if it is at least 0. The triangle inequalities of the diagonal
# are necessary, not sufficient.
#
# Source: Wensing, Kim and Slotine, IEEE Robotics and Automation Letters 3 (2018) 60.

inertia_entries <- c("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
entry_places <- cbind(c(1L, 2L, 3L, 1L, 1L, 2L), c(1L, 2L, 3L, 2L, 3L, 3L))

# Margins relative to the largest moment. Rotating a plate costs up to eight roundings; 1e-12 is far
# above any rounding of a legal tensor and far below any printed digit.
margin_of_rounding <- -8 * 2^-53
margin_of_legality <- -1e-12
asymmetry_allowed <- 1e-12

#' Check whether an inertia tensor is physical
#'
#' `check_inertia()` lists the conditions that an inertia tensor must satisfy, their margins, and
#' likely typing errors. It does not change its argument.
#'
#' | condition | value | must be |
#' |---|---|---|
#' | `finite` | entries that are NA, NaN or infinite | 0 |
#' | `symmetric` | largest asymmetry, relative to the largest entry | at most 1e-12 |
#' | `positive semidefinite` | I1, the smallest principal moment | at least 0 |
#' | `triangle inequality` | I1 + I2 - I3, twice the smallest eigenvalue of C | at least 0 |
#' | `mass` | the mass, where it is known | at least 0; and not 0 if there is inertia |
#' | `size` | radius of gyration sqrt(c3/m), c3 the largest eigenvalue of C | at most `size_m` |
#'
#' I1 <= I2 <= I3 are the principal moments and C = int x x^T dm is the second moment of the mass,
#' so that I = tr(C) 1 - C. Each moment of inertia is the sum of two second moments, so none exceeds
#' the sum of the other two. A positive definite tensor may violate this, and so may the principal
#' moments of a tensor whose diagonal satisfies it.
#'
#' **Limits.** Legal are also a rod along x (I1 = 0), a plate (I1 + I2 = I3) and a point (all 0).
#' Rounding is tolerated: a condition violated by at most 8 roundings (8.9e-16 of I3) holds, by at
#' most 1e-12 `holds within rounding`, by more `fails`. For an asymmetry of at most 1e-12 the mean
#' of both entries is used.
#'
#' **Suggestions.** If a tensor fails, small repairs are tried separately: the last digit of an
#' entry; the decimal point of an entry; the sign of a product, or of all (the other convention);
#' the sign of a moment; a product that repeats a moment; a matrix with only one triangle filled;
#' two entries swapped; the unit of all entries, if mass and size are known. `inertia_repairs()`
#' lists those that make every condition hold, the smallest first; equally small ones are
#' alternatives. A known `mass_kg` and `size_m` exclude repairs. A suggestion is a guess, not a
#' measurement.
#'
#' @param x A 3 x 3 matrix, a `rot_body`, an [inertia_tensor()], six numbers named `ixx`, `iyy`,
#'   `izz`, `ixy`, `ixz`, `iyz`, three numbers (principal moments), or a data frame with such
#'   columns, one tensor in each row (without the last three, the products are 0). Case and the
#'   ending `_kg_m2` of names are ignored. In kg m^2, about the centre of mass; numbers or units
#'   objects.
#' @param ... Not used.
#' @param mass_kg Mass, one for all or one for each row; NA if unknown. By default the column
#'   `mass_kg` of a data frame.
#' @param size_m Distance from the centre of mass to the farthest point of the body, greater than 0;
#'   NA if unknown. By default the column `size_m` of a data frame.
#' @param products The meaning of the off-diagonal numbers. `"negative"`: the tensor's own entries,
#'   ixy = -int x y dm, as in URDF, SDF and most simulators. `"positive"`: the products of inertia
#'   int x y dm, as printed by most CAD programs.
#' @param name Names of the tensors, one for all or one for each row.
#' @return `check_inertia()`: a tibble of class `rot_inertia_check`, one row for each condition and
#'   tensor: `r describe_columns(check_columns)`
#'   `verdict` is "holds", "holds within rounding", "fails", or "not checked" if entries are not
#'   finite. The conditions `mass` and `size` are checked if these are known.
#'
#'   `inertia_repairs()`: a tibble, one row for each change of an entry:
#'   `r describe_columns(repair_columns)`
#'   Sizes: 1 for the last digit; 2 for a sign, a repetition, a triangle of the matrix or a unit; 3
#'   for two entries swapped; 1 + n for a decimal point moved n places. Repairs one larger than the
#'   smallest are listed, too.
#' @section Reliability of suggestions:
#' `bench/inertia-repair.R` draws random bodies (5 to 60 points in boxes of random sides), moves the
#' decimal point of one moment one or two places, and repairs the tensors that are not physical.
#' `r repair_figures`
#' @section Errors: `rotdyn_error_type` for other types, and for missing columns;
#'   `rotdyn_error_argument` for a column that nearly has the name of one which is not given;
#'   `rotdyn_error_size` for other numbers of entries; `rotdyn_error_value` for numbers without
#'   names, and sizes that are not greater than 0; `rotdyn_error_unit` for units objects of another
#'   dimension. NA, NaN and Inf in a tensor, and a mass of NaN or Inf, are no errors: the check
#'   reports them.
#' @source Wensing, Kim and Slotine, IEEE Robotics and Automation Letters 3 (2018) 60; Traversaro,
#'   Brossette, Escande and Nori, IROS (2016) 5516.
#' @seealso [read_links()] checks a robot description.
#' @concept valid tensor
#' @concept triangle inequality
#' @concept positive definite
#' @concept URDF
#' @examples
#' # A link of a robot; the decimal point of izz is missing.
#' link <- c(ixx = 0.0123, iyy = 0.0145, izz = 213, ixy = 0, ixz = 0, iyz = 0)
#' check_inertia(link, name = "forearm")
#' inertia_repairs(check_inertia(link))
#'
#' # The diagonal satisfies the inequalities and the matrix is positive definite, but it fails.
#' check_inertia(matrix(c(2, -1, 0, -1, 2, -1, 0, -1, 2), 3))$verdict
#'
#' # A plate and a rod are legal.
#' check_inertia(data.frame(ixx = c(1, 0), iyy = c(2, 5), izz = c(3, 5)))$verdict
#' @export
check_inertia <- function(x, ..., mass_kg = NULL, size_m = NULL,
                          products = c("negative", "positive"), name = NULL) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  if (missing(products)) products <- "negative"
  check_string(products, "products", c("negative", "positive"), call)
  given <- as_tensors(x, products, call)
  n <- length(given$tensor)
  mass_kg <- known_numbers(mass_kg, given$mass_kg, "mass_kg", "kg", n, call)
  size_m <- known_numbers(size_m, given$size_m, "size_m", "m", n, call)
  low <- which(!is.na(size_m) & !(size_m > 0 & is.finite(size_m)) | is.nan(size_m))
  if (length(low)) {
    abort_domain(size_m[low[1L]], "size_m", "m", call, 0, Inf, TRUE, if (n > 1L) low[1L])
  }
  check_tensors(given, mass_kg, size_m, known_names(name, given$object, n, call))
}

#' @param check Result of `check_inertia()`.
#' @rdname check_inertia
#' @export
inertia_repairs <- function(check, ...) {
  call <- check_no_dots(...)
  check_supplied("check", call)
  check_class(check, "rot_inertia_check", "check", "Make one with {.fn check_inertia}.", call)
  attr(check, "repairs")
}

# ---- input ----------------------------------------------------------------------------------

# A list of tensors (3 x 3, the tensor's own signs) and the sign of the products as given.
as_tensors <- function(x, products, call) {
  sign <- if (products == "positive") -1 else 1
  given <- list(sign = sign)
  if (inherits(x, "rot_body")) {
    check_body(x, call, "x")
    given$sign <- 1
    given$tensor <- list(unname(x$inertia_kg_m2))
    given$mass_kg <- x$mass_kg
    reach <- x$reach_m
    given$size_m <- if (length(reach) == 1L && is.finite(reach) && reach > 0) reach
    given$object <- x$shape
    return(given)
  }
  if (is.data.frame(x)) {
    names(x) <- lower_case(names(x))
    given$tensor <- tensors_from_columns(x, sign, call)
    given$mass_kg <- x[["mass_kg"]]
    given$size_m <- x[["size_m"]]
    given$object <- if (is.character(x[["object"]])) x[["object"]]
    return(given)
  }
  if (inherits(x, "rot_inertia_tensor")) {
    check_inertia_tensor(x, "x", call)
    given$sign <- sign <- if (attr(x, "products") == "positive") -1 else 1
    x <- as.matrix(x)
  }
  size <- dim(x)
  names <- names(x)
  x <- check_column(x, "x", "kg*m^2", call)
  if (is.null(size)) {
    given$tensor <- list(tensor_from_vector(x, names, sign, call))
  } else if (identical(size, c(3L, 3L))) {
    x <- matrix(x, 3L)
    x[row(x) != col(x)] <- sign * x[row(x) != col(x)]
    given$tensor <- list(x)
  } else {
    abort_rotdyn(
      c("A matrix {.arg x} must be 3 x 3.", x = "It is {paste(size, collapse = ' x ')}."),
      "size", call
    )
  }
  given
}

# The names x, y, z (of a diagonal) stand for ixx, iyy, izz.
plain_entry_names <- function(names) {
  names <- sub("_kg_m2$", "", lower_case(names))
  if (setequal(names, c("x", "y", "z"))) paste0("i", names, names) else names
}

tensor_from_vector <- function(x, names, sign, call) {
  if (length(x) == 3L && is.null(names)) return(diag(as.double(x), 3L))
  if (!length(x) %in% c(3L, 6L)) {
    abort_rotdyn(
      c("{.arg x} must be a 3 x 3 matrix, six numbers or three.", x = "It has length {length(x)}."),
      "size", call
    )
  }
  wanted <- inertia_entries[seq_along(x)]
  names <- plain_entry_names(names)
  if (!setequal(names, wanted)) {
    abort_rotdyn(c(
      "The numbers of {.arg x} must be named {.val {wanted}}.",
      x = if (length(names)) "They are named {.val {names}}." else "They have no names.",
      i = "The order differs between formats and is not guessed."
    ), "value", call)
  }
  six_to_tensor(c(x[match(wanted, names)], 0, 0, 0)[1:6] * rep(c(1, sign), each = 3L))
}

tensors_from_columns <- function(x, sign, call) {
  names(x) <- plain_entry_names(names(x))
  check_near_columns(x, c(inertia_entries, "mass_kg", "size_m"), names(x), NULL, call)
  has <- inertia_entries %in% names(x)
  lacking <- if (any(has[4:6])) inertia_entries[!has] else inertia_entries[1:3][!has[1:3]]
  if (length(lacking)) {
    abort_rotdyn(c(
      "{.arg x} must have the columns {.val {inertia_entries}}.",
      x = "{.val {lacking}} {?is/are} missing.",
      i = "Without all of {.val {inertia_entries[4:6]}} the products are 0."
    ), "type", call)
  }
  columns <- lapply(inertia_entries[has], function(entry) {
    check_column(x[[entry]], entry, "kg*m^2", call)
  })
  entries <- matrix(0, nrow(x), 6L)
  entries[, has] <- unlist(columns)
  entries[, 4:6] <- sign * entries[, 4:6]
  lapply(seq_len(nrow(x)), function(i) six_to_tensor(entries[i, ]))
}

six_to_tensor <- function(six) {
  matrix(six[c(1L, 4L, 5L, 4L, 2L, 6L, 5L, 6L, 3L)], 3L)
}

tensor_to_six <- function(tensor) {
  tensor[entry_places]
}

# Masses or sizes: from the argument, or else from x; NA if unknown.
known_numbers <- function(x, with_x, arg, unit, n, call) {
  if (is.null(x)) x <- with_x
  if (is.null(x)) return(rep_len(NA_real_, n))
  x <- check_column(x, arg, unit, call)
  check_one_or_each(length(x), arg, n, call)
  rep_len(as.double(x), n)
}

known_names <- function(name, with_x, n, call) {
  if (is.null(name)) name <- with_x
  if (is.null(name)) return(rep_len(NA_character_, n))
  if (!is.character(name)) {
    abort_rotdyn(c("{.arg name} must be text.", x = "It is {describe_value(name)}."), "type", call)
  }
  check_one_or_each(length(name), "name", n, call)
  rep_len(name, n)
}

check_one_or_each <- function(length, arg, n, call) {
  if (length != 1L && length != n) {
    abort_rotdyn(c(
      "{.arg {arg}} must have length 1, or one element for each tensor.",
      x = "It has length {length}, and there {cli::qty(n)}{?is/are} {n} tensor{?s}."
    ), "size", call)
  }
}

# ---- the conditions -------------------------------------------------------------------------

check_tensors <- function(given, mass_kg, size_m, object) {
  n <- length(given$tensor)
  judged <- lapply(seq_len(n), function(i) {
    judge_tensor(given$tensor[[i]], mass_kg[i], size_m[i], given$sign)
  })
  repairs <- lapply(seq_len(n), function(i) {
    repairs_of(given$tensor[[i]], mass_kg[i], size_m[i], given$sign, judged[[i]])
  })
  rows <- vapply(judged, function(one) length(one$condition), 1L)
  gather <- function(what, kind) {
    vapply(unlist(lapply(judged, `[[`, what)), identity, kind, USE.NAMES = FALSE)
  }
  check <- new_table(
    list(
      row = rep(seq_len(n), rows),
      object = rep(object, rows),
      condition = gather("condition", ""),
      value = gather("value", 0),
      limit = gather("limit", 0),
      margin = gather("margin", 0),
      verdict = gather("verdict", ""),
      meaning = gather("meaning", ""),
      suggestion = as.character(unlist(lapply(seq_len(n), function(i) {
        suggestion_of(judged[[i]], repairs[[i]])
      })))
    ),
    class = "rot_inertia_check"
  )
  attr(check, "repairs") <- bind_repairs(repairs)
  check
}

# A value, its limit, and the relative margin (negative outside the limit).
condition_row <- function(condition, value, limit, margin, verdict, meaning) {
  list(
    condition = condition, value = value, limit = limit, margin = margin, verdict = verdict,
    meaning = meaning
  )
}

verdict_of <- function(margin) {
  ifelse(
    !is.na(margin) & margin >= margin_of_rounding, "holds",
    ifelse(!is.na(margin) & margin >= margin_of_legality, "holds within rounding", "fails")
  )
}

# `sign` is only used to quote the user's own numbers.
judge_tensor <- function(tensor, mass_kg, size_m, sign = 1) {
  bad <- sum(!is.finite(tensor))
  rows <- list(
    condition_row("finite", bad, 0, -bad, if (bad) "fails" else "holds", meaning_finite(tensor))
  )
  if (bad) {
    for (condition in c("symmetric", "positive semidefinite", "triangle inequality")) {
      rows <- c(rows, list(condition_row(
        condition, NA_real_, NA_real_, NA_real_, "not checked", "undetermined"
      )))
    }
  } else {
    found <- principal_moments(symmetric_part(tensor))
    rows <- c(rows, list(judge_symmetry(tensor, sign)), judge_moments(found))
  }
  if (!is.na(mass_kg) || is.nan(mass_kg)) {
    rows <- c(rows, list(judge_mass(mass_kg, any(tensor != 0, na.rm = TRUE))))
  }
  if (!bad && is_positive(mass_kg) && !is.na(size_m)) {
    rows <- c(rows, list(judge_size(found, mass_kg, size_m)))
  }
  fields <- names(rows[[1L]])
  judged <- lapply(fields, function(field) unlist(lapply(rows, `[[`, field)))
  names(judged) <- fields
  judged
}

# Principal moments, ascending, and the second moments along the axes, descending, scaled by a power
# of 2 so that no sum overflows.
principal_moments <- function(tensor) {
  largest <- max(abs(tensor))
  scale <- if (largest > 0) 2^floor(log2(largest)) else 1
  found <- .Call(ffi_inertia_principal, .Call(ffi_inertia_second, tensor / scale), 0)
  list(moment = found$moment, second = found$second, scale = scale)
}

asymmetry <- function(tensor) {
  largest <- max(abs(tensor))
  if (largest == 0) 0 else max(abs(tensor / largest - t(tensor) / largest))
}

# The mean of both entries, from halves, since their sum may overflow.
symmetric_part <- function(tensor) {
  upper <- tensor + (t(tensor) / 2 - tensor / 2)
  upper[lower.tri(upper)] <- t(upper)[lower.tri(upper)]
  upper
}

meaning_finite <- function(tensor) {
  at <- which(!is.finite(tensor[entry_places]) | !is.finite(t(tensor)[entry_places]))
  if (!length(at)) return("every entry is a number")
  values <- ifelse(
    is.finite(tensor[entry_places][at]), t(tensor)[entry_places][at], tensor[entry_places][at]
  )
  paste0(paste(inertia_entries[at], "is", format_si(values), collapse = ", "), ": not finite")
}

judge_symmetry <- function(tensor, sign) {
  value <- asymmetry(tensor)
  verdict <- if (value == 0) {
    "holds"
  } else if (value <= asymmetry_allowed) {
    "holds within rounding"
  } else {
    "fails"
  }
  meaning <- if (value == 0) {
    "entries across the diagonal are equal"
  } else {
    difference <- abs(tensor - t(tensor))[entry_places]
    at <- which.max(difference)
    both <- format_number(sign * c(tensor[entry_places][at], t(tensor)[entry_places][at]))
    entry <- strsplit(inertia_entries[at], "")[[1L]]
    if (verdict == "fails") {
      paste0(
        inertia_entries[at], " is ", both[1L], " above the diagonal and ", both[2L],
        " below it: int ", entry[2L], " ", entry[3L], " dm has one value"
      )
    } else {
      "entries across the diagonal differ by rounding: their mean is used"
    }
  }
  condition_row("symmetric", value, asymmetry_allowed, asymmetry_allowed - value, verdict, meaning)
}

# The excess I1 + I2 - I3 is twice the smallest second moment, which Jacobi rotations resolve where
# the sum of three moments cancels.
judge_moments <- function(found) {
  largest <- max(abs(found$moment))
  if (largest == 0) largest <- 1
  smallest <- found$moment[1L] / largest
  excess <- 2 * found$second[3L] / largest
  moments <- found$moment * found$scale
  list(
    condition_row(
      "positive semidefinite", moments[1L], 0, smallest, verdict_of(smallest),
      if (smallest >= margin_of_legality) {
        "no axis has a negative moment of inertia"
      } else {
        paste0(
          "about one axis the moment of inertia is ", format_si(moments[1L]),
          " kg m^2: mass times distance squared is never negative"
        )
      }
    ),
    condition_row(
      "triangle inequality", 2 * found$second[3L] * found$scale, 0, excess, verdict_of(excess),
      meaning_triangle(moments, smallest, excess)
    )
  )
}

meaning_triangle <- function(moments, smallest, excess) {
  if (excess < margin_of_legality) {
    return(paste0(
      "the largest principal moment, ", format_si(moments[3L]),
      " kg m^2, exceeds the sum of the others, ", format_si(moments[1L] + moments[2L]),
      ": I1 + I2 - I3 = 2 int x3^2 dm is not negative"
    ))
  }
  flat <- excess <= -margin_of_legality
  if (moments[3L] == 0) {
    "a point: no moment about any axis"
  } else if (flat && smallest <= -margin_of_legality) {
    "a rod: all mass on one line"
  } else if (flat) {
    "a plate: all mass in one plane"
  } else {
    "no principal moment exceeds the sum of the others"
  }
}

judge_mass <- function(mass_kg, has_inertia) {
  meaning <- if (!is.finite(mass_kg)) {
    "the mass is not finite"
  } else if (mass_kg < 0) {
    "the mass is negative"
  } else if (mass_kg == 0 && has_inertia) {
    "the mass is 0 and the inertia is not"
  }
  condition_row(
    "mass", mass_kg, 0,
    if (!is.finite(mass_kg)) -Inf else if (mass_kg < 0) -1 else if (is.null(meaning)) 1 else -1,
    if (is.null(meaning)) "holds" else "fails",
    if (is.null(meaning)) {
      if (mass_kg > 0) "the mass is positive" else "neither mass nor inertia"
    } else {
      meaning
    }
  )
}

judge_size <- function(found, mass_kg, size_m) {
  # Separate roots, since the quotient may overflow.
  radius <- sqrt(max(0, found$second[1L])) * sqrt(found$scale) / sqrt(mass_kg)
  margin <- 1 - radius / size_m
  verdict <- verdict_of(margin)
  condition_row(
    "size", radius, size_m, margin, verdict,
    if (verdict == "fails") {
      paste0(
        "the radius of gyration would be ", format_si(radius), " m, and the body reaches only ",
        format_si(size_m), " m"
      )
    } else if (radius > 0 && radius < size_m / radius_too_small) {
      paste0(
        "legal, but the radius of gyration is ", format_si(radius),
        " m and the body reaches ", format_si(size_m), " m"
      )
    } else {
      "the mass lies within the size"
    }
  )
}

format_number <- function(x, digits = 10) {
  vapply(x, format, character(1), digits = digits)
}

# ---- print ----------------------------------------------------------------------------------

#' @export
print.rot_inertia_check <- function(x, ...) {
  if (!all(check_columns %in% names(x))) return(NextMethod())
  rows <- unique(x$row)
  for (row in rows[seq_len(min(length(rows), 10L))]) {
    print_one_check(x[x$row == row, ])
  }
  if (length(rows) > 10L) {
    left <- x[!x$row %in% rows[1:10] & x$verdict == "fails", ]
    more <- length(rows) - 10L
    say(
      "... and ", more, " tensor", if (more > 1L) "s", " more, ", length(unique(left$row)),
      " of them with a condition that fails\n"
    )
  }
  invisible(x)
}

print_one_check <- function(x) {
  failed <- sum(x$verdict %in% "fails")
  head <- if (failed == 0L) {
    "physical"
  } else {
    paste0("not physical: ", failed, " of ", nrow(x), " conditions fail", if (failed == 1L) "s")
  }
  label <- if (is.na(x$object[1L])) paste("tensor", x$row[1L]) else x$object[1L]
  say("<rot_inertia_check> ", label, ": ", head, "\n")
  verdict <- ifelse(x$verdict == "fails", "FAILS", x$verdict)
  labels <- paste0("  ", format(x$condition), "  ", format(verdict), "  ")
  indent <- nchar(labels[1L])
  for (i in seq_along(labels)) {
    if (indent > print_width() %/% 2L) {
      say("  ", x$condition[i], "  ", verdict[i], "\n    ", x$meaning[i])
      next
    }
    words <- strwrap(x$meaning[i], width = print_width() - indent, exdent = 2L)
    say(paste0(c(labels[i], rep(strrep(" ", indent), length(words) - 1L)), words), sep = "\n")
  }
  for (text in x$suggestion[!is.na(x$suggestion)]) {
    say(
      strwrap(paste("suggestion:", text), width = print_width(), indent = 2L, exdent = 4L),
      sep = "\n"
    )
  }
  if (failed && all(is.na(x$suggestion))) {
    say("  no small change of one entry makes every condition hold\n")
  }
}

# ---- for body_tensor() ----------------------------------------------------------------------

# The symmetric 3 x 3 tensor, or an error with the condition that fails, its margin and suggested
# repairs. Conditions that hold within rounding are reported for tensors given by the user. A mass
# or a reach that is NULL or NA is unknown.
check_inertia_or_abort <- function(tensor, mass_kg, call, reach_m = NULL, given_by_user = TRUE) {
  mass_kg <- mass_kg %||% NA_real_
  # A reach of 0 is that of a point, but sizes must be greater than 0.
  reach_m <- if (is.null(reach_m)) NA_real_ else max(reach_m, 2^-1074)
  given <- list(tensor = list(unname(tensor)), sign = 1)
  judged <- judge_tensor(given$tensor[[1L]], mass_kg, reach_m)
  if (any(judged$verdict == "fails")) {
    abort_inertia(check_tensors(given, mass_kg, reach_m, NA_character_), call)
  }
  near <- judged$verdict == "holds within rounding"
  if (any(near) && given_by_user) {
    cli::cli_inform(
      c(
        "The inertia tensor is physical within rounding.",
        stats::setNames(
          paste0(judged$condition[near], ": ", judged$meaning[near], "."),
          rep("i", sum(near))
        )
      ),
      class = c("rotdyn_message_inertia", "rotdyn_message")
    )
  }
  symmetric <- symmetric_part(given$tensor[[1L]])
  dimnames(symmetric) <- dimnames(tensor)
  symmetric
}

abort_inertia <- function(check, call) {
  failed <- check[check$verdict == "fails", ]
  first <- failed[1L, ]
  suggestion <- first$suggestion
  measured <- paste0(
    inertia_measure(first), if (first$condition %in% relative_conditions) {
      paste0(", ", format(100 * first$margin, digits = 3), " % of the largest moment")
    }
  )
  abort_rotdyn(
    c(
      "The inertia tensor is not physical: the condition {.val {first$condition}} fails.",
      x = "{measured}: {first$meaning}.",
      i = if (!is.na(suggestion)) "Suggestion: {suggestion}. Nothing was changed.",
      i = "{.fn check_inertia} shows every condition."
    ),
    "inertia",
    call,
    condition = first$condition,
    value = first$value,
    margin = first$margin,
    check = check
  )
}

relative_conditions <- c("positive semidefinite", "triangle inequality")

inertia_measure <- function(row) {
  value <- format_si(row$value)
  switch(row$condition,
    finite = paste(value, if (row$value == 1) "entry is" else "entries are", "not finite"),
    symmetric = paste("The relative asymmetry is", value),
    "positive semidefinite" = paste("The smallest principal moment is", value, "kg m^2"),
    "triangle inequality" = paste("I1 + I2 - I3 is", value, "kg m^2"),
    mass = paste("The mass is", value, "kg"),
    size = paste("The radius of gyration is", value, "m")
  )
}
