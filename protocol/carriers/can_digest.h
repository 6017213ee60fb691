// An EncoderReport in one CAN frame, without loss.
//
// Most of a report follows from the one before: its time, and the capture period when the interval
// had one edge or none. Both ends keep the last report; what cannot be told in one frame (a first
// report, an irregular interval, an illegal transition) goes whole, over several frames.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/messages.h"

namespace towbench::protocol {

class CanDigest {
 public:
  struct Packed {
    std::uint64_t digest = 0;
    std::optional<std::uint64_t> index;  // to be sent before the digest
  };

  // Nothing when expand() would not give the same report again.
  [[nodiscard]] std::optional<Packed> compress(const EncoderReport& report) const noexcept;

  // The report that the words stand for. Nothing when the frame before is missing, or when the
  // interval is not known yet.
  [[nodiscard]] std::optional<EncoderReport> expand(core::Axis axis,
                                                    const Packed& packed) const noexcept;

  // The report that was sent or received, packed or whole.
  void note(const EncoderReport& report) noexcept;

  // Something is missing: two whole reports in a row are needed again.
  void forget() noexcept { noted_ = 0; }

 private:
  EncoderReport last_;
  core::Nanoseconds interval_ns_ = 0;
  unsigned noted_ = 0;  // reports in a row, up to two: then the interval is known
};

}  // namespace towbench::protocol
