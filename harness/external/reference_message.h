// A point of the reference on its way to a controller.
#pragma once

#include "harness/experiment/reference.h"
#include "protocol/messages.h"

namespace towbench::harness {

[[nodiscard]] inline protocol::Reference reference_message(const ReferenceSchedule& schedule,
                                                           core::Axis axis,
                                                           core::Nanoseconds time_ns) noexcept {
  const auto point = schedule.at(axis, time_ns);
  return {.axis = axis,
          .time_ns = time_ns,
          .position_m = static_cast<float>(point.position_m),
          .velocity_m_per_s = static_cast<float>(point.velocity_m_per_s),
          .acceleration_m_per_s2 = static_cast<float>(point.acceleration_m_per_s2)};
}

}  // namespace towbench::harness
