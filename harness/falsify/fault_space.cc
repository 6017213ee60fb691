#include "harness/falsify/fault_space.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {
namespace {

constexpr double kShortest_s = 1e-3;
constexpr double kLastingShare = 0.2;
constexpr double kSteps_a_second = 1e6;  // in which times are told

// What happens once, or says itself how long it takes.
bool has_duration(FaultKind kind) noexcept {
  using enum FaultKind;
  constexpr std::array kMomentary{kBounce,      kReleased,    kWelded,         kJump,
                                  kSlip,        kToothSkip,   kLateTick,       kBusOff,
                                  kMissedTicks, kPeerRestart, kStoppedProcess, kPeerKilled};
  return std::find(kMomentary.begin(), kMomentary.end(), kind) == kMomentary.end();
}

bool is_whole(std::string_view key) noexcept {
  return key == "counts" || key == "bounces" || key == "ticks" || key == "messages" ||
         key == "level" || key == "reads_active";
}

double told(double time_s) {
  return std::round(time_s * kSteps_a_second) / kSteps_a_second;
}

}  // namespace

std::string FaultChoice::name() const {
  return fmt::format("{} {}", name_of(place), row_of(place.part, kind).name);
}

std::vector<FaultChoice> fault_choices(const std::vector<std::string>& words,
                                       const core::PerAxis<bool>& exists) {
  std::vector<FaultChoice> all;
  for (const auto& place_name : all_place_names()) {
    const auto place = *place_named(place_name);
    for (const auto& row : fault_catalogue()) {
      const bool fits = row.part == place.part && (!is_of_an_axis(row.part) || exists[place.axis]);
      if (fits && row.start == FaultStart::kAnyTime && row.needs == FaultNeeds::kNothing) {
        all.push_back({place, row.kind});
      }
    }
  }
  std::vector<FaultChoice> chosen;
  for (const auto& word : words) {
    const auto before = chosen.size();
    std::copy_if(all.begin(), all.end(), std::back_inserter(chosen), [&](const FaultChoice& one) {
      return word == one.name() || word == row_of(one.place.part, one.kind).name ||
             word == name_of(one.place);
    });
    if (chosen.size() == before) {
      throw FixtureError({.file = "command line", .key = "--faults"}, '"' + word + '"',
                         "kinds, places or \"PLACE KIND\" of docs/reference/faults.md that may "
                         "begin at any time, on an axis that the rig has");
    }
  }
  return words.empty() ? all : chosen;
}

FaultSpace::FaultSpace(std::vector<FaultChoice> faults, double end_s, SetupSpace setup,
                       const std::vector<std::vector<Stretch>>& phases)
    : faults_(std::move(faults)), setup_(std::move(setup)) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const std::string prefix = i == 0 ? "" : "second ";
    const auto& row = row_of(faults_[i].place.part, faults_[i].kind);
    variables_.push_back({.name = prefix + "at_s",
                          .to = end_s,
                          .is_moment = true,
                          .phases = i < phases.size() ? phases[i] : std::vector<Stretch>{}});
    if (has_duration(row.kind)) {
      variables_.push_back({.name = prefix + "duration_s",
                            .from = kShortest_s,
                            .to = std::max(2 * kShortest_s, end_s),
                            .logarithmic = true,
                            .may_last = true});
    }
    for (const auto& parameter : row.parameters) {
      if (!parameter.key.empty()) {
        variables_.push_back(
            {.name = prefix + std::string(parameter.key),
             .from = parameter.min,
             .to = parameter.max,
             .logarithmic = parameter.min > 0 && parameter.max >= 100 * parameter.min,
             .whole = is_whole(parameter.key)});
      }
    }
  }
  const auto& of_setup = setup_.variables();
  variables_.insert(variables_.end(), of_setup.begin(), of_setup.end());
}

std::vector<BoxSide> FaultSpace::sides() const {
  std::vector<BoxSide> sides;
  for (const auto& variable : variables_) {
    sides.push_back({.has_ends = !variable.is_moment, .stretches = variable.phases});
  }
  return sides;
}

FaultPlan FaultSpace::plan_at(const BoxPoint& point) const {
  FaultPlan plan;
  std::size_t next = 0;
  for (const auto& choice : faults_) {
    Fault fault;
    fault.place = choice.place;
    fault.kind = choice.kind;
    fault.trigger.value = told(value_at(variables_[next], point[next]));
    ++next;
    if (has_duration(choice.kind)) {
      const double share = point[next] / (1 - kLastingShare);
      if (share <= 1) {
        fault.duration_s = std::max(kShortest_s, told(value_at(variables_[next], share)));
      }
      ++next;
    }
    const auto& parameters = fault.row().parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (!parameters[k].key.empty()) {
        fault.parameters[k] = value_at(variables_[next], point[next]);
        ++next;
      }
    }
    plan.push_back(fault);
  }
  return plan;
}

SearchCase FaultSpace::case_at(const BoxPoint& point) const {
  return {plan_at(point), setup_.at(std::span(point).last(setup_.variables().size()))};
}

std::vector<std::string> SearchCase::words() const {
  std::vector<std::string> told;
  std::transform(faults.begin(), faults.end(), std::back_inserter(told),
                 [](const Fault& fault) { return harness::describe(fault); });
  const auto of_setup = describe(setup);
  told.insert(told.end(), of_setup.begin(), of_setup.end());
  return told;
}

std::string FaultSpace::name() const {
  std::string text = faults_.empty() ? "no fault" : "";
  for (const auto& fault : faults_) {
    text += (text.empty() ? "" : " and ") + fault.name();
  }
  return text;
}

}  // namespace towbench::harness
