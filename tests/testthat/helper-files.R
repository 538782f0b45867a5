# Files of instruments, written from the descriptions of their formats.

spin_samples <- function(n = 60) {
  t <- (seq_len(n) - 1) / 50
  data.frame(t = t, x = 0.02 * sin(7 * t), y = -0.03 * cos(5 * t), z = 4 - 0.5 * t)
}

# phyphox: ten digits in exponents, quoted headings, five dialects.
phyphox_lines <- function(data, separator = ",", decimal = ".") {
  number <- function(x) {
    text <- sub("e([-+])0?", "E\\1", formatC(x, format = "e", digits = 9))
    text <- sub("E[+]", "E", text)
    if (decimal == ",") sub(".", ",", text, fixed = TRUE) else text
  }
  heads <- c(
    "Time (s)", paste0("Gyroscope ", c("x", "y", "z"), " (rad/s)"), "Absolute (rad/s)"
  )
  data$absolute <- sqrt(data$x^2 + data$y^2 + data$z^2)
  cells <- vapply(data, number, character(nrow(data)))
  c(
    paste0("\"", heads, "\"", collapse = separator),
    apply(cells, 1, paste, collapse = separator)
  )
}

text_file <- function(lines, name = NULL, ext = ".csv", encoding = "UTF-8", bom = FALSE) {
  file <- if (is.null(name)) tempfile(fileext = ext) else file.path(tempfile("d"), name)
  dir.create(dirname(file), showWarnings = FALSE, recursive = TRUE)
  text <- enc2utf8(paste0(paste(lines, collapse = "\n"), "\n"))
  bytes <- if (encoding == "UTF-8") charToRaw(text) else {
    iconv(text, "UTF-8", encoding, toRaw = TRUE)[[1]]
  }
  mark <- if (bom) {
    as.raw(list("UTF-8" = c(0xef, 0xbb, 0xbf), "UTF-16LE" = c(0xff, 0xfe))[[encoding]])
  }
  writeBin(c(mark, bytes), file)
  file
}

# A zip whose files are stored without compression.
zip_file <- function(files) {
  crc <- function(bytes) {
    table <- vapply(0:255, function(n) {
      for (k in 1:8) {
        odd <- n %% 2
        n <- n %/% 2
        if (odd) n <- xor32(n, 0xEDB88320)
      }
      n
    }, 0)
    value <- 0xFFFFFFFF
    for (b in as.integer(bytes)) {
      value <- xor32(table[bitwXor(value %% 256, b) + 1], value %/% 256)
    }
    xor32(value, 0xFFFFFFFF)
  }
  xor32 <- function(a, b) {
    bitwXor(a %/% 65536, b %/% 65536) * 65536 + bitwXor(a %% 65536, b %% 65536)
  }
  little <- function(x, n) as.raw((x %/% 256^(0:(n - 1))) %% 256)
  body <- raw()
  directory <- raw()
  for (name in names(files)) {
    bytes <- charToRaw(paste0(paste(files[[name]], collapse = "\n"), "\n"))
    common <- c(
      little(20, 2), little(0, 2), little(0, 2), little(0, 4), little(crc(bytes), 4),
      little(length(bytes), 4), little(length(bytes), 4), little(nchar(name), 2), little(0, 2)
    )
    directory <- c(
      directory, little(0x02014b50, 4), little(20, 2), common, little(0, 2), little(0, 2),
      little(0, 2), little(0, 4), little(length(body), 4), charToRaw(name)
    )
    body <- c(body, little(0x04034b50, 4), common, charToRaw(name), bytes)
  }
  end <- c(
    little(0x06054b50, 4), little(0, 4), little(length(files), 2), little(length(files), 2),
    little(length(directory), 4), little(length(body), 4), little(0, 2)
  )
  file <- tempfile(fileext = ".zip")
  writeBin(c(body, directory, end), file)
  file
}

# Logger Pro and Graphical Analysis: a DataSet for each run.
vernier_xml <- function(runs) {
  column <- function(name, unit, values) {
    c(
      "<DataColumn>", "<ID>1 </ID>", paste0("<DataObjectName>", name, "</DataObjectName>"),
      paste0("<ColumnUnits>", unit, "</ColumnUnits>"),
      paste0("<ColumnCells>\n", paste(values, collapse = "\n"), "\n</ColumnCells>"), "</DataColumn>"
    )
  }
  sets <- unlist(lapply(names(runs), function(name) {
    run <- runs[[name]]
    c(
      "<DataSet>", paste0("<DataSetName>", name, "</DataSetName>"),
      column("Time", "s", run$t), column("Angle", "rad", run$a),
      column("Velocity", "rad/s", run$v), "</DataSet>"
    )
  }))
  c("<?xml version=\"1.0\"?>", "<Document>", sets, "</Document>")
}

tracker_xml <- function(marks, dt_ms = 1000 / 30, scale = 500, origin = c(320, 240), angle = 0,
                        start = 0) {
  property <- function(name, value, type = "double") {
    paste0("<property name=\"", name, "\" type=\"", type, "\">", value, "</property>")
  }
  object <- function(class, ...) c(paste0("<object class=\"", class, "\">"), ..., "</object>")
  inside <- function(name, ...) {
    c(paste0("<property name=\"", name, "\" type=\"object\">"), ..., "</property>")
  }
  osp <- "org.opensourcephysics."
  turn <- angle * pi / 180
  tracks <- unlist(lapply(names(marks), function(name) {
    m <- marks[[name]]
    px <- origin[1] + scale * (m$x * cos(turn) - m$y * sin(turn))
    py <- origin[2] - scale * (m$x * sin(turn) + m$y * cos(turn))
    frames <- unlist(lapply(seq_along(px), function(i) {
      inside(paste0("[", m$frame[i], "]"), object(
        paste0(osp, "cabrillo.tracker.PointMass$FrameData"),
        property("x", format(px[i], digits = 16)), property("y", format(py[i], digits = 16))
      ))
    }))
    inside("item", object(
      paste0(osp, "cabrillo.tracker.PointMass"), property("name", name, "string"),
      "<property name=\"framedata\" type=\"array\">", frames, "</property>"
    ))
  }))
  c("<?xml version=\"1.0\" encoding=\"UTF-8\"?>", object(
    paste0(osp, "cabrillo.tracker.TrackerPanel"),
    inside("videoclip", object(
      paste0(osp, "media.core.VideoClip"), property("startframe", start, "int"),
      property("starttime", 0)
    )),
    inside("clipcontrol", object(
      paste0(osp, "media.core.StepperClipControl"), property("delta_t", format(dt_ms, digits = 16))
    )),
    inside("coords", object(
      paste0(osp, "media.core.ImageCoordSystem"),
      "<property name=\"framedata\" type=\"array\">",
      inside("[0]", object(
        paste0(osp, "media.core.ImageCoordSystem$FrameData"), property("xorigin", origin[1]),
        property("yorigin", origin[2]), property("angle", angle), property("xscale", scale),
        property("yscale", scale)
      )), "</property>"
    )),
    "<property name=\"tracks\" type=\"collection\">", tracks, "</property>"
  ))
}

# Files of every dialect with the rotation of spin_samples() or of a mark on a wheel.
dialect_files <- function() {
  d <- spin_samples(30)
  a <- 1 + 3 * d$t
  runs <- list("Run 1" = data.frame(t = d$t, a = a, v = 3), Latest = data.frame(t = d$t[1:20],
    a = a[1:20], v = 3))
  list(
    text_file(phyphox_lines(d)), text_file(phyphox_lines(d, "\t", ",")),
    text_file(phyphox_lines(d, ";", ",")),
    text_file(c("masa A", "t\tx\ty", paste(d$t, round(0.2 * cos(a), 5), round(0.2 * sin(a), 5),
      sep = "\t")), ext = ".txt"),
    text_file(c("Latest: Time (s),Latest: Angle (rad)", paste(d$t, a, sep = ","))),
    text_file(c("Time (s) Run #1\tAngle (rad) Run #1", paste(d$t, a, sep = "\t"))),
    text_file(c("time,seconds_elapsed,z,y,x", paste(1.7e18, d$t, d$z, d$y, d$x, sep = ",")),
      name = "Gyroscope.csv"),
    text_file(vernier_xml(runs), ext = ".cmbl"),
    text_file(tracker_xml(list(A = data.frame(frame = 0:29, x = 0.2 * cos(a), y = 0.2 * sin(a)))),
      ext = ".trk"),
    zip_file(list("Gyroscope.csv" = phyphox_lines(d), "meta/time.csv" = "\"event\",\"x\""))
  )
}

# The name of a folder that goes with the function that asks, or with that of `env`.
folder_of <- function(env = parent.frame()) {
  folder <- tempfile("sweep-")
  do.call(on.exit, list(bquote(unlink(.(folder), recursive = TRUE)), add = TRUE), envir = env)
  folder
}
