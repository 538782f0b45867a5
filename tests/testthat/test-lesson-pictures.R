# Pictures of the lessons as they stand in a page: vignettes/pictures.R.

page_picture <- function(body) {
  skip_if_not_installed("knitr")
  path <- file.path(
    Sys.getenv("ROTDYN_ROOT", file.path("..", "..")), "vignettes", "pictures.R"
  )
  skip_if(!file.exists(path), "no vignettes")
  file <- tempfile(fileext = ".svg")
  writeLines(c(
    "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 504.00 259.20'>", "<defs></defs>",
    body, "</svg>"
  ), file)
  kept <- knitr::opts_chunk$get()
  hook <- knitr::knit_hooks$get("plot")
  width <- options(width = getOption("width"))
  own <- new.env(parent = globalenv())
  on.exit({
    unlink(file)
    knitr::opts_chunk$restore(kept)
    knitr::knit_hooks$set(plot = hook)
    options(width)
  })
  sys.source(path, own)
  own$svg_in_page(file, "a picture")
}

test_that("identifiers are of one page, the data of a map as they were", {
  map <- "<image xlink:href='data:image/png;base64,AAcpB/cp+9=' width='10.00' height='20.04'/>"
  page <- page_picture(c(
    "<clipPath id='cpMC4w'><rect x='0.04' y='1.26' width='3.00' height='4'/></clipPath>",
    "<g clip-path='url(#cpMC4w)'>", map, "</g>"
  ))
  expect_match(page, "base64,AAcpB/cp+9='", fixed = TRUE)
  expect_match(page, "<clipPath id='c1MC4w'><rect x='0' y='1.3' width='3'", fixed = TRUE)
  expect_match(page, "url(#c1MC4w)", fixed = TRUE)
})

test_that("long texts have their width in Helvetica", {
  text <- function(words, style) {
    sprintf("<text x='1.00' y='2.00' style='font-size: 10.00px;%s'>%s</text>", style, words)
  }
  page <- page_picture(c(
    text("iiiiiiiiii", ""), text("MMMMMMMMMM", "font-weight: bold;"), text("a &amp; b &lt; c", ""),
    text("short", "")
  ))
  long <- as.numeric(regmatches(page, gregexpr("(?<=textLength=')[0-9.]+", page, perl = TRUE))[[1]])
  # Adobe's metrics, of 1000 of the size: i 222; M, bold 833; a & b < c with its blanks.
  words <- (556 + 667 + 556 + 584 + 500 + 4 * 278) / 100
  expect_equal(long, c(22.2, 83.3, words), tolerance = 0.005)
  expect_match(page, ">short</text>", fixed = TRUE)
})
