#include "harness/record/event_lines.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/record/csv_writer.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

std::string_view name_of(emulator::PlantEventKind kind) {
  constexpr std::array<std::string_view, 9> kNames{
      "input_line_changed",    "hard_end_contact", "index_pulse",   "fault",
      "scheduled_event_fired", "peer_lost",        "drive_removed", "finished",
      "operator_reset"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string_view name_of(bbmc::ControllerEvent::Kind kind) {
  constexpr std::array<std::string_view, 9> kNames{"state_changed",  "fault_latched", "reset",
                                                   "motion_started", "motion_ended",  "duty_zeroed",
                                                   "line_edge",      "log_full",      "peer_lost"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string head(core::Nanoseconds time_ns, std::string_view side, std::string_view kind) {
  std::array<char, kLongestSeconds> time{};
  const auto length = static_cast<std::size_t>(write_seconds(time.data(), time_ns) - time.data());
  return fmt::format(R"({{"time_s":{},"side":"{}","kind":"{}")",
                     std::string_view(time.data(), length), side, kind);
}

void add_code(std::string& line, core::ErrorCode code) {
  if (code != core::ErrorCode::kNone) {
    line += fmt::format(R"(,"code":{},"text":"{}")", core::number_of(code), core::describe(code));
  }
}

struct TimedLine {
  double time_s = 0;
  std::string text;
};

// A line torn by a kill is left out: it has no end, or does not parse.
void read_lines(const std::filesystem::path& path, std::vector<TimedLine>& lines) {
  std::ifstream stream(path);
  std::string text;
  while (std::getline(stream, text)) {
    const auto parsed = nlohmann::json::parse(text, nullptr, false);
    if (parsed.is_object() && parsed.contains("time_s")) {
      lines.push_back({parsed["time_s"].get<double>(), text});
    }
  }
}

}  // namespace

std::string event_line(const emulator::PlantEvent& event) {
  std::string line = head(event.time_ns, "plant", name_of(event.kind));
  line += fmt::format(R"(,"axis":"{}")", core::name_of(event.axis));
  add_code(line, event.code);
  line += fmt::format(R"(,"lines":{},"value":{},"energy_J":{}}})"
                      "\n",
                      event.lines, event.value, event.energy_J);
  return line;
}

std::string event_line(const bbmc::ControllerEvent& event) {
  std::string line = head(event.time_ns, "controller", name_of(event.kind));
  line += fmt::format(R"(,"axis":"{}")", core::name_of(event.axis));
  add_code(line, event.code);
  line += fmt::format(R"(,"value":{}}})"
                      "\n",
                      event.value);
  return line;
}

std::string wire_event_line(core::Nanoseconds time_ns, std::string_view kind) {
  return head(time_ns, "wire", kind) + "}\n";
}

std::string operator_act_line(const OperatorAct& act) {
  return head(act.time_ns, "operator", name_of(act.kind)) +
         fmt::format(R"(,"text":{}}})"
                     "\n",
                     nlohmann::json(act.text).dump(-1, ' ', true,
                                                   nlohmann::json::error_handler_t::replace));
}

void merge_events(const std::filesystem::path& folder) {
  std::vector<TimedLine> lines;
  read_lines(folder / kPlantEventsFile, lines);
  read_lines(folder / kControllerEventsFile, lines);
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  std::string text;
  for (const auto& line : lines) {
    text += line.text + "\n";
  }
  write_atomically(folder / kEventsFile, text);
  std::filesystem::remove(folder / kPlantEventsFile);
  std::filesystem::remove(folder / kControllerEventsFile);
}

}  // namespace towbench::harness
