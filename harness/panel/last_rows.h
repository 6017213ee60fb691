// The last rows of a run: one thread writes them and asks nobody, one reads what it wants of them.
// Nobody waits; what is older than the capacity is gone, whether it was read or not.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

namespace towbench::harness {

template <typename Row>
class LastRows {
  static_assert(std::is_trivially_copyable_v<Row>);
  static_assert(sizeof(Row) % sizeof(std::uint64_t) == 0);

 public:
  // Keeps `least` rows, and more for as long as a reader needs to copy them.
  explicit LastRows(std::size_t least) { clear(least); }

  // ---- writer ----
  void add(const Row& row) noexcept {
    const auto number = written_.load(std::memory_order_relaxed);
    auto& words = slots_[number & mask_].words;
    const auto* const from = static_cast<const std::byte*>(static_cast<const void*>(&row));
    for (std::size_t i = 0; i < words_; ++i) {
      std::uint64_t word = 0;
      std::memcpy(&word, from + i * sizeof(word), sizeof(word));
      // Whoever reads this word knows that all rows before have been written (read(), below).
      words[i].store(word, std::memory_order_release);
    }
    written_.store(number + 1, std::memory_order_release);
  }

  // ---- reader ----
  // Rows are numbered from 0; this many there have been.
  [[nodiscard]] std::uint64_t written() const noexcept {
    return written_.load(std::memory_order_acquire);
  }
  [[nodiscard]] std::uint64_t least() const noexcept { return least_; }

  // All rows from number `from` on that are still there, in place of what `rows` holds. The number
  // of the first of them.
  std::uint64_t copy(std::uint64_t from, std::vector<Row>& rows) const {
    const auto end = written();
    const auto first = std::min(end, std::max(from, oldest(end)));
    rows.resize(end - first);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      read(first + i, rows[i]);
    }
    // Those that were written over meanwhile may be half of one row and half of another.
    const auto whole = std::min(end, std::max(first, oldest(written())));
    rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(whole - first));
    return whole;
  }

  // ---- while nobody writes or reads ----
  // Of each row the first `bytes` are passed on, whole words; the rest is read as it was made.
  void clear(std::size_t least, std::size_t bytes = sizeof(Row)) {
    least_ = least;
    words_ = bytes / sizeof(std::uint64_t);
    const auto capacity = std::bit_ceil(least + least / 4);
    if (slots_ == nullptr || capacity != mask_ + 1) {
      slots_ = std::make_unique<Slot[]>(capacity);
      mask_ = capacity - 1;
    }
    written_ = 0;
  }

 private:
  static constexpr std::size_t kWords = sizeof(Row) / sizeof(std::uint64_t);
  struct alignas(64) Slot {
    std::array<std::atomic<std::uint64_t>, kWords> words{};
  };

  // The first row that is not being written over when there have been `written`.
  [[nodiscard]] std::uint64_t oldest(std::uint64_t written) const noexcept {
    return written > mask_ ? written - mask_ : 0;
  }

  void read(std::uint64_t number, Row& row) const noexcept {
    const auto& words = slots_[number & mask_].words;
    auto* const to = static_cast<std::byte*>(static_cast<void*>(&row));
    for (std::size_t i = 0; i < words_; ++i) {
      const auto word = words[i].load(std::memory_order_acquire);
      std::memcpy(to + i * sizeof(word), &word, sizeof(word));
    }
  }

  std::unique_ptr<Slot[]> slots_;
  std::size_t mask_ = 0;
  std::size_t least_ = 0;
  std::size_t words_ = kWords;
  // On a cache line that is read twice a copy, not once a row.
  alignas(64) std::atomic<std::uint64_t> written_{0};
};

}  // namespace towbench::harness
