#include "protocol/carriers/sim_lines.h"

#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace towbench::protocol {

CarrierResult<std::unique_ptr<SimLines>> SimLines::open(const std::string& chip,
                                                        unsigned first_line) {
  std::unique_ptr<SimLines> lines(new SimLines);
  lines->pulls_.fill(-1);
  lines->values_.fill(-1);
  const auto file = [&](std::size_t line, const char* name, int mode) {
    const auto path = "/sys/bus/gpio/devices/" + chip + "/sim_gpio" +
                      std::to_string(first_line + line) + '/' + name;
    return ::open(path.c_str(), mode | O_CLOEXEC);
  };
  bool is_complete = true;
  for (std::size_t i = 0; i < kWiredInputLines; ++i) {
    lines->pulls_[i] = file(i, "pull", O_WRONLY);
    is_complete = is_complete && lines->pulls_[i] >= 0;
  }
  for (std::size_t i = 0; i < kWiredOutputLines; ++i) {
    lines->values_[i] = file(kWiredInputLines + i, "value", O_RDONLY);
    is_complete = is_complete && lines->values_[i] >= 0;
  }
  if (!is_complete) {
    return carrier_failure(
        core::ErrorCode::kTransportFailed,
        chip + ": is no simulated GPIO chip with lines " + std::to_string(first_line) + " to " +
            std::to_string(first_line + kWiredInputLines + kWiredOutputLines - 1) +
            " (gpio-sim), or no right to drive it");
  }
  return lines;
}

SimLines::~SimLines() {
  (void)write(0);
  for (const int descriptor : pulls_) {
    ::close(descriptor);
  }
  for (const int descriptor : values_) {
    ::close(descriptor);
  }
}

core::Result<LineLevels> SimLines::read() noexcept {
  LineLevels levels;
  for (std::size_t i = 0; i < values_.size(); ++i) {
    char value = 0;
    if (::pread(values_[i], &value, 1, 0) != 1) {
      return core::failure(core::ErrorCode::kTransportFailed);
    }
    levels.lines = static_cast<std::uint16_t>(levels.lines | (value == '1' ? 1U << i : 0U));
  }
  return levels;
}

core::Status SimLines::write(std::uint16_t lines) noexcept {
  for (std::size_t i = 0; i < pulls_.size(); ++i) {
    const bool active = ((unsigned{lines} >> i) & 1U) != 0;
    const bool was_active = ((unsigned{written_} >> i) & 1U) != 0;
    const std::string_view pull = active ? "pull-up" : "pull-down";
    if ((!is_written_ || active != was_active) &&
        ::pwrite(pulls_[i], pull.data(), pull.size(), 0) != static_cast<ssize_t>(pull.size())) {
      return core::failure(core::ErrorCode::kTransportFailed);
    }
  }
  written_ = lines;
  is_written_ = true;
  return {};
}

}  // namespace towbench::protocol
