// From the registers of one decoder to count, speed and what changed, once an exchange.
#pragma once

#include <cstdint>

#include "bbmc/device/eqep.h"
#include "bbmc/system/encoder_plausibility.h"
#include "bbmc/system/position_counter.h"
#include "bbmc/system/velocity_estimator.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class AxisObserver {
 public:
  AxisObserver(const AxisConfiguration& axis, double exchange_rate_Hz) noexcept
      : velocity_(axis.velocity, exchange_rate_Hz) {}

  TOWBENCH_REALTIME void observe(const Eqep::Reading& reading) noexcept {
    change_.counts = counter_.update(reading.position);
    change_.elapsed_s = core::seconds(reading.time_ns - change_.time_ns);
    change_.time_ns = reading.time_ns;
    change_.raw_count = counter_.raw();
    change_.edges = reading.edges - last_.edges;
    change_.edges_known = reading.edges_known;
    change_.illegal_transitions = reading.illegal_transitions - last_.illegal_transitions;
    change_.index_pulses = reading.index_pulses - last_.index_pulses;
    change_.index_raw_count = counter_.unwrap(reading.index_position);
    change_.speed_count_per_s = velocity_.update(reading, counter_.raw());
    last_ = reading;
  }

  [[nodiscard]] const EncoderChange& change() const noexcept { return change_; }
  [[nodiscard]] EncoderChange& change() noexcept { return change_; }
  [[nodiscard]] const Eqep::Reading& reading() const noexcept { return last_; }
  [[nodiscard]] std::int64_t count() const noexcept { return counter_.count(); }
  [[nodiscard]] std::int64_t raw_count() const noexcept { return counter_.raw(); }
  [[nodiscard]] double speed_count_per_s() const noexcept { return change_.speed_count_per_s; }
  void declare(std::int64_t count) noexcept { counter_.declare(count); }

 private:
  PositionCounter counter_;
  VelocityEstimator velocity_;
  EncoderChange change_;
  Eqep::Reading last_;
};

}  // namespace towbench::bbmc
