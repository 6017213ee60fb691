// Straight tows: trapezoids there and back (8.3), smoothed over one period of the carriage on its
// transmission so that the steady part begins at rest.
#pragma once

#include <string>
#include <vector>

#include "core/bounded_vector.h"
#include "core/parameter.h"
#include "study/procedures/tow/tow_loads.h"

namespace towbench::study::procedures {

struct StraightTowSettings {
  core::BoundedVector<double, 32> speeds_m_per_s;
  double start_m = 0.450;   // of Y, near RUN_POSINIT_Y
  double distance_m = 2.2;  // 8.4.1
  double acceleration_s = 0.8;
  double smooth_s = 0.243;  // one period of 4.12 Hz, the carriage against a held motor
  double settle_s = 0.6;    // of the steady part, left out
  double start_x_m = 0.3368;

  StraightTowSettings() noexcept;
  explicit StraightTowSettings(std::initializer_list<double> speeds) noexcept;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.list("speeds_m_per_s", speeds_m_per_s, core::between(1e-3, 2.0), "of the steady parts");
    v.value("start_m", start_m, core::between(0.0, 10.0), "where a tow begins and ends");
    v.value("distance_m", distance_m, core::between(0.01, 10.0), "of each tow, towards max");
    v.value("acceleration_s", acceleration_s, core::between(0.01, 5.0), "from rest to speed");
    v.value("smooth_s", smooth_s, core::between(0.0, 2.0), "S-curve: averaged over this time");
    v.value("settle_s", settle_s, core::between(0.0, 10.0), "of each steady part, left out");
    v.value("start_x_m", start_x_m, core::between(0.0, 10.0), "where the X axis is held");
  }
};

// One conversation for a speed: there and back along Y, X held.
[[nodiscard]] Conversation there_and_back(const Machine& machine, const std::string& name,
                                          const StraightTowSettings& settings,
                                          double speed_m_per_s);

// Why those tows cannot be made, of all their speeds, or empty.
[[nodiscard]] std::string why_not(const Machine& machine, const StraightTowSettings& settings);

struct Tows {
  std::vector<identify::Recording> recordings;  // one a speed
  std::string trouble;                          // empty: all went well
};

[[nodiscard]] Tows tow(const Machine& machine, const std::string& name,
                       const StraightTowSettings& settings);

}  // namespace towbench::study::procedures
