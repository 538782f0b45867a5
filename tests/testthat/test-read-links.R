skip_if_not_installed("xml2")

arm <- function() system.file("extdata", "arm.urdf", package = "rotdyn", mustWork = TRUE)
urdf <- function(inertia = 'ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"',
                 mass = '<mass value="1"/>', origin = "", more = "") {
  sprintf(
    '<robot name="r"><link name="a"><inertial>%s%s<inertia %s/></inertial>%s</link></robot>',
    origin, mass, inertia, more
  )
}

test_that("the example's links are told apart", {
  links <- read_links(arm())
  expect_equal(links$link, c("world", "base", "upper_arm", "forearm", "gripper"))
  expect_equal(links$verdict, c("no inertia", "holds", "holds", "fails", "holds"))
  expect_equal(links$mass_kg, c(NA, 4, 2.1, 1.4, 0.3))
  expect_match(links$fault[4], "^triangle inequality")
  expect_match(links$suggestion[4], "^izz = 0.0213 instead of 213 .* every condition hold$")
  expect_equal(is.na(links$fault), c(TRUE, TRUE, TRUE, FALSE, TRUE))
  expect_equal(vapply(links$body, is.null, TRUE), c(TRUE, FALSE, FALSE, TRUE, FALSE))
  expect_setequal(setdiff(names(links), column_table()$name), character())
  # A mesh leaves the reach open; a cylinder of 0.1 x 0.12 about its centre does not.
  expect_equal(links$reach_m[c(2, 5)], c(sqrt(0.1^2 + 0.06^2), NA))
})

test_that("a cylinder's link is the cylinder", {
  base <- read_links(arm())$body[[2]]
  expect_equal(as.double(base$centre_m), c(0, 0, 0.06))
  expect_equal(diag(base$inertia_kg_m2), c(x = 0.0148, y = 0.0148, z = 4 * 0.1^2 / 2))
})

test_that("bodies are in the link's own frame: R = Rz Ry Rx, I = R I R'", {
  rpy <- c(0.3, -0.5, 0.7)
  tensor <- matrix(c(1.1, 0.1, -0.2, 0.1, 1.3, 0.05, -0.2, 0.05, 1.6), 3)
  text <- urdf(
    'ixx="1.1" ixy="0.1" ixz="-0.2" iyy="1.3" iyz="0.05" izz="1.6"',
    origin = '<origin xyz="1 -2 0.5" rpy="0.3 -0.5 0.7"/>'
  )
  body <- read_links(text)$body[[1]]
  turn <- rotation_about("z", angle_rad = rpy[3]) %*% rotation_about("y", angle_rad = rpy[2]) %*%
    rotation_about("x", angle_rad = rpy[1])
  expect_equal(unname(body$inertia_kg_m2), turn %*% tensor %*% t(turn), tolerance = 1e-14)
  expect_equal(as.double(body$centre_m), c(1, -2, 0.5))
  # A rod along x, turned: along (cos yaw cos pitch, sin yaw cos pitch, -sin pitch).
  rod <- read_links(urdf(
    'ixx="0" ixy="0" ixz="0" iyy="2" iyz="0" izz="2"', origin = '<origin rpy="0.3 -0.5 0.7"/>'
  ))$body[[1]]
  along <- c(cos(0.7) * cos(-0.5), sin(0.7) * cos(-0.5), -sin(-0.5))
  expect_equal(unname(rod$second_moment_kg_m2), 2 * along %o% along, tolerance = 1e-14)
})

test_that("the reach is that of the farthest drawn point", {
  # Against points on the surface of each solid, turned and moved.
  reach <- function(geometry) {
    read_links(urdf(
      'ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"',
      origin = '<origin xyz="0.1 0.2 -0.1"/>',
      more = sprintf(
        '<visual><origin xyz="-0.2 0.1 0.3" rpy="0.4 -0.3 1.1"/><geometry>%s</geometry></visual>',
        geometry
      )
    ))$reach_m
  }
  turn <- rotation_about("z", angle_rad = 1.1) %*% rotation_about("y", angle_rad = -0.3) %*%
    rotation_about("x", angle_rad = 0.4)
  farthest <- function(points) {
    from <- turn %*% points + c(-0.2, 0.1, 0.3) - c(0.1, 0.2, -0.1)
    sqrt(max(colSums(from^2)))
  }
  corners <- t(as.matrix(expand.grid(c(-1, 1), c(-1, 1), c(-1, 1))))
  angle <- seq(0, 2 * pi, length.out = 20001)
  rims <- rbind(0.2 * cos(angle), 0.2 * sin(angle), 0)
  expect_equal(reach('<box size="0.3 0.5 0.7"/>'), farthest(corners * c(0.15, 0.25, 0.35)))
  expect_equal(
    reach('<cylinder radius="0.2" length="0.6"/>'),
    max(farthest(rims + c(0, 0, 0.3)), farthest(rims - c(0, 0, 0.3))),
    tolerance = 1e-7
  )
  ends <- cbind(c(0, 0, 0.3), c(0, 0, -0.3))
  expect_equal(reach('<capsule radius="0.2" length="0.6"/>'), farthest(ends) + 0.2)
  expect_equal(reach('<sphere radius="0.2"/>'), farthest(cbind(c(0, 0, 0))) + 0.2)
  expect_equal(reach('<mesh filename="a.stl"/>'), NA_real_)
})

test_that("a tensor too large for what is drawn fails, and still is a body", {
  ball <- '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
  links <- read_links(urdf(
    'ixx="4000" ixy="0" ixz="0" iyy="4000" iyz="0" izz="4000"', more = ball
  ))
  expect_equal(links$verdict, "fails")
  expect_match(links$fault, "^size")
  expect_match(links$suggestion, "unit (kg mm^2)", fixed = TRUE)
  expect_s3_class(links$body[[1]], "rot_body")
  expect_equal(links$reach_m, 0.1)
  # Its numbers are those of a body: it has a text.
  expect_equal(links$body[[1]]$reach_m, NA_real_)
  expect_no_error(write_scene(links$body[[1]]))
})

test_that("masses and tensors that are no number are faults, not errors", {
  links <- read_links(urdf(mass = '<mass value="nan"/>'))
  expect_match(links$fault, "^mass")
  expect_null(links$body[[1]])
  links <- read_links(urdf('ixx="inf" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"'))
  expect_match(links$fault, "^finite: ixx is Inf")
  links <- read_links(urdf(mass = '<mass value="0"/>'))
  expect_match(links$fault, "^mass: the mass is 0")
  links <- read_links(urdf(
    'ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"', mass = '<mass value="0"/>'
  ))
  expect_equal(links$verdict, "holds")
})

test_that("rounding is told in the table, without a message", {
  text <- urdf('ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="2.00000000000001"')
  expect_no_message(links <- read_links(text))
  expect_equal(links$verdict, "holds within rounding")
  expect_s3_class(links$body[[1]], "rot_body")
})

test_that("documents, namespaces and blanks are understood", {
  expect_equal(read_links(xml2::read_xml(arm())), read_links(arm()))
  text <- sub("<robot", '<robot xmlns="http://drake.mit.edu"', urdf(), fixed = TRUE)
  expect_equal(read_links(text)$mass_kg, 1)
  expect_equal(read_links(paste0("\n  ", urdf(mass = '<mass value=" 1e-1 "/>')))$mass_kg, 0.1)
})

test_that("SDF is read", {
  sdf <- function(pose, inertia) {
    sprintf(
      '<sdf version="1.9"><world name="w"><model name="m"><link name="a"><pose>9 9 9 1 1 1</pose>
      <inertial><pose%s</pose><mass>2</mass><inertia>%s</inertia></inertial>
      <collision name="c"><geometry><box><size>2 2 2</size></box></geometry></collision>
      </link></model><model name="n"><link name="b"/></model></world></sdf>', pose, inertia
    )
  }
  plain <- "<ixx>0.1</ixx><iyy>0.2</iyy><izz>0.25</izz>"
  links <- read_links(sdf(' degrees="true">0.1 0 0 0 0 90', plain))
  expect_equal(links$link, c("m::a", "n::b"))
  expect_equal(links$verdict, c("holds", "no inertia"))
  # A quarter turn about z changes x for y.
  expect_equal(
    unname(links$body[[1]]$inertia_kg_m2), diag(c(0.2, 0.1, 0.25)), tolerance = 1e-14
  )
  expect_equal(as.double(links$body[[1]]$centre_m), c(0.1, 0, 0))
  expect_equal(links$reach_m[1], sqrt(1.1^2 + 2))
  radians <- read_links(sdf(">0.1 0 0 0 0 1.5707963267948966", plain))
  expect_equal(radians$body[[1]]$inertia_kg_m2, links$body[[1]]$inertia_kg_m2)
  expect_error(
    read_links(sdf(' rotation_format="quat_xyzw">0 0 0 0 0 0 1', plain)),
    class = "rotdyn_error_file"
  )
  expect_error(read_links(sdf(">0 0 0 0 0 0", "<ixx>1</ixx>")), class = "rotdyn_error_file")
})

test_that("what a macro would have written is missed", {
  macro <- '<link name="a"><xacro:box_inertia m="1"/></link>'
  bound <- '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
  for (head in c(bound, '<robot name="r">')) {
    expect_no_warning(
      expect_error(
        read_links(paste0(head, macro, "</robot>")), "expand it first",
        class = "rotdyn_error_file"
      )
    )
  }
  # The declaration alone is what an expanded file keeps; other prefixes do not matter.
  text <- sub('<robot name="r">', bound, urdf(more = "<old:gazebo/>"), fixed = TRUE)
  expect_no_warning(links <- read_links(text))
  expect_equal(links$mass_kg, 1)
})

test_that("nothing is taken that is there twice, or in a unit of its own", {
  two <- sub("</robot>", '<link name="b"/><link name="b"/></robot>', urdf(), fixed = TRUE)
  expect_error(read_links(two), "More than one link is named \"b\"", class = "rotdyn_error_file")
  expect_error(
    read_links(urdf(mass = '<mass value="1"/><mass value="2"/>')), "must have one",
    class = "rotdyn_error_file"
  )
  expect_error(
    read_links(urdf(mass = '<mass value="1" unit="g"/>')), "\"g\"",
    class = "rotdyn_error_unit"
  )
  sdf <- paste0(
    '<sdf version="1.9"><model name="m"><link name="a"><inertial auto="true"/></link></model></sdf>'
  )
  expect_error(read_links(sdf), "A simulator would use", class = "rotdyn_error_file")
})

test_that("links of several worlds are told apart", {
  world <- '<world name="%s"><model name="m"><link name="a"/></model></world>'
  worlds <- paste0("<sdf>", sprintf(world, "v"), sprintf(world, "w"), "</sdf>")
  expect_equal(read_links(worlds)$link, c("v::m::a", "w::m::a"))
})

test_that("what is drawn in another frame leaves the reach unknown, and no more", {
  sdf <- function(attribute) {
    paste0(
      '<sdf version="1.9"><model name="m"><link name="a"><inertial><mass>2</mass><inertia>',
      "<ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>",
      "<visual name=\"v\"><pose ", attribute, ">0 0 3 0 0 0</pose>",
      "<geometry><sphere><radius>1</radius></sphere></geometry></visual></link></model></sdf>"
    )
  }
  expect_equal(read_links(sdf(""))$reach_m, 4)
  expect_equal(read_links(sdf('relative_to="a"'))$reach_m, 4)
  expect_equal(read_links(sdf('relative_to="other"'))$reach_m, NA_real_)
  expect_equal(read_links(sdf('rotation_format="quat_xyzw"'))$verdict, "holds")
})

test_that("text is UTF-8 whatever it declares", {
  text <- paste0('<?xml version="1.0" encoding="ISO-8859-1"?>', urdf())
  text <- sub('<link name="[^"]*"', '<link name="caf\u00e9"', text)
  expect_equal(read_links(text)$link, "caf\u00e9")
})

test_that("what cannot be read is an error that names the link", {
  expect_error(read_links(), class = "rotdyn_error_missing")
  expect_error(read_links(3), class = "rotdyn_error_type")
  expect_error(read_links(c("a", "b")), class = "rotdyn_error_type")
  expect_error(read_links("<robot>"), "well-formed", class = "rotdyn_error_file")
  expect_error(read_links(tempdir()), class = "rotdyn_error_file")
  expect_error(read_links('<robot><link name=""/></robot>'), class = "rotdyn_error_file")
  expect_error(
    read_links(urdf(more = "<visual><geometry><box/></geometry></visual>")),
    class = "rotdyn_error_file"
  )
  error <- tryCatch(read_links(urdf(mass = "")), error = identity)
  expect_equal(error$call[[1]], quote(read_links))
  expect_snapshot(error = TRUE, {
    read_links("no-such.urdf")
    read_links("<html/>")
    read_links('<robot name="r"/>')
    read_links(urdf('ixx="1"'))
    read_links(urdf(mass = ""))
    read_links(urdf(mass = '<mass value="${m}"/>'))
    read_links(urdf(mass = '<mass value="1,5"/>'))
    read_links(urdf(origin = '<origin xyz="0 0"/>'))
    read_links(urdf(origin = '<origin xyz="0 0 inf"/>'))
  })
})

test_that("a damaged file is closed again", {
  skip_if_not_installed("xml2")
  skip_if_not(dir.exists("/proc/self/fd"))
  path <- tempfile(fileext = ".urdf")
  on.exit(unlink(path))
  writeLines("<robot><link", path)
  before <- length(list.files("/proc/self/fd"))
  for (i in 1:20) expect_error(read_links(path), class = "rotdyn_error_file")
  expect_lt(length(list.files("/proc/self/fd")), before + 5)
})
