#include "harness/external/external_timing.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/realtime/realtime_checks.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

double ms(core::Nanoseconds duration_ns) {
  return static_cast<double>(duration_ns) * 1e-6;
}

std::string text_of(const AnswerWatch& answers) {
  const auto& latency = answers.latency();
  constexpr double kHalf = 0.5;
  constexpr double kHundredth = 0.99;
  return fmt::format("controller: answers within p50 {:.2f}, p99 {:.2f}, max {:.2f} ms of {}\n",
                     ms(latency.percentile_ns(kHalf)), ms(latency.percentile_ns(kHundredth)),
                     ms(latency.max_ns()), latency.count());
}

}  // namespace

Check controller_on_time(const AnswerWatch& answers) {
  Check check;
  check.name = "controller_on_time";
  check.meaning = "the controller answers in time, which takes a host that serves it";
  check.unit = "s";
  check.value = core::seconds(answers.most_behind_ns());
  check.max = core::seconds(answers.limit_ns());
  check.verdict = Verdict::kPass;
  if (answers.latency().count() == 0 && answers.most_behind_ns() == 0) {
    check.verdict = Verdict::kInvalid;
    check.reason = "it has answered nothing";
  }
  if (answers.most_behind_ns() > answers.limit_ns()) {
    check.verdict = Verdict::kInvalid;
    check.reason = fmt::format(
        "what it was told at {:.4f} s was not answered after {:.1f} ms: the host was "
        "late, or the controller is too slow",
        core::seconds(answers.worst_ns()), ms(answers.most_behind_ns()));
  }
  return check;
}

std::string ExternalTiming::judge_into(const std::filesystem::path& folder,
                                       Judgement& judgement) const {
  const auto plant = plant_.summary();
  judgement.checks.push_back(host_on_time(plant));
  judgement.checks.push_back(controller_on_time(*answers_));
  judgement.verdict = worst_of(judgement.checks);
  const nlohmann::json controller = {{"answers", answers_->latency().count()},
                                     {"latency", to_json(figures_of(answers_->latency()))},
                                     {"latency_us_answers", bins_of(answers_->latency())},
                                     {"most_behind_ns", answers_->most_behind_ns()},
                                     {"worst_ns", answers_->worst_ns()}};
  const nlohmann::json both = {
      {"schema", 1}, {"emulator", to_json(plant, plant_.record())}, {"controller", controller}};
  write_atomically(folder / "realtime.json", both.dump(1) + "\n");
  return harness::text_of(plant) + text_of(*answers_);
}

}  // namespace towbench::harness
