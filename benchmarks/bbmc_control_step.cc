// Time per control step of both axes: estimator, law, guards, data log; without devices and plant.
//
// The encoder follows the reference exactly, so the motion goes on for as long as it is measured.
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include <benchmark/benchmark.h>

#include "bbmc/system/configuration.h"
#include "bbmc/system/motion_control.h"
#include "bbmc/system/trajectory/harmonic.h"

namespace {

using namespace towbench;
using core::Axis;

class FollowedReference {
 public:
  FollowedReference() : log_rows_(bbmc::kDataLogRows), log_(log_rows_) {
    for (Axis axis : core::kPlanarAxes) {
      // An encoder without index whose axis stands under full torque would be a frozen one; told
      // of a load that large, the controller still judges it at every step.
      configuration_.axes[axis].plausibility.index_fitted = false;
      configuration_.axes[axis].plausibility.external_load_N = 1e9;
    }
    sample_.lines = static_cast<std::uint16_t>(bbmc::mask_of(bbmc::Line::kAmplifierReadyY) |
                                               bbmc::mask_of(bbmc::Line::kAmplifierReadyX));
    control_ = std::make_unique<bbmc::MotionControl>(configuration_, kPeriod_ns, log_);
    for (Axis axis : core::kPlanarAxes) {
      count_[axis] = count_at(axis, kStart_m);
      control_->axis(axis).declare_position(count_[axis]);
    }
  }

  // Both axes on a sinusoid of `amplitude_m`, for ever.
  bool move(double amplitude_m) {
    bbmc::MotionOrder order;
    order.kind = bbmc::MotionKind::kReference;
    for (Axis axis : core::kPlanarAxes) {
      const auto reference =
          bbmc::Harmonic::make({.start_m = kStart_m,
                                .amplitude_m = amplitude_m,
                                .phase = {.frequency_hz = 1.0 / 7.0, .turns = 1e6, .ramp_s = 1.0}});
      if (!reference) {
        return false;
      }
      order.driven[axis] = true;
      order.trajectory[axis] = *reference;
    }
    return control_->submit(order);
  }

  void exchange(bool tick_due) {
    sample_.time_ns += kPeriod_ns;
    sample_.tick_due = tick_due;
    sample_.tick_due_ns = sample_.time_ns;
    for (Axis axis : core::kPlanarAxes) {
      auto& encoder = sample_.encoder[axis];
      encoder.time_ns = sample_.time_ns;
      const auto position = static_cast<std::uint32_t>(count_[axis] - count_at(axis, kStart_m));
      encoder.edges += static_cast<std::uint32_t>(
          std::abs(static_cast<std::int32_t>(position - encoder.position)));
      encoder.position = position;
    }
    control_->exchange(sample_, edges_, command_);
    benchmark::DoNotOptimize(command_);
    bbmc::TelemetryRow row;
    while (control_->next_row(row)) {
      for (Axis axis : core::kPlanarAxes) {
        if (row.axes[axis].mode == bbmc::AxisMode::kPosition) {
          count_[axis] = count_at(axis, row.axes[axis].reference_m);
        }
      }
    }
    bbmc::SystemEvent event;
    while (control_->next_event(event)) {
    }
  }

  [[nodiscard]] bool faulted() const { return control_->status().fault != core::ErrorCode::kNone; }

 private:
  static constexpr double kStart_m = 0.3;
  static constexpr core::Nanoseconds kPeriod_ns = core::kNanosecondsPerMillisecond;

  [[nodiscard]] std::int64_t count_at(Axis axis, double position_m) const {
    return static_cast<std::int64_t>(
        std::floor(position_m * configuration_.axes[axis].counts_per_m()));
  }

  bbmc::Configuration configuration_;
  std::vector<bbmc::DataLogRow> log_rows_;
  bbmc::DataLog log_;
  std::unique_ptr<bbmc::MotionControl> control_;
  bbmc::LineEdgeQueue edges_;
  bbmc::DriveCommand command_;
  bbmc::ControlSample sample_;
  core::PerAxis<std::int64_t> count_;
};

void step(benchmark::State& state, double amplitude_m, bool tick_due) {
  FollowedReference bench;
  if (!bench.move(amplitude_m)) {
    state.SkipWithError("the motion was refused");
    return;
  }
  bench.exchange(true);
  for (auto _ : state) {
    bench.exchange(tick_due);
  }
  if (bench.faulted()) {
    state.SkipWithError("the controller latched a fault: nothing was measured");
  }
}

void control_step_holding(benchmark::State& state) {
  step(state, 1e-6, true);
}
void control_step_moving(benchmark::State& state) {
  step(state, 0.05, true);
}
// What stops the machine is served between control ticks too.
void guards_between_steps(benchmark::State& state) {
  step(state, 1e-6, false);
}
BENCHMARK(control_step_holding);
BENCHMARK(control_step_moving);
BENCHMARK(guards_between_steps);

}  // namespace
