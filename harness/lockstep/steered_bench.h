// What an operator may do to a run under way, whoever controls.
#pragma once

#include "core/time.h"
#include "harness/lockstep/injection.h"

namespace towbench::harness {

class SteeredBench {
 public:
  SteeredBench() = default;
  SteeredBench(const SteeredBench&) = delete;
  SteeredBench& operator=(const SteeredBench&) = delete;
  virtual ~SteeredBench() = default;

  [[nodiscard]] virtual core::Nanoseconds now_ns() const noexcept = 0;
  [[nodiscard]] virtual core::Nanoseconds exchange_ns() const noexcept = 0;
  // What nobody had planned, from the next exchange on. False when it cannot be done here.
  [[nodiscard]] virtual bool inject(const Injection& injection) = 0;
  // The operator holds the run back, and does so for some time yet.
  virtual void wait_a_little() noexcept {}
};

}  // namespace towbench::harness
