#include "harness/fault_cases/case_headline.h"

#include <vector>

#include <fmt/format.h>

namespace towbench::harness {
namespace {

constexpr double kMilli = 1e3;

std::string cause_of(const CaseFigures& figures) {
  switch (figures.fault) {
    case core::ErrorCode::kNone:
      return "went on: no fault was latched";
    case core::ErrorCode::kFaultKillSwitch:
      return "stopped by the kill switch";
    default:
      return fmt::format("stopped with fault {} ({})", core::number_of(figures.fault),
                         core::describe(figures.fault));
  }
}

}  // namespace

std::string headline_of(const CaseVerdict& verdict) {
  const auto& figures = verdict.figures;
  if (!verdict.fired) {
    return "the fault took no effect: nothing was judged";
  }
  std::vector<std::string> parts;
  const auto add_ms = [&](const char* what, const std::optional<double>& seconds) {
    if (seconds) {
      parts.push_back(fmt::format("{} {:.3g} ms", what, kMilli * *seconds));
    }
  };
  if (figures.kill_to_zero_duty_s) {
    add_ms("zero duty after", figures.kill_to_zero_duty_s);
  } else {
    add_ms("latched after", figures.to_fault_s);
    add_ms("zero drive after", figures.to_zero_drive_s);
  }
  if (figures.to_standstill_m) {
    parts.push_back(fmt::format("standstill after {:.3g} mm", kMilli * *figures.to_standstill_m));
  }
  if (figures.contact_speed_m_per_s > 0) {
    parts.push_back(
        fmt::format("hard end met at {:.3g} mm/s", kMilli * figures.contact_speed_m_per_s));
  }
  const auto cause = cause_of(figures);
  return parts.empty() ? cause : fmt::format("{}: {}", cause, fmt::join(parts, ", "));
}

}  // namespace towbench::harness
