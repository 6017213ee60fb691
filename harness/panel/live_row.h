// One control tick for those who observe: what the controller said, and what its inputs held then.
// As small as it goes, because every cache line of it has to cross to another processor: of a
// machine of axes y and x the part before `further` alone is passed on.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "bbmc/device/eqep.h"
#include "bbmc/system/telemetry_row.h"
#include "core/axis.h"
#include "emulator/truth_row.h"
#include "harness/panel/last_edges.h"

namespace towbench::harness {

struct LiveAxis {
  double reference_m = 0;
  double velocity_m_per_s = 0;
  std::int64_t count = 0;
  float reference_velocity_m_per_s = 0;
  float duty_pct = 0;
  LastEdges last_edges;
  std::uint32_t edges = 0;
  std::uint8_t mode = 0;
};

struct alignas(64) LiveRow {
  [[nodiscard]] LiveAxis axis(core::Axis which) const noexcept {
    return core::is_planar(which)
               ? LiveAxis{.reference_m = reference_m[which],
                          .velocity_m_per_s = velocity_m_per_s[which],
                          .count = count[which],
                          .reference_velocity_m_per_s = reference_velocity_m_per_s[which],
                          .duty_pct = duty_pct[which],
                          .last_edges = last_edges[which],
                          .edges = edges[which],
                          .mode = mode[which]}
               : further[core::index_of(which) - core::kPlanarAxes.size()];
  }
  void set(core::Axis which, const LiveAxis& axis) noexcept {
    if (!core::is_planar(which)) {
      further[core::index_of(which) - core::kPlanarAxes.size()] = axis;
      return;
    }
    reference_m[which] = axis.reference_m;
    velocity_m_per_s[which] = axis.velocity_m_per_s;
    count[which] = axis.count;
    reference_velocity_m_per_s[which] = axis.reference_velocity_m_per_s;
    duty_pct[which] = axis.duty_pct;
    last_edges[which] = axis.last_edges;
    edges[which] = axis.edges;
    mode[which] = axis.mode;
  }

  core::Nanoseconds time_ns = 0;
  core::PerPlanarAxis<double> reference_m;
  core::PerPlanarAxis<double> velocity_m_per_s;
  core::PerPlanarAxis<std::int64_t> count;
  core::PerPlanarAxis<float> reference_velocity_m_per_s;
  core::PerPlanarAxis<float> duty_pct;
  core::PerPlanarAxis<LastEdges> last_edges;
  core::PerPlanarAxis<std::uint32_t> edges;
  core::PerPlanarAxis<float> force_N;  // of the force sensor, tank frame; meaningless without
  std::uint16_t fault = 0;
  core::PerPlanarAxis<std::uint8_t> mode;
  bool has_force = false;
  alignas(64) std::array<LiveAxis, core::kFurtherAxes.size()> further;
};

struct LiveTruthAxis {
  double carriage_m = 0;
  float carriage_speed_m_per_s = 0;
  float current_A = 0;
  float transmission_force_N = 0;
};

struct alignas(64) LiveTruth {
  core::Nanoseconds time_ns = 0;
  core::PerPlanarAxis<LiveTruthAxis> planar;
  protocol::InputLines input_lines = 0;
  alignas(64) std::array<LiveTruthAxis, core::kFurtherAxes.size()> further;

  [[nodiscard]] LiveTruthAxis& axis(core::Axis which) noexcept {
    return core::is_planar(which) ? planar[which]
                                  : further[core::index_of(which) - core::kPlanarAxes.size()];
  }
  [[nodiscard]] const LiveTruthAxis& axis(core::Axis which) const noexcept {
    return core::is_planar(which) ? planar[which]
                                  : further[core::index_of(which) - core::kPlanarAxes.size()];
  }
};
static_assert(std::is_trivially_copyable_v<LiveRow> && offsetof(LiveRow, further) == 128);
static_assert(std::is_trivially_copyable_v<LiveTruth> && offsetof(LiveTruth, further) == 64);

[[nodiscard]] inline LiveTruth live(const emulator::TruthRow& row) noexcept {
  LiveTruth truth;
  truth.time_ns = row.time_ns;
  for (const auto which : core::kAllAxes) {
    const auto& now = row.axes[which];
    truth.axis(which) = {.carriage_m = now.carriage_m,
                         .carriage_speed_m_per_s = static_cast<float>(now.carriage_speed_m_per_s),
                         .current_A = static_cast<float>(now.current_A),
                         .transmission_force_N = static_cast<float>(now.transmission_force_N)};
  }
  truth.input_lines = row.input_lines;
  return truth;
}

}  // namespace towbench::harness
