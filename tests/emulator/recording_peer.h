// The other end of a plant under test: writes down every message and observation, in order.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "emulator/plant_node.h"
#include "protocol/message_sink.h"

namespace towbench::emulator {

// An axis's edges without the 4 kB of storage.
struct EdgeInterval {
  core::Axis axis;
  protocol::EncoderLevels start_levels;
  core::Nanoseconds start_ns;
  core::Nanoseconds end_ns;
  std::uint32_t sequence;
  std::vector<protocol::EncoderEdge> edges;
};

class RecordingPeer : public protocol::MessageSink, public PlantObserver {
 public:
  using Message = std::variant<protocol::HelloReply, EdgeInterval, protocol::EncoderReport,
                               protocol::DigitalInputs, protocol::Advanced, protocol::Fault,
                               protocol::Bye, protocol::ForceSample, protocol::CurrentSample,
                               protocol::Reset, protocol::AbsoluteCount>;

  using MessageSink::on;
  void on(const protocol::HelloReply& m) noexcept override { add("HelloReply", m); }
  void on(const protocol::EncoderEdges& m) noexcept override {
    add(m.axis == core::Axis::kY ? "EdgesY" : "EdgesX",
        EdgeInterval{m.axis,
                     m.start_levels,
                     m.start_ns,
                     m.end_ns,
                     m.sequence,
                     {m.edges.begin(), m.edges.end()}});
  }
  void on(const protocol::EncoderReport& m) noexcept override {
    add(m.axis == core::Axis::kY ? "ReportY" : "ReportX", m);
  }
  void on(const protocol::DigitalInputs& m) noexcept override { add("Inputs", m); }
  void on(const protocol::ForceSample& m) noexcept override { add("Force", m); }
  void on(const protocol::CurrentSample& m) noexcept override { add("Current", m); }
  void on(const protocol::Advanced& m) noexcept override { add("Advanced", m); }
  void on(const protocol::Fault& m) noexcept override { add("Fault", m); }
  void on(const protocol::Bye& m) noexcept override { add("Bye", m); }
  void on(const protocol::Reset& m) noexcept override { add("Reset", m); }
  void on(const protocol::AbsoluteCount& m) noexcept override {
    add(m.axis == core::Axis::kY ? "AbsoluteY" : "AbsoluteX", m);
  }

  void on_truth(const TruthRow& row) noexcept override { truth.push_back(row); }
  void on_event(const PlantEvent& event) noexcept override { events.push_back(event); }

  // The names of all messages so far, e.g. "HelloReply Inputs EdgesY EdgesX Advanced".
  [[nodiscard]] const std::string& order() const { return order_; }
  void forget() {
    order_.clear();
    messages.clear();
    truth.clear();
    events.clear();
  }

  template <typename M>
  [[nodiscard]] std::vector<M> all() const {
    std::vector<M> found;
    for (const Message& message : messages) {
      if (const M* m = std::get_if<M>(&message)) {
        found.push_back(*m);
      }
    }
    return found;
  }
  [[nodiscard]] std::vector<PlantEvent> all(PlantEventKind kind) const {
    std::vector<PlantEvent> found;
    for (const PlantEvent& event : events) {
      if (event.kind == kind) {
        found.push_back(event);
      }
    }
    return found;
  }

  std::vector<Message> messages;
  std::vector<TruthRow> truth;
  std::vector<PlantEvent> events;

 private:
  void add(const char* name, Message message) {
    order_ += order_.empty() ? "" : " ";
    order_ += name;
    messages.push_back(std::move(message));
  }

  std::string order_;
};

// A controller as a test needs it: greets, commands, advances.
class ScriptedController {
 public:
  ScriptedController(const RigParameters& rig, std::vector<ScheduledEvent> events = {},
                     std::uint64_t seed = 1)
      : plant(rig, seed, events, peer) {
    plant.connect(peer);
  }

  static protocol::Hello hello() {
    return {.role = protocol::Role::kController,
            .axes_mask = 3,
            .tick_ns = 100'000,
            .exchange_ns = 1'000'000,
            .capabilities = protocol::kCapabilityEdges};
  }
  void greet(const protocol::Hello& message = hello()) { plant.on(message); }
  void enable(std::uint16_t lines = 3) {
    plant.on(protocol::DigitalOutputs{.lines = lines, .sequence = output_sequence_++});
  }
  // Signed duty in PWM ticks of 1000.
  void drive(core::Axis axis, int ticks) {
    plant.on(
        protocol::PwmDuty{.axis = axis,
                          .enable = true,
                          .channel_a_ticks = static_cast<std::uint16_t>(ticks > 0 ? ticks : 0),
                          .channel_b_ticks = static_cast<std::uint16_t>(ticks < 0 ? -ticks : 0),
                          .period_ticks = 1000,
                          .sequence = duty_sequence_[axis]++});
  }
  void advance_by(core::Nanoseconds interval_ns) {
    plant.on(protocol::Advance{plant.now_ns() + interval_ns});
  }
  // Exchanges of 1 ms.
  void run_for(core::Nanoseconds duration_ns, core::Nanoseconds exchange_ns = 1'000'000) {
    for (core::Nanoseconds t = 0; t < duration_ns; t += exchange_ns) {
      advance_by(exchange_ns);
    }
  }

  RecordingPeer peer;
  PlantNode plant;

 private:
  std::uint32_t output_sequence_ = 0;
  core::PerAxis<std::uint32_t> duty_sequence_{};
};

// The nominal rig, both axes at rest at these places.
inline RigParameters rig_starting_at(double y_m, double x_m) {
  RigParameters rig;
  rig.axes[core::Axis::kY].start_m = y_m;
  rig.axes[core::Axis::kX].start_m = x_m;
  return rig;
}

}  // namespace towbench::emulator
