#include "harness/panel/steering.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/fault_plan/fault_text.h"
#include "harness/panel/own_experiments.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

constexpr std::size_t kMostTyped = 4096;
constexpr double kLongestStep_ms = 60'000;
constexpr double kFastest = 10'000;

FixtureError bad(const std::string& key, const std::string& given, const std::string& allowed) {
  return FixtureError({.file = "panel", .key = key}, given, allowed);
}

double number(const json& message, const char* key, double min, double max) {
  const auto found = message.find(key);
  const bool good = found != message.end() && found->is_number() && found->get<double>() >= min &&
                    found->get<double>() <= max;
  if (!good) {
    throw bad(key, found == message.end() ? "nothing" : found->dump(),
              fmt::format("{} <= x <= {}", min, max));
  }
  return found->get<double>();
}

std::string text(const json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_string() ||
      found->get_ref<const std::string&>().size() > kMostTyped) {
    throw bad(key, found == message.end() ? "nothing" : "something else",
              fmt::format("a text of at most {} bytes", kMostTyped));
  }
  return found->get<std::string>();
}

bool flag(const json& message, const char* key) {
  const auto found = message.find(key);
  return found != message.end() && found->is_boolean() && found->get<bool>();
}

SessionStart start_of(const json& message) {
  SessionStart wanted;
  wanted.experiment = experiment_named(text(message, "experiment")).string();
  for (const auto& line : message.value("lines", json::array())) {
    if (!line.is_array() || line.size() != 2 || !line[0].is_number_unsigned() ||
        !line[1].is_string() || line[1].get_ref<const std::string&>().size() > kMostTyped) {
      throw bad("lines", line.dump(), "[index, text]");
    }
    wanted.lines.emplace_back(line[0].get<std::size_t>(), line[1].get<std::string>());
  }
  for (const auto& words : message.value("faults", json::array())) {
    if (!words.is_string()) {
      throw bad("faults", words.dump(), "a fault in words");
    }
    wanted.faults.push_back(words.get<std::string>());
  }
  if (message.contains("seed")) {
    wanted.seed = static_cast<std::uint64_t>(number(message, "seed", 0, 9e15));
  }
  if (message.contains("duration_limit_s")) {
    wanted.duration_limit_s = number(message, "duration_limit_s", 1e-3, 86'400);
  }
  if (message.contains("clock")) {
    const auto clock = text(message, "clock");
    if (clock != "lockstep" && clock != "real") {
      throw bad("clock", '"' + clock + '"', "lockstep real");
    }
    wanted.clock = clock == "real" ? RunClock::kReal : RunClock::kLockstep;
  }
  wanted.pace = {.speed = number(message, "speed", 0, kFastest), .paused = flag(message, "paused")};
  wanted.holds = flag(message, "hold");
  return wanted;
}

// "PART KIND parameters" with a beginning, which the operator sets.
Fault fault_of(const json& message) {
  const auto words = text(message, "fault");
  return parse_fault(words + (words.find(" at=") == std::string::npos ? " at=0s" : ""));
}

// A fault that is built in has no beginning: it is refused by name.
Fault any_fault_of(const json& message) {
  try {
    return fault_of(message);
  } catch (const FixtureError&) {
    return parse_fault(text(message, "fault"));
  }
}

void carry_out(Session& session, const json& message) {
  const auto what = text(message, "do");
  if (what == "start") {
    session.start(start_of(message));
  } else if (what == "cut") {
    session.cut_short();
  } else if (what == "finish") {
    session.run_operator().finish();
  } else if (what == "pause" || what == "resume") {
    session.run_operator().pause(what == "pause");
  } else if (what == "step") {
    const auto ms = number(message, "ms", 0.1, kLongestStep_ms);
    session.run_operator().step(core::nanoseconds(ms * 1e-3));
  } else if (what == "speed") {
    session.run_operator().set_speed(number(message, "speed", 0, kFastest));
  } else if (what == "type") {
    session.type(text(message, "text"));
  } else if (what == "inject") {
    session.run_operator().inject_now(any_fault_of(message));
  } else if (what == "clear") {
    const auto fault = any_fault_of(message);
    session.run_operator().clear(fault.place, fault.kind);
  } else {
    throw bad("do", '"' + what + '"', "start cut finish pause resume step speed type inject clear");
  }
}

}  // namespace

std::string steer(Session& session, std::string_view message) noexcept {
  try {
    const auto parsed = json::parse(message, nullptr, false);
    if (!parsed.is_object()) {
      return "panel: not a JSON object";
    }
    carry_out(session, parsed);
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace towbench::harness
