// A sink that writes every message down as text, so that a test compares what arrived, in order.
#pragma once

#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/each_message.h"

namespace towbench::protocol {

inline std::string text_of(const Hello& m) {
  std::ostringstream out;
  out << "Hello " << m.version << ' ' << int(m.role) << ' ' << int(m.axes_mask) << ' ' << m.tick_ns
      << ' ' << m.exchange_ns << ' ' << m.capabilities << ' ' << m.fixture_hash;
  return out.str();
}
inline std::string text_of(const HelloReply& m) {
  return "HelloReply " + text_of(m.plant) + ' ' + std::to_string(number_of(m.refusal));
}
inline std::string text_of(const PwmDuty& m) {
  std::ostringstream out;
  out << "PwmDuty " << name_of(m.axis) << ' ' << m.enable << ' ' << m.channel_a_ticks << ' '
      << m.channel_b_ticks << ' ' << m.period_ticks << ' ' << m.sequence;
  return out.str();
}
inline std::string text_of(const EncoderEdges& m) {
  std::ostringstream out;
  out << "EncoderEdges " << name_of(m.axis) << ' ' << int(m.start_levels) << ' ' << m.start_ns
      << ' ' << m.end_ns << ' ' << m.sequence;
  for (const EncoderEdge edge : m.edges) {
    out << ' ' << int(edge.line()) << '@' << edge.step_ns();
  }
  return out.str();
}
inline std::string text_of(const EncoderReport& m) {
  std::ostringstream out;
  out << "EncoderReport " << name_of(m.axis) << ' ' << int(m.levels) << ' ' << m.time_ns << ' '
      << m.count_change << ' ' << m.last_edge_ns << ' ' << m.capture_period_ns << ' '
      << m.index_count << ' ' << m.index_pulses << ' ' << m.illegal_transitions << ' '
      << m.sequence;
  return out.str();
}
inline std::string text_of(const DigitalInputs& m) {
  return "DigitalInputs " + std::to_string(m.lines) + ' ' + std::to_string(m.change_ns) + ' ' +
         std::to_string(m.sequence);
}
inline std::string text_of(const DigitalOutputs& m) {
  return "DigitalOutputs " + std::to_string(m.lines) + ' ' + std::to_string(m.change_ns) + ' ' +
         std::to_string(m.sequence);
}
inline std::string text_of(const ForceSample& m) {
  std::ostringstream out;
  out << std::setprecision(9) << "ForceSample " << m.time_ns;
  for (const float f : m.force_N) {
    out << ' ' << f;
  }
  for (const float t : m.torque_Nm) {
    out << ' ' << t;
  }
  return out.str();
}
inline std::string text_of(const CurrentSample& m) {
  std::ostringstream out;
  out << std::setprecision(9) << "CurrentSample " << name_of(m.axis) << ' ' << m.time_ns << ' '
      << m.armature_current_A;
  return out.str();
}
inline std::string text_of(const Advance& m) {
  return "Advance " + std::to_string(m.until_ns);
}
inline std::string text_of(const Advanced& m) {
  return "Advanced " + std::to_string(m.time_ns);
}
inline std::string text_of(const Heartbeat& m) {
  return "Heartbeat " + std::to_string(m.time_ns) + ' ' + std::to_string(m.sequence);
}
inline std::string text_of(const Fault& m) {
  return "Fault " + std::to_string(number_of(m.code)) + ' ' + std::to_string(m.time_ns) + ' ' +
         std::to_string(m.detail);
}
inline std::string text_of(const Bye& m) {
  return "Bye " + std::to_string(m.time_ns);
}
inline std::string text_of(const Reference& m) {
  std::ostringstream out;
  out << std::setprecision(9) << "Reference " << name_of(m.axis) << ' ' << m.time_ns << ' '
      << m.position_m << ' ' << m.velocity_m_per_s << ' ' << m.acceleration_m_per_s2;
  return out.str();
}
inline std::string text_of(const Reset& m) {
  return "Reset " + std::to_string(m.time_ns);
}
inline std::string text_of(const AbsoluteCount& m) {
  return "AbsoluteCount " + std::string(name_of(m.axis)) + ' ' + std::to_string(m.time_ns) + ' ' +
         std::to_string(m.count) + ' ' + std::to_string(m.sequence);
}

class RecordingSink final : public EachMessage<RecordingSink> {
 public:
  template <typename Message>
  void handle(const Message& message) noexcept {
    texts.push_back(text_of(message));
  }
  std::vector<std::string> texts;
};

// Takes everything and keeps nothing but the number.
class CountingSink final : public EachMessage<CountingSink> {
 public:
  template <typename Message>
  void handle(const Message& /*message*/) noexcept {
    ++count;
  }
  std::uint64_t count = 0;
};

}  // namespace towbench::protocol
