// One judgement of a run, and how several become one.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace towbench::harness {

// Ordered from harmless to grave: a run is as good as its worst check. INVALID outranks FAIL: a run
// that cannot be trusted has not shown a failure either.
enum class Verdict : std::uint8_t { kPass = 0, kFail = 1, kInvalid = 2 };

[[nodiscard]] constexpr std::string_view name_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kPass:
      return "PASS";
    case Verdict::kFail:
      return "FAIL";
    case Verdict::kInvalid:
      break;
  }
  return "INVALID";
}

struct Check {
  std::string name;
  std::string window;  // empty for checks of the run as a whole
  std::string meaning;
  std::optional<double> value;
  std::string unit;
  std::optional<double> min;
  std::optional<double> max;
  // Distance to the nearer limit over that limit's size; plain distance where the limit is 0.
  std::optional<double> margin;
  Verdict verdict = Verdict::kInvalid;
  std::string reason;  // why not PASS
  std::string source;
};

// Of something that makes a run prove nothing.
[[nodiscard]] Check invalid_check(std::string name, std::string meaning, std::string reason);

// No check at all is no evidence: INVALID.
[[nodiscard]] Verdict worst_of(std::span<const Check> checks) noexcept;

// Process exit codes (RUN-1).
inline constexpr int kExitPass = 0;
inline constexpr int kExitFail = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitRuntime = 3;
inline constexpr int kExitInvalid = 4;

[[nodiscard]] constexpr int exit_code_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kPass:
      return kExitPass;
    case Verdict::kFail:
      return kExitFail;
    case Verdict::kInvalid:
      break;
  }
  return kExitInvalid;
}

}  // namespace towbench::harness
