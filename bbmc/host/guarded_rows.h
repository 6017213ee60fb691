// Rows that end where the memory ends: writing one too many ends the process at once, as it would
// on a board whose log lies at the end of its memory, instead of spoiling what lies behind.
//
// Nothing is written before it is used: a controller whose log stays short costs little memory.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include <sys/mman.h>
#include <unistd.h>

#include "core/check.h"

namespace towbench::bbmc {

template <typename Row>
class GuardedRows {
  // They begin as zeros, which nobody constructs.
  static_assert(std::is_trivially_copyable_v<Row> && std::is_trivially_destructible_v<Row>);

 public:
  explicit GuardedRows(std::size_t rows) : rows_(rows) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t used = (rows * sizeof(Row) + page - 1) / page * page;
    size_ = used + page;
    memory_ = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    core::check(memory_ != MAP_FAILED);
    auto* const guard = static_cast<std::byte*>(memory_) + used;
    core::check(mprotect(guard, page, PROT_NONE) == 0);
    first_ = static_cast<Row*>(static_cast<void*>(guard - rows * sizeof(Row)));
  }
  GuardedRows(const GuardedRows&) = delete;
  GuardedRows& operator=(const GuardedRows&) = delete;
  ~GuardedRows() { munmap(memory_, size_); }

  [[nodiscard]] std::span<Row> span() noexcept { return {first_, rows_}; }

 private:
  std::size_t rows_;
  std::size_t size_ = 0;
  void* memory_ = nullptr;
  Row* first_ = nullptr;
};

}  // namespace towbench::bbmc
