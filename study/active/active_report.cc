#include "study/active/active_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/record/line_writer.h"

namespace towbench::study::active {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Outcome::End end) {
  switch (end) {
    case Outcome::End::kOneCause:
      return "one_cause";
    case Outcome::End::kNothingSeparates:
      return "nothing_separates";
    case Outcome::End::kOutOfRounds:
      return "out_of_rounds";
    case Outcome::End::kRunFailed:
      return "run_failed";
    case Outcome::End::kStopped:
      return "stopped";
    case Outcome::End::kUnderWay:
      break;
  }
  return "under_way";
}

Json json_of(const Round& round) {
  Json folders = Json::array();
  for (const auto& folder : round.folders) {
    folders.push_back(folder.string());
  }
  return {{"asked", round.asked},
          {"motion", round.motion},
          {"experiment", round.experiment.string()},
          {"runs", folders},
          {"answer", round.answer}};
}

std::string what_was_run(const Outcome& outcome) {
  if (outcome.rounds.empty()) {
    return "nothing";
  }
  std::string out;
  for (const Round& round : outcome.rounds) {
    out += (out.empty() ? "" : "; then ") + round.motion;
  }
  return out;
}

std::string what_was_asked(const Outcome& outcome) {
  std::string out;
  for (const Round& round : outcome.rounds) {
    out += (out.empty() ? "" : "; then ") + joined(round.asked, " or ");
  }
  return out.empty() ? "nothing: " + outcome.first_answer : out;
}

}  // namespace

std::string json_of(const Outcome& outcome) {
  Json rounds = Json::array();
  for (const Round& round : outcome.rounds) {
    rounds.push_back(json_of(round));
  }
  const Json all{{"schema", "towbench/active/1"},
                 {"first_answer", outcome.first_answer},
                 {"rounds", rounds},
                 {"end", name_of(outcome.end)},
                 {"answer", outcome.answer},
                 {"why", outcome.why}};
  return all.dump(2) + "\n";
}

std::string told(const Request& request, const Outcome& outcome) {
  const auto answered = std::count_if(outcome.rounds.begin(), outcome.rounds.end(),
                                      [](const Round& round) { return !round.answer.empty(); });
  const auto last = request.out / fmt::format("round-{}", answered);
  std::string out = fmt::format("What was asked: {}.\n", what_was_asked(outcome));
  out += fmt::format("What was run:   {}.\n", what_was_run(outcome));
  out +=
      fmt::format("Where it lies:  {}; the diagnosis of all logs: {}\n",
                  outcome.rounds.empty() ? std::string("no run") : (request.out / "runs").string(),
                  (last / "report.html").string());
  out += fmt::format("The answer:     {}.\n", outcome.answer);
  out += fmt::format("Why there:      {}.\n", outcome.why);
  for (const Round& round : outcome.rounds) {
    for (const auto& folder : round.folders) {
      out += fmt::format("  {}\n", folder.string());
    }
  }
  return out;
}

void write_report(const Request& request, const Outcome& outcome) {
  harness::write_atomically(request.out / "active.json", json_of(outcome));
  harness::write_atomically(request.out / "active.txt", told(request, outcome));
}

}  // namespace towbench::study::active
