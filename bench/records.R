# What a record costs: Rscript bench/records.R
#
# Processor time of records_add() for a trajectory of 1000 rows, the least of 200 batches of 5, on
# an open connection and by the name of a file; and of records_list() for 10,000 runs. Goals: at
# most 5 ms and 0.2 s.
library(rotdyn)

lab <- tempfile(fileext = ".sqlite")
records_create(lab)
con <- DBI::dbConnect(RSQLite::SQLite(), lab)
wheel <- scene_axle(
  body_disk(2, 0.25), torque_knots(c(0, 1, 4, 6, 8), c(0, 0.8, 0.8, 0, 0)),
  resistance(viscous_n_m_s = 0.03)
)
motion <- trajectory(wheel, seq(0, 8, length.out = 1000))
processor_s <- function(code) sum(system.time(code)[c("user.self", "sys.self")])
batch_ms <- function(con) {
  processor_s(for (i in 1:5) records_add(con, motion)) / 5 * 1e3
}
least <- function(con) {
  min(replicate(200, batch_ms(con)))
}
cat(sprintf("record of 1000 rows, an open connection: %.2f ms\n", least(con)))
cat(sprintf("record of 1000 rows, a file by its name: %.2f ms\n", least(lab)))
# Copies of a run under other names make up what is missing to 10,000.
invisible(DBI::dbExecute(con, "PRAGMA foreign_keys = ON"))
columns <- DBI::dbListFields(con, "rot_run")
n <- nrow(records_list(con))
invisible(DBI::dbExecute(con, paste0(
  "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < ", 1e4 - n, ")
  INSERT INTO rot_run SELECT ", paste(ifelse(
    columns == "run", "substr(run, 1, 24) || printf('%012d', i)", columns
  ), collapse = ", "), " FROM n, (SELECT * FROM rot_run LIMIT 1)"
)))
stopifnot(nrow(records_list(con)) == 1e4)
s <- min(replicate(10, processor_s(records_list(con))))
cat(sprintf("10,000 runs listed: %.3f s\n", s))
DBI::dbDisconnect(con)
unlink(lab)
