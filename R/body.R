# A body: mass, centre of mass, inertia tensor (point, axes and sign convention stated), size.
# `centre_m` is in the body's own axes, whose origin is the point the shape's help names.
new_body <- function(shape, mass_kg, size_m, inertia_kg_m2, beta, formula) {
  body <- list(
    shape = shape,
    mass_kg = mass_kg,
    size_m = size_m,
    centre_m = c(x = 0, y = 0, z = 0),
    inertia_kg_m2 = inertia_kg_m2,
    point = "centre of mass",
    axes = "own",
    beta = beta,
    formula = formula
  )
  class(body) <- "rot_body"
  body
}

# I_n = n' I n about a unit vector n in the body's own axes.
moment_about_axis <- function(body, axis) {
  sum(axis * (.subset2(body, "inertia_kg_m2") %*% axis))
}

#' @export
print.rot_body <- function(x, ...) {
  size <- paste0(names(x$size_m), " = ", format_si(x$size_m), collapse = ", ")
  principal <- format_si(diag(x$inertia_kg_m2))
  cat(
    "<rot_body> ", x$shape, "\n",
    "  mass     ", format_si(x$mass_kg), " kg, ", size, "\n",
    "  inertia  ", paste(c("Ixx", "Iyy", "Izz"), principal, collapse = ", "),
    " kg m^2 about the ", x$point, ", ", x$axes, " axes\n",
    if (!is.na(x$beta)) paste0("  beta     ", format_si(x$beta), "  (I/(m r^2) when it rolls)\n"),
    "  formula  ", x$formula, "\n",
    sep = ""
  )
  invisible(x)
}

format_si <- function(x) {
  vapply(x, format, character(1), digits = 7)
}
