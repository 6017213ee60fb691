// Encoder channels on the lines of a GPIO chip, read edge by edge or driven.
//
// The second form of the kernel's own interface (linux/gpio.h), whose calls stand in gpio_edges.cc
// and nowhere else: one queue for all lines, with a time and two numbers at each edge. libgpiod 1.6
// speaks the first form, which keeps 16 edges of each line and says nothing when it loses one.
#pragma once

#include <memory>
#include <string>

#include "protocol/carriers/carrier_error.h"
#include "protocol/carriers/edge_order.h"
#include "protocol/carriers/edge_port.h"

namespace towbench::protocol {

struct EdgePlace {
  std::string chip;         // "gpiochip0" or a path
  unsigned first_line = 0;  // the chip's number of the first axis' A
  bool with_index = false;
};

// Lines that were asked of a chip; they go back when it ends.
class RequestedLines {
 public:
  enum class Use : std::uint8_t { kReadEdges, kDrive };
  // Refused in words that name the chip, the line and who has it.
  static CarrierResult<RequestedLines> request(const EdgePlace& place, Use use);
  explicit RequestedLines(int descriptor) noexcept : descriptor_(descriptor) {}
  RequestedLines(RequestedLines&& other) noexcept : descriptor_(other.descriptor_) {
    other.descriptor_ = -1;
  }
  RequestedLines& operator=(RequestedLines&&) = delete;
  RequestedLines(const RequestedLines&) = delete;
  RequestedLines& operator=(const RequestedLines&) = delete;
  ~RequestedLines();
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  int descriptor_;
};

class GpioEdgeReader final : public EdgeReader {
 public:
  static CarrierResult<std::unique_ptr<GpioEdgeReader>> open(const EdgePlace& place);

  core::Result<std::span<const LineEdge>> read() noexcept override;
  core::Result<std::uint8_t> levels() noexcept override;
  [[nodiscard]] core::Nanoseconds now_ns() const noexcept override;  // CLOCK_MONOTONIC
  [[nodiscard]] bool has_index() const noexcept override { return place_.with_index; }

 private:
  GpioEdgeReader(EdgePlace place, RequestedLines lines) noexcept
      : place_(std::move(place)), lines_(std::move(lines)) {}

  EdgePlace place_;
  RequestedLines lines_;
  EdgeOrder order_;
};

class GpioEdgeDriver final : public EdgeDriver {
 public:
  static CarrierResult<std::unique_ptr<GpioEdgeDriver>> open(const EdgePlace& place);
  ~GpioEdgeDriver() override;

  core::Status set(unsigned place, bool level) noexcept override;
  [[nodiscard]] bool has_index() const noexcept override { return has_index_; }

 private:
  GpioEdgeDriver(RequestedLines lines, bool has_index) noexcept
      : lines_(std::move(lines)), has_index_(has_index) {}

  RequestedLines lines_;
  bool has_index_;
};

}  // namespace towbench::protocol
