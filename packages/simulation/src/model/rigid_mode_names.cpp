#include "model/rigid_mode_names.hpp"

namespace mortise {

const char* rigid_mode_name(int dimension, bool axisymmetric, int mode) {
  static const char* plane[] = {"translation in x", "translation in y", "rotation"};
  static const char* space[] = {"translation in x", "translation in y", "translation in z",
                                "rotation about x", "rotation about y", "rotation about z"};
  return axisymmetric ? "translation along the axis" : dimension == 2 ? plane[mode] : space[mode];
}

std::vector<std::pair<int, int>> distinct_modes(Eigen::MatrixXd motions, int per_body) {
  std::vector<std::pair<int, int>> found;
  for (Eigen::Index left = motions.cols(); left > 0; --left) {
    Eigen::Index mode = 0;
    motions.rowwise().squaredNorm().maxCoeff(&mode);
    found.emplace_back(static_cast<int>(mode / per_body), static_cast<int>(mode % per_body));
    const Eigen::VectorXd taken = motions.row(mode).transpose().normalized();
    motions -= (motions * taken).eval() * taken.transpose();
  }
  return found;
}

}  // namespace mortise
