// Low-pass filters run forwards and backwards: no phase, squared magnitude.
//
// Every column of a regression must pass the same filter: then F y = F X theta has the theta of
// y = X theta (Gautier 1997; Janot, Gautier, Brunot 2019, the EMPS benchmark).
//
//   smooth  Butterworth, order 4:  |H|^2 = 1 / (1 + (f/fc)^8), twice: amplitude 1/2 at fc
//   sharp   Chebyshev type I, order 8, ripple 0.05 dB, twice: flat to 0.1 dB up to fc, then a
//   cliff;
//           what MATLAB's decimate() uses with fc = 0.4 of the new rate
//
// Bilinear transform with pre-warping. Ends are continued by odd reflection.
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace towbench::study::identify {

class ZeroPhaseFilter {
 public:
  // 0 < cutoff_Hz < rate_Hz / 2; anything else aborts.
  [[nodiscard]] static ZeroPhaseFilter smooth(double cutoff_Hz, double rate_Hz);
  [[nodiscard]] static ZeroPhaseFilter sharp(double cutoff_Hz, double rate_Hz);

  [[nodiscard]] Eigen::VectorXd apply(const Eigen::Ref<const Eigen::VectorXd>& x) const;
  // Samples from either end within which the reflection shows.
  [[nodiscard]] Eigen::Index border() const noexcept { return border_; }

 private:
  struct Section {
    double b0, b1, b2, a1, a2;
  };
  // Upper-half poles of the analogue prototype with cut-off 1 rad/s, and its gain at 0.
  ZeroPhaseFilter(const std::vector<std::complex<double>>& poles, double gain, double cutoff_Hz,
                  double rate_Hz);
  void run(Eigen::VectorXd& x) const;
  template <std::size_t kSections>
  void cascade(Eigen::VectorXd& x) const;

  std::vector<Section> sections_;
  Eigen::Index border_;
};

// dx/dt by central differences, one-sided at the ends; `period_s` between samples.
[[nodiscard]] Eigen::VectorXd central_difference(const Eigen::Ref<const Eigen::VectorXd>& x,
                                                 double period_s);

}  // namespace towbench::study::identify
