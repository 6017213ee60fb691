#include "harness/commands/machine_defaults.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "harness/fixtures/fixture_paths.h"
#include "harness/fixtures/rig_fixture.h"
#include "harness/new_machine/disagreement.h"

namespace towbench::harness {
namespace {

bool is_shipped(const std::filesystem::path& path) {
  try {
    const auto beyond = std::filesystem::relative(path, fixtures_directory());
    return !beyond.empty() && *beyond.begin() != "..";
  } catch (const FixtureError&) {
    return false;  // no fixtures/ here: nothing is the project's
  }
}

// Without the binary of a plant of one's own.
std::vector<std::filesystem::path> fixtures_of(const SourceFiles& sources) {
  std::vector<std::filesystem::path> paths;
  for (const auto& source : sources) {
    if (source.path.extension() == ".toml") {
      paths.push_back(source.path);
    }
  }
  return paths;
}

constexpr std::size_t kPageWidth = 120;

// Comma-separated, broken into lines.
std::string wrapped(const std::vector<UnstatedValue>& values) {
  std::string text;
  std::size_t column = kPageWidth;
  for (const auto& each : values) {
    if (!each.is_off) {
      continue;
    }
    const bool breaks = column + each.key.size() + 2 > kPageWidth;
    text += (text.empty() ? "" : ",") + std::string(breaks ? "\n    " : " ") + each.key;
    column = (breaks ? 4 : column + 2) + each.key.size();
  }
  return text;
}

void print_values(const std::string& file, const std::vector<UnstatedValue>& values) {
  if (values.empty()) {
    return;
  }
  std::printf("%s leaves to the defaults:\n", file.c_str());
  for (const auto& each : values) {
    if (!each.is_off) {
      std::printf("  %s\n",
                  fmt::format("{} = {}  # {}", each.key, each.value, each.meaning).c_str());
    }
  }
  if (const auto off = wrapped(values); !off.empty()) {
    std::printf("  0, false or empty:%s\n", off.c_str());
  }
}

}  // namespace

void MachineDefaults::of_rig(const std::filesystem::path& path) {
  SourceFiles sources;
  const auto rig = load_rig(path, sources);
  if (!is_shipped(path)) {
    const auto files = fixtures_of(sources);
    machines_[files.front()] = {unstated_values(rig.parameters, files), false, files};
  }
}

void MachineDefaults::of_plant(const std::filesystem::path& path) {
  SourceFiles sources;
  const auto plant = load_plant(path, sources);
  if (!is_shipped(path)) {
    const auto files = fixtures_of(sources);
    machines_[files.front()] = {unstated_values(plant.parameters, files), true, files};
  }
}

void MachineDefaults::of_experiment(const ExperimentFixture& fixture) {
  of_rig(fixture.rig_file);
  if (is_shipped(fixture.rig_file)) {
    return;
  }
  for (const auto& sentence :
       disagreements(fixture.rig.parameters, fixture.controller.configuration)) {
    differences_.insert(fmt::format("warning: {} and {}: {}", fixture.rig_file.filename().string(),
                                    fixture.controller_file.filename().string(), sentence));
  }
}

bool MachineDefaults::has_its_rig(const Machine& plant) const {
  return plant.is_plant && std::any_of(machines_.begin(), machines_.end(), [&](const auto& each) {
           const Machine& other = each.second;
           return !other.is_plant && std::find(other.files.begin(), other.files.end(),
                                               plant.files.front()) != other.files.end();
         });
}

void MachineDefaults::print() const {
  for (const auto& difference : differences_) {
    std::printf("%s\n", difference.c_str());
  }
  for (const auto& [path, machine] : machines_) {
    if (!has_its_rig(machine)) {
      print_values(path.filename().string(), machine.values);
    }
  }
}

}  // namespace towbench::harness
