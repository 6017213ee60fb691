// The truth of a plant that runs in another process, from the record that it is writing: the panel
// reads behind it, and neither side of the run knows. Half a second late.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/checks/recorded_axes.h"
#include "harness/panel/live_row.h"

namespace towbench::harness {

class TruthTail {
 public:
  explicit TruthTail(std::filesystem::path folder, const RecordedAxes& axes = planar_axes())
      : folder_(std::move(folder)), axes_(axes) {}

  // What has been written since the last call, whole lines only, so much at once.
  [[nodiscard]] std::vector<LiveTruth> rows();
  [[nodiscard]] std::string events();

 private:
  struct Tail {
    std::uint64_t at = 0;
    std::string rest{};  // of a line that is not complete
  };
  static std::string whole_lines(const std::filesystem::path& file, Tail& tail);

  std::filesystem::path folder_;
  RecordedAxes axes_;  // that it has columns of
  Tail truth_;
  Tail events_;
};

}  // namespace towbench::harness
