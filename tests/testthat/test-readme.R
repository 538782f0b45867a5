# The README stands beside the package's sources.
readme <- function() {
  path <- file.path(Sys.getenv("ROTDYN_ROOT", "no such folder"), "README.md")
  if (!file.exists(path)) skip("no README")
  readLines(path, encoding = "UTF-8")
}

# Lines of the chunks of R that name the package, or follow one that does.
readme_chunks <- function() {
  lines <- readme()
  open <- which(lines == "```r")
  close <- vapply(open, function(i) i + which(lines[-seq_len(i)] == "```")[1], 1)
  chunks <- Map(function(from, to) lines[(from + 1L):(to - 1L)], open, close)
  Filter(function(chunk) !any(grepl("install.packages", chunk)), chunks)
}

test_that("the examples of the README print what it shows", {
  skip_if_not(l10n_info()[["UTF-8"]])
  old <- options(width = 100, cli.unicode = TRUE)
  on.exit(options(old))
  env <- new.env(parent = globalenv())
  for (chunk in readme_chunks()) {
    shown <- sub("^#> ?", "", grep("^#>", chunk, value = TRUE))
    printed <- utils::capture.output(for (step in parse(text = chunk, encoding = "UTF-8")) {
      value <- withVisible(eval(step, env))
      if (value$visible) print(value$value)
    })
    # What the last digits round to is a machine's own; the lines about rows left out, pillar's.
    plain <- function(x) {
      x <- x[!grepl("more rows", x)]
      gsub("\\s+", " ", gsub("[0-9.]+e-1[0-9]|[0-9.]+e-0?9", "#", trimws(x)))
    }
    expect_identical(plain(printed), plain(shown), label = chunk[1])
  }
})

test_that("README and the sheet of all verbs name what exists, and what is new", {
  root <- Sys.getenv("ROTDYN_ROOT", "no such folder")
  sheet <- file.path(root, "vignettes", "rotdyn.Rmd")
  if (!file.exists(sheet)) skip("no vignettes")
  sheet <- readLines(sheet, encoding = "UTF-8")
  of_others <- c(
    "library", "tail", "seq", "c", "list", "function", "vignette", "autoplot", "update", "predict",
    "summary", "browseVignettes", "f"
  )
  for (text in list(readme(), sheet)) {
    code <- unlist(regmatches(text, gregexpr("`[^`]+`", text)))
    called <- unlist(regmatches(code, gregexpr("[A-Za-z_.]+(?=\\()", code, perl = TRUE)))
    known <- c(getNamespaceExports("rotdyn"), of_others, "install.packages")
    expect_identical(setdiff(called, known), character())
    # Arguments by name, of calls without calls inside.
    plain <- unlist(regmatches(code, gregexpr("[a-z_]+\\([^()]*=[^()]*\\)", code)))
    for (call in plain) {
      name <- sub("\\(.*", "", call)
      f <- tryCatch(getExportedValue("rotdyn", name), error = function(e) NULL)
      if (is.null(f) || name %in% c("compare_runs", "forces")) next
      said <- regmatches(call, gregexpr("[a-z0-9_]+(?= *=)", call, perl = TRUE))[[1]]
      expect_identical(setdiff(said, c(names(formals(f)), "omega_rad_per_s")), character())
    }
  }
  scenes <- grep("^scene_(?!hash|code)", getNamespaceExports("rotdyn"), value = TRUE, perl = TRUE)
  for (name in c(scenes, "brake", "time_when", "period_of", "update")) {
    expect_true(any(grepl(paste0(name, "("), sheet, fixed = TRUE)), info = name)
  }
  for (name in c("brake(", "time_when(", "period_of(", "update(", "axle_euler", "step_s")) {
    expect_true(any(grepl(name, readme(), fixed = TRUE)), info = name)
    expect_true(any(grepl(name, sheet, fixed = TRUE)), info = name)
  }
})

test_that("README installs what the lessons need, and make demo does", {
  root <- Sys.getenv("ROTDYN_ROOT", "no such folder")
  skip_if_not(file.exists(file.path(root, "tools", "setup.R")), "the repository")
  text <- paste(readme(), collapse = "\n")
  named <- unlist(regmatches(text, gregexpr("install[.]packages\\(c\\([^)]*\\)", text)))
  named <- gsub("\"", "", unlist(regmatches(named, gregexpr("\"[^\"]+\"", named))))
  wanted <- function(what) {
    old <- setwd(root)
    on.exit(setwd(old))
    system2(file.path(R.home("bin"), "Rscript"), c("tools/setup.R", what), stdout = TRUE)
  }
  lessons <- wanted("lessons")
  expect_true(all(c("ggplot2", "svglite", "knitr", "rmarkdown", "RSQLite") %in% lessons))
  expect_setequal(named, c(wanted("imports"), lessons))
  demo <- grep("^ *demo\\) may=", readLines(file.path(root, "tools", "setup.sh")), value = TRUE)
  expect_match(demo, "ask_r lessons")
})
