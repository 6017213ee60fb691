#include "harness/falsify/shrink_case.h"

#include <cmath>
#include <utility>

namespace towbench::harness {
namespace {

constexpr double kSlack = 0.02;

class Shrinking {
 public:
  Shrinking(const SearchCase& found, const Outcome& outcome, Objective& objective)
      : shrunk_{.needed = found, .outcome = outcome},
        most_(*outcome.margin + kSlack * std::fabs(*outcome.margin)),
        objective_(objective) {}

  ShrunkCase run() {
    machine();
    for (const auto axis : core::kAllAxes) {
      if (shrunk_.needed.setup.start_offset_m[axis] != 0) {
        try_without([axis](SearchCase& one) { one.setup.start_offset_m[axis] = 0; });
      }
    }
    if (shrunk_.needed.setup.speed != 1) {
      try_without([](SearchCase& one) { one.setup.speed = 1; });
    }
    if (!shrunk_.needed.setup.typed.empty()) {
      try_without([](SearchCase& one) { one.setup.typed.clear(); });
    }
    for (auto i = shrunk_.needed.faults.size(); i > 0 && shrunk_.needed.faults.size() > 1; --i) {
      try_without([i](SearchCase& one) {
        one.faults.erase(one.faults.begin() + static_cast<std::ptrdiff_t>(i - 1));
      });
    }
    return std::move(shrunk_);
  }

 private:
  void machine() {
    if (!shrunk_.needed.setup.machine) {
      return;
    }
    try_without([](SearchCase& one) { one.setup.machine.reset(); });
    for (const auto axis : core::kAllAxes) {
      for (std::size_t i = 0; i < kUncertainQuantities.size() && shrunk_.needed.setup.machine;
           ++i) {
        if ((*shrunk_.needed.setup.machine)[axis][i] != 1) {
          try_without([axis, i](SearchCase& one) { (*one.setup.machine)[axis][i] = 1; });
        }
      }
    }
  }

  template <typename Change>
  void try_without(Change change) {
    auto smaller = shrunk_.needed;
    change(smaller);
    auto outcome = objective_.measure(smaller);
    ++shrunk_.runs;
    if (outcome.fired && outcome.margin && *outcome.margin <= most_ &&
        outcome.broken == shrunk_.outcome.broken) {
      shrunk_.needed = std::move(smaller);
      shrunk_.outcome = std::move(outcome);
    }
  }

  ShrunkCase shrunk_;
  double most_;
  Objective& objective_;
};

}  // namespace

ShrunkCase shrink(const SearchCase& found, const Outcome& outcome, Objective& objective) {
  return Shrinking(found, outcome, objective).run();
}

}  // namespace towbench::harness
