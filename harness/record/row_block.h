// Collects rows on the bench's thread and hands them over a block at a time.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "harness/record/background_writer.h"

namespace towbench::harness {

// Write is called on the writer's thread, once a row, in order. A kill loses at most the rows that
// have not been handed over.
template <typename Row, typename Write>
class RowBlock {
 public:
  // The writer outlives this.
  RowBlock(BackgroundWriter& writer, Write write) : writer_(writer), write_(std::move(write)) {
    rows_.reserve(kRows);
  }

  void add(const Row& row) {
    rows_.push_back(row);
    if (rows_.size() == kRows) {
      hand_over();
    }
  }

  void hand_over() {
    writer_.post([rows = std::exchange(rows_, {}), write = write_] {
      for (const auto& row : rows) {
        write(row);
      }
    });
    rows_.reserve(kRows);
  }

 private:
  static constexpr std::size_t kRows = 256;

  BackgroundWriter& writer_;
  Write write_;
  std::vector<Row> rows_;
};

}  // namespace towbench::harness
