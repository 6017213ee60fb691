#include "study/identify/zero_phase_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/check.h"

namespace towbench::study::identify {
namespace {

constexpr double kChebyshevRippleDecibel = 0.05;

std::vector<std::complex<double>> butterworth_poles(int order) {
  std::vector<std::complex<double>> poles;
  for (int i = 0; i < order / 2; ++i) {
    const double angle = std::numbers::pi * (2.0 * i + 1.0) / (2.0 * order);
    poles.emplace_back(-std::sin(angle), std::cos(angle));
  }
  return poles;
}

}  // namespace

ZeroPhaseFilter ZeroPhaseFilter::smooth(double cutoff_Hz, double rate_Hz) {
  return {butterworth_poles(4), 1.0, cutoff_Hz, rate_Hz};
}

ZeroPhaseFilter ZeroPhaseFilter::sharp(double cutoff_Hz, double rate_Hz) {
  constexpr int kOrder = 8;
  const double ripple = std::sqrt(std::pow(10.0, kChebyshevRippleDecibel / 10.0) - 1.0);
  const double mu = std::asinh(1.0 / ripple) / kOrder;
  std::vector<std::complex<double>> poles;
  for (const auto& pole : butterworth_poles(kOrder)) {
    poles.emplace_back(std::sinh(mu) * pole.real(), std::cosh(mu) * pole.imag());
  }
  return {poles, 1.0 / std::sqrt(1.0 + ripple * ripple), cutoff_Hz, rate_Hz};  // even order
}

ZeroPhaseFilter::ZeroPhaseFilter(const std::vector<std::complex<double>>& poles, double gain,
                                 double cutoff_Hz, double rate_Hz)
    : border_(static_cast<Eigen::Index>(std::ceil(1.5 * rate_Hz / cutoff_Hz))) {
  core::check(cutoff_Hz > 0 && cutoff_Hz < rate_Hz / 2);
  const double k = std::tan(std::numbers::pi * cutoff_Hz / rate_Hz);  // pre-warped
  for (const auto& pole : poles) {
    // Pole pair s^2 + 2 d s + w^2 of the prototype, s = (1 - z^-1) / (k (1 + z^-1)).
    const double w2 = std::norm(pole) * k * k;
    const double d = -2.0 * pole.real() * k;
    const double norm = 1.0 / (1.0 + d + w2);
    sections_.push_back({.b0 = w2 * norm,
                         .b1 = 2.0 * w2 * norm,
                         .b2 = w2 * norm,
                         .a1 = 2.0 * (w2 - 1.0) * norm,
                         .a2 = (1.0 - d + w2) * norm});
  }
  sections_[0].b0 *= gain;
  sections_[0].b1 *= gain;
  sections_[0].b2 *= gain;
}

// Transposed direct form II, each section started in the steady state of its first sample. A sample
// passes all sections before the next one begins: a section waits for its own last output alone, so
// that the processor works at as many samples at once as there are sections.
template <std::size_t kSections>
void ZeroPhaseFilter::cascade(Eigen::VectorXd& x) const {
  std::array<Section, kSections> sections;
  std::array<double, kSections> z1;
  std::array<double, kSections> z2;
  double first = x[0];
  for (std::size_t i = 0; i < kSections; ++i) {
    const Section& s = sections[i] = sections_[i];
    const double settled = (s.b0 + s.b1 + s.b2) / (1.0 + s.a1 + s.a2) * first;
    z2[i] = s.b2 * first - s.a2 * settled;
    z1[i] = s.b1 * first - s.a1 * settled + z2[i];
    first = s.b0 * first + z1[i];
  }
  for (double& value : x) {
    double in = value;
    for (std::size_t i = 0; i < kSections; ++i) {
      const Section& s = sections[i];
      const double out = s.b0 * in + z1[i];
      z1[i] = s.b1 * in - s.a1 * out + z2[i];
      z2[i] = s.b2 * in - s.a2 * out;
      in = out;
    }
    value = in;
  }
}

void ZeroPhaseFilter::run(Eigen::VectorXd& x) const {
  constexpr std::size_t kSharp = 4;
  constexpr std::size_t kSmooth = 2;
  if (sections_.size() == kSharp) {
    cascade<kSharp>(x);
  } else {
    core::check(sections_.size() == kSmooth);
    cascade<kSmooth>(x);
  }
}

Eigen::VectorXd ZeroPhaseFilter::apply(const Eigen::Ref<const Eigen::VectorXd>& x) const {
  const Eigen::Index n = x.size();
  if (n < 2) {
    return x;
  }
  // Three times the order, as filtfilt of MATLAB and scipy has it: published figures depend on it.
  const auto order = static_cast<Eigen::Index>(2 * sections_.size());
  const Eigen::Index pad = std::min(n - 1, 3 * order);
  Eigen::VectorXd y(n + 2 * pad);
  y.segment(pad, n) = x;
  for (Eigen::Index i = 1; i <= pad; ++i) {
    y[pad - i] = 2 * x[0] - x[i];
    y[pad + n - 1 + i] = 2 * x[n - 1] - x[n - 1 - i];
  }
  run(y);
  y.reverseInPlace();
  run(y);
  y.reverseInPlace();
  return y.segment(pad, n);
}

Eigen::VectorXd central_difference(const Eigen::Ref<const Eigen::VectorXd>& x, double period_s) {
  const Eigen::Index n = x.size();
  Eigen::VectorXd d = Eigen::VectorXd::Zero(n);
  if (n < 3) {
    return d;
  }
  d.segment(1, n - 2) = (x.tail(n - 2) - x.head(n - 2)) / (2 * period_s);
  d[0] = (x[1] - x[0]) / period_s;
  d[n - 1] = (x[n - 1] - x[n - 2]) / period_s;
  return d;
}

}  // namespace towbench::study::identify
