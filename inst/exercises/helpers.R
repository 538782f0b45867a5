# What the exercises share: numbers drawn from a grid, numbers in text and in formulas, the record
# of what is asked. Each exercise sources this file; it works with R/exams and without.

# Free fall, in every exercise.
g <- 9.81
take_g <- "(*g* = 9.81 m/s^2^)"

# One number of from, from + by, ..., to. Three digits at most, as text shows no more.
draw <- function(from, to, by) {
  steps <- round((to - from) / by)
  x <- signif(from + by * (sample.int(steps + 1L, 1L) - 1L), 12)
  stopifnot(isTRUE(all.equal(x, signif(x, 3), tolerance = 1e-12)))
  signif(x, 3)
}

# One of the arguments.
pick <- function(...) {
  from <- list(...)
  from[[sample.int(length(from), 1L)]]
}

# c("1.5", "-3"): digits of x, and the power of ten where there is one.
digits_of <- function(x, digits) {
  x <- signif(x, digits)
  power <- if (x == 0 || (abs(x) < 1e5 && abs(x) >= 1e-4)) 0 else floor(log10(abs(x)))
  shown <- format(signif(x / 10^power, digits), digits = 15, scientific = FALSE, trim = TRUE)
  c(shown, if (power != 0) format(power))
}

# In text: "2.5 kg m^2^", with blanks that do not break.
say <- function(x, unit = "", digits = 3) {
  parts <- digits_of(x, digits)
  number <- sub("^(-.*)", "$\\1$", parts[1])
  if (length(parts) == 2L) number <- paste0(number, "&nbsp;&times;&nbsp;10^", parts[2], "^")
  unit <- gsub("\\^(-?[0-9]+)", "^\\1^", gsub(" ", "&nbsp;", unit, fixed = TRUE))
  paste0(number, if (nzchar(unit)) "&nbsp;", unit)
}

# In a formula: "2.5\,\mathrm{kg\,m^2}".
tex <- function(x, unit = "", digits = 3) {
  parts <- digits_of(x, digits)
  number <- parts[1]
  if (length(parts) == 2L) number <- paste0(number, " \\cdot 10^{", parts[2], "}")
  if (unit == "deg") return(paste0(number, "^\\circ"))
  unit <- gsub("%", "\\%", gsub(" ", "\\,", unit, fixed = TRUE), fixed = TRUE)
  if (nzchar(unit)) paste0(number, "\\,\\mathrm{", unit, "}") else number
}

# A vector's components in text.
say_vector <- function(x, unit) {
  paste0("(", paste(vapply(x, say, ""), collapse = ", "), ")&nbsp;", unit)
}

# For the lines of the meta-information: all digits, no power of ten.
plain <- function(x) {
  format(signif(x, 12), digits = 15, scientific = FALSE, trim = TRUE, drop0trailing = TRUE)
}

# A number is asked. `value`: the package's; `by_hand`: that of the formula in the solution;
# `range`: what all drawings keep; `within`: relative tolerance; `error`: relative error of `value`.
number <- function(value, unit, range, by_hand, within = 0.01, error = 1e-12) {
  value <- as.double(value)
  list(
    value = value, range = range, by_hand = by_hand, within = within, error = error,
    solution = plain(value), tolerance = plain(within * abs(value)),
    hint = paste0(
      "Give ", if (nzchar(unit)) paste("the answer in", sub("^1&nbsp;", "", say(1, unit))) else
        "the number", ", to within ", 100 * within, "&nbsp;%."
    )
  )
}

# One of several numbers is right. `wrong`: each from a mistake that the solution names.
choice <- function(right, wrong, unit, range, by_hand, error = 1e-12) {
  values <- as.double(c(right, wrong))
  list(
    value = values[1], values = values, range = range, by_hand = by_hand, within = 0.02,
    error = error, text = vapply(values, say, "", unit = unit)
  )
}

# One of several statements is right.
statement <- function(right, wrong) list(text = c(right, wrong))

# Whether numbers differ by at least 8 % of the larger of each two: draw again where they do not.
apart <- function(values) {
  size <- abs(outer(values, values, "-")) / pmax(outer(abs(values), abs(values), pmax), 1e-300)
  all(size[upper.tri(size)] > 0.08)
}
