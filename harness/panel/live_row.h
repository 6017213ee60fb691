// One control tick for those who observe: what the controller said, and what its inputs held then.
// As small as it goes, because every cache line of it has to cross to another processor.
#pragma once

#include <cstdint>
#include <type_traits>

#include "bbmc/device/eqep.h"
#include "bbmc/system/telemetry_row.h"
#include "core/axis.h"
#include "emulator/truth_row.h"
#include "harness/panel/last_edges.h"

namespace towbench::harness {

struct alignas(64) LiveRow {
  core::Nanoseconds time_ns = 0;
  core::PerAxis<double> reference_m;
  core::PerAxis<double> velocity_m_per_s;
  core::PerAxis<std::int64_t> count;
  core::PerAxis<float> reference_velocity_m_per_s;
  core::PerAxis<float> duty_pct;
  core::PerAxis<LastEdges> last_edges;
  core::PerAxis<std::uint32_t> edges;
  core::PerAxis<float> force_N;  // of the force sensor, tank frame; meaningless without
  std::uint16_t fault = 0;
  core::PerAxis<std::uint8_t> mode;
  bool has_force = false;
};

struct alignas(64) LiveTruth {
  core::Nanoseconds time_ns = 0;
  core::PerAxis<double> carriage_m;
  core::PerAxis<float> carriage_speed_m_per_s;
  core::PerAxis<float> current_A;
  core::PerAxis<float> chain_force_N;
  std::uint16_t input_lines = 0;
};
static_assert(std::is_trivially_copyable_v<LiveRow> && sizeof(LiveRow) == 128);
static_assert(std::is_trivially_copyable_v<LiveTruth> && sizeof(LiveTruth) == 64);

[[nodiscard]] inline LiveTruth live(const emulator::TruthRow& row) noexcept {
  LiveTruth truth;
  truth.time_ns = row.time_ns;
  for (const auto axis : core::kAxes) {
    const auto& now = row.axes[axis];
    truth.carriage_m[axis] = now.carriage_m;
    truth.carriage_speed_m_per_s[axis] = static_cast<float>(now.carriage_speed_m_per_s);
    truth.current_A[axis] = static_cast<float>(now.current_A);
    truth.chain_force_N[axis] = static_cast<float>(now.chain_force_N);
  }
  truth.input_lines = row.input_lines;
  return truth;
}

}  // namespace towbench::harness
