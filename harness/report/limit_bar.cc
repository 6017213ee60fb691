#include "harness/report/limit_bar.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace towbench::harness::report {
namespace {

struct Scale {
  double from = 0;
  double to = 1;
  [[nodiscard]] double percent(double value) const { return (value - from) / (to - from) * 100; }
};

// A fifth of the allowed span stays visible beyond each limit. A one-sided limit spans from zero,
// or, where zero is on its wrong side, as much again as the limit itself.
Scale scale_for(const LimitBar& bar) {
  const double value = bar.value;
  double low = bar.min.value_or(0);
  double high = bar.max.value_or(0);
  if (!bar.min) {
    low = std::min({0.0, value, high > 0 ? 0.0 : 2 * high});
  } else if (!bar.max) {
    high = std::max({0.0, value, low > 0 ? 2 * low : 0.0});
  }
  if (high <= low) {
    high = low + (low == 0 ? 1 : std::fabs(low));
  }
  const double beyond = (high - low) / 5;
  return {bar.min ? low - beyond : low, bar.max ? high + beyond : high};
}

}  // namespace

std::string limit_bar(const LimitBar& bar) {
  if ((!bar.min && !bar.max) || !std::isfinite(bar.value)) {
    return {};
  }
  const Scale scale = scale_for(bar);
  const double from = bar.min ? scale.percent(*bar.min) : 0;
  const double to = bar.max ? scale.percent(*bar.max) : 100;
  const double at = scale.percent(bar.value);
  const char* off_scale = at < 0 ? " below" : at > 100 ? " above" : "";
  return fmt::format(
      "<span class=\"bar\" aria-hidden=\"true\">"
      "<i class=\"band{}{}\" style=\"left:{:.2f}%;width:{:.2f}%\"></i>"
      "<b class=\"mark{}\" style=\"left:{:.2f}%\"></b></span>",
      bar.min ? " has-min" : "", bar.max ? " has-max" : "", from, to - from, off_scale,
      std::clamp(at, 0.0, 100.0));
}

}  // namespace towbench::harness::report
