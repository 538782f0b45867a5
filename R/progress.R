# Progress bars. A display may fail (cli formats no estimate beyond 2^31 years); the run goes on
# without it.

# A function of the fraction done, for C to call at most 20 times a second. The bar appears a second
# after the first call, and with a fraction from which the time left can be estimated: short runs
# make none. It ends with the frame that called progress_bar(); a later run in that frame begins a
# new one.
progress_bar <- function(name) {
  start <- NULL
  last <- -Inf
  bar <- NULL
  failed <- FALSE
  owner <- parent.frame()
  function(fraction) {
    if (failed || !isTRUE(fraction >= 1e-6 && fraction <= 1)) return()
    # A rendered page would keep each state of the bar as a message.
    if (isTRUE(getOption("knitr.in.progress"))) return()
    now <- proc.time()[[3L]]
    if (is.null(start)) start <<- now
    if (now - start < 1 || now - last < 0.2) return()
    last <<- now
    tryCatch(
      {
        if (is.null(bar)) bar <<- cli::cli_progress_bar(name, total = 1, .envir = owner)
        # At 1 the bar would end, and a second phase of the run would find none.
        cli::cli_progress_update(set = min(fraction, 0.999), id = bar, .envir = owner)
      },
      error = function(e) if (is_time_limit(e)) stop(e) else failed <<- TRUE
    )
  }
}

# An error of setTimeLimit(), which has no class of its own, or another that wraps it. It is raised
# once: who catches it goes on without a limit.
is_time_limit <- function(error) {
  said <- character()
  while (inherits(error, "condition")) {
    said <- c(said, error$message)
    error <- error$parent
  }
  any(said %in% gettext("reached elapsed time limit", "reached CPU time limit", domain = "R"))
}
