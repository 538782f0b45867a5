# The value in SI units: a plain number is unchanged, a units object or a difftime is converted to
# `unit` (in the notation of the units package).
as_si <- function(x, unit, arg, call) {
  if (!is.object(x)) return(x)
  if (inherits(x, "difftime")) {
    if (unit != "s") abort_dimension(attr(x, "units"), unit, arg, call)
    return(as.numeric(x, units = "secs"))
  }
  if (!inherits(x, "units")) return(x)
  need_package("units", "An argument with units", call)
  given <- units::deparse_unit(x)
  if (!units::ud_are_convertible(units(x), unit)) abort_dimension(given, unit, arg, call)
  # The units package takes 1 Hz for 1 rad/s.
  if ((startsWith(unit, "rad/") || unit == "rpm") && grepl("Hz|hertz", given)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a quantity in {plain_unit(unit)}.",
      x = "Its unit, {given}, counts cycles: a cycle is 2 pi rad.",
      i = "Give it in {.val rpm}, or {.code 2 * pi} times it in {.val rad/s}."
    ), "unit", call)
  }
  as.numeric(units::set_units(x, unit, mode = "standard"))
}

abort_dimension <- function(given, unit, arg, call) {
  wanted <- if (unit == "1") "a plain number" else paste("a quantity in", plain_unit(unit))
  abort_rotdyn(
    c("{.arg {arg}} must be {wanted}.", x = "Its unit, {given}, has another dimension."),
    "unit", call
  )
}
