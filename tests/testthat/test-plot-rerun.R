skip_if_not_installed("ggplot2")

rerun <- function(where, verdict = "within errors") {
  structure(list(verdict = verdict, where = where), class = "rot_rerun")
}

test_that("differences are drawn over what is allowed", {
  where <- as_table(
    quantity = c("theta_rad", "omega_rad_per_s", "time_s"), row = c(3, 4, 1),
    difference = c(3e-9, 5e-9, 0), allowed = c(1e-9, 1e-8, 0)
  )
  plot <- ggplot2::autoplot(rerun(where, "differs"))
  expect_equal(plot$data$ratio, c(2, 0.5, 0)) # beyond 2 at the edge
  expect_identical(rev(levels(plot$data$quantity)), as.character(plot$data$quantity))
  expect_identical(as.character(plot$data$quantity[3]), column_label("time_s"))
  expect_equal(plot$data$fits, c(FALSE, TRUE, TRUE))
  expect_match(plot$labels$alt, "differs; the most: theta_rad in row 3, off by 3e-09, 1e-09 all")
  expect_match(plot$labels$alt, "2 of 3 quantities")
  where$difference <- 0
  same <- ggplot2::autoplot(rerun(where, "identical"))
  expect_match(same$labels$subtitle, "every value has the same bits")
  expect_true(all(same$data$ratio == 0))
  expect_error(ggplot2::autoplot(rerun(where[0, ])), class = "rotdyn_error_value")
  expect_error(ggplot2::autoplot(rerun(where["row"])), class = "rotdyn_error_type")
  for (damaged in names(where)[-2]) {
    bad <- where
    bad[[damaged]] <- if (damaged == "quantity") 1 else "1"
    expect_error(ggplot2::autoplot(rerun(bad)), class = "rotdyn_error_type")
  }
  expect_error(ggplot2::autoplot(rerun(where), 2), class = "rotdyn_error_argument")
})

test_that("a record computed again is drawn", {
  skip_if_not_installed("RSQLite")
  skip_if_not_installed("yyjsonr")
  records <- DBI::dbConnect(RSQLite::SQLite(), ":memory:")
  on.exit(DBI::dbDisconnect(records))
  records_create(records)
  again <- records_rerun(records, records_add(records, spin_up(time_s = 0:8)))
  plot <- ggplot2::autoplot(again)
  expect_equal(nrow(plot$data), nrow(again$where))
  expect_match(plot$labels$title, "identical")
})
