test_that("each line prints what the command prints", {
  said <- cli("batch", "-", input = c(
    "roll --beta 0.4", "", "# a note", "rotdyn inertia disk --mass-kg 2 --radius-m '0.25' # note"
  ))
  expect_identical(said$status, 0L)
  expect_identical(said$out, c(
    cli("roll", "--beta", "0.4")$out,
    cli("inertia", "disk", "--mass-kg", "2", "--radius-m", "0.25")$out
  ))
})

test_that("a line that fails is named, the others run, and its status is the batch's", {
  said <- cli("batch", "-", "--mark", "END", input = c(
    "roll --beta 0.4", "rolle", "inertia disk", "batch -", "version 'x", "version"
  ))
  expect_identical(said$status, 2L)
  expect_identical(grep("^END", said$out, value = TRUE), paste("END", c(0, 2, 2, 2, 2, 0)))
  expect_match(said$err[1], "line 2: unknown verb `rolle`", fixed = TRUE)
  expect_true(any(grepl("line 4: a batch contains no batch", said$err)))
  expect_true(any(grepl("line 5: a quote is not closed", said$err)))
  file <- tempfile()
  on.exit(unlink(file))
  writeLines(c("shapes --quiet --out /", "rolle"), file)
  said <- cli("batch", file)
  expect_identical(said$status, 3L)
  expect_match(said$err[1], paste0(file, ":1: "), fixed = TRUE)
})

test_that("options of the batch are those of lines that have none", {
  said <- cli("batch", "-", "--json", input = c(
    "roll --beta 0.4", "roll --beta 0.4 --format csv", "roll --beta 0.4 --json"
  ))
  json <- cli("roll", "--beta", "0.4", "--json")$out
  expect_identical(said$out, c(json, cli("roll", "--beta", "0.4")$out, json))
  expect_identical(json, cli("roll", "--beta", "0.4", "--format", "json")$out)
  expect_identical(cli("roll", "--json", "--format", "csv")$status, 2L)
  file <- tempfile()
  on.exit(unlink(file))
  kept <- cli("batch", "-", "--out", file, input = c("roll --beta 0.4", "version"))
  expect_length(kept$out, 0L)
  expect_identical(readLines(file), c(cli("roll", "--beta", "0.4")$out, cli("version")$out))
})

test_that("words are a shell's", {
  split <- rotdyn:::cli_split
  expect_identical(split("a  'b c' \"d \\\" e\" f\\ g # h"), c("a", "b c", "d \" e", "f g"))
  expect_identical(split("a#b '' x\"y\"z"), c("a#b", "", "xyz"))
  expect_identical(split("  "), character())
  expect_null(split("a 'b"))
})

test_that("standard input is the batch's own", {
  said <- cli("batch", "-", input = c("audit - --times 0,1", "roll --beta 0.4"))
  expect_match(said$err[1], "standard input can be read once", fixed = TRUE)
})

test_that("a program gets each answer before it asks again", {
  skip_on_os("windows")
  skip_on_cran()
  command <- install_cli(tempfile("bin"))
  folder <- dirname(command)
  on.exit(unlink(folder, recursive = TRUE))
  # The second line is written after the first answer was read.
  script <- file.path(folder, "talk.sh")
  writeLines(c(
    "mkfifo ask answer", paste(shQuote(command), "batch - --mark END < ask > answer &"),
    "exec 3> ask 4< answer", "echo version >&3", "read one <&4; read mark <&4",
    "echo \"roll --beta 0.4\" >&3", "read two <&4; read three <&4; read mark2 <&4",
    "exec 3>&-", "echo \"$one|$mark|$three|$mark2\""
  ), script)
  said <- system(paste("cd", shQuote(folder), "&& sh talk.sh"), intern = TRUE)
  expect_match(said, "^rotdyn .*[|]END 0[|]0[.]4,.*[|]END 0$")
})

test_that("a zero byte is an error of its line", {
  file <- tempfile()
  on.exit(unlink(file))
  text <- c(
    charToRaw("roll --beta 0.4\nroll --beta 0.4"), as.raw(0),
    charToRaw(" --format json\nroll --beta 0.4")
  )
  writeBin(text, file)
  out <- err <- character()
  status <- rotdyn:::cli_run(
    c("batch", "-", "--mark", "END"), function(lines) out <<- c(out, lines),
    function(lines) err <<- c(err, lines), file, FALSE, rotdyn:::cli_verbs()
  )
  expect_identical(status, 3L)
  expect_identical(grep("^END", out, value = TRUE), paste("END", c(0, 3, 0)))
  expect_match(err, "line 2: it has a zero byte", fixed = TRUE)
  expect_length(err, 1L)
})
