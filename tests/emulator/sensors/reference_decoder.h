// A quadrature decoder written from the encoder's data sheet, to judge the encoder: it knows lines
// and levels only, and counts by the table of allowed transitions.
#pragma once

#include <cstdint>

#include "emulator/sensors/quadrature_encoder.h"

namespace towbench::emulator {

class ReferenceDecoder {
 public:
  ReferenceDecoder(protocol::EncoderLevels levels, std::int64_t count)
      : a_((levels & 1U) != 0), b_((levels & 2U) != 0), index_((levels & 4U) != 0), count_(count) {}

  void toggle(protocol::EncoderLine line) {
    switch (line) {
      case protocol::EncoderLine::kA:
        // A rising while B is low, or falling while B is high: A leads, so upwards.
        count_ += (!a_ && !b_) || (a_ && b_) ? 1 : -1;
        a_ = !a_;
        return;
      case protocol::EncoderLine::kB:
        count_ += (!b_ && a_) || (b_ && !a_) ? 1 : -1;
        b_ = !b_;
        return;
      case protocol::EncoderLine::kIndex:
        index_ = !index_;
        return;
    }
  }

  [[nodiscard]] bool a() const { return a_; }
  [[nodiscard]] bool b() const { return b_; }
  [[nodiscard]] bool index() const { return index_; }
  [[nodiscard]] std::int64_t count() const { return count_; }

 private:
  bool a_;
  bool b_;
  bool index_;
  std::int64_t count_;
};

}  // namespace towbench::emulator
