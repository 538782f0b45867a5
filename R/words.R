# Words: sentences, articles, lists.

sentence <- function(text) {
  substr(text, 1, 1) <- toupper(substr(text, 1, 1))
  text
}

# "an annulus", "a half disk"; "a uniform rod", "an hour"; "points" and other names of several.
with_article <- function(name) {
  # Its axle is at the end; a scene says so.
  name <- gsub("_", " ", sub("^point$", "point mass", sub("^rod_end$", "rod", name)))
  vowel <- grepl("^([aeio]|u(?!ni|s[aei]))", name, ignore.case = TRUE, perl = TRUE)
  several <- grepl("[^sui]s$", name)
  ifelse(several, name, paste(ifelse(vowel, "an", "a"), name))
}

# "a disk" for the body of a scene, "a body" for one that is its moments.
scene_body <- function(scene) {
  body <- .subset2(scene, "body")
  if (inherits(body, "rot_body") && nzchar(body$shape)) with_article(body$shape) else "a body"
}

# What a scene is, as its user described it.
scene_title <- function(scene) {
  lower_first(constraint_of(scene)$title(list(scene = scene, solved = scene)))
}

lower_first <- function(text) paste0(tolower(substr(text, 1L, 1L)), substring(text, 2L))

and_words <- function(x) {
  n <- length(x)
  if (n < 2L) x else paste(paste(x[-n], collapse = ", "), "and", x[n])
}
