#include "protocol/carriers/load.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "protocol/carriers/can_fd_segments.h"
#include "protocol/carriers/can_packer.h"
#include "protocol/carriers/can_segments.h"
#include "protocol/carriers/serial_port.h"
#include "protocol/cobs.h"

namespace towbench::protocol {
namespace {

// A payload of `size` bytes as a frame, however its bytes need stuffing.
double cobs_frame_bits(std::size_t size) noexcept {
  const std::size_t body = size + kCrcSize;
  return static_cast<double>((body + cobs_overhead(body) + 1) * kBitsPerSerialByte);
}

template <typename Message>
double cobs_bits() noexcept {
  return cobs_frame_bits(encoded_size(Message{}));
}

// All edges of one axis in one exchange; full messages first.
double edges_bits(double edges) noexcept {
  const double full = std::floor(edges / static_cast<double>(kMaxEdgesPerMessage));
  const auto rest =
      static_cast<std::size_t>(edges - full * static_cast<double>(kMaxEdgesPerMessage));
  return full * cobs_frame_bits(kMaxPayloadSize) +
         cobs_frame_bits(kEdgesHeaderSize + kBytesPerEdge * rest);
}

template <typename Message>
double whole_message_frames() noexcept {
  return static_cast<double>(segments_of(encoded_size(Message{})));
}

// All edges of one axis in one exchange over FD frames; full messages first. `ratio`: nominal rate
// over that of the data.
double fd_edges_bits(double edges, double ratio) noexcept {
  const auto message_bits = [ratio](std::size_t payload) {
    const auto frame_bits = [ratio](std::size_t size) {
      const CanFdBits bits = worst_can_fd_bits(static_cast<unsigned>(size));
      return bits.nominal + bits.data * ratio;
    };
    return static_cast<double>(fd_segments_of(payload) - 1) * frame_bits(kCanFdDataSize) +
           frame_bits(last_fd_segment_of(payload));
  };
  const double full = std::floor(edges / static_cast<double>(kMaxEdgesPerMessage));
  const auto rest =
      static_cast<std::size_t>(edges - full * static_cast<double>(kMaxEdgesPerMessage));
  return full * message_bits(kMaxPayloadSize) +
         message_bits(kEdgesHeaderSize + kBytesPerEdge * rest);
}

std::string rounded(double value) {
  if (!std::isfinite(value)) {
    return "infinitely many";
  }

  return std::to_string(std::llround(value));
}

}  // namespace

double Load::fraction() const noexcept {
  const double worst = is_shared ? to_plant_bit_per_s + to_controller_bit_per_s
                                 : std::max(to_plant_bit_per_s, to_controller_bit_per_s);
  return worst / capacity_bit_per_s;
}

Load serial_load(const Traffic& traffic, std::uint32_t baud) noexcept {
  const double exchange_s = core::seconds(traffic.exchange_ns);
  const double axes = traffic.axes;
  const double edges = std::ceil(traffic.edges_per_s * exchange_s);

  const double line_changes = traffic.line_changes_per_s * exchange_s;

  double to_plant = axes * cobs_bits<PwmDuty>() + line_changes * cobs_bits<DigitalOutputs>();
  double to_controller = line_changes * cobs_bits<DigitalInputs>();
  to_controller += axes * (traffic.fidelity == Fidelity::kEdges ? edges_bits(edges)
                                                                : cobs_bits<EncoderReport>());
  to_controller += traffic.force_samples ? cobs_bits<ForceSample>() : 0.0;
  to_controller += traffic.current_samples ? axes * cobs_bits<CurrentSample>() : 0.0;
  to_controller += traffic.references ? axes * cobs_bits<Reference>() : 0.0;
  to_controller += traffic.absolute_counts ? axes * cobs_bits<AbsoluteCount>() : 0.0;
  if (traffic.lockstep) {
    to_plant += cobs_bits<Advance>();
    to_controller += cobs_bits<Advanced>();
  }
  return {.to_plant_bit_per_s = to_plant / exchange_s,
          .to_controller_bit_per_s = to_controller / exchange_s,
          .capacity_bit_per_s = static_cast<double>(baud)};
}

Load can_load(const Traffic& traffic, std::uint32_t bit_per_s,
              std::uint32_t data_bit_per_s) noexcept {
  const double exchanges_per_s = 1.0 / core::seconds(traffic.exchange_ns);
  const double axes = traffic.axes;

  double to_plant = axes * exchanges_per_s + traffic.line_changes_per_s;
  double to_controller = traffic.line_changes_per_s;
  double edges_bit_per_s = 0.0;
  if (traffic.fidelity == Fidelity::kDigest) {
    to_controller += axes * exchanges_per_s + axes * traffic.index_pulses_per_s;
    to_controller += axes * exchanges_per_s * 2.0 / kReportsBetweenWholeOnes *
                     whole_message_frames<EncoderReport>();
  } else if (data_bit_per_s > 0) {
    const double edges = std::ceil(traffic.edges_per_s / exchanges_per_s);
    const double ratio = static_cast<double>(bit_per_s) / data_bit_per_s;
    edges_bit_per_s = axes * exchanges_per_s * fd_edges_bits(edges, ratio);
  } else {
    edges_bit_per_s = std::numeric_limits<double>::infinity();
  }
  to_controller +=
      traffic.force_samples ? exchanges_per_s * whole_message_frames<ForceSample>() : 0.0;
  to_controller += traffic.current_samples
                       ? axes * exchanges_per_s * whole_message_frames<CurrentSample>()
                       : 0.0;
  to_controller +=
      traffic.references ? axes * exchanges_per_s * whole_message_frames<Reference>() : 0.0;
  to_controller += traffic.absolute_counts
                       ? axes * exchanges_per_s * whole_message_frames<AbsoluteCount>()
                       : 0.0;
  if (traffic.lockstep) {
    to_plant += exchanges_per_s;
    to_controller += exchanges_per_s;
  }
  return {.to_plant_bit_per_s = to_plant * worst_can_bits(kCanDataSize),
          .to_controller_bit_per_s = to_controller * worst_can_bits(kCanDataSize) + edges_bit_per_s,
          .capacity_bit_per_s = static_cast<double>(bit_per_s),
          .is_shared = true};
}

CarrierResult<void> accept_load(const Load& load, const std::string& carrier_name) {
  // Written so that a load that is not a number is refused too.
  if (load.fraction() <= kMaxLoad) {
    return {};
  }
  return carrier_failure(
      core::ErrorCode::kCarrierOverloaded,
      carrier_name + ": the worst case is " + rounded(100.0 * load.fraction()) + " % of " +
          rounded(load.capacity_bit_per_s) + " bit/s (" + rounded(load.to_plant_bit_per_s) +
          " bit/s to the plant, " + rounded(load.to_controller_bit_per_s) +
          " bit/s to the controller); at most " + rounded(100.0 * kMaxLoad) + " % is allowed");
}

}  // namespace towbench::protocol
