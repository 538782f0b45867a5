# Results to bench/results.csv, and to the tables in bench/README.md between
#   <!-- begin NAME --> and <!-- end NAME -->

results_file <- "bench/results.csv"
readme_file <- "bench/README.md"

# What was not run this time stays.
merge_results <- function(results, order) {
  if (file.exists(results_file)) {
    old <- utils::read.csv(results_file)
    results <- rbind(old[!old$comparison %in% results$comparison, ], results)
  }
  results[order(match(results$comparison, order)), ]
}

write_results <- function(results) {
  numbers <- vapply(results, is.double, logical(1))
  results[numbers] <- lapply(results[numbers], signif, 4)
  utils::write.csv(results, results_file, row.names = FALSE, na = "")
}

# ---- tables -------------------------------------------------------------------------------------

number <- function(x, digits = 3) {
  text <- formatC(signif(x, digits), format = "fg", digits = digits, big.mark = ",")
  ifelse(is.na(x), "", trimws(text))
}

small <- function(x) ifelse(is.na(x), "", ifelse(x == 0, "0", formatC(x, format = "e", digits = 1)))

with_quartiles <- function(median, q1, q3) {
  ifelse(is.na(median), "", paste0(number(median), " (", number(q1), " to ", number(q3), ")"))
}

markdown <- function(columns) {
  columns <- columns[vapply(columns, function(x) any(nzchar(x)), logical(1))]
  row <- function(cells) paste0("| ", paste(cells, collapse = " | "), " |")
  c(
    row(names(columns)),
    row(rep("---", length(columns))),
    vapply(seq_along(columns[[1]]), function(i) {
      row(vapply(columns, `[`, character(1), i))
    }, character(1))
  )
}

comparison_table <- function(rows) {
  first <- !duplicated(rows$case)
  markdown(list(
    "case" = ifelse(first, rows$case, ""),
    "contender" = rows$contender,
    "time, us" = with_quartiles(rows$median_us, rows$q1_us, rows$q3_us),
    "time / rotdyn's" = ifelse(
      first, "1", with_quartiles(rows$ratio_median, rows$ratio_q1, rows$ratio_q3)
    ),
    "error" = small(rows$error),
    "error of omega, pointwise" = small(rows$error_pointwise),
    "right-hand sides" = number(rows$rhs_calls, 6)
  ))
}

# ---- goals --------------------------------------------------------------------------------------

goal <- function(text, comparison, case, contender, column, least = NA, most = NA) {
  data.frame(text, comparison, case, contender, column, least, most)
}

goals <- rbind(
  goal(
    "spin-up to the finished tibble: times faster than deSolve with an R function at 1e-9",
    "spin-up", "1000 rows", "deSolve lsoda, R function, 1e-9", "ratio_median", least = 50
  ),
  goal(
    "the same, aim", "spin-up", "1000 rows", "deSolve lsoda, R function, 1e-9", "ratio_median",
    least = 100
  ),
  goal(
    "spin-up: times faster than deSolve, compiled, at its default", "spin-up", "1000 rows",
    "deSolve lsoda, compiled, 1e-6 (default)", "ratio_median", least = 4
  ),
  goal(
    "spin-up: times faster than scipy's default", "spin-up", "1000 rows",
    "scipy RK45, 1e-3 (default)", "ratio_median", least = 10
  ),
  goal(
    "spin-up to the finished tibble, us", "spin-up", "1000 rows", "rotdyn, trajectory()",
    "median_us", most = 36
  ),
  goal(
    "spin-up, the routine that trajectory() calls, us", "spin-up", "1000 rows",
    "rotdyn, the routine that trajectory() calls", "median_us", most = 12
  ),
  goal(
    "spin-up, C core, us", "spin-up", "1000 rows", "rotdyn, C core without R", "median_us",
    most = 2
  ),
  goal(
    "sweep, C core: times faster than GSL rk8pd, split at the kinks", "sweep", "100,000 rows",
    "GSL rk8pd in C, 1e-9, split at the kinks", "ratio_median", least = 50
  ),
  goal(
    "sweep, C core, us for 100,000 rows", "sweep", "100,000 rows", "rotdyn, C core without R",
    "median_us", most = 10000
  ),
  goal("spin-up, error", "spin-up", "1000 rows", "rotdyn, trajectory()", "error", most = 2e-15),
  goal(
    "rolling table, 1e3 rows: times faster than dplyr", "rolling", "1e3 rows", "dplyr, mutate()",
    "ratio_median", least = 10
  ),
  goal(
    "rolling table, 1e7 rows: times faster than dplyr", "rolling", "1e7 rows", "dplyr, mutate()",
    "ratio_median", least = 4
  ),
  goal(
    "hollow spheres of any wall, error", "shapes", "1e6 rows of seven shapes",
    "rotdyn, inertia_table()", "error", most = 9e-16
  ),
  goal(
    "spin-up, torque an R function, breaks looked for, us", "function-torque", "1000 rows",
    "rotdyn, breaks looked for", "median_us", most = 3000
  ),
  goal(
    "laws that are R functions: time over that of the fastest model that reaches the accuracy",
    "laws", "all", "time / fastest of ours that reaches the accuracy", "ratio_median", most = 1.5
  ),
  goal(
    "the same, laws below 10 us: time over lsoda's at equal true error", "laws", "all",
    "time / lsoda's, laws below 10 us", "ratio_median", most = 1
  ),
  goal(
    "mesh, C core: time of the plain loop over ours (50 and 75 million triangles a second)", "mesh",
    "1.3e6 triangles, 0 from the origin", "plain loop in C: integrals alone", "ratio_median",
    least = 0.667
  ),
  goal(
    "mesh, error far from the origin", "mesh", "1.3e6 triangles, 1e+06 from the origin",
    "rotdyn, C core: integrals, area, closure, error bound", "error", most = 2e-15
  )
)

goals_table <- function(results) {
  keys <- c("comparison", "case", "contender")
  key <- function(x) do.call(paste, c(x[keys], sep = "\r"))
  at <- match(key(goals), key(results))
  found <- mapply(function(row, column) results[[column]][row], at, goals$column)
  met <- ifelse(is.na(goals$least), found <= goals$most, found >= goals$least)
  figure <- function(x) ifelse(goals$column == "error", small(x), number(x))
  markdown(list(
    "goal" = goals$text,
    "wanted" = ifelse(
      is.na(goals$least), paste("at most", figure(goals$most)),
      paste("at least", figure(goals$least))
    ),
    "found" = ifelse(is.na(found), "not run", figure(found)),
    "met" = ifelse(is.na(met), "", ifelse(met, "yes", "**no**"))
  ))
}

# ---- the page -----------------------------------------------------------------------------------

replace_block <- function(page, name, lines) {
  from <- match(paste0("<!-- begin ", name, " -->"), page)
  to <- match(paste0("<!-- end ", name, " -->"), page)
  if (is.na(from) || is.na(to)) stop("bench/README.md has no block ", name)
  c(page[seq_len(from)], "", lines, "", page[to:length(page)])
}

write_page <- function(results, ran) {
  page <- readLines(readme_file)
  for (name in ran) {
    rows <- results[results$comparison == name, ]
    table <- if (name == "laws") laws_table(rows) else comparison_table(rows)
    page <- replace_block(page, name, c(table, "", describe_machine()))
  }
  page <- replace_block(page, "goals", goals_table(results))
  writeLines(page, readme_file)
}
