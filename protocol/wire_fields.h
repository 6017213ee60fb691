// Every message's fields in wire order, each with its legal range, written down once: the writer,
// the reader and the byte counter of the codec all walk these lists.
//
// `Io::Field<M>` is `const M` for a writer and `M` for a reader. An Io offers
//   value(field)             an integer of which every value is legal
//   checked(field, is_legal) an integer, enum or float with a range
//   flag(field)              a bool in one byte, 0 or 1
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "protocol/messages.h"

namespace towbench::protocol {

namespace legal {

inline constexpr auto axis = [](core::Axis a) { return core::index_of(a) < core::kMostAxes; };
inline constexpr auto axes_mask = [](std::uint8_t mask) { return mask < 1U << core::kMostAxes; };
inline constexpr auto role = [](Role r) { return r <= Role::kObserver; };
inline constexpr auto time = [](core::Nanoseconds t) { return t >= 0; };
inline constexpr auto levels = [](EncoderLevels l) { return l < 8U; };
inline constexpr auto finite = [](float f) { return std::isfinite(f); };
inline constexpr auto positive = [](std::uint16_t n) { return n > 0; };
inline constexpr auto code = [](core::ErrorCode c) { return core::is_known(c); };
inline constexpr auto input_lines = [](InputLines l) { return l < 1U << kInputLineCount; };
inline constexpr auto output_lines = [](std::uint16_t l) { return l < 1U << kOutputLineCount; };
inline constexpr auto edge_count = [](std::uint16_t n) { return n <= kMaxEdgesPerMessage; };

}  // namespace legal

// Layout frozen for all versions, so that a refusal can name both sides.
template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Hello>& m) noexcept {
  io.value(m.version);
  io.checked(m.role, legal::role);
  io.checked(m.axes_mask, legal::axes_mask);
  io.value(m.tick_ns);
  io.value(m.exchange_ns);
  io.value(m.capabilities);
  io.value(m.fixture_hash);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<HelloReply>& m) noexcept {
  wire_fields(io, m.plant);
  io.checked(m.refusal, legal::code);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<PwmDuty>& m) noexcept {
  io.checked(m.axis, legal::axis);
  io.flag(m.enable);
  io.value(m.channel_a_ticks);
  io.value(m.channel_b_ticks);
  io.checked(m.period_ticks, legal::positive);
  io.value(m.sequence);
}

// The part before the edges; the codec adds a 16-bit count and 32 bits an edge.
template <typename Io>
void wire_fields(Io& io, typename Io::template Field<EncoderEdges>& m) noexcept {
  io.checked(m.axis, legal::axis);
  io.checked(m.start_levels, legal::levels);
  io.checked(m.start_ns, legal::time);
  io.checked(m.end_ns, legal::time);
  io.value(m.sequence);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<EncoderReport>& m) noexcept {
  io.checked(m.axis, legal::axis);
  io.checked(m.levels, legal::levels);
  io.checked(m.time_ns, legal::time);
  io.value(m.count_change);
  io.checked(m.last_edge_ns, legal::time);
  io.value(m.capture_period_ns);
  io.value(m.index_count);
  io.value(m.index_pulses);
  io.value(m.illegal_transitions);
  io.value(m.sequence);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<DigitalInputs>& m) noexcept {
  io.checked(m.lines, legal::input_lines);
  io.checked(m.change_ns, legal::time);
  io.value(m.sequence);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<DigitalOutputs>& m) noexcept {
  io.checked(m.lines, legal::output_lines);
  io.checked(m.change_ns, legal::time);
  io.value(m.sequence);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<ForceSample>& m) noexcept {
  io.checked(m.time_ns, legal::time);
  for (auto& force : m.force_N) {
    io.checked(force, legal::finite);
  }
  for (auto& torque : m.torque_Nm) {
    io.checked(torque, legal::finite);
  }
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<CurrentSample>& m) noexcept {
  io.checked(m.axis, legal::axis);
  io.checked(m.time_ns, legal::time);
  io.checked(m.armature_current_A, legal::finite);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Advance>& m) noexcept {
  io.checked(m.until_ns, legal::time);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Advanced>& m) noexcept {
  io.checked(m.time_ns, legal::time);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Heartbeat>& m) noexcept {
  io.checked(m.time_ns, legal::time);
  io.value(m.sequence);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Fault>& m) noexcept {
  io.checked(m.code, legal::code);
  io.checked(m.time_ns, legal::time);
  io.value(m.detail);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Bye>& m) noexcept {
  io.checked(m.time_ns, legal::time);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Reference>& m) noexcept {
  io.checked(m.axis, legal::axis);
  io.checked(m.time_ns, legal::time);
  io.checked(m.position_m, legal::finite);
  io.checked(m.velocity_m_per_s, legal::finite);
  io.checked(m.acceleration_m_per_s2, legal::finite);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<Reset>& m) noexcept {
  io.checked(m.time_ns, legal::time);
}

template <typename Io>
void wire_fields(Io& io, typename Io::template Field<AbsoluteCount>& m) noexcept {
  io.checked(m.axis, legal::axis);
  io.checked(m.time_ns, legal::time);
  io.value(m.count);
  io.value(m.sequence);
}

// What no single field shows.
template <typename Message>
[[nodiscard]] constexpr bool is_consistent(const Message& /*message*/) noexcept {
  return true;
}
// Both channels active is legal on the wire: it is the machine that is wrong then, and the plant
// reports it (kBothChannelsActive).
template <>
[[nodiscard]] constexpr bool is_consistent(const PwmDuty& m) noexcept {
  return m.channel_a_ticks <= m.period_ticks && m.channel_b_ticks <= m.period_ticks;
}
template <>
[[nodiscard]] constexpr bool is_consistent(const EncoderReport& m) noexcept {
  return m.last_edge_ns <= m.time_ns;
}

}  // namespace towbench::protocol
