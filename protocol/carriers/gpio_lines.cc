#include "protocol/carriers/gpio_lines.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include <gpiod.h>

#include "protocol/messages.h"

namespace towbench::protocol {
namespace {

constexpr const char* kLineConsumer = "towbench";
constexpr unsigned kAllLines = kWiredInputLines + kWiredOutputLines;

core::Nanoseconds monotonic_now() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * core::kNanosecondsPerSecond + now.tv_nsec;
}

std::string line_reason(int error) {
  return std::strerror(error);  // NOLINT(concurrency-mt-unsafe): set-up has one thread
}

struct Group {
  unsigned first;  // of the nine
  unsigned count;
};
constexpr Group kFromMachine{0, kWiredInputLines};
constexpr Group kToMachine{kWiredInputLines, kWiredOutputLines};

}  // namespace

class GpioLines::Chip {
 public:
  explicit Chip(gpiod_chip* chip) noexcept : chip_(chip) {
    ::gpiod_line_bulk_init(&heard_);
    ::gpiod_line_bulk_init(&driven_);
  }
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;
  ~Chip() {
    if (drives_) {
      (void)drive(0);
    }
    ::gpiod_chip_close(chip_);  // gives the lines back
  }

  // "" when both groups are ours, else why not.
  std::string take(const GpioPlace& place, LineSide side) {
    if (::gpiod_chip_num_lines(chip_) < place.first_line + kAllLines) {
      return "has " + std::to_string(::gpiod_chip_num_lines(chip_)) + " lines; " +
             std::to_string(kAllLines) + " are wanted from line " +
             std::to_string(place.first_line) + " on";
    }
    const bool controls = side == LineSide::kController;
    std::string trouble = collect(place.first_line, controls ? kFromMachine : kToMachine, heard_);
    if (trouble.empty()) {
      trouble = collect(place.first_line, controls ? kToMachine : kFromMachine, driven_);
    }
    if (!trouble.empty()) {
      return trouble;
    }
    const std::array<int, kWiredInputLines> inactive{};
    if (::gpiod_line_request_bulk_output(&driven_, kLineConsumer, inactive.data()) != 0) {
      return "cannot drive its lines: " + line_reason(errno);
    }
    drives_ = true;
    if (::gpiod_line_request_bulk_both_edges_events(&heard_, kLineConsumer) != 0) {
      return "gives no edge events: " + line_reason(errno);
    }
    return {};
  }

  core::Status drive(std::uint16_t lines) noexcept {
    std::array<int, kWiredInputLines> values{};
    for (unsigned i = 0; i < ::gpiod_line_bulk_num_lines(&driven_); ++i) {
      values[i] = (lines >> i) & 1;
    }
    return ::gpiod_line_set_value_bulk(&driven_, values.data()) == 0
               ? core::Status()
               : core::failure(core::ErrorCode::kTransportFailed);
  }

  // The lines' levels now, without their events.
  core::Result<std::uint16_t> levels() noexcept {
    std::array<int, kWiredInputLines> values{};
    if (::gpiod_line_get_value_bulk(&heard_, values.data()) != 0) {
      return core::failure(core::ErrorCode::kTransportFailed);
    }
    unsigned lines = 0;
    for (unsigned i = 0; i < ::gpiod_line_bulk_num_lines(&heard_); ++i) {
      lines |= values[i] != 0 ? 1U << i : 0U;
    }
    return static_cast<std::uint16_t>(lines);
  }

  // Every event that waits: counted, newest time kept.
  core::Status take_events(LineDebouncer& debouncer, LineLevels& levels) noexcept {
    const timespec at_once{0, 0};
    gpiod_line_bulk ready;
    int waiting = ::gpiod_line_event_wait_bulk(&heard_, &at_once, &ready);
    while (waiting > 0) {
      for (unsigned i = 0; i < ::gpiod_line_bulk_num_lines(&ready); ++i) {
        gpiod_line* line = ::gpiod_line_bulk_get_line(&ready, i);
        gpiod_line_event event{};
        if (::gpiod_line_event_read(line, &event) != 0) {
          return core::failure(core::ErrorCode::kTransportFailed);
        }
        const core::Nanoseconds time_ns =
            event.ts.tv_sec * core::kNanosecondsPerSecond + event.ts.tv_nsec;
        debouncer.edge(index_of(line), event.event_type == GPIOD_LINE_EVENT_RISING_EDGE, time_ns);
        levels.edge_ns = time_ns > levels.edge_ns ? time_ns : levels.edge_ns;
        ++levels.edges;
      }
      waiting = ::gpiod_line_event_wait_bulk(&heard_, &at_once, &ready);
    }
    return waiting == 0 ? core::Status() : core::failure(core::ErrorCode::kTransportFailed);
  }

 private:
  [[nodiscard]] unsigned index_of(gpiod_line* line) noexcept {
    for (unsigned i = 0; i < ::gpiod_line_bulk_num_lines(&heard_); ++i) {
      if (::gpiod_line_bulk_get_line(&heard_, i) == line) {
        return i;
      }
    }
    return 0;
  }

  std::string collect(unsigned first_line, const Group& group, gpiod_line_bulk& into) {
    for (unsigned i = 0; i < group.count; ++i) {
      const unsigned number = first_line + group.first + i;
      gpiod_line* line = ::gpiod_chip_get_line(chip_, number);
      if (line == nullptr) {
        return "line " + std::to_string(number) + ": " + line_reason(errno);
      }
      if (::gpiod_line_is_used(line)) {
        const char* holder = ::gpiod_line_consumer(line);
        return "line " + std::to_string(number) + " is taken by " +
               (holder != nullptr ? holder : "the kernel");
      }
      ::gpiod_line_bulk_add(&into, line);
    }
    return {};
  }

  gpiod_chip* chip_;
  gpiod_line_bulk heard_;
  gpiod_line_bulk driven_;
  bool drives_ = false;
};

GpioLines::GpioLines(std::unique_ptr<Chip> chip, LineDebouncer debouncer) noexcept
    : chip_(std::move(chip)), debouncer_(debouncer) {}

GpioLines::~GpioLines() = default;

CarrierResult<std::unique_ptr<GpioLines>> GpioLines::open(const GpioPlace& place, LineSide side) {
  const auto refuse = [&](const std::string& why) {
    return carrier_failure(core::ErrorCode::kTransportFailed, place.chip + ": " + why);
  };
  gpiod_chip* opened = ::gpiod_chip_open_lookup(place.chip.c_str());
  if (opened == nullptr) {
    return refuse("no such GPIO chip, or no right to open it (" + line_reason(errno) + ")");
  }
  auto chip = std::make_unique<Chip>(opened);
  if (const auto trouble = chip->take(place, side); !trouble.empty()) {
    return refuse(trouble);
  }
  const auto levels = chip->levels();
  if (!levels) {
    return refuse("its lines cannot be read");
  }
  return std::unique_ptr<GpioLines>(
      new GpioLines(std::move(chip), LineDebouncer(*levels, place.debounce_ns)));
}

core::Result<LineLevels> GpioLines::read() noexcept {
  seen_.edges = 0;
  if (const auto status = chip_->take_events(debouncer_, seen_); !status) {
    return core::failure(status.error());
  }
  seen_.lines = debouncer_.settled(monotonic_now());
  return seen_;
}

core::Status GpioLines::write(std::uint16_t lines) noexcept {
  return chip_->drive(lines);
}

}  // namespace towbench::protocol
