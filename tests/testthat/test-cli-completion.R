verbs <- rotdyn:::cli_verbs()
names(verbs) <- vapply(verbs, `[[`, "", "name")

# What bash offers for these words, of which the last is incomplete.
bash_offers <- function(...) {
  words <- c(...)
  script <- tempfile(fileext = ".bash")
  on.exit(unlink(script))
  writeLines(c(
    cli("completion", "bash")$out,
    paste0("COMP_WORDS=(", paste(shQuote(words), collapse = " "), ")"),
    paste0("COMP_CWORD=", length(words) - 1L), "_rotdyn",
    "printf '%s\\n' \"${COMPREPLY[@]}\""
  ), script)
  offered <- system2("bash", c("--norc", script), stdout = TRUE)
  offered[nzchar(offered)]
}

test_that("bash completes verbs, options, values and files", {
  skip_on_os("windows")
  skip_if(!nzchar(Sys.which("bash")), "bash is not installed")
  expect_setequal(bash_offers("rotdyn", ""), names(verbs))
  expect_identical(bash_offers("rotdyn", "traj"), "trajectory")
  expect_identical(bash_offers("rotdyn", "roll", "--gra"), "--gravity-m-per-s2")
  expect_setequal(bash_offers("rotdyn", "roll", "--format", ""), rotdyn:::cli_formats)
  # bash makes three words of --format=j.
  expect_setequal(bash_offers("rotdyn", "roll", "--format", "=", "j"), c("json", "jsonl"))
  expect_setequal(bash_offers("rotdyn", "roll", "--format", "="), rotdyn:::cli_formats)
  expect_setequal(
    bash_offers("rotdyn", "audit", "--model", "free_"), grep("^free_", models()$model, value = TRUE)
  )
  expect_setequal(
    bash_offers("rotdyn", "inertia", "disk", "--"),
    paste0("--", vapply(rotdyn:::cli_options_of(verbs$inertia), `[[`, "", "name"))
  )
  expect_setequal(bash_offers("rotdyn", "inertia", ""), shapes()$shape)
  expect_setequal(bash_offers("rotdyn", "completion", ""), c("bash", "zsh", "fish"))
  # Files are readline's own; of a number nothing is known.
  expect_length(bash_offers("rotdyn", "roll", "--out", ""), 0L)
  expect_length(bash_offers("rotdyn", "roll", "--beta", ""), 0L)
  # A file of trajectory, a flag of rerun.
  expect_length(bash_offers("rotdyn", "trajectory", "--record", "--"), 0L)
  expect_true("--format" %in% bash_offers("rotdyn", "rerun", "--record", "--"))
})

test_that("each shell takes its script, which has every verb and option", {
  for (shell in rotdyn:::cli_shells) {
    said <- cli("completion", shell)
    expect_identical(said$status, 0L)
    text <- paste(said$out, collapse = "\n")
    dash <- if (shell == "fish") "-l " else "--"
    for (name in unique(sub(".*:--", "", names(rotdyn:::cli_option_patterns(verbs))))) {
      expect_true(grepl(paste0(dash, name), text, fixed = TRUE), info = paste(shell, name))
    }
    for (verb in names(verbs)) expect_match(text, verb, fixed = TRUE)
    if (nzchar(Sys.which(shell))) {
      file <- tempfile()
      writeLines(said$out, file)
      expect_identical(system2(shell, c("-n", file)), 0L)
      unlink(file)
    }
  }
  expect_match(cli("completion", "ksh")$err[1], "completion is for `bash`, `zsh`, `fish`")
})

test_that("fish completes values", {
  skip_if(!nzchar(Sys.which("fish")), "fish is not installed")
  file <- tempfile(fileext = ".fish")
  on.exit(unlink(file))
  offers <- function(line) {
    writeLines(c(cli("completion", "fish")$out, paste("complete -C", shQuote(line))), file)
    sub("\t.*", "", system2("fish", c("--private", file), stdout = TRUE))
  }
  expect_setequal(offers("rotdyn traj"), "trajectory")
  expect_setequal(offers("rotdyn roll --format "), rotdyn:::cli_formats)
  expect_setequal(offers("rotdyn audit --model "), models()$model)
})

test_that("zsh and fish say what each verb is for", {
  for (shell in c("zsh", "fish")) {
    text <- paste(cli("completion", shell)$out, collapse = "\n")
    for (verb in verbs) {
      expect_true(grepl(sub("[':].*", "", verb$help[1]), text, fixed = TRUE), info = verb$name)
    }
  }
})
