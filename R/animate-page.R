# An animation as a page of HTML with its player (inst/animate): the marks of all frames as numbers
# that the script draws as SVG. Nothing is loaded: script and style are in the page.

# Coordinates are whole numbers: 2000 for half of the picture.
page_half <- 2000

# ---- tracks -------------------------------------------------------------------------------------

# Each mark of a film is a track: what it is in each frame. Marks of two frames are one if they
# have the same type, style, part and number among those. A track has `s`, its points,
#   still    p: for all frames
#   trail    p: points of all frames; w: how many are shown
#   move     p, and t: the matrix of an affine map for each frame (row by row, then the shift)
#   same     p, of: the number of a track whose map it has
#   free     f: points for each frame, 0 where it is not seen
# and points are a flat list of coordinates or, as an arc, {"a": [x, y, radius, from, to]} in
# degrees.

# By slot: list of the marks of all frames, NULL where there is none.
film_slots <- function(frames) {
  named <- lapply(frames, function(frame) {
    of <- vapply(frame$marks, function(one) {
      paste(one$type, one$style, one$part %||% "", one$edge %||% "", !is.null(one$trail))
    }, "")
    paste(of, stats::ave(seq_along(of), of, FUN = seq_along))
  })
  order <- character()
  for (names in named[order(-lengths(named))]) {
    if (all(names %in% order)) next
    for (k in seq_along(names)) {
      if (names[k] %in% order) next
      # Behind the one before it, or first.
      after <- if (k > 1L) match(names[k - 1L], order) else 0L
      order <- append(order, names[k], after)
    }
  }
  lapply(stats::setNames(nm = order), function(name) {
    Map(function(frame, names) {
      at <- match(name, names)
      if (!is.na(at)) frame$marks[[at]]
    }, frames, named)
  })
}

# The arc that points lie on, evenly: c(x, y, radius, from, to) in degrees, or NULL.
as_arc <- function(points) {
  n <- nrow(points)
  if (n < 8L || ncol(points) != 2L || anyNA(points)) return(NULL)
  a <- points[1, ]
  b <- points[1 + n %/% 3, ]
  c <- points[1 + (2 * n) %/% 3, ]
  m <- 2 * rbind(b - a, c - a)
  if (abs(det(m)) <= 1e-9 * sum(m^2)) return(NULL) # all points may be one
  centre <- solve(m, c(sum(b^2) - sum(a^2), sum(c^2) - sum(a^2)))
  out <- sweep(points, 2, centre)
  radius <- sqrt(rowSums(out^2))
  if (diff(range(radius)) > 1e-6 * radius[1]) return(NULL)
  step <- diff(atan2(out[, 2], out[, 1]))
  step <- step - 2 * pi * round(step / (2 * pi))
  if (diff(range(step)) > 1e-6) return(NULL)
  from <- atan2(out[1, 2], out[1, 1]) * 180 / pi
  c(centre, mean(radius), from, from + sum(step) * 180 / pi)
}

# to_grid(points): coordinates as whole numbers.
grid_of <- function(box, space) {
  middle <- c(mean(box[1:2]), mean(box[3:4]), 0)
  if (space) middle[] <- 0
  half <- max(diff(box[1:2]), diff(box[3:4])) / 2
  list(
    half = half, middle = middle,
    to = function(points) {
      sweep(points, 2, middle[seq_len(ncol(points))]) * (page_half / half)
    }
  )
}

points_json <- function(points) {
  arc <- as_arc(points)
  if (is.null(arc)) return(numbers_json(round(t(points))))
  paste0("{\"a\":", numbers_json(round(arc, 2)), "}")
}

numbers_json <- function(x) {
  x <- as.vector(x)
  text <- ifelse(is.finite(x), vapply(x, format, "", digits = 12, scientific = FALSE, trim = TRUE),
                 "null")
  paste0("[", paste(sub("^-0$", "0", text), collapse = ","), "]")
}

whole_json <- function(x) {
  paste0("[", paste(sprintf("%.0f", round(as.vector(x)) + 0), collapse = ","), "]")
}

# The affine maps of points of the first frame to those of the others: a row for each frame, or
# NULL where there are none, or nothing is gained.
affine_maps <- function(points) {
  d <- ncol(points[[1]])
  from <- cbind(points[[1]], page_half)
  root <- svd(from)
  kept <- root$d > 1e-9 * root$d[1]
  inverse <- root$v[, kept, drop = FALSE] %*% (t(root$u[, kept, drop = FALSE]) / root$d[kept])
  maps <- matrix(0, length(points), d * (d + 1L))
  for (k in seq_along(points)) {
    map <- inverse %*% points[[k]]
    if (max(abs(from %*% map - points[[k]])) > 0.05) return(NULL)
    map[d + 1L, ] <- map[d + 1L, ] * page_half
    maps[k, ] <- t(map)
  }
  maps
}

# Parts of a map are in ten-thousandths; the shift is on the grid.
maps_json <- function(maps, d) {
  linear <- seq_len(d * d)
  maps[, linear] <- 1e4 * maps[, linear]
  whole_json(t(maps))
}

film_tracks <- function(film) {
  grid <- grid_of(film$box, film$space)
  slots <- film_slots(film$frames)
  d <- if (film$space) 3L else 2L
  movers <- list()
  out <- list()
  for (marks in slots) {
    seen <- !vapply(marks, is.null, NA)
    first <- marks[[which(seen)[1]]]
    head <- paste0(
      "\"k\":\"", first$type, "\",\"s\":\"", first$style, "\"",
      if (!is.null(first$part)) paste0(",\"part\":\"", first$part, "\""),
      if (isTRUE(first$edge)) ",\"e\":1"
    )
    if (!is.null(first$trail)) {
      path <- grid$to(first$trail$path)
      last <- marks[[length(marks)]]$trail
      whole <- last$from == 1L
      body <- paste0("\"trail\":", whole_json(t(path)), ",\"w\":",
                     if (whole) length(marks) else last$to - last$from)
    } else {
      points <- lapply(marks[seen], function(one) grid$to(one$points))
      sizes <- vapply(points, nrow, 0L)
      body <- NULL
      if (all(seen) && length(unique(sizes)) == 1L) {
        same <- max(vapply(points, function(p) max(abs(p - points[[1]])), 0)) < 0.05
        if (same) {
          body <- paste0("\"p\":", points_json(points[[1]]))
        } else {
          # A map that an earlier track has.
          for (m in seq_along(movers)) {
            joint <- affine_maps(Map(rbind, movers[[m]]$points, points))
            if (is.null(joint)) next
            movers[[m]]$points <- Map(rbind, movers[[m]]$points, points)
            movers[[m]]$maps <- joint
            body <- paste0("\"p\":", points_json(points[[1]]), ",\"of\":", m - 1L)
            break
          }
          if (is.null(body) && sizes[1] > 2L && is.null(as_arc(points[[length(points)]]))) {
            maps <- affine_maps(points)
          } else if (is.null(body) && sizes[1] > 2L && d == 2L) {
            maps <- affine_maps(points)
          } else {
            maps <- NULL
          }
          if (is.null(body) && !is.null(maps)) {
            movers[[length(movers) + 1L]] <- list(points = points, maps = maps)
            body <- paste0("\"p\":", points_json(points[[1]]), ",\"of\":", length(movers) - 1L)
          }
        }
      }
      if (is.null(body)) {
        texts <- rep("0", length(marks))
        texts[seen] <- vapply(points, points_json, "")
        body <- paste0("\"f\":[", paste(texts, collapse = ","), "]")
      }
    }
    out[[length(out) + 1L]] <- paste0("{", head, ",", body, "}")
  }
  list(
    marks = paste0("[", paste(unlist(out), collapse = ",\n"), "]"),
    moves = paste0("[", paste(vapply(movers, function(one) maps_json(one$maps, d), ""),
                              collapse = ",\n"), "]")
  )
}

# ---- symbols ------------------------------------------------------------------------------------

greek_letters <- c(
  alpha = "\u03b1", beta = "\u03b2", gamma = "\u03b3", theta = "\u03b8", mu = "\u03bc",
  omega = "\u03c9", Omega = "\u03a9", tau = "\u03c4", phi = "\u03c6", rho = "\u03c1"
)

# "omega[1]" as letters and what stands below the line: c("\u03c9", "1").
symbol_parts <- function(symbol) {
  if (startsWith(symbol, "\"")) return(c(gsub("^\"|\"$", "", symbol), ""))
  base <- sub("\\[.*", "", symbol)
  low <- if (grepl("[", symbol, fixed = TRUE)) sub("^[^[]*\\[(.*)\\]$", "\\1", symbol) else ""
  letters <- strsplit(base, "*", fixed = TRUE)[[1]]
  known <- letters %in% names(greek_letters)
  letters[known] <- greek_letters[letters[known]]
  c(paste(letters, collapse = ""), gsub("\"", "", low))
}

html_text <- function(x) {
  # "kg m^2" as it is written.
  x <- gsub("^2", "\u00b2", enc2utf8(x), fixed = TRUE)
  x <- gsub("&", "&amp;", x, fixed = TRUE)
  x <- gsub("<", "&lt;", x, fixed = TRUE)
  gsub("\"", "&quot;", gsub(">", "&gt;", x, fixed = TRUE), fixed = TRUE)
}

symbol_html <- function(symbol) {
  parts <- html_text(symbol_parts(symbol))
  paste0("<i>", parts[1], "</i>", if (nzchar(parts[2])) paste0("<sub>", parts[2], "</sub>"))
}

labels_json <- function(film) {
  grid <- grid_of(film$box, film$space)
  axes <- if (film$space) c("x", "y", "z") else c("x", "y")
  frames <- lapply(film$frames, `[[`, "labels")
  names <- unique(unlist(lapply(frames, function(one) {
    if (!is.null(one)) paste(one$symbol, one$style)
  })))
  texts <- vapply(names, function(name) {
    at <- lapply(frames, function(one) {
      row <- if (!is.null(one)) match(name, paste(one$symbol, one$style))
      if (!length(row) || is.na(row)) return(NULL)
      round(grid$to(as.matrix(one[row, axes])))
    })
    symbol <- sub(" [^ ]*$", "", name)
    parts <- json_string(symbol_parts(symbol))
    first <- Find(function(one) symbol %in% one$symbol, frames)
    first <- first[match(symbol, first$symbol), ]
    still <- length(unique(at)) == 1L
    points <- vapply(if (still) at[1] else at, function(p) {
      if (is.null(p)) "0" else whole_json(p)
    }, "")
    paste0(
      "{\"t\":[", parts[1], ",", parts[2], "],\"s\":\"", sub("^.* ", "", name), "\"",
      if (startsWith(symbol, "\"")) ",\"word\":1",
      if (isTRUE(first[["beside"]])) ",\"aside\":1",
      if (!is.null(first[["hjust"]])) paste0(",\"h\":", first$hjust),
      ",\"at\":[", paste(points, collapse = ","), "]}"
    )
  }, "")
  paste0("[", paste(texts, collapse = ",\n"), "]")
}

# ---- the page -----------------------------------------------------------------------------------

# Numbers with the digits that are shown.
value_digits <- 5L

film_json <- function(film) {
  tracks <- film_tracks(film)
  values <- vapply(film$values, function(one) {
    paste0(
      "{\"label\":", json_string(one$label), ",\"unit\":", json_string(one$unit), ",\"x\":",
      numbers_json(signif(one$x, value_digits)), "}"
    )
  }, "")
  says <- vapply(film$frames, `[[`, "", "says")
  words <- unique(says)
  box <- film$box
  grid <- grid_of(box, film$space)
  half <- c(diff(box[1:2]), diff(box[3:4])) / 2 * page_half / grid$half
  text <- paste0(
    "{\"time\":", numbers_json(signif(film$time_s, 12)),
    ",\"slow\":", numbers_json(film$slow), ",\"digits\":", film_time_digits(film),
    ",\"space\":", if (film$space) paste0("[", paste(space_view_deg, collapse = ","), "]") else "0",
    ",\"half\":", whole_json(half),
    if (film$space) {
      paste0(",\"gap\":", whole_json(label_gap * film$look$radius / grid$half * page_half))
    },
    ",\"marks\":", tracks$marks, ",\"moves\":", tracks$moves, ",\"labels\":", labels_json(film),
    ",\"values\":[", paste(values, collapse = ","), "]",
    ",\"words\":[", paste(json_string(words), collapse = ","), "]",
    ",\"says\":", if (length(words) > 1L) whole_json(match(says, words) - 1) else "0", "}"
  )
  # No "</script>" in a script.
  gsub("<", "\\u003c", text, fixed = TRUE)
}

# A file of inst/animate, without comments, indents and empty lines.
player_part <- function(name) {
  lines <- readLines(system.file("animate", name, package = "rotdyn"), encoding = "UTF-8")
  lines <- sub("^ +", "", sub("^ *(//|/\\*).*$", "", lines))
  lines[nzchar(lines)]
}

# Text colours that differ enough from white (4.5 : 1).
page_inks <- c(
  body = "#333333", speed = "#0068A3", torque = "#B04A00", weight = "#007A59",
  resistance = "#96348A", spring = "#7D5B05"
)

key_html <- function(key) {
  if (is.null(key) || !nrow(key)) return(NULL)
  key <- key[nzchar(key$name), ]
  rows <- vapply(seq_len(nrow(key)), function(i) {
    one <- key[i, ]
    # A value stands with its unit in one line.
    value <- if (nzchar(one$value)) {
      paste0(" <span class=\"value\">", html_text(one$value), "</span>")
    }
    paste0(
      "<li><span style=\"color:", page_inks[[one$style]], "\">",
      if (nzchar(one$symbol)) paste0(symbol_html(one$symbol), "</span> ") else "</span>",
      html_text(one$name), value, "</li>"
    )
  }, "")
  c("<ul class=\"key\">", rows, "</ul>")
}

values_html <- function(values) {
  if (!length(values)) return(NULL)
  rows <- vapply(values, function(one) {
    sprintf(
      "<tr><th scope=\"row\">%s</th><td class=\"x\"></td><td>%s</td></tr>",
      html_text(one$label), html_text(one$unit)
    )
  }, "")
  c("<table class=\"values\"><caption>now</caption><tbody>", rows, "</tbody></table>")
}

# The picture and its controls: inst/animate/player.html with what is of this film.
controls_html <- function(film, id) {
  lines <- player_part("player.html")
  if (!film$space) {
    view <- which(lines == "<div class=\"bar view\">")
    lines <- lines[seq_len(view - 1L)]
  }
  speed <- speed_words(film$slow)
  with <- c(
    ID = id, LAST = length(film$time_s) - 1L, BESIDE = space_view_deg[[1]],
    ABOVE = space_view_deg[[2]],
    SPEED = if (nzchar(speed)) paste("film:", html_text(speed)) else ""
  )
  for (name in names(with)) lines <- gsub(name, with[[name]], lines, fixed = TRUE)
  lines
}

# A part of a page. Its script finds it by its id and shares nothing with other ones.
film_html <- function(film, width_px, alone = FALSE) {
  id <- paste0("rotdyn-", film$id)
  tag <- function(name, class, text, ...) {
    paste0("<", name, " class=\"", class, "\"", ..., ">", text, "</", name, ">")
  }
  named <- function(what) paste0(" id=\"", id, "-", what, "\"")
  colours <- c(draw_fills, stats::setNames(draw_colours, paste0("line-", names(draw_colours))))
  c(
    paste0(
      "<div class=\"rotdyn-film\" id=\"", id, "\" style=\"max-width:", width_px, "px\"",
      if (alone) " data-alone=\"1\"", ">"
    ),
    "<style>", gsub("ROOT", paste0("#", id), player_part("player.css"), fixed = TRUE), "</style>",
    paste0("<div class=\"box\" role=\"group\" aria-labelledby=\"", id, "-title\">"),
    tag(if (alone) "h1" else "p", "title", html_text(film$title), named("title")),
    controls_html(film, id), values_html(film$values), tag("p", "says", ""), key_html(film$key),
    tag("p", "alt", html_text(film$alt), named("alt")),
    tag("p", "live", "", " aria-live=\"polite\""),
    tag("p", "help", "Keys: space plays and pauses, arrows step, Home and End go to the ends."),
    "</div>",
    "<script type=\"application/json\">", film_json(film), "</script>",
    "<script>", player_part("player.js"),
    paste0(
      "play(document.getElementById(", json_string(id), "),", json_object(colours), ",",
      json_object(page_inks), ");"
    ),
    "})();", "</script>", "</div>"
  )
}

json_object <- function(x) {
  paste0("{", paste0(json_string(names(x)), ":", json_string(unname(x)), collapse = ","), "}")
}

film_page <- function(film, width_px) {
  c(
    "<!DOCTYPE html>", "<html lang=\"en\">", "<head>", "<meta charset=\"utf-8\">",
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">",
    "<link rel=\"icon\" href=\"data:,\">",
    sprintf("<title>%s</title>", html_text(film$title)),
    "<style>body{margin:0;padding:1em;background:#fff}main{margin:auto}</style>",
    "</head>", "<body>", "<main>", film_html(film, width_px, alone = TRUE), "</main>", "</body>",
    "</html>"
  )
}

# A page in the viewer of the session, or in the browser.
show_page <- function(html, call) {
  path <- tempfile(fileext = ".html")
  write_file(html, path, call)
  show <- getOption("viewer")
  if (is.function(show)) show(path) else utils::browseURL(path)
}
