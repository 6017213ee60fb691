// docs/measurements/velocity.md: the estimators of thesis 3.4.2 against truth, from 0.2 mm/s to
// beyond the top speed.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "tests/bbmc/figures/figures.h"
#include "tests/bbmc/support/encoder_bench.h"

namespace towbench::tests {
namespace {

constexpr double kRate_Hz = 1000.0;
constexpr double kYCountsPerM = 445'348.0;  // (3.42), R = 0.050 m
constexpr double kXCountsPerM = 742'247.0;  // R = 0.030 m
constexpr std::array kMethods{VelocityMethod::kFrequency, VelocityMethod::kPeriod,
                              VelocityMethod::kHybrid};

struct Point {
  double speed = 0;
  std::array<VelocityError, 3> error;
};

Point measure(double speed) {
  Point point{.speed = speed, .error = {}};
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    point.error[i] = velocity_error(kMethods[i], speed, kRate_Hz);
  }
  return point;
}

constexpr double kWidth = 720;
constexpr double kHeight = 420;
constexpr double kLeft = 70;
constexpr double kBottom = 50;
constexpr double kTop = 20;

double x_of(double speed) {
  return kLeft + (std::log10(speed) - 1.8) / (5.7 - 1.8) * (kWidth - kLeft - 20);
}
double y_of(double error) {
  const double decade = std::log10(std::max(error, 1e-3));
  return kHeight - kBottom - (decade + 3) / 8.0 * (kHeight - kBottom - kTop);
}

}  // namespace

void print_velocity_table() {
  fmt::print(
      "| speed, counts/s | on Y, mm/s | on X, mm/s | frequency, RMS | max | period, RMS | max | "
      "hybrid, RMS | max |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const double speed : {89.0, 148.0, 450.0, 2'200.0, 10'000.0, 20'000.0, 35'000.0, 39'500.0,
                             45'000.0, 89'000.0, 178'000.0, 254'000.0, 283'000.0, 390'000.0}) {
    const Point p = measure(speed);
    fmt::print("| {:.0f} | {:.2f} | {:.2f} |", speed, 1e3 * speed / kYCountsPerM,
               1e3 * speed / kXCountsPerM);
    for (const VelocityError& error : p.error) {
      fmt::print(" {:.3g} | {:.3g} |", error.rms, error.largest);
    }
    fmt::print("\n");
  }
}

void print_velocity_picture() {
  std::vector<Point> points;
  for (double speed = 80; speed < 400'000; speed *= 1.13) {
    points.push_back(measure(speed));
  }
  fmt::print(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" "
      "font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
      kWidth, kHeight);
  for (int decade = 2; decade <= 5; ++decade) {
    const double x = x_of(std::pow(10.0, decade));
    fmt::print(
        "<path d=\"M{0:.1f} {1}V{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\">1e{4}</text>\n",
        x, kTop, kHeight - kBottom, kHeight - kBottom + 18, decade);
  }
  for (int decade = -3; decade <= 5; ++decade) {
    const double y = y_of(std::pow(10.0, decade));
    fmt::print(
        "<path d=\"M{0} {1:.1f}H{2}\" stroke=\"#ddd\"/><text x=\"{3}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">1e{5}</text>\n",
        kLeft, y, kWidth - 20, kLeft - 6, y + 4, decade);
  }
  constexpr std::array<const char*, 3> kColours{"#c0392b", "#2471a3", "#111"};
  constexpr std::array<const char*, 3> kNames{"frequency (3.46)", "period (3.54)", "hybrid"};
  constexpr std::array<const char*, 3> kStyles{"2 0", "2 0", "5 4"};
  for (std::size_t method = 0; method < kMethods.size(); ++method) {
    std::string path;
    for (const Point& point : points) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x_of(point.speed),
                          y_of(point.error[method].rms));
    }
    fmt::print(
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
        "stroke-dasharray=\"{}\"/>\n<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n",
        path, kColours[method], kStyles[method], kLeft + 20,
        kTop + 20 + 18 * static_cast<double>(method), kColours[method], kNames[method]);
  }
  fmt::print(
      "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">speed, counts/s</text>\n"
      "<text transform=\"translate(16 {})rotate(-90)\" text-anchor=\"middle\">RMS error, "
      "counts/s</text>\n</svg>\n",
      kWidth / 2, kHeight - 10, kHeight / 2);
}

}  // namespace towbench::tests
