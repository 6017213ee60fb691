// The plant in this process, but everything between goes over CAN frames: what a bus does to the
// data (the digest instead of edges) without a bus. Gives the same bits as a run over one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>

#include "harness/link/in_process_plant.h"
#include "protocol/carriers/can_link.h"

namespace towbench::harness {

class CanFramedPlant final : public PlantEnd, public PeerControl {
 public:
  // All outlive this.
  CanFramedPlant(const emulator::RigParameters& rig, std::uint64_t seed,
                 std::span<const emulator::ScheduledEvent> events,
                 emulator::PlantObserver& observer)
      : plant_(rig, seed, events, observer) {
    plant_.connect(far_.peer());
  }

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return near_.peer(); }
  void connect(protocol::MessageSink& controller) noexcept override { controller_ = &controller; }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    if (!to_plant_.frames.empty()) {
      if (const auto heard = far_.wait(plant_.sink()); !heard) {
        return core::failure(heard.error());
      }
      (void)plant_.wait_for(expected);
    }
    return near_.wait_for(expected, *controller_);
  }

  [[nodiscard]] core::ErrorCode kill_peer() noexcept override { return plant_.kill_peer(); }
  [[nodiscard]] core::ErrorCode restart_peer() noexcept override { return plant_.restart_peer(); }
  [[nodiscard]] core::ErrorCode leave_bus() noexcept override { return plant_.leave_bus(); }

 private:
  struct Bus {
    std::deque<protocol::CanFrame> frames;
  };
  // One node: puts its frames on one bus and takes those of the other.
  struct Port final : protocol::CanPort {
    Port(Bus& sends_to, Bus& hears_from) : out(sends_to), in(hears_from) {}
    core::Status send(std::span<const protocol::CanFrame> frames) noexcept override {
      out.frames.insert(out.frames.end(), frames.begin(), frames.end());
      return {};
    }
    core::Result<std::size_t> receive(std::span<protocol::CanFrame> into,
                                      core::Nanoseconds /*timeout_ns*/) noexcept override {
      if (in.frames.empty()) {  // nothing is on its way when somebody waits
        return core::failure(core::ErrorCode::kPeerSilent);
      }
      const std::size_t count = std::min(into.size(), in.frames.size());
      const auto end = in.frames.begin() + static_cast<std::ptrdiff_t>(count);
      std::copy(in.frames.begin(), end, into.begin());
      in.frames.erase(in.frames.begin(), end);
      return count;
    }
    Bus& out;
    Bus& in;
  };

  Bus to_plant_;
  Bus to_controller_;
  Port near_port_{to_plant_, to_controller_};
  Port far_port_{to_controller_, to_plant_};
  protocol::CanLink near_{near_port_, protocol::CanDirection::kToPlant};
  protocol::CanLink far_{far_port_, protocol::CanDirection::kToController};
  InProcessPlant plant_;
  protocol::MessageSink* controller_ = nullptr;
};

}  // namespace towbench::harness
