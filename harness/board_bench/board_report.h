// board.json: what the virtual board executed in a run.
#pragma once

#include <filesystem>

#include "board/board.h"
#include "harness/board_bench/debug_probe.h"

namespace towbench::harness {

// Instructions in all, of each interrupt (count, mean, worst), of the most expensive functions, the
// stack's depth, idle time, and what the image asked for that is not modelled. False when the file
// cannot be written.
[[nodiscard]] bool write_board_report(const std::filesystem::path& file, const board::Board& board,
                                      const DebugProbe& probe);

}  // namespace towbench::harness
