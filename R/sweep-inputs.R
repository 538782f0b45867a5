# What of a scene may vary in a sweep, and what comes out of a row.

#' What may vary in a sweep, and what comes out
#'
#' `sweep_inputs()`: the numbers of a scene that the rows of a sweep may vary, by their paths: those
#' of its constructor and of the constructors of its parts. `sweep_outputs()`: what may be kept of
#' each row.
#'
#' A path is the name of an argument, of an argument of a part behind `$`, with the place of an item
#' or of a number in brackets: `body$mass_kg`, `pivot_m[3]`, `bodies[2]$radius_m`. What the
#' constructors derive, such as the moment of inertia of a body, is no input: vary what it follows
#' from. An optional argument that has the value which its constructor finds without it, such as
#' `omega0_rad_per_s` of a body that rolls at the start, follows when others vary, as in
#' [update()]. A body may be replaced by a number where the constructor takes one (`body`, its
#' moment of inertia).
#'
#' @param scene A scene, see [scene_axle()].
#' @param ... Not used: an unknown argument is an error.
#' @return `sweep_inputs()`: a tibble with a row for each number and the columns
#'   `r describe_columns(sweep_inputs_columns, sweep_inputs_meanings)`
#'   `sweep_outputs()`: a tibble with the columns
#'   `r describe_columns(sweep_outputs_columns, sweep_outputs_meanings)`
#'   Times of events are Inf where there is none up to the last time. `lost_j`, `supplied_j` and
#'   `balanced` need the audit of the run, some microseconds for each row. Of several rows for each
#'   time (`rotor`, `link`) an output has the number in brackets: `final_theta_rad[2]`.
#' @section Errors: `rotdyn_error_type`; `rotdyn_error_scene` for a scene that cannot be made again
#'   from its parts.
#' @source Constructors and their domains: the help of each, such as [scene_axle()].
#' @seealso [sweep_plan()], [design_sobol()], [write_scene()].
#' @concept parameter study
#' @concept sensitivity
#' @examples
#' wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(viscous_n_m_s = 0.03))
#' sweep_inputs(wheel)
#' sweep_outputs(wheel)
#' @export
sweep_inputs <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene(scene, call)
  found <- inputs_that_vary(scene_node_with_functions(scene, call))
  as_table(
    input = found$path, unit = plain_units(found$unit), value = found$value,
    domain = domain_words(found$low, found$high, found$above), meaning = found$words
  )
}

#' @rdname sweep_inputs
#' @export
sweep_outputs <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  check_scene(scene, call)
  found <- outputs_of_scene(scene, call)
  as_table(output = found$path, unit = plain_units(found$unit), meaning = found$words)
}

inputs_that_vary <- function(node) .Call(ffi_sweep_inputs, node)

# The unit of a column is that of the dictionary, or that in its name where the scene named it.
outputs_of_scene <- function(scene, call) {
  found <- .Call(ffi_sweep_outputs, scene_node_with_functions(scene, call))
  pattern <- "^((?:final|max_abs|max|min)_)(.*?)(\\[[0-9]+\\])?$"
  column <- sub(pattern, "\\2", found$path, perl = TRUE)
  named <- constraint_of(scene)$named
  own <- column %in% names(named)
  found$path[own] <- paste0(sub(pattern, "\\1", found$path[own], perl = TRUE), named[column[own]])
  dictionary <- column_table()
  unknown <- is.na(found$unit)
  found$unit[unknown] <- dictionary$unit[match(column[unknown], dictionary$name)]
  found$unit[own] <- vapply(named[column[own]], unit_of_name, "", USE.NAMES = FALSE)
  found
}

# "> 0", "0 to 90", "any"
domain_words <- function(low, high, above) {
  at_most <- abs(high) < .Machine$double.xmax
  at_least <- abs(low) < .Machine$double.xmax
  ifelse(
    at_least & at_most, paste(format_each(low), "to", format_each(high)),
    ifelse(at_least, paste(ifelse(above, ">", ">="), format_each(low)),
           ifelse(at_most, paste("<=", format_each(high)), "any"))
  )
}

plain_units <- function(units) gsub("*", " ", units, fixed = TRUE)

format_each <- function(x) vapply(x, format, "", digits = 6)
