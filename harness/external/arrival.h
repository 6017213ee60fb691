// How a controller comes to the bench: by itself, or because the bench starts it.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "harness/external/controller_process.h"
#include "harness/external/external_controller.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/temporary_folder.h"
#include "protocol/carriers/connection.h"

namespace towbench::harness {

inline constexpr auto kProcessComes = std::chrono::seconds(30);

// The command with the bench's address for every {address}.
[[nodiscard]] std::string with_address(std::string command, const std::string& address);

// Waits for the controller to come and greet; starts it where it is the bench's to start.
class Arrival {
 public:
  // What a process prints is appended to `printed`. Controller and watchers outlive this.
  Arrival(const ExternalController& controller, std::filesystem::path printed,
          const LoopWatchers& watchers);

  // Empty when a controller has greeted; else why not.
  [[nodiscard]] std::string await();

  // Of a controller that has greeted.
  [[nodiscard]] protocol::Connection& connection() { return *connection_; }
  [[nodiscard]] protocol::TurnLink& link() { return connection_->link(); }
  [[nodiscard]] const protocol::Hello& hello() const { return hello_; }
  // What the process did at its end that it should not; empty when there is none.
  [[nodiscard]] std::string join();

 private:
  using Clock = std::chrono::steady_clock;

  // Asked when the bench listens already.
  bool goes_on();
  std::string nobody_came();
  [[nodiscard]] std::string note_of_missing_address() const;

  const ExternalController& controller_;
  std::filesystem::path printed_;
  const LoopWatchers& watchers_;
  TemporaryFolder socket_;  // that only this user may enter
  protocol::CarrierAddress address_;
  Clock::time_point deadline_;
  bool told_ = false;
  std::unique_ptr<protocol::Connection> connection_;
  protocol::Hello hello_;
  std::optional<ControllerProcess> process_;
};

}  // namespace towbench::harness
