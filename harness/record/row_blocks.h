// Collects rows on the bench's thread and hands them over a block at a time. The blocks exist from
// the start and are used in turn: a row costs its copy, and no heap, lock or system call.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/realtime.h"
#include "harness/record/background_writer.h"

namespace towbench::harness {

// Write is called on the writer's thread with the rows of a block, in order. A kill loses at most
// the rows that the writer has not begun with.
template <typename Row, typename Write>
class RowBlocks {
 public:
  // The writer outlives this.
  RowBlocks(BackgroundWriter& writer, Write write, std::size_t rows_per_block = 256)
      : writer_(writer), rows_per_block_(rows_per_block) {
    for (auto& block : blocks_) {
      block.rows.reserve(rows_per_block);
      block.write = write;
    }
  }

  TOWBENCH_REALTIME void add(const Row& row) noexcept { add(std::span<const Row>(&row, 1)); }
  // At most rows_per_block: they stay together.
  TOWBENCH_REALTIME void add(std::span<const Row> rows) noexcept {
    if (blocks_[current_].rows.size() + rows.size() > rows_per_block_) {
      hand_over();
    }
    auto& into = blocks_[current_].rows;
    into.insert(into.end(), rows.begin(), rows.end());
  }

  // Waits only where the writer is behind by all blocks.
  TOWBENCH_REALTIME void hand_over() noexcept {
    writer_.give(blocks_[current_]);
    current_ = (current_ + 1) % kBlocks;
    if (writer_.is_given(blocks_[current_])) {
      writer_.wait_for(blocks_[current_]);
    }
  }

 private:
  struct Block final : WriterJob {
    void run() noexcept override {
      write(std::span<const Row>(rows));
      rows.clear();
    }
    std::vector<Row> rows;
    Write write{};
  };
  static constexpr std::size_t kBlocks = 8;

  BackgroundWriter& writer_;
  std::size_t rows_per_block_;
  std::array<Block, kBlocks> blocks_;
  std::size_t current_ = 0;
};

}  // namespace towbench::harness
