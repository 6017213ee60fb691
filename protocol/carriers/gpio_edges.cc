#include "protocol/carriers/gpio_edges.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace towbench::protocol {
namespace {

constexpr const char* kEdgeConsumer = "towbench encoder";

unsigned lines_of(bool with_index) noexcept {
  return with_index ? kEncoderChannelsAndIndex : kEncoderChannels;
}

std::string edge_reason(int error) {
  return std::strerror(error);  // NOLINT(concurrency-mt-unsafe): set-up has one thread
}

// A chip's own descriptor, for as long as lines are asked for.
class Chip {
 public:
  explicit Chip(const std::string& name)
      : descriptor_(
            ::open((name.starts_with('/') ? name : "/dev/" + name).c_str(), O_RDWR | O_CLOEXEC)) {}
  Chip(const Chip&) = delete;
  Chip& operator=(const Chip&) = delete;
  ~Chip() {
    if (descriptor_ >= 0) {
      ::close(descriptor_);
    }
  }
  [[nodiscard]] bool is_open() const noexcept { return descriptor_ >= 0; }
  template <typename Argument>
  [[nodiscard]] bool call(unsigned long request, Argument& argument) const noexcept {
    return ::ioctl(descriptor_, request, &argument) == 0;
  }

 private:
  int descriptor_;
};

// Who stands in the way, "" when nobody does.
std::string trouble_with(const Chip& chip, const EdgePlace& place) {
  gpiochip_info about{};
  if (!chip.call(GPIO_GET_CHIPINFO_IOCTL, about)) {
    return "is no GPIO chip (" + edge_reason(errno) + ")";
  }
  const unsigned count = lines_of(place.with_index);
  if (about.lines < count || about.lines - count < place.first_line) {
    return "has " + std::to_string(about.lines) + " lines; " + std::to_string(count) +
           " are wanted from line " + std::to_string(place.first_line) + " on";
  }
  for (unsigned i = 0; i < count; ++i) {
    gpio_v2_line_info line{};
    line.offset = place.first_line + i;
    if (chip.call(GPIO_V2_GET_LINEINFO_IOCTL, line) && (line.flags & GPIO_V2_LINE_FLAG_USED) != 0) {
      return "line " + std::to_string(line.offset) + " is taken by " +
             (line.consumer[0] != '\0' ? line.consumer : "the kernel");
    }
  }
  return {};
}

}  // namespace

CarrierResult<RequestedLines> RequestedLines::request(const EdgePlace& place, Use use) {
  const auto refuse = [&](const std::string& why) {
    return carrier_failure(core::ErrorCode::kTransportFailed, place.chip + ": " + why);
  };
  const Chip chip(place.chip);
  if (!chip.is_open()) {
    return refuse("no such GPIO chip, or no right to open it (" + edge_reason(errno) + ")");
  }
  if (const auto trouble = trouble_with(chip, place); !trouble.empty()) {
    return refuse(trouble);
  }
  gpio_v2_line_request request{};
  request.num_lines = lines_of(place.with_index);
  for (unsigned i = 0; i < request.num_lines; ++i) {
    request.offsets[i] = place.first_line + i;
  }
  std::strncpy(request.consumer, kEdgeConsumer, sizeof request.consumer - 1);
  if (use == Use::kReadEdges) {
    request.config.flags =
        GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_EDGE_RISING | GPIO_V2_LINE_FLAG_EDGE_FALLING;
    request.event_buffer_size = kEdgeQueue;
  } else {
    request.config.flags = GPIO_V2_LINE_FLAG_OUTPUT;  // low
  }
  if (!chip.call(GPIO_V2_GET_LINE_IOCTL, request) || request.fd < 0) {
    return refuse((use == Use::kReadEdges ? "gives no edges: " : "cannot drive its lines: ") +
                  edge_reason(errno));
  }
  if (::fcntl(request.fd, F_SETFL, O_NONBLOCK) != 0) {
    ::close(request.fd);
    return refuse("cannot be read without waiting: " + edge_reason(errno));
  }
  return RequestedLines(request.fd);
}

RequestedLines::~RequestedLines() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

CarrierResult<std::unique_ptr<GpioEdgeReader>> GpioEdgeReader::open(const EdgePlace& place) {
  auto lines = RequestedLines::request(place, RequestedLines::Use::kReadEdges);
  if (!lines) {
    return tl::unexpected<CarrierError>(lines.error());
  }
  return std::unique_ptr<GpioEdgeReader>(new GpioEdgeReader(place, std::move(*lines)));
}

core::Result<std::span<const LineEdge>> GpioEdgeReader::read() noexcept {
  std::array<gpio_v2_line_event, 64> events{};
  for (;;) {
    const auto bytes = ::read(lines_.descriptor(), events.data(), sizeof events);
    if (bytes < 0 && errno == EINTR) {
      continue;
    }
    if (bytes < 0 && errno == EAGAIN) {
      return order_.take(now_ns());
    }
    if (bytes <= 0) {
      return core::failure(core::ErrorCode::kTransportFailed);
    }
    const auto count = static_cast<std::size_t>(bytes) / sizeof(gpio_v2_line_event);
    for (const auto& event : std::span(events).first(count)) {
      const NumberedEdge edge{
          .sequence = event.seqno,
          .line_sequence = event.line_seqno,
          .edge = {.place = static_cast<std::uint8_t>(event.offset - place_.first_line),
                   .time_ns = static_cast<core::Nanoseconds>(event.timestamp_ns)}};
      if (const auto status = order_.add(edge); !status) {
        return core::failure(status.error());
      }
    }
  }
}

core::Result<std::uint8_t> GpioEdgeReader::levels() noexcept {
  gpio_v2_line_values values{};
  values.mask = (1U << lines_of(place_.with_index)) - 1U;
  if (::ioctl(lines_.descriptor(), GPIO_V2_LINE_GET_VALUES_IOCTL, &values) != 0) {
    return core::failure(core::ErrorCode::kTransportFailed);
  }
  return static_cast<std::uint8_t>(values.bits & values.mask);
}

core::Nanoseconds GpioEdgeReader::now_ns() const noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * core::kNanosecondsPerSecond + now.tv_nsec;
}

CarrierResult<std::unique_ptr<GpioEdgeDriver>> GpioEdgeDriver::open(const EdgePlace& place) {
  auto lines = RequestedLines::request(place, RequestedLines::Use::kDrive);
  if (!lines) {
    return tl::unexpected<CarrierError>(lines.error());
  }
  return std::unique_ptr<GpioEdgeDriver>(new GpioEdgeDriver(std::move(*lines), place.with_index));
}

GpioEdgeDriver::~GpioEdgeDriver() {
  for (unsigned place = 0; place < lines_of(has_index_); ++place) {
    (void)set(place, false);
  }
}

core::Status GpioEdgeDriver::set(unsigned place, bool level) noexcept {
  gpio_v2_line_values values{};
  values.mask = std::uint64_t{1} << place;
  values.bits = level ? values.mask : 0;
  return ::ioctl(lines_.descriptor(), GPIO_V2_LINE_SET_VALUES_IOCTL, &values) == 0
             ? core::Status()
             : core::failure(core::ErrorCode::kTransportFailed);
}

}  // namespace towbench::protocol
