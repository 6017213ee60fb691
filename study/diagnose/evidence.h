// The fit of a structure (nominal columns and accepted effects) and the residual it leaves,
// corrected by the simulated reference.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "study/diagnose/effect.h"
#include "study/diagnose/simulated_reference.h"

namespace towbench::harness::diagnose {

// An effect with its scales fixed: a term of the model.
struct Term {
  const Effect* effect = nullptr;
  Scales scales;
};

struct Evidence {
  Eigen::VectorXd y;
  Eigen::MatrixXd x;       // base columns, then the terms' columns
  Eigen::VectorXd fitted;  // coefficients of x by least squares: what predicts best
  Eigen::VectorXd
      coefficients;  // the same corrected by the simulated reference: nearest to the truth
  Eigen::MatrixXd covariance;  // HAC, of the coefficients
  Eigen::MatrixXd basis;       // orthonormal, of x
  Eigen::VectorXd residual;    // y - x coefficients
  Eigen::VectorXd corrected;   // minus the same of the simulated reference
  double force_rms_N = 0;      // of what the command made
  double reference_rms_N = 0;  // what processing and quantisation alone leave
  std::vector<Eigen::Index> starts;
  ControlLaw::Kind law = ControlLaw::Kind::kTracking;

  [[nodiscard]] Theta theta() const { return coefficients.head<kBaseColumns>(); }
};

[[nodiscard]] Eigen::MatrixXd design_matrix(const Dataset& data, const Context& context,
                                            const std::vector<Term>& terms);
[[nodiscard]] Eigen::MatrixXd raw_columns(const Signals& signals, const Context& context,
                                          const std::vector<Term>& terms);
// What the terms say of the chain itself. `coefficients`: base columns first.
[[nodiscard]] ChainShift chain_shift(const std::vector<Term>& terms,
                                     const Eigen::VectorXd& coefficients);
// The machine that the terms describe, its chain included.
[[nodiscard]] Baseline machine_with(const Baseline& baseline, const std::vector<Term>& terms,
                                    const Eigen::VectorXd& coefficients);
// What the other terms take along a motion, where they act.
[[nodiscard]] ExtraForce extra_force(const Signals& signals, const Context& context,
                                     const std::vector<Term>& terms,
                                     const Eigen::VectorXd& coefficients);

// `rounds` = 0: plain least squares, no simulated reference. Laws: one a member.
[[nodiscard]] Evidence fit_bias_corrected(const Dataset& data, const Context& context,
                                          const std::vector<Term>& terms,
                                          const std::vector<ControlLaw>& laws, int rounds,
                                          std::uint64_t seed);

}  // namespace towbench::harness::diagnose
