# Inertia of a mesh of 1.3e6 triangles: the C core beside the loop as one would write it in C, and
# with the checks of the mesh. The torus is that of bench/peers/mesh-core.c.

mesh_rings <- 1300
mesh_sides <- 500

mesh_torus <- function(offset) {
  turn <- 6.283185307179586
  i <- rep(seq_len(mesh_rings) - 1, each = mesh_sides)
  j <- rep(seq_len(mesh_sides) - 1, mesh_rings)
  u <- turn * i / mesh_rings
  v <- turn * j / mesh_sides
  number <- function(i, j) as.integer(i %% mesh_rings * mesh_sides + j %% mesh_sides + 1)
  # Two faces after each other, as there: their order is part of the speed.
  pairs <- function(first, second) as.vector(rbind(first, second))
  a <- number(i, j)
  c <- number(i + 1, j + 1)
  list(
    vertices = cbind(
      (1 + 0.25 * cos(v)) * cos(u) + offset, (1 + 0.25 * cos(v)) * sin(u) + offset,
      0.25 * sin(v) + offset
    ),
    faces = cbind(pairs(a, a), pairs(number(i + 1, j), c), pairs(c, number(i, j + 1)))
  )
}

run_mesh <- function(rounds) {
  program <- compile_program("mesh-core", core_files())
  one <- function(offset) {
    ask <- function(how) child(program, how, c(mesh_rings, mesh_sides, offset, 0, 0, 0))
    truth <- solve_child(ask("exact"))$theta_rad
    error <- function(second) max(abs(second - truth)) / sum(truth[1:3])
    in_c <- function(name, how) contender(name, ask(how), error(solve_child(ask(how))$theta_rad))
    torus <- mesh_torus(offset)
    ours <- function() rotdyn::body_mesh(torus, mass_kg = 1, length_unit = "m")
    second <- ours()$second_moment_kg_m2[c(1, 5, 9, 4, 7, 8)]
    paired(
      "mesh", paste0("1.3e6 triangles, ", format(offset), " from the origin"),
      list(
        in_c("rotdyn, C core: integrals, area, closure, error bound", "core"),
        in_c("plain loop in C: integrals alone", "plain"),
        in_c("rotdyn, C core: welded, edges and parts checked, integrals", "checked"),
        contender("rotdyn, body_mesh()", ours, error(second))
      ),
      rounds = min(rounds, 9L), batches = 3, batch_us = 1e5, collect = TRUE
    )
  }
  rbind(one(0), one(1e6))
}
