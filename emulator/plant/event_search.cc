#include "emulator/plant/event_search.h"

namespace towbench::emulator {

Crossing first_event(const AxisModel& model, const Situation& s, const TaylorFlow& flow) noexcept {
  struct Suspect {
    bool leaves = false;
    double last = 1.0;
  };
  constexpr std::size_t kMostMargins = 10;
  std::array<Suspect, kMostMargins> suspects{};
  bool any = false;
  for (const double fraction : {1.0, 0.5}) {
    std::size_t i = 0;
    visit_guards(model, s, flow.at(fraction), 1.0, [&](Event, double, double margin) {
      if (margin < 0) {
        suspects[i] = {.leaves = true, .last = fraction};
        any = true;
      }
      ++i;
    });
  }
  Crossing first;
  if (!any) {
    return first;
  }
  std::array<ScalarSeries, kMostMargins> series;
  for (int k = 0; k <= flow.terms(); ++k) {
    std::size_t i = 0;
    visit_guards(
        model, s, flow.coefficient(k), k == 0 ? 1.0 : 0.0,
        [&](Event, double, double margin) { series[i++][static_cast<std::size_t>(k)] = margin; });
  }
  std::size_t i = 0;
  visit_guards(model, s, flow.coefficient(0), 1.0, [&](Event event, double sign, double) {
    if (suspects[i].leaves) {
      const double fraction = first_crossing(series[i], flow.terms(), suspects[i].last);
      if (!first.found || fraction < first.fraction) {
        first = {.event = event, .sign = sign, .fraction = fraction, .found = true};
      }
    }
    ++i;
  });
  return first;
}

}  // namespace towbench::emulator
