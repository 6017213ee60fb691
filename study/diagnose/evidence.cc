#include "study/diagnose/evidence.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index columns_of(const std::vector<Term>& terms) {
  Index columns = kBaseColumns;
  for (const Term& term : terms) {
    columns += static_cast<Index>(term.effect->coefficients.size());
  }
  return columns;
}

VectorXd least_squares(const MatrixXd& x, const VectorXd& y) {
  const VectorXd scale = x.colwise().norm().transpose().cwiseMax(1e-300);
  const MatrixXd scaled = x.array().rowwise() / scale.transpose().array();
  return scaled.colPivHouseholderQr().solve(y).cwiseQuotient(scale);
}

// A simulated reference's own noise adds to the log's; a correction that leaves more than both is
// none.
constexpr double kWorstCorrection = 1.6;

// One simulated reference's own noise would add as much again to what is tested: of the last round
// several, whose encoders lie otherwise under the start, leave a quarter of it (in power).
constexpr int kReferences = 4;
constexpr std::uint64_t kSeedsApart = 1'000'003;  // more than there are runs

double rms(const VectorXd& x) {
  return std::sqrt(x.squaredNorm() / static_cast<double>(std::max<Index>(1, x.size())));
}

struct Processed {
  VectorXd y;
  MatrixXd x;
  ControlLaw::Kind law = ControlLaw::Kind::kFitted;
};

// The simulated references of all runs, through the same filter and at the same rows as the data.
Processed process_references(const Dataset& data, const Context& context,
                             const std::vector<Term>& terms, const VectorXd& coefficients,
                             const std::vector<ControlLaw>& laws, std::uint64_t seed) {
  Processed out{VectorXd(data.rows()), MatrixXd(data.rows(), columns_of(terms))};
  const Baseline machine = machine_with(data.baseline, terms, coefficients);
  Index at = 0;
  for (std::size_t i = 0; i < data.members.size(); ++i) {
    const Dataset::Member& member = data.members[i];
    const ExtraForce extra = extra_force(member.signals, context, terms, coefficients);
    const Theta theta = coefficients.head<kBaseColumns>();
    const SimulatedReference reference =
        simulate_reference(member, theta, machine, extra, laws[i], seed + i);
    if (reference.law == ControlLaw::Kind::kTracking) {
      out.law = reference.law;
    }
    const Signals signals = make_signals(reference.run, data.conditioning, data.baseline);
    const Index rows = member.conditioner.rows();
    out.y.segment(at, rows) = member.conditioner.column(signals.input_N);
    out.x.middleRows(at, rows) = member.conditioner.columns(raw_columns(signals, context, terms));
    at += rows;
  }
  return out;
}

// What several simulated references at `coefficients` leave, and by how much they are fitted wrong,
// on average.
struct SimulatedReferences {
  VectorXd bias;
  VectorXd residual;
  double one_rms_N = 0;  // of a single one's residual
  ControlLaw::Kind law = ControlLaw::Kind::kFitted;
};

SimulatedReferences fit_references(int count, const Dataset& data, const Context& context,
                                   const std::vector<Term>& terms, const VectorXd& coefficients,
                                   const std::vector<ControlLaw>& laws, std::uint64_t seed) {
  SimulatedReferences out{VectorXd::Zero(coefficients.size()), VectorXd::Zero(data.rows())};
  for (int i = 0; i < count; ++i) {
    const Processed reference =
        process_references(data, context, terms, coefficients, laws,
                           seed + static_cast<std::uint64_t>(i) * kSeedsApart);
    const VectorXd residual = reference.y - reference.x * coefficients;
    out.bias += (least_squares(reference.x, reference.y) - coefficients) / count;
    out.residual += residual / count;
    out.one_rms_N = std::max(out.one_rms_N, rms(residual));
    out.law = reference.law == ControlLaw::Kind::kTracking ? reference.law : out.law;
  }
  return out;
}

MatrixXd hac_of_coefficients(const Evidence& e) {
  const VectorXd scale = e.x.colwise().norm().transpose().cwiseMax(1e-300);
  const MatrixXd scaled = e.x.array().rowwise() / scale.transpose().array();
  const MatrixXd gram = scaled.transpose() * scaled;
  const MatrixXd bread = gram.ldlt().solve(MatrixXd::Identity(gram.rows(), gram.cols()));
  const MatrixXd scores = scaled.array().colwise() * e.corrected.array();
  const MatrixXd v = bread * hac_covariance(scores, e.starts) * bread;
  return scale.cwiseInverse().asDiagonal() * v * scale.cwiseInverse().asDiagonal();
}

}  // namespace

MatrixXd raw_columns(const Signals& signals, const Context& context,
                     const std::vector<Term>& terms) {
  MatrixXd raw(signals.size(), columns_of(terms));
  raw.leftCols(kBaseColumns) = base_columns(signals);
  Index at = kBaseColumns;
  for (const Term& term : terms) {
    const auto count = static_cast<Index>(term.effect->coefficients.size());
    raw.middleCols(at, count) = effect_columns(*term.effect, signals, context, term.scales);
    at += count;
  }
  return raw;
}

ChainShift chain_shift(const std::vector<Term>& terms, const VectorXd& coefficients) {
  // A fit may ask for a chain that is none.
  constexpr double kLeast = -0.6;
  constexpr double kMost = 1.5;
  ChainShift shift = ChainShift::Zero();
  Index at = kBaseColumns;
  for (const Term& term : terms) {
    const auto count = static_cast<Index>(term.effect->coefficients.size());
    if (term.effect->chain_part >= 0) {
      shift.segment(term.effect->chain_part, count) = coefficients.segment(at, count);
    }
    at += count;
  }
  shift = shift.cwiseMax(kLeast).cwiseMin(kMost);
  shift[kPlay] = std::max(0.0, shift[kPlay]);
  return shift;
}

Baseline machine_with(const Baseline& baseline, const std::vector<Term>& terms,
                      const VectorXd& coefficients) {
  Baseline machine = baseline;
  machine.model.chain = shifted(machine.model.chain, chain_shift(terms, coefficients));
  return machine;
}

ExtraForce extra_force(const Signals& signals, const Context& context,
                       const std::vector<Term>& terms, const VectorXd& coefficients) {
  ExtraForce extra{VectorXd::Zero(signals.size()), VectorXd::Zero(signals.size())};
  Index at = kBaseColumns;
  for (const Term& term : terms) {
    const auto count = static_cast<Index>(term.effect->coefficients.size());
    if (term.effect->chain_part < 0) {
      const ActingColumns columns = acting_columns(*term.effect, signals, context, term.scales);
      extra.on_motor_N += columns.on_motor * coefficients.segment(at, count);
      extra.on_load_N += columns.on_load * coefficients.segment(at, count);
    }
    at += count;
  }
  return extra;
}

MatrixXd design_matrix(const Dataset& data, const Context& context,
                       const std::vector<Term>& terms) {
  return data.stack([&](const Signals& s) { return raw_columns(s, context, terms); });
}

Evidence fit_bias_corrected(const Dataset& data, const Context& context,
                            const std::vector<Term>& terms, const std::vector<ControlLaw>& laws,
                            int rounds, std::uint64_t seed) {
  Evidence e;
  e.starts = data.starts();
  e.y = data.stack([](const Signals& s) -> MatrixXd { return s.input_N; });
  e.x = design_matrix(data, context, terms);
  e.force_rms_N = rms(data.stack([](const Signals& s) -> MatrixXd { return s.force_N(); }));
  e.fitted = least_squares(e.x, e.y);
  const VectorXd& plain = e.fitted;
  const double left = rms(e.y - e.x * plain);
  e.coefficients = plain;
  VectorXd reference_residual = VectorXd::Zero(e.y.size());
  for (int round = 0; round < rounds; ++round) {
    const bool last = round + 1 == rounds;
    const SimulatedReferences references =
        fit_references(last ? kReferences : 1, data, context, terms, e.coefficients, laws, seed);
    e.law = references.law;
    if (references.law == ControlLaw::Kind::kTracking && references.one_rms_N > left) {
      // Noisier than the log itself: no simulated references of it.
      reference_residual.setZero();
      e.reference_rms_N = 0;
      e.coefficients = plain;
      break;
    }
    // theta <- theta + theta_hat(data) - theta_hat(simulated reference(theta))
    reference_residual = references.residual;
    e.reference_rms_N = references.one_rms_N;
    e.coefficients = plain - references.bias;
  }
  if (rms(e.y - e.x * e.coefficients) > kWorstCorrection * left) {
    // The columns are so alike that the simulated reference's noise moved the coefficients: the
    // plain fit stands.
    reference_residual.setZero();
    e.reference_rms_N = 0;
    e.coefficients = plain;
  }
  e.residual = e.y - e.x * e.coefficients;
  e.corrected = e.residual - reference_residual;
  e.basis = orthonormal(e.x);
  e.covariance = hac_of_coefficients(e);
  return e;
}

}  // namespace towbench::harness::diagnose
