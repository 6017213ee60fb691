// Writes a run down in memory, as the columns that an estimator sees.
#pragma once

#include <optional>

#include "harness/link/plant_end.h"
#include "harness/lockstep/bench_recorder.h"
#include "protocol/tee_sink.h"
#include "study/identify/recording.h"

namespace towbench::study::procedures {

class MemoryRecorder final : public harness::BenchRecorder, public protocol::MessageSink {
 public:
  explicit MemoryRecorder(bool keeps_idle_rows) : keeps_idle_rows_(keeps_idle_rows) {}

  void drain(bbmc::ControllerNode& controller) noexcept override;
  void console(std::string_view text) noexcept override { recording_.console.append(text); }
  void wire_event(core::Nanoseconds /*time_ns*/, std::string_view /*kind*/) noexcept override {}
  void timing(core::Nanoseconds /*time_ns*/, core::Nanoseconds /*host_ns*/,
              core::Nanoseconds /*exchange_ns*/) noexcept override {}
  void flush() noexcept override {}
  [[nodiscard]] std::uint64_t rows() const noexcept override { return recording_.rows(); }
  [[nodiscard]] bool good() const noexcept override { return true; }

  using MessageSink::on;
  void on(const protocol::ForceSample& sample) noexcept override;
  void on(const protocol::CurrentSample& sample) noexcept override;

  // What was recorded; with the first latched fault as its trouble.
  [[nodiscard]] identify::Recording take();

 private:
  void keep(const bbmc::TelemetryRow& row);

  bool keeps_idle_rows_;
  identify::Recording recording_;
  core::ErrorCode fault_ = core::ErrorCode::kNone;
  bool has_force_ = false;
  core::PerPlanarAxis<bool> has_current_{};
  core::PerPlanarAxis<double> force_N_{};
  core::PerPlanarAxis<double> current_A_{};
};

// A plant whose sensors are also heard by the recorder: the controller has no use for them.
class SensorTap final : public harness::PlantEnd {
 public:
  // Both outlive this.
  SensorTap(harness::PlantEnd& plant, protocol::MessageSink& recorder)
      : plant_(plant), recorder_(recorder) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return plant_.sink(); }
  void connect(protocol::MessageSink& controller) noexcept override {
    tee_.emplace(recorder_, controller);
    plant_.connect(*tee_);
  }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    return plant_.wait_for(expected);
  }

 private:
  harness::PlantEnd& plant_;
  protocol::MessageSink& recorder_;
  std::optional<protocol::TeeSink> tee_;
};

}  // namespace towbench::study::procedures
