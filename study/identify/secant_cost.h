// Residuals of a slow simulation as a cost of Ceres, their derivatives with as few simulations as
// will do: by one-sided differences, then brought along by Broyden's rank-one formula
//
//   J += (dr - J dp) (D dp)^T / (dp^T D dp)      D: squared lengths of J's columns
//
// for as long as J foretells the residuals of the steps taken (Madsen, Nielsen, Tingleff 2004,
// Methods for Non-Linear Least Squares Problems, section 3.5; Broyden 1965, Math. Comp. 19, 577).
// D gives a parameter as much of the blame as it moves the residuals, whatever its unit.
//
// A minimum found with a brought along Jacobian is to be sought once more from there with a fresh
// one (forget()).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include <ceres/cost_function.h>

namespace towbench::study::identify {

struct Bounds {
  Eigen::VectorXd low;
  Eigen::VectorXd high;
};

struct Search {
  Bounds bounds;
  double tolerance = 1e-7;  // ends when a step gains less than this share of the cost
  // Above this cost (half the sum of squares) that share is the rough one. 0: at none.
  double rough_above = 0;
  double rough_tolerance = 1e-7;
  int most_rounds = 8;
};

class SecantCost final : public ceres::CostFunction {
 public:
  using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  // Writes the residuals at `parameters`; false where there are none.
  using Residuals = std::function<bool(const double* parameters, double* residuals)>;

  // `steps`: by how much each parameter is moved for its difference. `most_missed`: the share of a
  // change of the residuals that J may miss and still be brought along; 0: differences always.
  SecantCost(Residuals residuals, int count, std::vector<double> steps, double most_missed = 0.5);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

  // The next Jacobian is by differences.
  void forget() noexcept { known_ = false; }
  // The last one asked for, and the residuals there.
  [[nodiscard]] const Jacobian& jacobian() const noexcept { return jacobian_; }
  [[nodiscard]] const Eigen::VectorXd& residual() const noexcept { return residual_; }

 private:
  [[nodiscard]] bool seen(const Eigen::VectorXd& point) const;
  [[nodiscard]] bool bring_along(const Eigen::VectorXd& point) const;
  [[nodiscard]] bool difference(const Eigen::VectorXd& point) const;

  Residuals residuals_;
  std::vector<double> steps_;
  double most_missed_;
  // The last point asked about: Ceres tries a step and then asks for the Jacobian there.
  mutable Eigen::VectorXd tried_;
  mutable Eigen::VectorXd tried_residual_;
  mutable bool known_ = false;
  mutable Eigen::VectorXd point_;  // of the Jacobian
  mutable Eigen::VectorXd residual_;
  mutable Jacobian jacobian_;
};

// In rounds, each from a fresh Jacobian, until one gains less than ten times the tolerance. False,
// and why in `message`, where the search broke down.
[[nodiscard]] bool minimise(SecantCost& cost, const Search& search, Eigen::VectorXd& parameters,
                            std::string& message);

}  // namespace towbench::study::identify
