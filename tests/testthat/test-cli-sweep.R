test_that("each verb prints what it printed: sweeps", {
  for (need in c("nanoparquet", "yyjsonr")) skip_if_not_installed(need)
  seconds <- c("^([0-9],65536,0,0),.*" = "\\1,SECONDS",
               "^([0-9]+,327680,[0-9],5),[^,]*," = "\\1,SECONDS,")
  old <- setwd(tempdir())
  on.exit({
    unlink(c("wheels", "folder"), recursive = TRUE)
    setwd(old)
  })
  dir.create("folder")
  plan <- sweep_plan(
    scene_axle(0.0625, resistance = resistance(0.002), omega0_rad_per_s = 20), 60,
    design_random(5 * 2^16, seed = 1, "omega0_rad_per_s" = vary_normal(20, 1)),
    outputs = "final_theta_rad", keep = "summary", chunk_rows = 2^16
  )
  digest <- sweep_digest(sweep_run(plan, "wheels"))
  unlink(file.path("wheels", "sums", rotdyn:::part_name(1:4)))
  expect_snapshot({
    cli_golden("sweep", "status", "wheels", masked = seconds)
    cli_golden("sweep", "work", "wheels", "--part", "1", "--of", "3", masked = seconds)
    cli_golden("sweep", "resume", "wheels", "--threads", "2", masked = seconds)
    cli_golden("sweep", "work", "wheels")
    cli_golden("sweep", "status", "wheels", "--of", "3")
    cli_golden("sweep", "wrok", "wheels")
    cli_golden("sweep", "status", "folder")
    cli_golden("sweep", "status", "nowhere")
    cli_golden("sweep", "work", "wheels", "--part", "4", "--of", "3")
  })
  expect_identical(sweep_digest("wheels"), digest)
})
