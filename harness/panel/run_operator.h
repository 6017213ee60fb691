// What a page may do to a run under way, whatever its clock. Commands come from the server's
// thread; what a run cannot bear is refused in words.
#pragma once

#include <string>
#include <vector>

#include "core/time.h"
#include "harness/lockstep/operator.h"

namespace towbench::harness {

class RunOperator : public InteractiveOperator {
 public:
  struct Pace {
    double speed = 1;  // virtual over host time; 0: as fast as it goes
    bool paused = false;
  };

  // All throw FixtureError when they cannot be done.
  virtual void type(std::string bytes) = 0;
  // Injects from the next exchange on; the fault's own trigger is not used.
  virtual void inject_now(Fault fault) = 0;
  // Ends what inject_now() began.
  virtual void clear(const FaultPlace& place, FaultKind kind) = 0;
  virtual void set_speed(double speed) = 0;
  virtual void pause(bool paused) = 0;
  virtual void step(core::Nanoseconds length_ns) = 0;  // pauses behind it
  virtual void finish() = 0;
  // The stop flag has changed.
  virtual void wake() = 0;

  [[nodiscard]] virtual Pace pace() const = 0;
  // What is injected at present, in words, and why the last command came to nothing.
  [[nodiscard]] virtual std::vector<std::string> active_faults() const = 0;
  [[nodiscard]] virtual std::string take_trouble() = 0;
};

}  // namespace towbench::harness
