// Stands between controller and plant in a run that is judged for faults: notes what crosses, lets
// the link fail, and can take the wheel to find out what braking could have done at best.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "harness/fault_cases/case_record.h"
#include "harness/link/link_faults.h"
#include "harness/link/peer_control.h"
#include "harness/link/plant_end.h"
#include "harness/link/time_watcher.h"
#include "protocol/each_message.h"
#include "protocol/tee_sink.h"

namespace towbench::harness {

// From `from_ns` to `until_ns` the axis is driven with `duty` in `direction`, whatever the
// controller says; afterwards it is not driven at all.
struct FullReverse {
  core::Axis axis = core::kFirstAxis;
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds until_ns = std::numeric_limits<core::Nanoseconds>::max();
  int direction = -1;
  double duty = 1;  // 0 .. 1
};

class CaseLink final : public PlantEnd {
 public:
  // All outlive this. `peer` is whoever can end and restart the process behind `plant`.
  CaseLink(PlantEnd& plant, PeerControl& peer, const std::vector<LinkFault>& faults,
           CaseRecord& record);

  // Told of each exchange before the plant runs through it. Outlives this.
  void tell(TimeWatcher& watcher) noexcept { watcher_ = &watcher; }

  void take_over(const FullReverse& reverse) noexcept { to_plant_.reverse = reverse; }

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override;
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override;
  [[nodiscard]] bool happen(const emulator::ScheduledEvent& event) override {
    return plant_.happen(event);
  }
  [[nodiscard]] bool disturb(const LinkFault& fault) override;

 private:
  struct ToPlant final : protocol::EachMessage<ToPlant> {
    ToPlant(CaseLink& owner, const std::vector<LinkFault>& faults)
        : link(owner), disturber(faults, true) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      disturber.pass(message, link.now_ns_);
    }
    void handle(const protocol::PwmDuty& duty) noexcept;
    void handle(const protocol::DigitalOutputs& outputs) noexcept;
    void handle(const protocol::Advance& advance) noexcept;
    void drive_in_reverse() noexcept;
    [[nodiscard]] bool taken_over() const noexcept {
      return reverse && link.now_ns_ >= reverse->from_ns;
    }

    CaseLink& link;
    LinkDisturber disturber;
    std::optional<FullReverse> reverse{};
    std::uint32_t duty_sequence = 0;  // of the axis that may be taken over
    std::uint32_t outputs_sequence = 0;
    std::uint16_t period_ticks = 1000;
  };
  struct ToController final : protocol::EachMessage<ToController> {
    ToController(CaseLink& owner, const std::vector<LinkFault>& faults)
        : link(owner), disturber(faults, false) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      disturber.pass(message, link.until_ns_);
    }
    void handle(const protocol::Advanced& advanced) noexcept;

    CaseLink& link;
    LinkDisturber disturber;
  };
  // Behind the faults: what really arrives.
  struct Witness final : protocol::MessageSink {
    explicit Witness(CaseLink& owner) : link(owner) {}
    using MessageSink::on;
    void on(const protocol::EncoderEdges& edges) noexcept override;
    void on(const protocol::EncoderReport& report) noexcept override;
    void on(const protocol::DigitalInputs& inputs) noexcept override;
    void on(const protocol::CurrentSample& sample) noexcept override;
    void mix(std::uint64_t word) noexcept;

    CaseLink& link;
    std::uint64_t digest = 0;
  };

  // What happens to the peer or the bus by then.
  void strike(core::Nanoseconds time_ns) noexcept;
  [[nodiscard]] bool is_lost() const noexcept { return lost_ != core::ErrorCode::kNone; }
  // A node that is off its bus puts nothing on it, and hears of that from its driver.
  [[nodiscard]] bool sends() const noexcept { return !is_lost() && !is_off_bus_; }

  PlantEnd& plant_;
  PeerControl& peer_;
  CaseRecord& record_;
  TimeWatcher* watcher_ = nullptr;
  std::vector<LinkFault> blows_;  // not struck yet
  core::ErrorCode lost_ = core::ErrorCode::kNone;
  bool is_off_bus_ = false;
  ToPlant to_plant_;
  ToController to_controller_;
  Witness witness_{*this};
  std::optional<protocol::TeeSink> witnessed_;
  core::Nanoseconds now_ns_ = 0;    // what the controller acts at
  core::Nanoseconds until_ns_ = 0;  // what the plant runs to
};

}  // namespace towbench::harness
