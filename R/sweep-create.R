# The folder of a sweep, made before any of its rows: for jobs that a scheduler starts.

#' Make the folder of a sweep
#'
#' Writes what a sweep is into a folder, and computes no chunk of it. [sweep_work()] of the jobs of
#' a cluster, [sweep_chunk()] and [sweep_resume()] do that afterwards. [sweep_run()] with a folder
#' needs no call of it.
#'
#' @param plan A plan of [sweep_plan()].
#' @param folder Name of a folder: a new one, an empty one, or one that has this very sweep.
#' @param ... Not used: an unknown argument is an error.
#' @return `folder`, invisibly.
#' @section Errors: `rotdyn_error_folder` for a folder with another sweep; `rotdyn_error_file` where
#'   it cannot be written, or has other files; `rotdyn_error_package` without \pkg{nanoparquet} or
#'   \pkg{yyjsonr}; `rotdyn_error_type`, `rotdyn_error_argument`.
#' @source The layout of a folder: [sweep_run()].
#' @seealso [sweep_run()], [sweep_work()].
#' @concept cluster
#' @concept array job
#' @examplesIf all(c("nanoparquet", "yyjsonr") %in% rownames(utils::installed.packages()))
#' plan <- sweep_plan(
#'   scene_axle(0.0625, resistance = resistance(0.002), omega0_rad_per_s = 20), time_s = 60,
#'   design_grid("omega0_rad_per_s" = c(10, 20))
#' )
#' folder <- sweep_create(plan, tempfile("wheels-"))
#' sweep_todo(folder)
#' sweep_work(folder, part = 1, parts = 2)
#' sweep_status(folder)
#' unlink(folder, recursive = TRUE)
#' @export
sweep_create <- function(plan, folder, ...) {
  call <- check_no_dots(...)
  check_supplied(c("plan", "folder"), call)
  check_plan(plan, call)
  check_file_name(folder, call, "folder", "folder")
  make_sweep_folder(plan, folder, call)
  invisible(folder)
}
