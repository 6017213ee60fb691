#include "harness/experiment/experiment_fixture.h"

#include <algorithm>

#include "core/time.h"
#include "harness/experiment/board_plan_text.h"
#include "harness/experiment/board_wiring_text.h"
#include "harness/experiment/event_text.h"
#include "harness/experiment/reference_table.h"
#include "harness/experiment/reference_text.h"
#include "harness/experiment/requirement_text.h"
#include "harness/experiment/start_text.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/canonical_hash.h"
#include "harness/metrics/metric.h"

namespace towbench::harness {
namespace {

ConsoleStep read_console_step(TableReader& reader) {
  ConsoleStep step;
  double at_s = 0;
  reader.value("at_s", at_s, core::between(0, kLongestRun_s), "time before which nothing is typed");
  if (reader.has("at_s")) {
    step.at_s = at_s;
  }
  reader.text("send", step.send, "what is typed, without the end of line");
  // The script's check looks for one answer: that of a second line would go unheard.
  if (step.send.find_first_of("\r\n") != std::string::npos) {
    throw FixtureError(reader.place_of("send"), "text with an end of line",
                       "one line; a [[console]] step for each");
  }
  reader.text("expect", step.expect, "part of what the console must answer");
  std::size_t wait = 0;
  reader.choice("wait", wait, {"none", "idle"});
  step.wait_idle = wait == 1;
  reader.value("wait_s", step.wait_s, core::between(0, kLongestRun_s), "pause after the step");
  reader.value("timeout_s", step.timeout_s, core::between(1e-3, kLongestRun_s),
               "longest time for expect and wait");
  reader.finish();
  return step;
}

OperatorAct read_operator_act(TableReader& reader) {
  OperatorAct act;
  reader.value("at_ns", act.time_ns, core::between(0, kLongestRun_s * 1e9), "when it was done");
  std::size_t kind = 0;
  reader.choice("did", kind, {std::begin(kOperatorActNames), std::end(kOperatorActNames)});
  act.kind = static_cast<OperatorAct::Kind>(kind);
  reader.text("text", act.text, "what was typed, broken, changed or done to the clock");
  reader.require("at_ns");
  reader.require("did");
  reader.finish();
  return act;
}

EvaluationWindow read_window(TableReader& reader) {
  EvaluationWindow window;
  reader.text("name", window.name, "how budgets call the window");
  std::size_t origin = 0;
  reader.choice("relative_to", origin, {"run", "motion"});
  window.origin = static_cast<EvaluationWindow::Origin>(origin);
  reader.value("from_s", window.from_s, core::between(0, kLongestRun_s), "start");
  reader.value("to_s", window.to_s, core::between(0, kLongestRun_s), "end");
  for (const char* key : {"name", "from_s", "to_s"}) {
    reader.require(key);
  }
  reader.finish();
  if (!(window.to_s > window.from_s)) {
    throw FixtureError(reader.place_of("to_s"), std::to_string(window.to_s), "a time after from_s");
  }
  return window;
}

// Budgets name their window: of two with one name the second would be used by none.
void add_window(TableReader& reader, std::vector<EvaluationWindow>& windows) {
  auto added = read_window(reader);
  if (std::any_of(windows.begin(), windows.end(),
                  [&](const EvaluationWindow& other) { return other.name == added.name; })) {
    throw FixtureError(reader.place_of("name"), '"' + added.name + '"',
                       "a name that no other window has; \"whole\" is the whole run");
  }
  windows.push_back(std::move(added));
}

Budget read_budget(TableReader& reader, const std::vector<EvaluationWindow>& windows) {
  Budget budget;
  reader.text("metric", budget.metric, "name of a metric");
  reader.text("window", budget.window, "name of a window");
  reader.text("source", budget.source, "where the figure comes from");
  double min = 0;
  double max = 0;
  reader.value("min", min, core::any_finite(), "smallest value allowed");
  reader.value("max", max, core::any_finite(), "largest value allowed");
  reader.require("metric");
  reader.finish();
  if (reader.has("min")) {
    budget.min = min;
  }
  if (reader.has("max")) {
    budget.max = max;
  }
  if (!budget.min && !budget.max) {
    throw FixtureError(reader.place_of("metric"), "a budget without limits", "min, max or both");
  }
  if (budget.min && budget.max && *budget.min > *budget.max) {
    throw FixtureError(reader.place_of("min"), "min above max", "min <= max");
  }
  if (find_metric(budget.metric) == nullptr) {
    throw FixtureError(reader.place_of("metric"), '"' + budget.metric + '"',
                       suggest_metric(budget.metric));
  }
  const bool window_exists = std::any_of(windows.begin(), windows.end(), [&](const auto& window) {
    return window.name == budget.window;
  });
  if (!window_exists) {
    throw FixtureError(reader.place_of("window"), '"' + budget.window + '"',
                       "\"whole\" or the name of a [[window]] of this file");
  }
  return budget;
}

Experiment read_script(TableReader& reader) {
  Experiment experiment;
  reader.text("name", experiment.name, "short name, part of the folder's name");
  reader.text("title", experiment.title, "one line for a person");
  reader.text("description", experiment.description, "what it shows, and why");
  reader.value("duration_limit_s", experiment.duration_limit_s, core::between(1e-3, kLongestRun_s),
               "virtual time at which the run ends in any case");
  reader.value("seed", experiment.seed, core::between(0, 9e15), "of every random quantity");
  reader.value("logger_rate_Hz", experiment.logger_rate_Hz, core::between(1.0, 10e3),
               "of logger.csv: what a data logger beside the controller keeps of log.csv");
  for (auto& step : reader.tables("console")) {
    experiment.console.push_back(read_console_step(step));
  }
  experiment.reference = read_reference(reader);
  if (!experiment.reference.empty() && !experiment.console.empty()) {
    throw FixtureError(reader.place_of("reference"), "beside [[console]]",
                       "one of them: BBMC's console, or a reference for any controller");
  }
  experiment.events = read_events(reader, !experiment.reference.empty());
  const auto read_whether_budgets_apply = [&](TableReader& fault) {
    bool apply = true;
    fault.value("budgets_apply", apply, core::Range{},
                "false of a fault of the command line: what it does to the budgets is not judged");
    experiment.budgets_apply = experiment.budgets_apply && apply;
  };
  for (auto& fault : reader.tables("fault")) {
    read_whether_budgets_apply(fault);
    experiment.faults.push_back(read_fault(fault));
  }
  for (auto& fault : reader.tables("board_fault")) {
    read_whether_budgets_apply(fault);
    experiment.board.faults.push_back(read_board_fault(fault));
  }
  for (auto& budget : reader.tables("board_budget")) {
    experiment.board.budgets.push_back(read_board_budget(budget));
  }
  for (auto& act : reader.tables("operator")) {
    experiment.operator_acts.push_back(read_operator_act(act));
    experiment.budgets_apply =
        experiment.budgets_apply && !experiment.operator_acts.back().disturbs();
  }
  std::stable_sort(experiment.operator_acts.begin(), experiment.operator_acts.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  experiment.windows.emplace_back();
  for (auto& window : reader.tables("window")) {
    add_window(window, experiment.windows);
  }
  for (auto& budget : reader.tables("budget")) {
    experiment.budgets.push_back(read_budget(budget, experiment.windows));
  }
  experiment.requirements = read_requirements(reader, experiment.windows);
  return experiment;
}

void check_axes_agree(const ExperimentFixture& fixture) {
  for (const auto further : core::kFurtherAxes) {
    if (fixture.rig.parameters.axes[further].exists) {
      throw FixtureError(
          {fixture.rig_file.string(), 0, "axis." + std::string(core::name_of(further))},
          "an axis beside BBMC, which serves y and x",
          "another controller: a [[reference]] instead of a console's script");
    }
  }
  for (const auto which : core::kPlanarAxes) {
    const bool in_rig = fixture.rig.parameters.axes[which].exists;
    const bool in_controller = fixture.controller.configuration.axes[which].exists;
    if (in_rig != in_controller) {
      throw FixtureError({fixture.controller_file.string(), 0,
                          "axis." + std::string(core::name_of(which)) + ".exists"},
                         in_controller ? "true" : "false",
                         std::string(in_rig ? "true" : "false") + ", as the rig " +
                             fixture.rig_file.string() + " has it");
    }
  }
}

void refuse_motion(const ExperimentFixture& fixture, const char* key, const std::string& given) {
  throw FixtureError({fixture.file.string(), 0, key}, given,
                     "an axis that the rig " + fixture.rig_file.string() + " has");
}

void check_pushes(const ExperimentFixture& fixture) {
  for (const auto& event : fixture.experiment.events) {
    if (event.kind == emulator::ScheduledEventKind::kPushCarriage &&
        !fixture.rig.parameters.axes[event.axis].exists) {
      refuse_motion(fixture, "event", "a push on " + std::string(core::name_of(event.axis)));
    }
  }
}

void check_axes_move(const ExperimentFixture& fixture) {
  for (const auto axis : core::kAllAxes) {
    const auto& motions = fixture.experiment.reference;
    const bool moves = std::any_of(motions.begin(), motions.end(),
                                   [&](const auto& motion) { return motion.moves(axis); });
    if (moves && !fixture.rig.parameters.axes[axis].exists) {
      refuse_motion(fixture, "reference", "a motion of " + std::string(core::name_of(axis)));
    }
  }
}

// Tables are long, and what stands in their middle is easily overlooked.
void check_tables_fit(const ExperimentFixture& fixture) {
  for (const auto axis : core::kAllAxes) {
    const auto& rig = fixture.rig.parameters.axes[axis];
    double start_m = rig.start_m;
    for (const auto& motion : fixture.experiment.reference) {
      if (motion.table && motion.axis == axis) {
        motion.table->require_within(rig.plant.hard_ends.min_m - start_m,
                                     rig.plant.hard_ends.max_m - start_m);
      }
      start_m += motion.moves(axis) ? motion.at(axis, motion.duration_s()).position_m : 0;
    }
  }
}

void check_name(const TableReader& reader, const std::string& name) {
  const bool plain =
      !name.empty() && name.size() <= 60 && std::all_of(name.begin(), name.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
      });
  if (!plain) {
    throw FixtureError(reader.place_of("name"), '"' + name + '"',
                       "1 to 60 of a-z, 0-9 and - (it names the run folder)");
  }
}

}  // namespace

Experiment read_experiment(const FixtureFile& file) {
  TableReader reader(file, file.table());
  auto experiment = read_script(reader);
  for (const char* key : {"rig", "controller", "start", "wiring"}) {
    reader.permit(key);
  }
  for (const char* key : {"name", "rig", "duration_limit_s"}) {
    reader.require(key);
  }
  if (experiment.reference.empty()) {
    reader.require("controller");
  } else if (reader.has("controller")) {
    throw FixtureError(reader.place_of("controller"), "a key without effect",
                       "none beside [[reference]]: the controller is --controller's");
  }
  reader.finish();
  check_name(reader, experiment.name);
  return experiment;
}

std::filesystem::path wiring_file(const std::filesystem::path& experiment) {
  const auto file = FixtureFile::load(experiment);
  TableReader reader(file, file.table());
  std::string wiring;
  reader.text("wiring", wiring, "path of the wiring file");
  return wiring.empty() ? std::filesystem::path()
                        : std::filesystem::path(file.resolve(wiring, reader.place_of("wiring")));
}

ExperimentFixture load_experiment(const std::filesystem::path& path) {
  const auto file = FixtureFile::load(path);
  ExperimentFixture fixture;
  fixture.file = path;
  remember(fixture.sources, file);
  fixture.experiment = read_experiment(file);

  TableReader reader(file, file.table());
  std::string rig;
  std::string controller;
  reader.text("rig", rig, "path of the rig file");
  reader.text("controller", controller, "path of the controller file");
  fixture.rig_file = file.resolve(rig, reader.place_of("rig"));
  fixture.rig = load_rig(fixture.rig_file, fixture.sources);
  read_start(reader, fixture.rig);
  check_pushes(fixture);
  if (reader.has("wiring")) {
    std::string wiring;
    reader.text("wiring", wiring, "path of the wiring file");
    const auto wiring_file = FixtureFile::load(file.resolve(wiring, reader.place_of("wiring")));
    remember(fixture.sources, wiring_file);
    fixture.experiment.board.wiring = read_board_wiring(wiring_file);
    fixture.experiment.board.names_wiring = true;
  }
  if (fixture.experiment.reference.empty()) {
    fixture.controller_file = file.resolve(controller, reader.place_of("controller"));
    fixture.controller = load_controller(fixture.controller_file, fixture.sources);
    check_axes_agree(fixture);
  } else {
    read_reference_tables(reader, fixture.experiment.reference, fixture.sources);
    check_axes_move(fixture);
    check_units(reader, fixture.experiment.reference, fixture.rig.parameters.axes);
    check_tables_fit(fixture);
  }
  CanonicalHash hash;
  hash.add(file.text());
  fixture.hash = hash.value();
  return fixture;
}

}  // namespace towbench::harness
