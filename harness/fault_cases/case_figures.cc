#include "harness/fault_cases/case_figures.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness {
namespace {

constexpr double kStandstill_m_per_s = 1e-3;

double way_between(const CaseRecord& run, core::Nanoseconds from_ns, core::Nanoseconds to_ns) {
  const auto& from = run.truth_at(from_ns);
  double way_m = 0;
  for (const auto& row : run.truth) {
    if (row.time_ns < from_ns || row.time_ns > to_ns) {
      continue;
    }
    for (const auto axis : core::kAllAxes) {
      way_m = std::max(way_m, std::fabs(row.axes[axis].carriage_m - from.axes[axis].carriage_m));
    }
  }
  return way_m;
}

bool any_of(const core::PerAxis<bool>& axes) {
  return std::find(axes.begin(), axes.end(), true) != axes.end();
}

bool stands(const KeptTruth& row) {
  return std::all_of(core::kAllAxes.begin(), core::kAllAxes.end(), [&](core::Axis axis) {
    return std::fabs(row.axes[axis].carriage_speed_m_per_s) < kStandstill_m_per_s;
  });
}

}  // namespace

std::optional<core::Nanoseconds> drive_ends_ns(const CaseRecord& run, core::Nanoseconds from_ns,
                                               core::Nanoseconds until_ns) {
  core::PerAxis<bool> driven{};
  std::optional<core::Nanoseconds> ended;
  bool any = false;
  for (const auto& duty : run.duties) {
    if (duty.time_ns >= until_ns) {
      break;
    }
    const bool before = any_of(driven);
    driven[duty.axis] = duty.drives();
    const bool after = any_of(driven);
    if (duty.time_ns >= from_ns) {
      any = any || before || after;
      if (after) {
        ended.reset();
      } else if (before) {
        ended = duty.time_ns;
      }
    }
  }
  return any ? ended : std::nullopt;
}

CaseFigures figures_of(const CaseRecord& run, core::Nanoseconds cause_ns) {
  CaseFigures figures;
  figures.cause_ns = cause_ns;
  if (const auto* fault = run.first_fault(); fault != nullptr) {
    figures.fault = fault->code;
    figures.to_fault_s = core::seconds(fault->time_ns - cause_ns);
  }
  for (const auto& event : run.plant_events) {
    if (event.kind == emulator::PlantEventKind::kHardEndContact && event.time_ns >= cause_ns) {
      figures.contact_speed_m_per_s =
          std::max(figures.contact_speed_m_per_s, std::fabs(event.value));
    }
  }
  if (figures.fault == core::ErrorCode::kNone || run.truth.empty()) {
    return figures;
  }
  if (const auto zero_ns = drive_ends_ns(run, cause_ns, run.next_reset_ns(cause_ns)); zero_ns) {
    figures.to_zero_drive_s = core::seconds(*zero_ns - cause_ns);
    figures.to_zero_drive_m = way_between(run, cause_ns, *zero_ns);
  }
  if (stands(run.truth.back())) {
    const auto last_moving = std::find_if_not(run.truth.rbegin(), run.truth.rend(), stands);
    const auto still_ns =
        last_moving == run.truth.rend() ? cause_ns : std::max(cause_ns, last_moving->time_ns);
    figures.to_standstill_s = core::seconds(still_ns - cause_ns);
    figures.to_standstill_m = way_between(run, cause_ns, still_ns);
  }
  return figures;
}

}  // namespace towbench::harness
