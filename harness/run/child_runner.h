// The plant in a process of its own, which this run starts: over a socket, a serial line of its own
// or a carrier that is there already.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/link/emulator_process.h"
#include "harness/link/wires.h"
#include "harness/record/can_log.h"
#include "harness/run/runner.h"
#include "protocol/carriers/connection.h"

namespace towbench::harness {

class ChildRunner : public Runner {
 public:
  using Runner::Runner;
  [[nodiscard]] RunOutcome play() final;

 protected:
  // What this run says over the connection. `log` is null where no frames cross.
  [[nodiscard]] virtual RunOutcome play_over(EmulatorProcess& child,
                                             protocol::Connection& connection, CanLog* log) = 0;
  // `converse` with the plant, or with the plant and the real lines of the run.
  [[nodiscard]] RunOutcome with_lines(
      PlantEnd& plant, EdgeTimes times,
      const std::function<RunOutcome(PlantEnd&)>& conversation) const;

 private:
  using Wire = std::optional<protocol::CarrierEnds>;  // empty: a socket

  [[nodiscard]] std::vector<std::string> arguments() const;
  [[nodiscard]] std::unique_ptr<EmulatorProcess> start_child(const Wire& wire) const;
  [[nodiscard]] RunOutcome play_with(EmulatorProcess& child, const Wire& wire);
};

class LockstepChildRunner final : public ChildRunner {
 public:
  using ChildRunner::ChildRunner;

 private:
  [[nodiscard]] RunOutcome play_over(EmulatorProcess& child, protocol::Connection& connection,
                                     CanLog* log) override;
};

}  // namespace towbench::harness
