// One side's end of a lockstep run, whatever carries it: the messages of a turn leave together, and
// wait() delivers what the peer sends until it leaves the word to us.
//
//   controller's process                       plant's process
//     link.peer() is given to the controller     link.peer() is given to the plant
//     plant.on(Advance) encodes and sends        while (link.wait(plant) is no Bye) {}
//     link.wait_for(Turn::kAdvanced, controller)
//
// Knows messages only, neither side. A carrier derives from this and says how bytes or frames
// become messages (lockstep_link.h, can_link.h).
#pragma once

#include <cstdint>

#include "core/result.h"
#include "core/time.h"
#include "protocol/carriers/turn_watch.h"
#include "protocol/link_counts.h"
#include "protocol/message_sink.h"

namespace towbench::protocol {

class TurnLink {
 public:
  // `silence_limit_ns` is host time.
  explicit TurnLink(core::Nanoseconds silence_limit_ns) noexcept
      : silence_limit_ns_(silence_limit_ns) {}
  TurnLink(const TurnLink&) = delete;
  TurnLink& operator=(const TurnLink&) = delete;
  virtual ~TurnLink() = default;

  // Messages to the peer. A failure to send shows in the next wait.
  [[nodiscard]] virtual MessageSink& peer() noexcept = 0;

  // Delivers messages to `here` until one that ends a turn has been delivered, and says which; Bye
  // comes last of those that arrived together. kPeerClosed when the carrier ended without one,
  // kPeerSilent when none came within the silence limit (a peer that babbles is silent too),
  // kTransportFailed otherwise. Every further call returns the same error.
  [[nodiscard]] core::Result<Turn> wait(MessageSink& here) noexcept;

  // The same, until `expected`: other turns pass, except that Bye is kPeerClosed.
  [[nodiscard]] core::Status wait_for(Turn expected, MessageSink& here) noexcept;

  // Delivers what comes within `timeout_ns`, once. True when a turn has ended, which wait() then
  // returns at once. That nothing came is no loss.
  [[nodiscard]] core::Result<bool> listen(MessageSink& here, core::Nanoseconds timeout_ns) noexcept;

  [[nodiscard]] virtual const LinkCounts& counts() const noexcept = 0;

 protected:
  enum class Progress : std::uint8_t { kNothing, kSomething };
  // Takes what the carrier has, waiting for at most `timeout_ns`, and delivers it to watch().
  virtual core::Result<Progress> read_once(core::Nanoseconds timeout_ns) noexcept = 0;
  [[nodiscard]] TurnWatch& watch() noexcept { return watch_; }

 private:
  template <typename Predicate>
  core::Status wait_until(Predicate is_over, MessageSink& here) noexcept;

  core::Nanoseconds silence_limit_ns_;
  core::Status lost_;
  TurnWatch watch_;
};

}  // namespace towbench::protocol
