#include "harness/realtime/run_timing.h"

#include <cstdio>
#include <fstream>

#include <nlohmann/json.hpp>

#include "harness/realtime/realtime_checks.h"
#include "harness/realtime/tick_summary.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

using nlohmann::json;

// The plant goes before the controller: a machine does not wait.
constexpr int kEmulatorPriority = 80;
constexpr int kControllerPriority = 70;
// 2 ms that a side may be behind and still catch up: as long as a reaction may take, so that a run
// that counts has not been late by a whole reaction.
constexpr core::Nanoseconds kMaxBehind_ns = 2 * core::kNanosecondsPerMillisecond;

TickPolicy policy_of(core::Nanoseconds period_ns) {
  return {.period_ns = period_ns,
          .max_behind = static_cast<std::uint32_t>(kMaxBehind_ns / period_ns)};
}

constexpr const char* kEmulatorFile = "realtime_emulator.json";

void warn(const char* side, const RealtimeRights& rights) {
  for (const auto& warning : rights.warnings) {
    std::fprintf(stderr, "%s: %s\n", side, warning.c_str());
  }
}

void write(const std::filesystem::path& path, const json& value) {
  write_atomically(path, value.dump(1) + "\n");
}

}  // namespace

EmulatorTiming::EmulatorTiming(std::filesystem::path folder)
    : folder_(std::move(folder)),
      rights_(take_realtime_rights(kEmulatorPriority, 0)),
      loop_(std::make_unique<TickLoop>(clock_, policy_of(core::kPlantTick_ns))) {
  warn("emulator", rights_);
}

core::Status EmulatorTiming::serve(emulator::PlantNode& plant, protocol::TurnLink& link,
                                   const protocol::Hello& hello, const PlantSurroundings& around) {
  const auto ended = serve_plant_in_real_time(plant, link, hello, *loop_, around);
  if (!folder_.empty()) {
    write(folder_ / kEmulatorFile, to_json(summary(), loop_->record()));
  }
  return ended;
}

TickSummary EmulatorTiming::summary() const {
  return summarise("emulator", rights_.text(), loop_->policy(), loop_->record());
}

ControllerTiming::ControllerTiming(std::filesystem::path folder,
                                   const bbmc::Configuration& configuration)
    : folder_(std::move(folder)),
      rights_(take_realtime_rights(kControllerPriority, 1)),
      loop_(std::make_unique<TickLoop>(
          clock_, policy_of(bbmc::exchange_period_ns(configuration.control_period_ns())))) {
  warn("controller", rights_);
}

std::string ControllerTiming::judge_into(Judgement& judgement, core::Nanoseconds control_period_ns,
                                         const RealtimeBudget& budget) {
  loop_->end_tick();
  const auto controller = summarise("controller", rights_.text(), loop_->policy(), loop_->record());
  TickSummary emulator;  // without a tick, unless its file says more
  emulator.side = "emulator";
  json of_emulator = nullptr;
  try {
    std::ifstream stream(folder_ / kEmulatorFile);
    of_emulator = json::parse(stream);
    emulator = tick_summary_from(of_emulator);
  } catch (const json::exception&) {
    std::fprintf(stderr, "towbench: the emulator left no figures of its timing\n");
  }
  for (auto& check : realtime_checks(emulator, controller, control_period_ns, budget)) {
    judgement.checks.push_back(std::move(check));
  }
  judgement.verdict = worst_of(judgement.checks);
  write(folder_ / "realtime.json", {{"schema", 1},
                                    {"emulator", of_emulator},
                                    {"controller", to_json(controller, loop_->record())}});
  return text_of(emulator) + text_of(controller);
}

}  // namespace towbench::harness
