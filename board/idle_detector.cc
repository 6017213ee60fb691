#include "board/idle_detector.h"

#include <algorithm>
#include <cstring>

namespace towbench::board {
namespace {

constexpr std::uint32_t kFirstLimit = 16;  // blocks of the smallest loop looked for
constexpr std::uint32_t kLongestLoop = 4096;
constexpr std::uint32_t kMostPatience =
    1024;  // rounds between two looks at a loop that is not idle

}  // namespace

bool IdleDetector::look(std::uint32_t address, std::uint64_t disturbances,
                        const RegisterReader& reader) {
  if (disturbances != seen_) {
    seen_ = disturbances;
    head_ = address;
    steps_ = 0;
    limit_ = kFirstLimit;
    patience_ = rounds_to_check_ = 1;
    has_snapshot_ = confirming_ = false;
    return false;
  }
  if (address != head_) {
    if (++steps_ > limit_) {  // the circle does not come by the head: look for it further on
      head_ = address;
      steps_ = 0;
      limit_ = limit_ < kLongestLoop ? 2 * limit_ : limit_;
      has_snapshot_ = confirming_ = false;
    }
    return false;
  }
  steps_ = 0;
  if (has_snapshot_ && --rounds_to_check_ > 0) {
    return false;
  }
  const RegisterSet now = reader.registers();
  const auto stack = reader.stack_top();
  const bool same =
      has_snapshot_ && now == snapshot_ &&
      std::equal(stack.begin(), stack.end(), stack_snapshot_.begin(), stack_snapshot_.end());
  if (same) {
    rounds_to_check_ = 1;
    return confirm(address, reader);
  }
  if (has_snapshot_) {
    patience_ = patience_ < kMostPatience ? 2 * patience_ : patience_;
  }
  rounds_to_check_ = patience_;
  snapshot_ = now;
  stack_snapshot_.assign(stack.begin(), stack.end());
  has_snapshot_ = true;
  confirming_ = false;
  // A long wait between two looks would compare rounds far apart: the second look is at the next.
  return false;
}

bool IdleDetector::confirm(std::uint32_t address, const RegisterReader& reader) {
  Standing& standing = standing_[address];
  if (standing != Standing::kUnknown) {
    return standing == Standing::kIdle;
  }
  const FloatRegisters floats = reader.float_registers();
  if (!confirming_) {
    confirming_ = true;
    float_snapshot_ = floats;
    memory_copy_ = copy_of_memory();
    return false;
  }
  confirming_ = false;
  const bool idle = floats == float_snapshot_ && memory_is(memory_copy_);
  standing = idle ? Standing::kIdle : Standing::kBusy;
  memory_copy_ = {};
  return idle;
}

std::vector<std::uint8_t> IdleDetector::copy_of_memory() const {
  std::vector<std::uint8_t> copy;
  for (const auto part : memory_) {
    copy.insert(copy.end(), part.begin(), part.end());
  }
  return copy;
}

bool IdleDetector::memory_is(const std::vector<std::uint8_t>& copy) const {
  std::size_t at = 0;
  for (const auto part : memory_) {
    if (std::memcmp(copy.data() + at, part.data(), part.size()) != 0) {
      return false;
    }
    at += part.size();
  }
  return true;
}

}  // namespace towbench::board
