# Scenes and bodies as R code. The core writes it from their text, for R and for the lab.

#' R code that makes a scene
#'
#' The calls of constructors that make a scene or a body again: for a script, a lesson, or a
#' colleague. Numbers are written with as many digits as bring the same bits back; an R without
#' `capabilities("long.double")` may read a neighbour of some.
#'
#' What no call with numbers makes has no such code: bodies from meshes and densities, from tensors
#' about another point or along other axes than their own, and R functions. [write_scene()] keeps
#' all but the last.
#'
#' @param scene A scene (see [scene_axle()]), or a `rot_body`.
#' @param ... Not used: an unknown argument is an error.
#' @return One string, its lines separated by `"\n"`.
#' @section Errors: `rotdyn_error_scene` for a scene that such code cannot make;
#'   `rotdyn_error_type`.
#' @seealso [write_scene()], [lab()], whose page shows the same code.
#' @concept R code
#' @concept reproducible
#' @examples
#' wheel <- scene_axle(body_disk(2, 0.25), 0.8, resistance(viscous_n_m_s = 0.03))
#' cat(scene_code(wheel))
#' identical(scene_hash(eval(parse(text = scene_code(wheel)))), scene_hash(wheel))
#' @export
scene_code <- function(scene, ...) {
  call <- check_no_dots(...)
  check_supplied("scene", call)
  what <- if (inherits(scene, "rot_body")) "body" else "scene"
  code <- .Call(ffi_scene_code, json_text(scene_node(scene, call), 2L))
  if (is.null(code)) {
    abort_rotdyn(c(
      "No R code of constructors and numbers makes this {what}.",
      i = "{.fn write_scene} writes its text, from which {.fn read_scene} makes it."
    ), "scene", call)
  }
  code
}
