// An encoder whose motion is known, read by the real decoder and turned into speed by the real
// estimator: what each estimator is worth against truth.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "bbmc/host/quadrature_decoder.h"
#include "bbmc/system/position_counter.h"
#include "bbmc/system/velocity_estimator.h"
#include "core/check.h"

namespace towbench::tests {

using bbmc::Eqep;
using bbmc::PositionCounter;
using bbmc::QuadratureDecoder;
using bbmc::VelocityEstimator;
using bbmc::VelocityMethod;
using protocol::EncoderEdge;
using protocol::EncoderEdges;
using protocol::EncoderLine;

// Feeds a decoder with the edges of position(t) in counts, monotonic within a sample.
class EncoderBench {
 public:
  EncoderBench(VelocityMethod method, double rate_Hz, double timeout_s = 0.04)
      : estimator_({.method = method, .timeout_s = timeout_s}, rate_Hz),
        period_ns_(core::nanoseconds(1.0 / rate_Hz)) {}

  double sample(const std::function<double(double)>& position_counts) {
    EncoderEdges message;
    message.start_ns = now_ns_;
    message.end_ns = now_ns_ + period_ns_;
    message.start_levels = levels(count_);
    message.sequence = sequence_++;
    core::Nanoseconds last_ns = now_ns_;
    const auto end_count =
        static_cast<std::int64_t>(std::floor(position_counts(core::seconds(message.end_ns))));
    while (count_ != end_count) {
      const std::int64_t next = count_ + (end_count > count_ ? 1 : -1);
      const double threshold = static_cast<double>(std::max(next, count_));
      // Bisection for the crossing: independent of any closed form.
      double lo = core::seconds(last_ns);
      double hi = core::seconds(message.end_ns);
      const bool up = next > count_;
      for (int i = 0; i < 30; ++i) {
        const double mid = 0.5 * (lo + hi);
        ((position_counts(mid) >= threshold) == up ? hi : lo) = mid;
      }
      const core::Nanoseconds edge_ns = std::max(core::nanoseconds(hi), last_ns);
      const bool a_toggles = ((levels(next) ^ levels(count_)) & 1U) != 0;
      if (message.edges.full()) {
        message.end_ns = edge_ns;
        core::check(decoder_.take(message));
        message.start_ns = edge_ns;
        message.end_ns = now_ns_ + period_ns_;
        message.start_levels = levels(count_);
        message.sequence = sequence_++;
        message.edges.clear();
        last_ns = edge_ns;
      }
      core::check(
          message.edges.push_back(EncoderEdge(static_cast<std::uint32_t>(edge_ns - last_ns),
                                              a_toggles ? EncoderLine::kA : EncoderLine::kB)));
      last_ns = edge_ns;
      count_ = next;
    }
    core::check(decoder_.take(message));
    now_ns_ += period_ns_;
    const Eqep::Reading reading = decoder_.read();
    counter_.update(reading.position);
    return estimator_.update(reading, counter_.raw());
  }

  [[nodiscard]] const VelocityEstimator& estimator() const { return estimator_; }

 private:
  static std::uint8_t levels(std::int64_t count) {
    constexpr std::array<std::uint8_t, 4> kTable{0b00, 0b01, 0b11, 0b10};
    return kTable[static_cast<std::size_t>(((count % 4) + 4) % 4)];
  }

  QuadratureDecoder decoder_;
  PositionCounter counter_;
  VelocityEstimator estimator_;
  core::Nanoseconds period_ns_;
  core::Nanoseconds now_ns_ = 0;
  std::int64_t count_ = 0;
  std::uint32_t sequence_ = 0;
};

// Errors in counts/s over steady motion at speeds within 3 % of the one named, so that no single
// commensurable one decides.
struct VelocityError {
  double rms = 0;
  double largest = 0;
};

inline VelocityError velocity_error(VelocityMethod method, double speed, double rate_Hz,
                                    int speeds = 25) {
  VelocityError error;
  int n = 0;
  for (int i = 0; i < speeds; ++i) {
    EncoderBench bench(method, rate_Hz);
    const double v = speed * (0.97 + 0.06 * (i + 0.382) / speeds);
    for (int k = 0; k < 120; ++k) {
      const double off = bench.sample([v](double t) { return v * t + 0.3; }) - v;
      if (k >= 20) {
        error.rms += off * off;
        error.largest = std::max(error.largest, std::fabs(off));
        ++n;
      }
    }
  }
  error.rms = std::sqrt(error.rms / n);
  return error;
}

}  // namespace towbench::tests
