#include "bbmc/system/trajectory/prbs_program.h"

#include <array>
#include <cstddef>

#include "bbmc/system/trajectory/program_time.h"

namespace towbench::bbmc {
namespace {

constexpr std::int32_t kMinOrder = 4;
constexpr std::int32_t kMaxOrder = 11;
constexpr std::size_t kOrders = kMaxOrder - kMinOrder + 1;

// Two taps each where a primitive trinomial exists, else four (Ljung 1999, table 13.1): bit numbers
// of a register whose newest bit is 1, as a mask.
constexpr std::array<std::uint32_t, kOrders> kTaps{
    (1U << 0U) | (1U << 3U),                            // 4: 1, 4
    (1U << 1U) | (1U << 4U),                            // 5: 2, 5
    (1U << 0U) | (1U << 5U),                            // 6: 1, 6
    (1U << 2U) | (1U << 6U),                            // 7: 3, 7
    (1U << 0U) | (1U << 1U) | (1U << 6U) | (1U << 7U),  // 8: 1, 2, 7, 8
    (1U << 3U) | (1U << 8U),                            // 9: 4, 9
    (1U << 6U) | (1U << 9U),                            // 10: 7, 10
    (1U << 8U) | (1U << 10U),                           // 11: 9, 11
};

constexpr std::size_t kLongest = (1U << static_cast<unsigned>(kMaxOrder)) - 1U;

// Every sequence, worked out by the compiler: looking up a bit then costs the same for each.
struct Sequences {
  std::array<std::array<std::uint8_t, kLongest>, kOrders> bits{};
};

constexpr Sequences make_sequences() noexcept {
  Sequences sequences;
  for (std::size_t o = 0; o < kOrders; ++o) {
    const std::size_t order = o + kMinOrder;
    const std::uint32_t mask = (1U << order) - 1U;
    std::uint32_t state = mask;
    for (std::size_t i = 0; i < mask; ++i) {
      sequences.bits[o][i] = static_cast<std::uint8_t>((state >> (order - 1)) & 1U);
      std::uint32_t parity = state & kTaps[o];
      for (unsigned shift = 16; shift > 0; shift /= 2) {
        parity ^= parity >> shift;
      }
      state = ((state << 1U) | (parity & 1U)) & mask;
    }
  }
  return sequences;
}

constexpr Sequences kSequences = make_sequences();

}  // namespace

core::Result<PrbsProgram> PrbsProgram::make(const PrbsParameters& wanted) noexcept {
  const bool usable = is_duty(wanted.duty_pct) && is_time(wanted.bit_s) && is_time(wanted.wait_s) &&
                      wanted.order >= kMinOrder && wanted.order <= kMaxOrder && wanted.periods >= 1;
  if (!usable || core::nanoseconds(wanted.bit_s) == 0) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  PrbsProgram program;
  program.duty_pct_ = wanted.duty_pct;
  program.bit_ns_ = core::nanoseconds(wanted.bit_s);
  program.wait_ns_ = core::nanoseconds(wanted.wait_s);
  program.order_ = wanted.order;
  program.length_ = (std::int64_t{1} << wanted.order) - 1;
  program.periods_ = wanted.periods;
  if (!is_time(wanted.wait_s + wanted.bit_s * static_cast<double>(program.bits()))) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  return program;
}

double PrbsProgram::duty_pct(double time_s) const noexcept {
  const core::Nanoseconds tau_ns = whole_nanoseconds(time_s) - wait_ns_;
  if (tau_ns < 0 || tau_ns >= bits() * bit_ns_) {
    return 0;
  }
  const auto bit = static_cast<std::size_t>((tau_ns / bit_ns_) % length_);
  return kSequences.bits[static_cast<std::size_t>(order_ - kMinOrder)][bit] != 0 ? duty_pct_
                                                                                 : -duty_pct_;
}

double PrbsProgram::duration_s() const noexcept {
  return core::seconds(wait_ns_ + bits() * bit_ns_);
}

}  // namespace towbench::bbmc
