#include "study/diagnose/spectral_lines.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace towbench::harness::diagnose {
namespace {

constexpr std::size_t kMostFrequencies = 4800;  // half a resolution apart up to 65 s at 37 Hz

// |sum r exp(-2 pi i f x)|^2 at equally spaced f, by one rotation a sample and frequency.
std::vector<double> powers(const Eigen::VectorXd& x, const Eigen::VectorXd& r, double lowest,
                           double spacing, std::size_t count) {
  constexpr double kTurn = 2 * std::numbers::pi;
  std::vector<std::complex<double>> sums(count);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    std::complex<double> z = std::polar(r[i], -kTurn * lowest * x[i]);
    const std::complex<double> turn = std::polar(1.0, -kTurn * spacing * x[i]);
    for (std::size_t k = 0; k < count; ++k) {
      sums[k] += z;
      z = {z.real() * turn.real() - z.imag() * turn.imag(),
           z.real() * turn.imag() + z.imag() * turn.real()};
    }
  }
  std::vector<double> out;
  out.reserve(count);
  for (const auto& sum : sums) {
    out.push_back(std::norm(sum));
  }
  return out;
}

}  // namespace

Lines find_lines(const Eigen::VectorXd& coordinate, const Eigen::VectorXd& residual, double lowest,
                 double highest, std::size_t wanted) {
  Lines lines;
  const double span = coordinate.maxCoeff() - coordinate.minCoeff();
  if (!(span > 0) || !(highest > lowest)) {
    return lines;
  }
  const double resolution = 1 / span;
  const double fine = 0.5 * resolution;
  lines.searched =
      std::min(kMostFrequencies, 1 + static_cast<std::size_t>((highest - lowest) / fine));
  const double spacing =
      (highest - lowest) / static_cast<double>(std::max<std::size_t>(1, lines.searched - 1));
  const std::vector<double> power = powers(coordinate, residual, lowest, spacing, lines.searched);
  std::vector<std::size_t> order(power.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    order[k] = k;
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return power[a] > power[b]; });
  for (const std::size_t k : order) {
    const double f = lowest + static_cast<double>(k) * spacing;
    const bool apart = std::all_of(lines.frequency.begin(), lines.frequency.end(),
                                   [&](double g) { return std::abs(f - g) > 1.5 * resolution; });
    if (apart) {
      lines.frequency.push_back(f);
    }
    if (lines.frequency.size() == wanted) {
      break;
    }
  }
  return lines;
}

}  // namespace towbench::harness::diagnose
