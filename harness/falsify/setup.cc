#include "harness/falsify/setup.h"

#include <algorithm>
#include <cmath>
#include <regex>

#include <fmt/format.h>

#include "harness/experiment/experiment_toml.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

constexpr const char* kRigFile = "rig.toml";

// `text` with the number behind `before` changed; as it is when there is none.
template <typename Change>
std::string with_number(const std::string& text, const std::string& before, Change change) {
  const std::regex pattern("(" + before + R"(\s+)([-+0-9.eE]+))");
  std::smatch found;
  if (!std::regex_search(text, found, pattern)) {
    return text;
  }
  return found.prefix().str() + found[1].str() +
         fmt::format("{:.9g}", change(std::stod(found[2].str()))) + found.suffix().str();
}

void move_start(ExperimentFixture& made, const core::PerAxis<double>& offset_m) {
  for (const auto axis : core::kAllAxes) {
    made.rig.parameters.axes[axis].start_m += offset_m[axis];
    for (auto& step : made.experiment.console) {
      step.send = with_number(step.send, fmt::format("reset poscalib {}", core::name_of(axis)),
                              [&](double start_m) { return start_m + offset_m[axis]; });
    }
  }
}

void change_speed(Experiment& experiment, double factor) {
  const auto times = [factor](double speed) { return speed * factor; };
  for (auto& step : experiment.console) {
    step.send = with_number(step.send, "--speed", times);
    step.send = with_number(step.send, "--period", [&](double s) { return s / factor; });
  }
  for (auto& motion : experiment.reference) {
    motion.speed_m_per_s *= factor;
  }
}

void type(Experiment& experiment, const Setup& setup) {
  for (auto& step : experiment.console) {
    step.expect.clear();
  }
  experiment.operator_acts.push_back({.time_ns = core::nanoseconds(setup.typed_at_s),
                                      .kind = OperatorAct::Kind::kTyped,
                                      .text = setup.typed + '\r'});
  std::stable_sort(experiment.operator_acts.begin(), experiment.operator_acts.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
}

std::string path_or_none(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return file.empty() ? std::string() : path_from(file, folder);
}

}  // namespace

bool Setup::is_nominal() const noexcept {
  return !machine && speed == 1 && typed.empty() &&
         std::all_of(start_offset_m.begin(), start_offset_m.end(),
                     [](double offset_m) { return offset_m == 0; });
}

SetupSpace::SetupSpace(SetupRanges ranges, const core::PerAxis<bool>& exists, double end_s)
    : ranges_(std::move(ranges)), exists_(exists) {
  for (const auto axis : core::kAllAxes) {
    if (!exists[axis]) {
      continue;
    }
    if (ranges_.machine > 0) {
      for (const auto quantity : kUncertainQuantities) {
        variables_.push_back({.name = fmt::format("{} {}", core::name_of(axis), quantity),
                              .from = 1 - ranges_.machine,
                              .to = 1 + ranges_.machine});
      }
    }
    if (ranges_.start_m > 0) {
      variables_.push_back({.name = fmt::format("{} start_m", core::name_of(axis)),
                            .from = -ranges_.start_m,
                            .to = ranges_.start_m});
    }
  }
  if (ranges_.speed.first < ranges_.speed.second) {
    variables_.push_back({.name = "speed",
                          .from = ranges_.speed.first,
                          .to = ranges_.speed.second,
                          .logarithmic = true});
  }
  if (!ranges_.typed.empty()) {
    variables_.push_back({.name = "typed at_s", .to = end_s, .is_moment = true});
  }
}

Setup SetupSpace::at(std::span<const double> shares) const {
  Setup setup;
  std::size_t next = 0;
  const auto value = [&] {
    const double at = value_at(variables_[next], shares[next]);
    ++next;
    return at;
  };
  if (ranges_.machine > 0) {
    for (auto& factors : setup.machine.emplace()) {
      factors.fill(1);
    }
  }
  for (const auto axis : core::kAllAxes) {
    if (exists_[axis] && setup.machine) {
      std::generate((*setup.machine)[axis].begin(), (*setup.machine)[axis].end(), value);
    }
    if (exists_[axis] && ranges_.start_m > 0) {
      setup.start_offset_m[axis] = value();
    }
  }
  if (ranges_.speed.first < ranges_.speed.second) {
    setup.speed = value();
  }
  if (!ranges_.typed.empty()) {
    setup.typed = ranges_.typed;
    setup.typed_at_s = value();
  }
  return setup;
}

std::vector<std::string> describe(const Setup& setup) {
  std::vector<std::string> phrases;
  for (const auto axis : core::kAllAxes) {
    const auto name = core::name_of(axis);
    for (std::size_t i = 0; setup.machine && i < kUncertainQuantities.size(); ++i) {
      const double factor = (*setup.machine)[axis][i];
      if (factor != 1) {
        phrases.push_back(fmt::format("{} {} x {:.4g}", name, kUncertainQuantities[i], factor));
      }
    }
    if (setup.start_offset_m[axis] != 0) {
      phrases.push_back(fmt::format("{} starts at {:+.4g} m", name, setup.start_offset_m[axis]));
    }
  }
  if (setup.speed != 1) {
    phrases.push_back(fmt::format("speed x {:.4g}", setup.speed));
  }
  if (!setup.typed.empty()) {
    phrases.push_back(fmt::format("\"{}\" typed at {:.6g} s", setup.typed, setup.typed_at_s));
  }
  return phrases;
}

ExperimentFixture in_setup(const ExperimentFixture& fixture, const Setup& setup,
                           const std::filesystem::path& folder) {
  auto made = fixture;
  move_start(made, setup.start_offset_m);
  change_speed(made.experiment, setup.speed);
  if (!setup.typed.empty()) {
    type(made.experiment, setup);
  }
  auto rig = path_from(fixture.rig_file, folder);
  if (setup.machine) {
    rig = kRigFile;
    write_atomically(folder / rig, changed_machine(fixture.rig_file, fixture.rig.parameters,
                                                   *setup.machine, "chosen by a search", folder));
  }
  const auto file = folder / (fixture.experiment.name + ".toml");
  write_atomically(file, to_toml(made, rig, path_or_none(fixture.controller_file, folder),
                                 path_or_none(wiring_file(fixture.file), folder)));
  return load_experiment(file);
}

}  // namespace towbench::harness
