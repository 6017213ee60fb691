#include "harness/report/event_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "harness/report/html.h"
#include "harness/report/quantity.h"
#include "harness/report/run_contents.h"
#include "protocol/messages.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

std::string name_of_line(std::size_t line) {
  using protocol::InputLine;
  const auto asked = static_cast<InputLine>(line);
  for (const auto axis : core::kAllAxes) {
    for (const bool at_max : {false, true}) {
      if (protocol::hall_line(axis, at_max) == asked) {
        return fmt::format("end-stop switch {} {}", core::name_of(axis), at_max ? "max" : "min");
      }
    }
    if (protocol::home_line(axis) == asked) {
      return fmt::format("home switch {}", core::name_of(axis));
    }
    if (core::is_planar(axis) && protocol::ready_line(axis) == asked) {
      return fmt::format("amplifier {} ready", core::name_of(axis));
    }
  }
  return asked == InputLine::kKillSwitch ? "kill switch" : "further amplifiers ready";
}

// bbmc::AxisMode, by number.
constexpr std::array<std::string_view, 6> kModeNames{
    "idle", "open loop", "position control", "velocity control", "braking", "faulted"};

struct Words {
  std::string text;
  std::vector<std::string_view> used;  // members that the text already says
};

// "kill switch: on". Names no line that the protocol does not have.
Words line_changed(const Json& event) {
  const double number = number_at(event, "value").value_or(-1);
  const double lines = number_at(event, "lines").value_or(-1);
  const bool known = number >= 0 && number < static_cast<double>(protocol::kInputLineCount) &&
                     lines >= 0 && std::floor(number) == number;
  if (!known) {
    return {};
  }
  const auto line = static_cast<unsigned>(number);
  const bool active = ((static_cast<unsigned>(lines) >> line) & 1U) != 0;
  return {fmt::format("{}: {}", name_of_line(line), active ? "on" : "off"), {"value", "lines"}};
}

Words contact(const Json& event) {
  const std::optional<double> speed = number_at(event, "value");
  const std::optional<double> energy = number_at(event, "energy_J");
  std::string text = speed ? "at " + readable_quantity(std::fabs(*speed), "m/s") : std::string{};
  if (energy) {
    text += ", " + readable_quantity(*energy, "J");
  }
  return {text, {"value", "energy_J"}};
}

Words state_changed(const Json& event) {
  const double mode = number_at(event, "value").value_or(-1);
  if (mode < 0 || mode >= static_cast<double>(kModeNames.size()) || std::floor(mode) != mode) {
    return {};
  }
  return {fmt::format("to {}", kModeNames[static_cast<std::size_t>(mode)]), {"value"}};
}

// The controller numbers its lines from 1, so that the sign can tell the direction.
Words line_edge(const Json& event) {
  const double value = number_at(event, "value").value_or(0);
  const double line = std::fabs(value) - 1;
  if (line < 0 || line >= static_cast<double>(protocol::kInputLineCount) ||
      std::floor(line) != line) {
    return {};
  }
  return {
      fmt::format("{}: {}", name_of_line(static_cast<std::size_t>(line)), value > 0 ? "on" : "off"),
      {"value"}};
}

Words words_for(const Json& event) {
  const std::string kind = text_at(event, "kind");
  if (kind == "state_changed") {
    return state_changed(event);
  }
  if (kind == "line_edge") {
    return line_edge(event);
  }
  if (kind == "input_line_changed") {
    return line_changed(event);
  }
  if (kind == "hard_end_contact") {
    return contact(event);
  }
  return {};
}

std::string shown(const Json& value) {
  return value.is_string()         ? value.get<std::string>()
         : value.is_number_float() ? readable_number(value.get<double>())
                                   : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string other_members(const Json& event, const std::vector<std::string_view>& used) {
  static constexpr std::array<std::string_view, 6> kColumns{"time_s", "side", "kind",
                                                            "axis",   "code", "text"};
  const auto in = [](const auto& list, const std::string& key) {
    return std::find(list.begin(), list.end(), key) != list.end();
  };
  std::string text;
  for (const auto& [key, value] : event.items()) {
    const bool says_nothing =
        value.is_null() || value == 0 || (value.is_string() && value.get<std::string>().empty());
    if (!in(kColumns, key) && !in(used, key) && !says_nothing) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, shown(value));
    }
  }
  return text;
}

}  // namespace

std::string event_words(const Json& event) {
  std::string kind = text_at(event, "kind");
  std::replace(kind.begin(), kind.end(), '_', ' ');
  std::string html = fmt::format("<strong>{}</strong>", escaped(kind));
  if (const std::optional<double> code = number_at(event, "code"); code && *code != 0) {
    html += fmt::format(" <code>{}</code>", escaped(readable_number(*code)));
  }
  if (const std::string text = text_at(event, "text"); !text.empty()) {
    html += fmt::format(" {}", escaped(text));
  }
  const Words words = words_for(event);
  if (!words.text.empty()) {
    html += fmt::format(" {}", escaped(words.text));
  }
  if (const std::string others = other_members(event, words.used); !others.empty()) {
    html += fmt::format("<span class=\"meaning\">{}</span>", escaped(others));
  }
  return html;
}

}  // namespace towbench::harness::report
