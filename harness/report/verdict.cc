#include "harness/report/verdict.h"

#include <cctype>
#include <cstddef>

#include <fmt/format.h>

namespace towbench::harness::report {
namespace {

struct Tally {
  std::size_t checks = 0;
  std::size_t failed = 0;
  std::size_t unjudged = 0;
};

Tally tally_of(const nlohmann::json& checks) {
  Tally tally;
  if (checks.is_array()) {
    for (const nlohmann::json& check : checks) {
      const VerdictKind kind = kind_of(text_at(check, "verdict"));
      ++tally.checks;
      tally.failed += kind == VerdictKind::kFail ? 1U : 0U;
      tally.unjudged += kind == VerdictKind::kPass || kind == VerdictKind::kFail ? 0U : 1U;
    }
  }
  return tally;
}

std::string sentence_for(const Tally& tally) {
  if (tally.failed > 0 && tally.unjudged > 0) {
    return fmt::format("Of {} checks {} failed and {} could not be judged.", tally.checks,
                       tally.failed, tally.unjudged);
  }
  if (tally.failed > 0) {
    return fmt::format("{} of {} checks failed.", tally.failed, tally.checks);
  }
  if (tally.unjudged > 0) {
    return fmt::format("{} of {} checks could not be judged.", tally.unjudged, tally.checks);
  }
  return tally.checks == 1 ? "The one check is met."
                           : fmt::format("All {} checks are met.", tally.checks);
}

// What happened, as a sentence before another.
std::string after(std::string judged, const std::string& sentence) {
  if (judged.empty()) {
    return sentence;
  }
  judged.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(judged.front())));
  return judged + ". " + sentence;
}

Verdict contradiction(std::string_view claimed, const Tally& tally) {
  return {VerdictKind::kInvalid,
          tally.checks == 0 ? fmt::format("The result says {}, but nothing was checked.", claimed)
                            : fmt::format("The result says {}, which its checks contradict. {}",
                                          claimed, sentence_for(tally))};
}

}  // namespace

VerdictKind kind_of(std::string_view word) {
  return word == "PASS"   ? VerdictKind::kPass
         : word == "FAIL" ? VerdictKind::kFail
                          : VerdictKind::kInvalid;
}

Verdict verdict_of(const nlohmann::json& result) {
  if (!result.is_object()) {
    return {VerdictKind::kIncomplete, "There is no readable result.json: nothing was judged."};
  }
  const std::string reason = text_at(result, "reason");
  if (text_at(result, "status") != "complete") {
    return {VerdictKind::kIncomplete,
            reason.empty() ? "The run did not come to its end: nothing was judged." : reason};
  }
  const Tally tally = tally_of(member(result, "checks"));
  const std::string word = text_at(result, "verdict");
  const bool clean = tally.checks > 0 && tally.failed == 0 && tally.unjudged == 0;
  const std::string judged = text_at(result, "judged");
  if (word == "PASS") {
    return clean ? Verdict{VerdictKind::kPass, after(judged, sentence_for(tally))}
                 : contradiction(word, tally);
  }
  if (word == "FAIL" || word == "INVALID") {
    std::string sentence = reason;
    if (tally.checks > 0 && !clean) {
      sentence += sentence.empty() ? "" : " ";
      sentence += sentence_for(tally);
    }
    return {kind_of(word), sentence.empty() ? "No reason was recorded." : after(judged, sentence)};
  }
  return {VerdictKind::kInvalid, "The result carries no verdict that this page knows."};
}

Verdict verdict_of(const RunContents& run) {
  return run.contradictions.empty()
             ? verdict_of(run.result)
             : Verdict{VerdictKind::kInvalid,
                       "This folder does not agree with itself: what it claims is not shown."};
}

std::string_view word_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::kPass:
      return "PASS";
    case VerdictKind::kFail:
      return "FAIL";
    case VerdictKind::kInvalid:
      return "INVALID";
    case VerdictKind::kIncomplete:
      break;
  }
  return "INCOMPLETE";
}

std::string_view symbol_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::kPass:
      return "✓";
    case VerdictKind::kFail:
      return "✕";
    case VerdictKind::kInvalid:
      return "?";
    case VerdictKind::kIncomplete:
      break;
  }
  return "…";
}

std::string_view class_of(VerdictKind kind) {
  switch (kind) {
    case VerdictKind::kPass:
      return "pass";
    case VerdictKind::kFail:
      return "fail";
    case VerdictKind::kInvalid:
      return "invalid";
    case VerdictKind::kIncomplete:
      break;
  }
  return "incomplete";
}

}  // namespace towbench::harness::report
