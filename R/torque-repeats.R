# A torque law that draws random numbers, or depends on a counter or a clock, is no function of its
# arguments: no step is short enough for it. Two calls with the same arguments show it; the
# integrator looks again where steps fail (rot_ode_check_repeats() in src/core/engine/ode/step.c).

random_remedy <- "Draw random numbers before the run: {.fn torque_knots} of times and values, or a
                  function that interpolates between them."

# `at`: the law at many times. Some differ by what an iterative solver leaves.
check_repeats <- function(at, from, to, call) {
  time_s <- from + (to - from) * c(0, 0.137, 0.382, 0.719)
  first <- at(time_s)
  again <- at(time_s)
  differs <- which(abs(first - again) > 1e-6 * max(abs(c(first, again))))
  if (length(differs)) {
    at <- differs[1]
    abort_rotdyn(c(
      "The torque function gives two values for the same arguments.",
      x = "At {format(time_s[at], digits = 7)} s it returned {format(first[at], digits = 7)} N m,
           then {format(again[at], digits = 7)} N m.",
      i = random_remedy
    ), "random", call)
  }
}
