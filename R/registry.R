# The constraints, by the class of their scenes. R/constraints.R has the list and says what a record
# of one holds.

registry <- new.env(parent = emptyenv())
# classes: of the scenes of the first constructors, in the order of the list.
joined <- new.env(parent = emptyenv())

constraint_of <- function(scene) {
  record <- .subset2(registry, class(scene)[1L])
  of_scene <- .subset2(record, "of_scene")
  if (is.null(of_scene)) record else of_scene(scene, record)
}

# One record for each; that of the first constructor of its scenes.
all_constraints <- function() mget(joined$classes, envir = registry)

# A named quantity with a unit and a norm: the columns that hold it, which are taken together by the
# 2-norm; distance(got, want), two matrices of these columns, where another one is meant.
measure <- function(unit, columns, distance = function(got, want) sqrt(rowSums((got - want)^2))) {
  list(unit = unit, columns = columns, distance = distance)
}

# One panel of the picture: its label, and its columns with the names of their lines ("" for a line
# that needs none). It is drawn where the table has one of them, and the column `only_with`.
panel <- function(label, columns, only_with = NULL) {
  list(label = label, columns = columns, only_with = only_with)
}

omega_panel <- function() panel("angular velocity (rad/s)", c(omega_rad_per_s = ""))
