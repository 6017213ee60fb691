#include "harness/record/can_log.h"

#include <array>

#include "protocol/carriers/can_layout.h"
#include "protocol/carriers/candump.h"

namespace towbench::harness {

CanLog::CanLog(const std::filesystem::path& path, std::string interface)
    : lines_(path), interface_(std::move(interface)) {}

void CanLog::on(const protocol::CanFrame& frame) noexcept {
  using protocol::CanDirection;
  constexpr auto kAdvance =
      protocol::can_id::kLockstep + static_cast<std::uint32_t>(CanDirection::kToPlant);
  if (frame.id == kAdvance && frame.size == protocol::kCanDataSize) {
    now_ns_ = static_cast<core::Nanoseconds>(protocol::word_of(frame));
  }
  std::array<char, protocol::kMaxCandumpLine> text{};
  lines_.write(
      protocol::write_candump({.time_ns = now_ns_, .interface = interface_, .frame = frame}, text));
  lines_.write("\n");
}

}  // namespace towbench::harness
