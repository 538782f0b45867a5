# The number that an object stands for where one is asked for: see R/body-quantity.R.
quantity_of <- function(x, arg, unit, call) UseMethod("quantity_of")

#' @export
quantity_of.default <- function(x, arg, unit, call) x

# The value in SI units: a plain number is unchanged, a units object or a difftime is converted to
# `unit` (in the notation of the units package).
as_si <- function(x, unit, arg, call) {
  if (!is.object(x)) return(x)
  if (inherits(x, "rot_measured")) return(check_measured(x, arg, call)$value)
  if (inherits(x, "rot_body")) return(quantity_of(x, arg, unit, call))
  if (inherits(x, "difftime")) {
    given <- attr(x, "units")
    known <- c("secs", "mins", "hours", "days", "weeks")
    if (!is.numeric(unclass(x)) || !isTRUE(given %in% known)) {
      abort_quantity(x, arg, call)
    }
    if (unit != "s") abort_dimension(given, unit, arg, call)
    return(as.numeric(x, units = "secs"))
  }
  if (!inherits(x, "units")) return(x)
  need_package("units", "An argument with units", call)
  invalid <- function(e) abort_quantity(x, arg, call)
  # Without its class the number underneath is one, or the object is no quantity.
  if (!is.numeric(unclass(x)) || !inherits(attr(x, "units"), "symbolic_units")) invalid()
  given <- tryCatch(units::deparse_unit(x), error = invalid)
  if (!tryCatch(units::ud_are_convertible(units(x), unit), error = invalid)) {
    abort_dimension(given, unit, arg, call)
  }
  # The units package takes 1 Hz for 1 rad/s.
  if ((startsWith(unit, "rad/") || unit == "rpm") && grepl("Hz|hertz", given)) {
    abort_rotdyn(c(
      "{.arg {arg}} must be a quantity in {plain_unit(unit)}.",
      x = "Its unit, {given}, counts cycles: a cycle is 2 pi rad.",
      i = "Give it in {.val rpm}, or {.code 2 * pi} times it in {.val rad/s}."
    ), "unit", call)
  }
  tryCatch(as.numeric(units::set_units(x, unit, mode = "standard")), error = invalid)
}

# An object of class units or difftime that has no number or no unit.
abort_quantity <- function(x, arg, call) {
  abort_rotdyn(c(
    "{.arg {arg}} is no quantity with a unit.",
    x = "It is {describe_value(x)} without a number or without a unit.",
    i = "Make it again, or give the plain number in SI units."
  ), "type", call)
}

abort_dimension <- function(given, unit, arg, call) {
  wanted <- if (unit == "1") "a plain number" else paste("a quantity in", plain_unit(unit))
  abort_rotdyn(
    c("{.arg {arg}} must be {wanted}.", x = "Its unit, {given}, has another dimension."),
    "unit", call
  )
}
