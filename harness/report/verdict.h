// The verdict that the page shows. It repeats result.json, but never better than the checks in it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "harness/report/run_contents.h"

namespace towbench::harness::report {

// From best to worst.
enum class VerdictKind : std::uint8_t { kPass, kFail, kInvalid, kIncomplete };

struct Verdict {
  VerdictKind kind = VerdictKind::kIncomplete;
  std::string sentence;  // what it means here, e.g. "2 of 12 checks failed."
};

// `result` is result.json, or null when there is none. A PASS needs status "complete", at least one
// check, and every check a PASS; a result that contradicts itself is INVALID.
[[nodiscard]] Verdict verdict_of(const nlohmann::json& result);
// The same of a whole folder: one that does not agree with itself is INVALID, whatever it claims.
[[nodiscard]] Verdict verdict_of(const RunContents& run);

[[nodiscard]] std::string_view word_of(VerdictKind kind);    // "PASS"
[[nodiscard]] std::string_view symbol_of(VerdictKind kind);  // a sign that needs no colour
[[nodiscard]] std::string_view class_of(VerdictKind kind);   // CSS class

// The kind that a check's own verdict stands for; anything unknown is INVALID.
[[nodiscard]] VerdictKind kind_of(std::string_view word);

}  // namespace towbench::harness::report
