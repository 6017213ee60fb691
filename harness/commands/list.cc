// towbench list: the experiments there are, the metrics that a budget may name, the signals and
// events of a requirement.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/metrics/metric.h"
#include "harness/requirements/run_signals.h"

namespace towbench::harness {
namespace {

struct ListOptions {
  bool metrics = false;
  bool signals = false;
  bool json = false;
};

// A table of six axes would say the same six times.
constexpr const char* kOfFurtherAxes = "z_, a_, b_ and c_: the same of each further axis";

int list_metrics(bool json) {
  auto array = nlohmann::json::array();
  for (const auto& metric : all_metrics()) {
    if (json) {
      array.push_back({{"name", metric.name}, {"unit", metric.unit}, {"meaning", metric.meaning}});
    } else if (core::is_planar(metric.axis)) {
      std::printf("%-36s %-5s %s\n", metric.name.c_str(), metric.unit.c_str(),
                  metric.meaning.c_str());
    }
  }
  std::printf("%s\n", json ? array.dump(2).c_str() : kOfFurtherAxes);
  return kExitPass;
}

int list_signals(bool json) {
  auto array = nlohmann::json::array();
  const auto tell = [&](const std::string& name, std::string_view unit, std::string_view meaning) {
    if (json) {
      array.push_back({{"name", name}, {"unit", unit}, {"meaning", meaning}});
    } else {
      std::printf("%-20s %-6s %s\n", name.c_str(), std::string(unit).c_str(),
                  std::string(meaning).c_str());
    }
  };
  for (const auto axis : core::kAllAxes) {
    for (const auto& signal : run_signals()) {
      if (!json && !core::is_planar(axis)) {
        continue;
      }
      tell(std::string(core::name_of(axis)) + '_' + std::string(signal.name), signal.unit,
           signal.meaning);
    }
  }
  tell("fault", "1", "number of the first latched fault; 0: none");
  for (const auto& event : run_event_names()) {
    if (json || core::is_planar(event.axis)) {
      tell(event.name, "event", event.meaning);
    }
  }
  std::printf("%s\n", json ? array.dump(2).c_str() : kOfFurtherAxes);
  return kExitPass;
}

int list_experiments(bool json) {
  auto array = nlohmann::json::array();
  int exit_code = kExitPass;
  for (const auto& [name, path] : named_experiments()) {
    try {
      const auto fixture = load_experiment(path);
      if (json) {
        array.push_back({{"name", fixture.experiment.name},
                         {"title", fixture.experiment.title},
                         {"file", path.string()}});
      } else {
        std::printf("%-28s %s\n", fixture.experiment.name.c_str(),
                    fixture.experiment.title.c_str());
      }
    } catch (const FixtureError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      exit_code = kExitBadInput;
    }
  }
  if (json) {
    std::printf("%s\n", array.dump(2).c_str());
  }
  return exit_code;
}

}  // namespace

void add_list(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ListOptions>();
  auto* verb =
      app.add_subcommand("list", "list the experiments, or what budgets and requirements may name");
  verb->add_flag("--metrics", options->metrics, "the metrics that a [[budget]] may name");
  verb->add_flag("--signals", options->signals,
                 "the signals and events that a [[requirement]] may name");
  verb->add_flag("--json", options->json, "print JSON");
  verb->footer("Example: towbench list --metrics");
  verb->callback([options, &exit_code] {
    exit_code = options->metrics   ? list_metrics(options->json)
                : options->signals ? list_signals(options->json)
                                   : list_experiments(options->json);
  });
}

}  // namespace towbench::harness
