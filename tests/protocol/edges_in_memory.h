// Encoder lines without a kernel: what one end drives the other reads, through a queue that throws
// its oldest away when it is full, as the kernel's does.
#pragma once

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <mutex>

#include "protocol/carriers/edge_order.h"
#include "protocol/carriers/edge_port.h"

namespace towbench::protocol {

class EdgesInMemory {
 public:
  // `clock` may be called from both ends' threads.
  explicit EdgesInMemory(std::function<core::Nanoseconds()> clock, bool with_index = true,
                         std::size_t capacity = kEdgeQueue)
      : clock_(std::move(clock)), with_index_(with_index), capacity_(capacity) {}

  [[nodiscard]] EdgeReader& reader() noexcept { return reader_; }
  [[nodiscard]] EdgeDriver& driver() noexcept { return driver_; }
  // The next toggle never gets onto the line, though the driver believes it.
  void swallow_one() noexcept { swallow_ = true; }
  // The next interrupt is numbered, and no thread tells of it.
  void coalesce_one() noexcept { coalesce_ = true; }
  [[nodiscard]] std::size_t most_waiting() const noexcept { return most_waiting_; }

 private:
  struct Reader final : EdgeReader {
    explicit Reader(EdgesInMemory& the_lines) noexcept : lines(the_lines) {}
    core::Result<std::span<const LineEdge>> read() noexcept override {
      const std::lock_guard lock(lines.mutex_);
      for (; !lines.queue_.empty(); lines.queue_.pop_front()) {
        if (const auto status = order.add(lines.queue_.front()); !status) {
          return core::failure(status.error());
        }
      }
      return order.take(lines.clock_());
    }
    core::Result<std::uint8_t> levels() noexcept override {
      const std::lock_guard lock(lines.mutex_);
      return lines.levels_;
    }
    [[nodiscard]] core::Nanoseconds now_ns() const noexcept override { return lines.clock_(); }
    [[nodiscard]] bool has_index() const noexcept override { return lines.with_index_; }
    EdgesInMemory& lines;
    EdgeOrder order;
  };
  struct Driver final : EdgeDriver {
    explicit Driver(EdgesInMemory& the_lines) noexcept : lines(the_lines) {}
    core::Status set(unsigned place, bool level) noexcept override {
      const std::lock_guard lock(lines.mutex_);
      lines.put(place, level);
      return {};
    }
    [[nodiscard]] bool has_index() const noexcept override { return lines.with_index_; }
    EdgesInMemory& lines;
  };

  void put(unsigned place, bool level) {
    const unsigned mask = 1U << place;
    if (((levels_ & mask) != 0) == level) {
      return;  // no edge
    }
    if (swallow_) {
      swallow_ = false;
      return;
    }
    levels_ = static_cast<std::uint8_t>(levels_ ^ mask);
    ++sequence_;
    if (coalesce_) {
      coalesce_ = false;
      return;
    }
    if (queue_.size() == capacity_) {
      queue_.pop_front();
    }
    queue_.push_back({.sequence = sequence_,
                      .line_sequence = ++line_sequences_[place],
                      .edge = {.place = static_cast<std::uint8_t>(place), .time_ns = clock_()}});
    most_waiting_ = std::max(most_waiting_, queue_.size());
  }

  std::function<core::Nanoseconds()> clock_;
  bool with_index_;
  std::size_t capacity_;
  std::mutex mutex_;
  std::deque<NumberedEdge> queue_;
  std::uint8_t levels_ = 0;
  std::uint32_t sequence_ = 0;
  std::array<std::uint32_t, kEncoderChannelsAndIndex> line_sequences_{};
  bool swallow_ = false;
  bool coalesce_ = false;
  std::size_t most_waiting_ = 0;
  Reader reader_{*this};
  Driver driver_{*this};
};

}  // namespace towbench::protocol
