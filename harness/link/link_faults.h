// What a link may do to the messages of one direction. The lockstep's own messages (greeting,
// Advance, Advanced, Bye) pass: without them there is no run to look at. Where the two ends
// disagree about the baud rate nothing passes by itself, and the run ends when a turn is not
// understood.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/random.h"
#include "core/time.h"
#include "harness/fault_plan/fault_catalogue.h"
#include "protocol/cobs.h"
#include "protocol/message_sink.h"
#include "protocol/messages.h"

namespace towbench::harness {

struct LinkFault {
  FaultKind kind = FaultKind::kLoss;
  bool to_plant = false;
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds until_ns = 0;
  double amount = 0;  // probability, seconds, messages or ratio, as the catalogue has it
  std::uint64_t seed = 1;

  [[nodiscard]] bool acts_at(core::Nanoseconds time_ns) const noexcept {
    return time_ns >= from_ns && time_ns < until_ns;
  }
};

// What a link may lose, delay or damage.
using LinkMessage =
    std::variant<protocol::PwmDuty, protocol::DigitalOutputs, protocol::EncoderEdges,
                 protocol::EncoderReport, protocol::DigitalInputs, protocol::ForceSample,
                 protocol::CurrentSample, protocol::Heartbeat, protocol::Fault, protocol::Reference,
                 protocol::Reset, protocol::AbsoluteCount>;

class LinkDisturber {
 public:
  // Takes the faults of one direction. `to` outlives this.
  LinkDisturber(const std::vector<LinkFault>& faults, bool to_plant);

  void connect(protocol::MessageSink& to) noexcept { to_ = &to; }
  // Between two messages; one of the other direction is left out.
  void add(const LinkFault& fault);

  // A message on its way at `now_ns`.
  template <typename Message>
  void pass(const Message& message, core::Nanoseconds now_ns) {
    if constexpr (std::is_constructible_v<LinkMessage, const Message&>) {
      if (!faults_.empty()) {
        carry(message, now_ns);
        return;
      }
    }
    to_->on(message);
  }
  // A message of the lockstep's own. False when the other end does not understand it.
  template <typename Message>
  [[nodiscard]] bool pass_turn(const Message& message, core::Nanoseconds now_ns) {
    Acting* line = mismatched(now_ns);
    if (line == nullptr) {
      to_->on(message);
      return true;
    }
    std::array<std::byte, protocol::CobsFraming::kMaxFrameSize> frame;
    return misread(*line, std::span(frame).first(protocol::CobsFraming::append(message, frame)));
  }
  // The turn ends: what is due arrives, and what a flood brings.
  void end_turn(core::Nanoseconds now_ns);

 private:
  struct Acting {
    LinkFault fault;
    core::Random random;
    std::optional<LinkMessage> held{};  // reorder
    core::Nanoseconds last_due_ns = 0;
    std::unique_ptr<protocol::CobsReader> reader{};  // baud mismatch
  };
  struct Waiting {
    core::Nanoseconds due_ns = 0;
    LinkMessage message;
  };

  void carry(const LinkMessage& message, core::Nanoseconds now_ns);
  // From the fault with this index on.
  void carry_from(std::size_t index, const LinkMessage& message, core::Nanoseconds now_ns);
  void reorder(std::size_t index, const LinkMessage& message, core::Nanoseconds now_ns);
  void corrupt(Acting& acting, const LinkMessage& message);
  void arrive(const LinkMessage& message);
  // The fault that has the two ends disagree; null when none does.
  [[nodiscard]] Acting* mismatched(core::Nanoseconds now_ns) noexcept;
  // Whether a message came out of the frame's bits at the other end.
  bool misread(Acting& line, std::span<const std::byte> frame);

  bool to_plant_;
  std::vector<Acting> faults_;
  std::deque<Waiting> waiting_;
  protocol::MessageSink* to_ = nullptr;
};

}  // namespace towbench::harness
