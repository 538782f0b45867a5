/* Eigenvalues and singular values by Jacobi rotations, accurate also for the small ones of a graded
 * matrix: A = V diag(values) V',  G U = Q diag(sigma).
 *
 * Reference: Demmel & Veselic, SIAM J. Matrix Anal. Appl. 13 (1992) 1204;
 * Drmac & Veselic, SIAM J. Matrix Anal. Appl. 29 (2008) 1322. */
#ifndef ROT_EIGEN_H
#define ROT_EIGEN_H

#include <stddef.h>

#include "ground/status.h"

/* Symmetric a (n x n, by rows; overwritten) => eigenvalues (ascending), eigenvectors (column j for
 * value j). ROT_EVALUE if an element is not finite. Polls the hooks (NULL: none) for large n. */
rot_status rot_eigen_symmetric(size_t n, double a[], double values[], double vectors[],
                               const rot_hooks *hooks);

/* g (rows x cols, by rows; overwritten), rows >= cols => singular values sigma (ascending), right
 * singular vectors (columns of u, cols x cols): G u_j has length sigma_j. QR with complete
 * pivoting, then rotations: each sigma has a relative error of some `cols` roundings if
 * G = D1 B D2 with diagonal D1, D2 and a well-conditioned B. ROT_EVALUE if an element is not
 * finite. Polls the hooks (NULL: none) for large `cols`. */
rot_status rot_eigen_singular(size_t rows, size_t cols, double g[], double sigma[], double u[],
                              const rot_hooks *hooks);

#endif
