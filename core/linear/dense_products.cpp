#include "dalembert/core/linear/dense.h"

namespace dalembert::dense {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

MatrixXd product(const MatrixXd& A, const MatrixXd& B) { return A * B; }
VectorXd product(const MatrixXd& A, const VectorXd& x) { return A * x; }
MatrixXcd product(const MatrixXd& A, const MatrixXcd& B) { return A * B; }
VectorXcd product(const MatrixXd& A, const VectorXcd& x) { return A * x; }
MatrixXd transposed_product(const MatrixXd& A, const MatrixXd& B) { return A.transpose() * B; }
VectorXd transposed_product(const MatrixXd& A, const VectorXd& x) { return A.transpose() * x; }
MatrixXd product_transposed(const MatrixXd& A, const MatrixXd& B) { return A * B.transpose(); }
MatrixXcd adjoint_product(const MatrixXcd& A, const MatrixXcd& B) { return A.adjoint() * B; }
MatrixXd restricted(const MatrixXd& N, const MatrixXd& X) { return transposed_product(N, X) * N; }
MatrixXd below(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd both(A.rows() + B.rows(), A.cols());
  both << A, B;
  return both;
}
MatrixXd beside(const MatrixXd& A, const MatrixXd& B) {
  MatrixXd both(A.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}
MatrixXd sizes(const MatrixXd& A) { return A.cwiseAbs(); }

}  // namespace dalembert::dense
