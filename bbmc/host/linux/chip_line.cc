#include "bbmc/host/linux/chip_line.h"

#include <cerrno>
#include <charconv>
#include <ctime>

#include <gpiod.h>
#include <poll.h>

namespace towbench::bbmc {
namespace {

constexpr const char* kConsumer = "towbench";

}  // namespace

ChipLine::~ChipLine() {
  if (line_ != nullptr && is_output_) {
    static_cast<void>(drive(false));
  }
  if (chip_ != nullptr) {
    ::gpiod_chip_close(chip_);  // gives the line back
  }
}

core::Status ChipLine::open(const std::string& place, Direction direction, bool active_low,
                            DeviceTrouble& trouble) {
  place_ = place;
  trouble_ = &trouble;
  const auto colon = place.rfind(':');
  unsigned offset = 0;
  const char* const end = place.data() + place.size();
  if (colon == std::string::npos ||
      std::from_chars(place.data() + colon + 1, end, offset).ptr != end ||
      colon + 1 == place.size()) {
    return trouble.note(DeviceCall::kOpen, place_, EINVAL);
  }
  chip_ = ::gpiod_chip_open_lookup(place.substr(0, colon).c_str());
  if (chip_ == nullptr) {
    return trouble.note(DeviceCall::kOpen, place_, errno);
  }
  gpiod_line* const line = ::gpiod_chip_get_line(chip_, offset);
  if (line == nullptr) {
    return trouble.note(DeviceCall::kOpen, place_, ENOENT);
  }
  const int flags = active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  is_output_ = direction == Direction::kOut;
  const int taken = is_output_
                        ? ::gpiod_line_request_output_flags(line, kConsumer, flags, 0)
                        : ::gpiod_line_request_both_edges_events_flags(line, kConsumer, flags);
  if (taken != 0) {
    return trouble.note(DeviceCall::kOpen, place_, errno);
  }
  line_ = line;
  return {};
}

core::Result<bool> ChipLine::level() noexcept {
  const int value = ::gpiod_line_get_value(line_);
  if (value < 0) {
    return core::failure(trouble_->note(DeviceCall::kRead, place_, errno).error());
  }
  return value != 0;
}

core::Status ChipLine::drive(bool active) noexcept {
  return ::gpiod_line_set_value(line_, active ? 1 : 0) == 0
             ? core::Status()
             : trouble_->note(DeviceCall::kWrite, place_, errno);
}

core::Result<bool> ChipLine::next_edge(LineEdge& edge) noexcept {
  pollfd waiting{.fd = ::gpiod_line_event_get_fd(line_), .events = POLLIN, .revents = 0};
  const int ready = ::poll(&waiting, 1, 0);
  if (ready == 0 || (ready < 0 && errno == EINTR)) {
    return false;
  }
  gpiod_line_event event{};
  if (ready < 0 || ::gpiod_line_event_read(line_, &event) != 0) {
    return core::failure(trouble_->note(DeviceCall::kRead, place_, errno).error());
  }
  edge = {.time_ns = event.ts.tv_sec * core::kNanosecondsPerSecond + event.ts.tv_nsec,
          .active = event.event_type == GPIOD_LINE_EVENT_RISING_EDGE};
  return true;
}

}  // namespace towbench::bbmc
