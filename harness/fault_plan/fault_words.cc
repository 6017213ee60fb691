#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "harness/fault_plan/fault_syntax.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/nearest_key.h"

namespace towbench::harness {
namespace {

using Place = FixtureError::Place;
using Trigger = FaultTrigger;

struct Unit {
  std::string_view text;
  std::string_view suffix;
  double factor;
};
constexpr std::array<Unit, 17> kUnits{{
    {"s", "_s", 1},
    {"ms", "_s", 1e-3},
    {"us", "_s", 1e-6},
    {"m", "_m", 1},
    {"mm", "_m", 1e-3},
    {"um", "_m", 1e-6},
    {"m/s", "_m_per_s", 1},
    {"mm/s", "_m_per_s", 1e-3},
    {"N", "_N", 1},
    {"V", "_V", 1},
    {"W", "_W", 1},
    {"Hz", "_Hz", 1},
    {"kHz", "_Hz", 1e3},
    {"deg", "_deg", 1},
    {"kg", "_kg", 1},
    {"g", "_kg", 1e-3},
    {"", "", 1},
}};

struct Setting {
  std::string key;  // with its unit
  double value = 0;
};

class WordReader {
 public:
  explicit WordReader(std::string_view words) : words_(words) {}

  Fault read() {
    const auto place = place_named(next_word());
    if (!place) {
      refuse(word_, near(all_place_names()));
    }
    const auto* row = find_fault(place->part, next_word());
    if (row == nullptr) {
      refuse(word_, near(kinds_of(place->part)));
    }
    fault_.place = *place;
    fault_.kind = row->kind;
    for (std::size_t i = 0; i < kMostFaultParameters; ++i) {
      fault_.parameters[i] = row->parameters[i].standard;
    }
    while (!next_word().empty()) {
      take_setting();
    }
    check_whole(fault_, has_trigger_, here(""));
    return fault_;
  }

 private:
  // The next word, empty at the end; also in word_.
  std::string_view next_word() {
    const auto start = words_.find_first_not_of(' ', at_);
    if (start == std::string_view::npos) {
      at_ = words_.size();
      word_ = {};
      return word_;
    }
    at_ = std::min(words_.find(' ', start), words_.size());
    word_ = words_.substr(start, at_ - start);
    return word_;
  }

  [[nodiscard]] Place here(std::string_view key) const {
    return {.file = fmt::format("--fault \"{}\"", printable(words_)), .key = std::string(key)};
  }
  [[noreturn]] void refuse(std::string_view given, const std::string& allowed) const {
    throw FixtureError(here(""), given.empty() ? "nothing" : '"' + printable(given) + '"', allowed);
  }
  [[nodiscard]] static std::string printable(std::string_view text) {
    std::string shown(text.substr(0, 200));
    std::replace_if(
        shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return shown;
  }
  [[nodiscard]] std::string near(const std::vector<std::string>& names) const {
    const auto closest = word_.empty() ? std::string() : nearest_key(word_, names);
    return closest.empty() ? fmt::format("{}", fmt::join(names, ", "))
                           : fmt::format("did you mean {}?", closest);
  }
  [[nodiscard]] static std::vector<std::string> kinds_of(FaultPart part) {
    std::vector<std::string> kinds;
    for (const auto& row : fault_catalogue()) {
      if (row.part == part) {
        kinds.emplace_back(row.name);
      }
    }
    return kinds;
  }

  void take_setting() {
    const auto equals = word_.find('=');
    if (equals == std::string_view::npos) {
      refuse(word_, "key=value");
    }
    const auto key = word_.substr(0, equals);
    const auto text = word_.substr(equals + 1);
    const bool taken = take_name(key, text) || take_number(key, text);
    if (!taken) {
      refuse_without_unit(key, text);
      refuse(word_, fmt::format("at, position, speed, phase, event, after, for, seed{}",
                                parameter_list()));
    }
  }

  void refuse_without_unit(std::string_view key, std::string_view text) const {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kUnitOf{
        {{"at", "s"}, {"after", "s"}, {"for", "s"}, {"position", "m"}, {"speed", "m/s"}}};
    for (const auto& [name, unit] : kUnitOf) {
      if (key == name) {
        refuse(word_, fmt::format("a number with its unit, as {}={}{}", key, text, unit));
      }
    }
  }

  [[nodiscard]] std::string parameter_list() const {
    std::string list;
    for (const auto& parameter : fault_.row().parameters) {
      list += parameter.key.empty() ? std::string() : fmt::format(", {}", parameter.key);
    }
    return list;
  }

  bool take_name(std::string_view key, std::string_view text) {
    if (key != "phase" && key != "event") {
      return false;
    }
    const std::span<const std::string_view> names =
        key == "phase" ? std::span<const std::string_view>(kPhaseNames) : kEventNames;
    if (std::find(names.begin(), names.end(), text) == names.end()) {
      refuse(word_, fmt::format("{}", fmt::join(names, ", ")));
    }
    begin_trigger(key == "phase" ? Trigger::Kind::kPhase : Trigger::Kind::kEvent);
    fault_.trigger.name = std::string(text);
    return true;
  }

  void begin_trigger(Trigger::Kind kind) {
    if (has_trigger_) {
      refuse(word_, "one trigger");
    }
    has_trigger_ = true;
    fault_.trigger.kind = kind;
  }

  // "20ms" under "at" is at_s = 0.02; "0.02" under "at_s" is the same.
  bool take_number(std::string_view key, std::string_view text) {
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !std::isfinite(number)) {
      refuse(word_, "a finite number");
    }
    const std::string_view unit_text(stop,
                                     static_cast<std::size_t>(text.data() + text.size() - stop));
    for (const auto& unit : kUnits) {
      if (unit.text == unit_text) {
        return take_value({std::string(key) + std::string(unit.suffix), number * unit.factor});
      }
    }
    refuse(word_, "a unit: s ms us m mm um m/s mm/s N V W Hz kHz deg kg g");
  }

  void must_be_in(core::Range range, double value) const {
    if (value < range.min || value > range.max) {
      refuse(word_, describe(range));
    }
  }

  bool take_value(const Setting& setting) {
    for (const auto& trigger : kNumericTriggers) {
      if (setting.key == trigger.key) {
        must_be_in(trigger.range, setting.value);
        begin_trigger(trigger.kind);
        fault_.trigger.value = setting.value;
        return true;
      }
    }
    if (setting.key == "after_s") {
      const bool own = fault_.kind == FaultKind::kReleased;
      if (!own) {
        must_be_in(core::between(0, kLongestFaultTime_s), setting.value);
        fault_.trigger.after_s = setting.value;
        return true;
      }
    }
    if (setting.key == "for_s" || setting.key == "duration_s") {
      must_be_in(core::between(1e-6, kLongestFaultTime_s), setting.value);
      fault_.duration_s = setting.value;
      return true;
    }
    if (setting.key == "seed") {
      must_be_in(core::between(0, 9e15), setting.value);
      fault_.seed = static_cast<std::uint64_t>(setting.value);
      return true;
    }
    for (std::size_t i = 0; i < kMostFaultParameters; ++i) {
      const auto& parameter = fault_.row().parameters[i];
      if (!parameter.key.empty() && setting.key == parameter.key) {
        must_be_in(core::between(parameter.min, parameter.max), setting.value);
        fault_.parameters[i] = setting.value;
        return true;
      }
    }
    return false;
  }

  std::string_view words_;
  std::size_t at_ = 0;
  std::string_view word_;
  Fault fault_;
  bool has_trigger_ = false;
};

}  // namespace

Fault parse_fault(std::string_view words) {
  return WordReader(words).read();
}

}  // namespace towbench::harness
