#include "harness/board_bench/board_report.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include <nlohmann/json.hpp>

namespace towbench::harness {
namespace {

using nlohmann::json;

json interrupts_of(const board::ExecutionProfile& profile) {
  json list = json::array();
  for (unsigned n = 0; n < board::ExecutionProfile::kInterrupts; ++n) {
    const board::InterruptCost& cost = profile.interrupt(n);
    if (cost.count > 0) {
      list.push_back({{"interrupt", n},
                      {"count", cost.count},
                      {"mean_instructions", cost.instructions / cost.count},
                      {"worst_instructions", cost.worst},
                      {"worst_at_s", core::seconds(cost.worst_at_ns)}});
    }
  }
  return list;
}

json functions_of(const board::Board& board) {
  constexpr std::size_t kShown = 40;
  const auto& costs = board.profile().functions();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (costs[i].instructions > 0) {
      order.push_back(i);
    }
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return costs[a].in_interrupts != costs[b].in_interrupts
               ? costs[a].in_interrupts > costs[b].in_interrupts
               : costs[a].instructions > costs[b].instructions;
  });
  order.resize(std::min(order.size(), kShown));
  json list = json::array();
  for (const std::size_t i : order) {
    list.push_back({{"function", board.image().symbols()[i].name},
                    {"instructions", costs[i].instructions},
                    {"in_interrupts", costs[i].in_interrupts}});
  }
  return list;
}

}  // namespace

bool write_board_report(const std::filesystem::path& file, const board::Board& board,
                        const DebugProbe& probe) {
  json report{{"schema", 1},
              {"instructions", board.profile().instructions()},
              {"idle_s", core::seconds(board.idle_ns())},
              {"simulated_time_s", core::seconds(board.now_ns())},
              {"interrupts", interrupts_of(board.profile())},
              {"functions", functions_of(board)},
              {"not_modelled", board.notes()},
              {"watchdog_resets", board.watchdog_resets()}};
  if (const auto used = probe.stack_used()) {
    report["stack"] = {{"used_bytes", *used}};
    if (probe.stack_size() > 0) {
      report["stack"]["size_bytes"] = probe.stack_size();
    }
  }
  if (board.verdict()) {
    report["stopped"] = {{"time_s", core::seconds(board.verdict()->time_ns)},
                         {"why", board.verdict()->sentence}};
  }
  std::ofstream stream(file);
  stream << report.dump(2) << '\n';
  return stream.good();
}

}  // namespace towbench::harness
