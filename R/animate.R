# Motions as moving pictures: a page with its player, or a file. The frames are made in
# R/animate-film.R and R/draw-*.R, pages in R/animate-page.R, other files in R/animate-video.R.

#' Animate a motion
#'
#' A motion as a moving picture: a page with its player, which a console, a notebook and R Markdown
#' show and which is a file of HTML for slides and course pages; or an animated GIF, an MP4 or a
#' WebM. The frames are drawn as [autoplot()][autoplot.rot_scene] draws the scene.
#'
#' * Motions of every scene. A body on an incline is to scale; where the path is longer than 14
#'   radii, the picture follows the body past marks a radius apart. Rotors in a line, seen from the
#'   side, have a stripe, blue, that comes to the front once a turn. A body in space is shown as a
#'   homogeneous box with its moments of inertia, or as the cylinder where two of them are equal;
#'   the sides have colours, so that turns show. Arrows are the angular velocity and the angular
#'   momentum; a thin line is the path of a point of the body. The page turns the view.
#' * A race, [roll_race()]: each body on a lane, with its time of arrival.
#' * A collision, [collide()], [ball_bounce()], [hinged_hit()], [disks_lock()], [rims_meet()]:
#'   before and after, the contact at time 0. Bodies move and turn evenly.
#'
#' The frames are evenly spaced in time, the last one is at the end of the motion, and each is
#' computed by the model of the motion, as [predict()][predict.rot_trajectory] does: none is
#' interpolated. Beside the picture stand the time, the numbers of each frame (at most six), a word
#' on the state, and the quantities of the scene.
#'
#' @section The page:
#' Nothing is loaded from elsewhere: the page works from a disk and without a network. Buttons and
#' keys play, pause and step: space, the arrows, Page up and down (ten frames), Home and End; a
#' slider is the time. Nothing moves before play is pressed; where the reader's system asks for
#' reduced motion, two pictures a second are shown. The text of the page says what the picture
#' shows; a polite live region reads the numbers half a second after the last step. In R Markdown
#' and Quarto an animation that a chunk returns is shown, and several on one page are
#' independent of each other. Where the document is not HTML, and in `plot()`, its last frame stands
#' for it, with alternative text.
#'
#' @param x From [trajectory()], [roll_race()] or [collide()] and the other functions of
#'   collisions. A motion is shown from its first row to its last, of collisions the first
#'   one.
#' @param file NULL, or a file to write, ending in `.html`; `.gif`, by the package gifski; `.mp4` or
#'   `.webm`, by the package av.
#' @param ... Not used; names after it must be given in full.
#' @param frames_per_s Frames in a second of the film, 1 to 50. In a GIF the time of a frame is a
#'   whole number of hundredths of a second.
#' @param slow_motion How many seconds of film one second of the motion takes: 1 as it is, 10 ten
#'   times as slow, 0.1 ten times as fast. NULL: 1 for a motion of 1 to 60 s, otherwise a round
#'   number with which the film takes 4 to 10 s.
#' @param width_px Width in pixels, 64 to 2000: of the pictures, which are as high as wide, and the
#'   largest one of the page.
#' @return With a `file`, its path, invisibly. Otherwise a `rot_animation`: printed, it opens in the
#'   browser (interactive sessions) or says what it has; `format(x)` is the HTML of the page.
#' @section Errors: `rotdyn_error_type`, `rotdyn_error_value` (also for more than 2000 frames),
#'   `rotdyn_error_time` for a motion of fewer than two times, `rotdyn_error_file` (also where an
#'   encoder wrote an empty or a damaged file), `rotdyn_error_package` without gifski or av;
#'   `rotdyn_error_unit`, `rotdyn_error_argument`, `rotdyn_error_missing`, and those of
#'   [predict()][predict.rot_trajectory].
#' @seealso [axis_path()], [polhode()], [autoplot.rot_trajectory()], [autoplot.rot_race()],
#'   [autoplot.rot_collision()].
#' @concept animation
#' @concept gif
#' @concept mp4
#' @concept html
#' @examples
#' race <- roll_race(c("hoop", "disk", "sphere"), incline_angle_deg = 10, length_m = 2)
#' animate_motion(race)
#' page <- animate_motion(race, tempfile(fileext = ".html"), frames_per_s = 10)
#' file.size(page)
#'
#' nut <- trajectory(scene_free(c(1, 2, 3), c(0.01, 4, 0.01)), time_s = c(0, 12))
#' if (requireNamespace("gifski", quietly = TRUE)) {
#'   file <- animate_motion(nut, tempfile(fileext = ".gif"), frames_per_s = 5, width_px = 160)
#'   file.size(file)
#' }
#' @export
animate_motion <- function(x, file = NULL, ..., frames_per_s = 25, slow_motion = NULL,
                           width_px = 640) {
  call <- check_no_dots(...)
  check_supplied("x", call)
  plan <- film_plan(x, call)
  rate <- check_number(frames_per_s, "frames_per_s", "Hz", call, lower = 1, upper = 50)
  slow <- if (is.null(slow_motion)) {
    round_slow_motion(diff(plan$ends))
  } else {
    check_number(slow_motion, "slow_motion", "1", call, lower = 0, open = TRUE)
  }
  width <- round(check_number(width_px, "width_px", "1", call, lower = 64, upper = 2000))
  kind <- ""
  if (!is.null(file)) {
    file <- check_film_name(file, call)
    kind <- tolower(sub("^.*\\.", "", file))
  }
  frame_s <- if (kind == "gif") round(100 / rate) / 100 else 1 / rate
  time_s <- film_times(plan$ends, frame_s / slow, call, plan$through)
  if (kind == "gif") need_package("gifski", "A GIF", call)
  if (kind %in% c("mp4", "webm")) {
    need_package("av", "A video", call)
    width <- 2 * ceiling(width / 2) # videos have even sizes
  }
  film <- plan$film(time_s)
  film$time_s <- time_s
  film$slow <- slow
  film$alt <- trimws(film_alt(film))
  if (kind %in% c("gif", "mp4", "webm")) {
    write_film(file, film, width, frame_s, call)
    return(invisible(file))
  }
  out <- structure(list(film = film, width_px = width), class = "rot_animation")
  if (kind != "html") return(out)
  write_file(format(out), file, call)
  invisible(file)
}

check_film_name <- function(file, call) {
  path <- check_file_name(file, call)
  if (!grepl("\\.(html|gif|mp4|webm)$", path, ignore.case = TRUE)) {
    abort_rotdyn(c(
      "{.arg file} must end in {.file .html}, {.file .gif}, {.file .mp4} or {.file .webm}.",
      x = "It is {.file {path}}."
    ), "value", call)
  }
  path
}

# ---- an animation as an object ------------------------------------------------------------------

# Ids of the elements of a page: no two of a session are the same.
film_count <- new.env(parent = emptyenv())

with_id <- function(film) {
  film_count$n <- (film_count$n %||% 0L) + 1L
  film$id <- paste0("film-", film_count$n)
  film
}

#' @export
format.rot_animation <- function(x, ...) {
  check_no_dots(...)
  film_page(with_id(x$film), x$width_px)
}

#' @export
print.rot_animation <- function(x, ...) {
  check_no_dots(...)
  film <- x$film
  ends <- format_si(signif(film$time_s[c(1, length(film$time_s))], 4))
  speed <- speed_words(film$slow)
  say("<rot_animation> ", escape_controls(film$title), "\n")
  say(
    "  ", length(film$time_s), " frames from ", ends[1], " to ", ends[2], " s",
    if (nzchar(speed)) paste0(", ", speed), "\n"
  )
  say("  A file of it: animate_motion(motion, \"motion.html\"), .gif, .mp4 or .webm.\n")
  if (interactive()) show_page(format(x), current_env())
  invisible(x)
}

#' A frame of an animation
#'
#' `autoplot()` and `plot()` of an animation draw one of its frames, with the quantities of the
#' scene; the last one, unless `time_s` says otherwise.
#'
#' @param object An animation, from [animate_motion()].
#' @inheritParams autoplot.rot_trajectory
#' @param time_s NULL, or a time in s: the frame nearest to it.
#' @return A ggplot, with alternative text.
#' @section Errors: `rotdyn_error_package` without ggplot2; `rotdyn_error_argument`,
#'   `rotdyn_error_type`, `rotdyn_error_value`, `rotdyn_error_unit`.
#' @seealso [animate_motion()].
#' @concept plot
#' @concept animation
#' @examplesIf requireNamespace("ggplot2", quietly = TRUE)
#' ggplot2::autoplot(animate_motion(roll_race(c("hoop", "sphere"))), time_s = 1)
#' @exportS3Method ggplot2::autoplot
autoplot.rot_animation <- function(object, ..., time_s = NULL, base_size = 13) {
  call <- check_plot(base_size, ...)
  film <- object$film
  i <- length(film$time_s)
  if (!is.null(time_s)) {
    i <- which.min(abs(film$time_s - check_number(time_s, "time_s", "s", call)))
  }
  frame <- flat_frame(film, i)
  now <- vapply(film$values, function(one) {
    paste(format_si(signif(one$x[i], 4)), one$unit)
  }, "")
  key <- rbind(film$key, if (length(now)) {
    do.call(rbind, Map(function(one, value) quantity("", one$label, value), film$values, now))
  })
  if (is.null(key)) key <- quantity("", "a motion", "")
  labels <- frame$labels
  if (is.null(labels)) labels <- label_at(character(), double(), double())
  draw(
    list(
      marks = frame$marks, labels = labels, quantities = key, limits = film$box, clip = "on",
      note = paste0(
        "t = ", formatC(film$time_s[i], format = "f", digits = film_time_digits(film)), " s",
        if (nzchar(frame$says)) paste0(": ", frame$says)
      )
    ), film$title, base_size
  )
}

#' @exportS3Method knitr::knit_print
knit_print.rot_animation <- function(x, ...) {
  html <- knitr::is_html_output(excludes = c("markdown", "gfm", "epub"))
  if (html) return(knitr::raw_html(paste(film_html(with_id(x$film), x$width_px), collapse = "\n")))
  # The last frame as a picture, its alternative text under it.
  latex <- knitr::is_latex_output()
  path <- knitr::fig_path(if (latex) ".pdf" else ".png")
  dir.create(dirname(path), showWarnings = FALSE, recursive = TRUE)
  if (latex) grDevices::pdf(path, 5, 5) else grDevices::png(path, 720, 720, res = 108)
  draw_film_frame(x$film, length(x$film$time_s))
  grDevices::dev.off()
  knitr::asis_output(paste0("\n\n![", gsub("[][]", "", x$film$alt), "](", path, ")\n\n"))
}
