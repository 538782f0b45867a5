# Calls use(folder) with a folder on a disk of `size` bytes, or skips.
on_tiny_disk <- function(size, use) {
  skip_on_cran()
  skip_if(Sys.info()[["sysname"]] != "Linux", "small disks are made on Linux alone")
  folder <- tempfile("disk")
  dir.create(folder)
  command <- paste0("mount -t tmpfs -o size=", size, " tmpfs")
  mounted <- suppressWarnings(
    system(paste(command, shQuote(folder)), ignore.stdout = TRUE, ignore.stderr = TRUE)
  ) == 0L
  on.exit({
    if (mounted) system(paste("umount", shQuote(folder)))
    unlink(folder, recursive = TRUE)
  })
  skip_if(!mounted, "no small disk can be made here")
  use(folder)
}

fill_disk <- function(disk) {
  suppressWarnings(system(
    paste0("dd if=/dev/zero bs=1k of=", shQuote(file.path(disk, "fill"))), ignore.stderr = TRUE
  ))
}
