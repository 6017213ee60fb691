// Boost.odeint's dense-output Dormand-Prince under the oracle, restarted at every event.
#include <cmath>

#include <boost/numeric/odeint.hpp>

#include "tests/support/axis_oracle.h"

namespace towbench::tests {
namespace {

namespace odeint = boost::numeric::odeint;
using State = AxisOracle::State;

// To order one: A, V, 100 rad, 100 rad/s, m, 0.1 m/s. The error norm is taken on scaled states.
constexpr State kScale{1, 1, 100, 100, 1, 0.1, 1};

State scaled(const State& y) {
  State s{};
  for (std::size_t i = 0; i < s.size(); ++i) {
    s[i] = y[i] / kScale[i];
  }
  return s;
}

State unscaled(const State& s) {
  State y{};
  for (std::size_t i = 0; i < s.size(); ++i) {
    y[i] = s[i] * kScale[i];
  }
  return y;
}

}  // namespace

void AxisOracle::advance(const Input& input, double duration_s) {
  begin(input);
  double now_s = 0;
  const auto rate_of = [this](const State& s, State& rate, double /*t*/) {
    State raw{};
    derivative(unscaled(s), raw);
    rate = scaled(raw);
  };
  constexpr double kFirstStep_s = 1e-5;
  constexpr double kLongestStep_s = 2e-5;  // so that no margin dips and comes back unseen
  while (now_s < duration_s) {
    auto stepper = odeint::make_dense_output(tolerance_, tolerance_, kLongestStep_s,
                                             odeint::runge_kutta_dopri5<State>());
    stepper.initialize(scaled(y_), now_s, kFirstStep_s);
    bool event = false;
    while (!event && now_s < duration_s) {
      const auto [from_s, reached_s] = stepper.do_step(rate_of);
      const double to_s = std::min(reached_s, duration_s);
      State at{};
      const auto margins_at = [&](double t) {
        stepper.calc_state(t, at);
        return margins(unscaled(at));
      };
      const Margins before = margins(y_);
      const Margins after = margins_at(to_s);
      double first_s = to_s;
      std::size_t which = kMargins;
      for (std::size_t i = 0; i < kMargins; ++i) {
        if (!(after[i] < 0)) {
          continue;
        }
        double low = from_s;
        double high = to_s;
        // A margin that starts at zero by construction counts as positive just after the start.
        for (int n = 0; n < 60 && high - low > 1e-15; ++n) {
          const double middle = 0.5 * (low + high);
          (margins_at(middle)[i] < 0 ? high : low) = middle;
        }
        if (which == kMargins || high < first_s) {
          first_s = high;
          which = i;
        }
      }
      static_cast<void>(before);
      stepper.calc_state(first_s, at);
      y_ = unscaled(at);
      now_s = first_s;
      if (which != kMargins) {
        handle(which);
        event = true;
      }
    }
  }
}

}  // namespace towbench::tests
