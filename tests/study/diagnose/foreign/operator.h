// Who drives a foreign machine while it is logged: a position loop, a relay, pulses of an open
// loop, or a hand at the load.
#pragma once

#include <memory>
#include <optional>

#include "tests/study/diagnose/foreign/plan.h"
#include "tests/study/diagnose/foreign/way.h"

namespace towbench::tests::foreign {

struct Command {
  double force_N = 0;                 // wanted of the drive
  std::optional<double> reference_m;  // where there is one
};

// A filtered difference of encoder readings.
class SpeedEstimate {
 public:
  SpeedEstimate(double period_s, double filter_s) : period_s_(period_s), filter_s_(filter_s) {}
  double update(double reading_m);

 private:
  double period_s_;
  double filter_s_;
  std::optional<double> last_m_;
  double speed_ = 0;
};

class Operator {
 public:
  virtual ~Operator() = default;
  // At each sample, from what the encoder reads.
  virtual Command command(double t_s, double reading_m) = 0;
  // Of a hand, at any instant: in the drive's place in a run of hand, else on the load.
  [[nodiscard]] virtual double hand_N(double /*t_s*/, double /*x_m*/, double /*v_m_per_s*/) const {
    return 0;
  }
  [[nodiscard]] virtual double start_m() const = 0;
};

[[nodiscard]] std::unique_ptr<Operator> make_operator(const RunPlan& run, const Machine& machine,
                                                      const Loop& loop);

}  // namespace towbench::tests::foreign
