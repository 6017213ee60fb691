#include "study/active/active_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "study/active/active_report.h"
#include "study/active/earlier_run.h"

namespace towbench::study::active {
namespace {

using diagnose::Diagnosis;
using End = Outcome::End;
using Means = Question::Means;

class Loop {
 public:
  Loop(const Request& request, const Hands& hands)
      : request_(request),
        hands_(hands),
        site_(find_site(request.data.front(), request.rig, request.axis)),
        data_(request.data),
        holdout_(request.holdout) {}

  Outcome run() {
    Diagnosis d = diagnosed();
    outcome_.first_answer = answer_of(d);
    while (true) {
      outcome_.answer = answer_of(d);
      const std::optional<Question> question = next_question(d);
      if (!question) {
        conclude(d);
        break;
      }
      if (static_cast<int>(outcome_.rounds.size()) >= request_.most_rounds) {
        end(End::kOutOfRounds,
            fmt::format("after {} rounds; --rounds allows more", request_.most_rounds));
        break;
      }
      if (!ask(*question)) {
        break;
      }
      d = diagnosed();
      outcome_.rounds.back().answer = answer_of(d);
      write_report(request_, outcome_);
    }
    write_report(request_, outcome_);
    return std::move(outcome_);
  }

 private:
  [[nodiscard]] Diagnosis diagnosed() const {
    return hands_.diagnose(data_, holdout_,
                           request_.out / fmt::format("round-{}", outcome_.rounds.size()), known_);
  }

  // What was weighed is a finding of its own, which the corrected model no longer shows.
  [[nodiscard]] std::string answer_of(const Diagnosis& d) const {
    const std::string rest = names_of(d);
    if (known_.of == Correction::Of::kNothing) {
      return rest;
    }
    const std::string found =
        known_.of == Correction::Of::kAmplifier ? kAmplifierGain : kAllByOneRatio;
    return rest == "nothing" ? found : found + ", " + rest;
  }

  [[nodiscard]] std::optional<Question> next_question(const Diagnosis& d) const {
    for (const Question& question : open_questions(d)) {
      const bool asked =
          std::any_of(outcome_.rounds.begin(), outcome_.rounds.end(), [&](const Round& round) {
            return round.asked == question.causes && round.motion == question.motion.words();
          });
      const bool weighed = question.means == Means::kKnownForce && weighed_;
      if (question.means != Means::kNone && !asked && !weighed) {
        return question;
      }
    }
    return std::nullopt;
  }

  // One cause is left, or a class that nothing separates: which, and why.
  void conclude(const Diagnosis& d) {
    for (const Question& question : open_questions(d)) {
      end(End::kNothingSeparates,
          fmt::format("{}: {}", joined(question.causes, " or "),
                      question.why.empty() ? "the experiment that should separate them was run and "
                                             "did not"
                                           : question.why));
      return;
    }
    const bool several = outcome_.answer.find(", ") != std::string::npos;
    end(End::kOneCause, outcome_.answer == "nothing" ? "nothing is named, so nothing is open"
                        : several
                            ? "they act together, and none of them has an alternative left that "
                              "explains these logs as well"
                            : "no other cause explains these logs as well");
  }

  void end(End how, std::string why) {
    outcome_.end = how;
    outcome_.why = std::move(why);
  }

  // False: a run failed or was stopped.
  bool ask(const Question& question) {
    Trial trial{.name = fmt::format("separate-{}", outcome_.rounds.size() + 1),
                .asks = joined(question.causes, " or "),
                .motion = question.motion};
    if (question.means == Means::kKnownForce) {
      trial.push = Push{.force_N = question.push_N};
    }
    const harness::ExperimentFixture fixture =
        write_trial(site_, trial, request_.out / "experiments");
    outcome_.rounds.push_back(
        {.asked = question.causes, .motion = question.motion.words(), .experiment = fixture.file});
    if (trial.push) {
      outcome_.rounds.back().motion += fmt::format(", pushed by {:.3g} N", trial.push->force_N);
    }
    hands_.tell(fmt::format("to tell {}: {}", trial.asks, outcome_.rounds.back().motion));
    write_report(request_, outcome_);
    return trial.push ? fit_bias_corrected(question, trial, fixture) : log_twice(fixture);
  }

  bool log_twice(const harness::ExperimentFixture& fixture) {
    for (const bool judged_on : {false, true}) {
      const auto folder = folder_of_run(fixture, judged_on ? 1 : 0);
      if (!folder) {
        return false;
      }
      (judged_on ? holdout_ : data_).push_back(folder->string());
    }
    return true;
  }

  bool fit_bias_corrected(const Question& question, const Trial& trial,
                          const harness::ExperimentFixture& fixture) {
    const auto folder = folder_of_run(fixture, 0);
    if (!folder) {
      return false;
    }
    weighed_ = true;
    const diagnose::Interval found = hands_.weigh_force(folder->string(), *trial.push);
    hands_.tell(
        fmt::format("the amplifier gives {:.4f} times less than stated (95 %: {:.4f} to "
                    "{:.4f}); {:.4f} would explain the logs",
                    found.value, found.low, found.high, question.ratio));
    const auto agrees = [&](double ratio) { return found.low < ratio && ratio < found.high; };
    if (agrees(question.ratio) != agrees(1)) {
      // The logs say how large the ratio is, the push says of what it is.
      known_ = {agrees(1) ? Correction::Of::kEverythingElse : Correction::Of::kAmplifier,
                question.ratio};
    }
    return true;
  }

  // The folder of a run to its end, from now or from an earlier start of the same command.
  std::optional<std::filesystem::path> folder_of_run(const harness::ExperimentFixture& fixture,
                                                     std::uint64_t repeat) {
    const auto runs = request_.out / "runs";
    const std::uint64_t seed = fixture.experiment.seed + repeat;
    auto folder = earlier_run(runs, fixture, seed);
    if (!folder) {
      const harness::RunResult result = hands_.run(fixture, runs, seed);
      if (!result.complete || result.exit_code != harness::kExitPass) {
        end(result.complete ? End::kRunFailed : End::kStopped,
            fmt::format("{}: {}", result.folder.string(),
                        result.complete ? "the experiment did not pass, see its report"
                                        : result.reason + "; the same command goes on from here"));
        outcome_.rounds.back().folders.push_back(result.folder);
        return std::nullopt;
      }
      folder = result.folder;
    }
    outcome_.rounds.back().folders.push_back(*folder);
    write_report(request_, outcome_);
    return folder;
  }

  const Request& request_;
  const Hands& hands_;
  Site site_;
  Logs data_;
  Logs holdout_;
  Correction known_;
  bool weighed_ = false;
  Outcome outcome_;
};

}  // namespace

Outcome diagnose_actively(const Request& request, const Hands& hands) {
  return Loop(request, hands).run();
}

}  // namespace towbench::study::active
