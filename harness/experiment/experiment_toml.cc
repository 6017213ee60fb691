#include "harness/experiment/experiment_toml.h"

#include <limits>

#include <fmt/format.h>

#include "harness/experiment/board_plan_text.h"
#include "harness/experiment/event_text.h"
#include "harness/experiment/reference_text.h"
#include "harness/experiment/requirement_text.h"
#include "harness/experiment/start_text.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/toml_number.h"
#include "harness/fixtures/toml_string.h"

namespace towbench::harness {
namespace {

std::string console_toml(const ConsoleStep& step) {
  std::string text = "\n[[console]]\n";
  text += step.at_s ? "at_s = " + toml_number(*step.at_s) + '\n' : "";
  text += step.send.empty() ? "" : "send = " + toml_string(step.send) + '\n';
  text += step.expect.empty() ? "" : "expect = " + toml_string(step.expect) + '\n';
  text += step.wait_idle ? "wait = \"idle\"\n" : "";
  text += step.wait_s > 0 ? "wait_s = " + toml_number(step.wait_s) + '\n' : "";
  return text + "timeout_s = " + toml_number(step.timeout_s) + '\n';
}

std::string operator_act_toml(const OperatorAct& act) {
  return fmt::format("\n[[operator]]\nat_ns = {}\ndid = \"{}\"\ntext = {}\n", act.time_ns,
                     name_of(act.kind), toml_string(act.text));
}

std::string window_toml(const EvaluationWindow& window) {
  const bool run = window.origin == EvaluationWindow::Origin::kRun;
  return fmt::format("\n[[window]]\nname = {}\nrelative_to = \"{}\"\nfrom_s = {}\nto_s = {}\n",
                     toml_string(window.name), run ? "run" : "motion", toml_number(window.from_s),
                     toml_number(window.to_s));
}

std::string budget_toml(const Budget& budget) {
  auto text = fmt::format("\n[[budget]]\nmetric = {}\nwindow = {}\n", toml_string(budget.metric),
                          toml_string(budget.window));
  text += budget.min ? "min = " + toml_number(*budget.min) + '\n' : "";
  text += budget.max ? "max = " + toml_number(*budget.max) + '\n' : "";
  return text + (budget.source.empty() ? "" : "source = " + toml_string(budget.source) + '\n');
}

template <typename Parts, typename Write>
void append(std::string& text, const Parts& parts, Write write) {
  for (const auto& part : parts) {
    text += write(part);
  }
}

}  // namespace

std::string to_toml(const ExperimentFixture& fixture, const std::string& rig,
                    const std::string& controller, const std::string& wiring) {
  const auto& experiment = fixture.experiment;
  auto text = fmt::format(
      "schema = 1\nname = {}\ntitle = {}\ndescription = {}\nrig = {}\n{}"
      "duration_limit_s = {}\nseed = {}\n",
      toml_string(experiment.name), toml_string(experiment.title),
      toml_string(experiment.description), toml_string(rig),
      (controller.empty() ? "" : "controller = " + toml_string(controller) + '\n') +
          (wiring.empty() ? "" : "wiring = " + toml_string(wiring) + '\n'),
      toml_number(experiment.duration_limit_s), experiment.seed);
  if (experiment.logger_rate_Hz > 0) {
    text += fmt::format("logger_rate_Hz = {}\n", toml_number(experiment.logger_rate_Hz));
  }
  text += start_toml(fixture.rig.parameters);
  append(text, experiment.console, console_toml);
  append(text, experiment.reference, [](const ReferenceMotion& motion) { return to_toml(motion); });
  append(text, experiment.events,
         [](const emulator::ScheduledEvent& event) { return to_toml(event); });
  append(text, experiment.faults, [](const Fault& fault) { return to_toml(fault); });
  append(text, experiment.board.faults, [](const BoardFault& fault) { return to_toml(fault); });
  const bool has_faults = !experiment.faults.empty() || !experiment.board.faults.empty();
  text += has_faults && !experiment.budgets_apply ? kBudgetsDoNotApply : "";
  append(text, experiment.board.budgets, [](const BoardBudget& budget) { return to_toml(budget); });
  append(text, experiment.operator_acts, operator_act_toml);
  append(text, std::span(experiment.windows).subspan(1), window_toml);  // "whole" always exists
  append(text, experiment.budgets, budget_toml);
  append(text, experiment.requirements,
         [](const Requirement& requirement) { return to_toml(requirement); });
  return text;
}

std::string to_toml(const ExperimentFixture& fixture) {
  const auto file = FixtureFile::parse(fixture.sources.front().text, fixture.file);
  TableReader reader(file, file.table());
  std::string rig;
  std::string controller;
  reader.text("rig", rig, "path of the rig file");
  std::string wiring;
  reader.text("controller", controller, "path of the controller file");
  reader.text("wiring", wiring, "path of the wiring file");
  return to_toml(fixture, rig, controller, wiring);
}

}  // namespace towbench::harness
