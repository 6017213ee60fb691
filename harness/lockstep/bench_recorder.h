// Who writes down the controller's side of a run: files (record/controller_recorder.h) or memory
// (fault_cases/case_record.h).
#pragma once

#include <cstdint>
#include <string_view>

#include "bbmc/host/controller_node.h"
#include "core/time.h"
#include "harness/experiment/operator_act.h"

namespace towbench::harness {

class BenchRecorder {
 public:
  BenchRecorder() = default;
  BenchRecorder(const BenchRecorder&) = delete;
  BenchRecorder& operator=(const BenchRecorder&) = delete;
  virtual ~BenchRecorder() = default;

  // Takes every row and event that waits in the controller.
  virtual void drain(bbmc::ControllerNode& controller) noexcept = 0;
  virtual void console(std::string_view text) noexcept = 0;
  // What the operator sent, as the controller took it; before what it prints in answer.
  virtual void typed(core::Nanoseconds /*time_ns*/, std::string_view /*text*/) noexcept {}
  // What a person did; before it takes effect.
  virtual void operator_acted(const OperatorAct& /*act*/) noexcept {}
  virtual void wire_event(core::Nanoseconds time_ns, std::string_view kind) noexcept = 0;
  // `host_ns` since the start of the run.
  virtual void timing(core::Nanoseconds time_ns, core::Nanoseconds host_ns,
                      core::Nanoseconds exchange_ns) noexcept = 0;
  virtual void flush() noexcept = 0;
  // Both as of the last flush().
  [[nodiscard]] virtual std::uint64_t rows() const noexcept = 0;
  [[nodiscard]] virtual bool good() const noexcept = 0;
};

}  // namespace towbench::harness
