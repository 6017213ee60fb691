// Tells a person what a machine refuses of its controller, with both sides' values, and counts it.
//
// Listens to what the controller sends and to what the plant notes; changes neither.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "emulator/plant_relay.h"
#include "protocol/each_message.h"
#include "protocol/link_counts.h"

namespace towbench::harness {

class Refusals final : public emulator::PlantRelay {
 public:
  // `tell` takes one line without its end; `observer` hears everything too. Both outlive this.
  Refusals(emulator::PlantObserver& observer, std::function<void(const std::string&)> tell)
      : PlantRelay(observer), tell_(std::move(tell)) {}

  // Hears the controller's messages before the plant does.
  [[nodiscard]] protocol::MessageSink& heard() noexcept { return heard_; }
  // Somebody else who hears them; outlives this.
  void pass_on_to(protocol::MessageSink& also) noexcept { heard_.also = &also; }

  void on_event(const emulator::PlantEvent& event) noexcept override;
  void on_refusal(const protocol::Hello& ours, const protocol::Hello& theirs,
                  core::ErrorCode why) noexcept override;

  // How many messages the plant refused.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  // What never reached the plant, by reason; empty when everything did.
  [[nodiscard]] static std::string dropped(const protocol::LinkCounts& counts);

 private:
  // Lines; what comes after them is counted only.
  static constexpr std::uint64_t kMostTold = 20;

  // The last message of a controller, in words.
  struct Heard final : protocol::EachMessage<Heard> {
    template <typename Message>
    void handle(const Message& message) noexcept {
      kind = Kind::kOther;
      keep(message);
      if (also != nullptr) {
        also->on(message);
      }
    }
    template <typename Message>
    void keep(const Message& /*message*/) noexcept {}
    void keep(const protocol::PwmDuty& message) noexcept {
      kind = Kind::kDuty;
      duty = message;
    }
    void keep(const protocol::DigitalOutputs& message) noexcept {
      kind = Kind::kOutputs;
      outputs = message;
    }
    void keep(const protocol::Advance& message) noexcept {
      kind = Kind::kAdvance;
      advance = message;
    }
    [[nodiscard]] std::string words() const;

    enum class Kind : std::uint8_t { kOther, kDuty, kOutputs, kAdvance } kind = Kind::kOther;
    protocol::PwmDuty duty;
    protocol::DigitalOutputs outputs;
    protocol::Advance advance;
    protocol::MessageSink* also = nullptr;
  };

  void tell(const std::string& line);

  std::function<void(const std::string&)> tell_;
  Heard heard_;
  std::uint64_t refused_ = 0;
};

}  // namespace towbench::harness
