#include "harness/board_bench/debug_probe.h"

#include <algorithm>
#include <memory>

#include "bbmc/baremetal/parameter_block.h"

namespace towbench::harness {
namespace {

// The object of that name in the board's memory; null when it is not there, or has another size.
template <typename T>
T* object_of(board::Board& board, const char* name) {
  const auto symbol = board.image().find(name);
  if (!symbol || symbol->size != sizeof(T) || symbol->address % alignof(T) != 0) {
    return nullptr;
  }
  const auto bytes = board.memory(symbol->address, sizeof(T));
  return bytes.empty() ? nullptr : reinterpret_cast<T*>(bytes.data());
}

struct StackPlace {
  std::uint32_t bottom = 0;
  std::uint32_t size = 0;
};
StackPlace stack_of(const board::Board& board) {
  const auto bottom = board.image().find("bbmc_stack_bottom");
  const auto top = board.image().find("bbmc_stack_top");
  return bottom && top && top->address > bottom->address
             ? StackPlace{bottom->address, top->address - bottom->address}
             : StackPlace{};
}

}  // namespace

DebugProbe::DebugProbe(board::Board& board)
    : board_(board), port_(object_of<bbmc::DebugPort>(board, bbmc::kDebugPortSymbol)) {}

std::string DebugProbe::set_parameters(const bbmc::Configuration& configuration) {
  auto* block = object_of<bbmc::ParameterBlock>(board_, bbmc::kParameterBlockSymbol);
  if (block == nullptr) {
    return "the image has a debug port but no parameter block";
  }
  auto packed = std::make_unique<bbmc::ParameterBlock>();
  if (!bbmc::pack(configuration, *packed)) {
    return "the controller's parameters do not fit into the image's block";
  }
  *block = *packed;
  return {};
}

bool DebugProbe::next_row(bbmc::TelemetryRow& row) noexcept {
  if (!is_running() || port_->rows.taken == port_->rows.written) {
    return false;
  }
  row = port_->rows.items[port_->rows.taken % port_->rows.items.size()];
  ++port_->rows.taken;
  return true;
}

bool DebugProbe::next_event(bbmc::SystemEvent& event) noexcept {
  if (!is_running() || port_->events.taken == port_->events.written) {
    return false;
  }
  event = port_->events.items[port_->events.taken % port_->events.items.size()];
  ++port_->events.taken;
  return true;
}

std::uint32_t DebugProbe::stack_size() const {
  return stack_of(board_).size;
}

std::optional<std::uint32_t> DebugProbe::stack_used() const {
  constexpr std::uint8_t kPaint = 0xA5;
  const StackPlace place = stack_of(board_);
  if (place.size == 0) {
    return stack_of_third_party();
  }
  const auto bytes = board_.memory(place.bottom, place.size);
  const auto touched =
      std::find_if(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte != kPaint; });
  return static_cast<std::uint32_t>(bytes.end() - touched);
}

// Memory outside the image is zero before the start. Around where interrupts found the stack it is
// followed both ways, until a gap of zeros says that it has ended.
std::optional<std::uint32_t> DebugProbe::stack_of_third_party() const {
  constexpr std::uint32_t kGapBelow = 1U << 20U;
  constexpr std::uint32_t kGapAbove = 1U << 12U;
  const std::uint32_t known = board_.profile().highest_stack();
  if (known == 0) {
    return std::nullopt;
  }
  for (const board::ElfSegment& segment : board_.image().segments()) {
    if (known >= segment.address && known - segment.address <= segment.memory_size) {
      return std::nullopt;
    }
  }
  const auto is_empty = [&](std::uint32_t address) {
    const auto byte = board_.memory(address, 1);
    return byte.empty() || byte[0] == 0;
  };
  std::uint32_t top = known;
  for (std::uint32_t at = known; at - top < kGapAbove; ++at) {
    top = is_empty(at) ? top : at + 1;
  }
  std::uint32_t bottom = known;
  for (std::uint32_t at = known; bottom - at < kGapBelow; --at) {
    bottom = is_empty(at) ? bottom : at;
  }
  return top - bottom;
}

}  // namespace towbench::harness
