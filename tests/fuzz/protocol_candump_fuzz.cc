// Any text as a line of a candump log: what is read is written and read again the same.
#include <array>
#include <cstdint>
#include <string>

#include "core/check.h"
#include "protocol/carriers/candump.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace towbench;
  std::string text(data, data + size);
  const auto line = protocol::read_candump(text);
  if (line) {
    std::array<char, protocol::kMaxCandumpLine> again{};
    const auto written = protocol::write_candump(*line, again);
    const auto reread = protocol::read_candump(written);
    core::check(reread.has_value());
    core::check(reread->time_ns == line->time_ns && reread->interface == line->interface &&
                reread->frame == line->frame);
  }
  return 0;
}
