# A number in SI units from what the user gave: a plain number is taken as it is, a units object or
# a difftime is converted to `unit` (in the notation of the units package).
as_si <- function(x, unit, arg, call) {
  if (!is.object(x)) {
    return(x)
  }
  if (inherits(x, "difftime")) {
    if (unit != "s") {
      abort_dimension(attr(x, "units"), unit, arg, call)
    }
    return(as.numeric(x, units = "secs"))
  }
  if (!inherits(x, "units")) {
    return(x)
  }
  need_package("units", "An argument with units", call)
  if (!units::ud_are_convertible(units(x), unit)) {
    abort_dimension(units::deparse_unit(x), unit, arg, call)
  }
  as.numeric(units::set_units(x, unit, mode = "standard"))
}

abort_dimension <- function(given, unit, arg, call) {
  wanted <- if (unit == "1") "a plain number" else paste("a quantity in", plain_unit(unit))
  abort_rotdyn(
    c(
      "{.arg {arg}} must be {wanted}.",
      x = "Its unit, {given}, has another dimension."
    ),
    "unit",
    call
  )
}
