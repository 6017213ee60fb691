// Memory that two processes share, and the turn in it: one writes a request and waits, the other
// answers and waits for the next.
//
// Who waits looks at the word for some microseconds, then sleeps in the kernel (futex(2)) until it
// changes: a step costs no system call while both sides have a processor. Looks that were in vain
// make the next ones fewer: on a busy host both sides would only keep each other from running.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "clients/plant/plant_abi.h"
#include "core/axis.h"

namespace towbench::harness {

enum class PlantOrder : std::uint32_t { kStep, kSave, kRestore, kEnd };

inline constexpr std::size_t kMostPlantState_bytes = 1U << 20U;

// A number that only grows; one side writes, the other waits for it.
class TurnWord {
 public:
  // Wakes the other side.
  void post(std::uint32_t value) noexcept;
  // Whether it is no longer `old`, after at most `longest_ns`; < 0: however long it takes.
  [[nodiscard]] bool changes_from(std::uint32_t old, std::int64_t longest_ns) noexcept;
  [[nodiscard]] std::uint32_t value() const noexcept {
    return word_.load(std::memory_order_acquire);
  }

 private:
  alignas(64) std::atomic<std::uint32_t> word_{0};
  alignas(64) std::atomic<std::uint32_t> sleeps_{0};
  // Of the side that waits.
  int looks_ = 100;
  unsigned waits_ = 0;
};

struct Mailbox {
  TurnWord requests;
  TurnWord answers;
  PlantOrder order = PlantOrder::kStep;
  double until_s = 0;
  std::array<towbench_plant_input, core::kMostAxes> inputs{};
  std::array<towbench_plant_output, core::kMostAxes> outputs{};
  double reached_s = 0;
  bool succeeded = false;
  std::array<char, 400> message{};
  std::size_t state_size = 0;
  std::array<std::byte, kMostPlantState_bytes> state;  // of kSave and kRestore
};

struct UnmapMailbox {
  void operator()(Mailbox* mailbox) const noexcept;
};
using SharedMailbox = std::unique_ptr<Mailbox, UnmapMailbox>;

// Shared with processes that are forked later. Throws std::system_error.
[[nodiscard]] SharedMailbox make_mailbox();

}  // namespace towbench::harness
