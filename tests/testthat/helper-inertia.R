holds <- function(check) all(check$verdict != "fails")
at <- function(check, condition) check[check$condition == condition, ]
six <- function(ixx, iyy, izz, ixy = 0, ixz = 0, iyz = 0) {
  c(ixx = ixx, iyy = iyy, izz = izz, ixy = ixy, ixz = ixz, iyz = iyz)
}

# The tensor of n equal masses, in the order of `six`, as read off a print of six digits.
random_tensor <- function(n) {
  x <- matrix(stats::runif(3 * n, -1, 1), n) %*% diag(c(1, 10^stats::runif(2, -1, 0)))
  x <- x %*% qr.Q(qr(matrix(stats::rnorm(9), 3)))
  x <- sweep(x, 2, colMeans(x))
  second <- crossprod(x) / n
  tensor <- sum(diag(second)) * diag(3) - second
  do.call(six, as.list(tensor[cbind(c(1, 2, 3, 1, 1, 2), c(1, 2, 3, 2, 3, 3))]))
}
