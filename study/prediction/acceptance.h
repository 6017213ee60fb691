// What a cause must show before it is accepted, and when two are told apart.
#pragma once

#include "study/prediction/blocks.h"
#include "study/prediction/state.h"

namespace towbench::study::diagnose {

struct Limits {
  double alpha = 1e-3;        // over all that is tried
  double least_gain = 0.01;   // of the prediction error
  double least_errors = 2.5;  // standard errors of the gain above zero
  std::size_t most_causes = 6;
};

inline constexpr double kBeyondDoubt = 1e-12;  // a p-value that needs no count of blocks beside it
inline constexpr double kAlias = 2;  // standard errors below which two are told apart by nothing

// A gain there must be, however certain a cause is: of a million samples the least misfit of a law
// is.
[[nodiscard]] bool is_significant(const Limits& limits, const Comparison& gain, double p_value);

// What an effect makes, in newtons: less is nothing, however certain. What only reads or goes
// otherwise is no force: it must make more than rounding does, whose error follows the place, too.
[[nodiscard]] bool matters(const Frame& frame, const Effect& effect, const State& without_it,
                           const State& with_it);

// Within what each law allows, and where the model states it, off by more than is worth a name.
[[nodiscard]] bool is_worth_naming(const Frame& frame, const Effect& effect, const Parameters& p);
[[nodiscard]] bool all_are_worth_naming(const Frame& frame, const State& s);

// Whether it only follows the measured places with a body of its own invention: its mass lies at an
// end of what is believed, or its dry friction holds the largest input.
[[nodiscard]] bool has_collapsed(const Context& context, const State& s);

// Whether `with_it` takes away little beside what the causes of `s` do (weak_causes.h), with blocks
// weighed by what it leaves: without it those in which it acts are outlying, if it acts in few.
// `base_e`: innovations of the model without causes.
[[nodiscard]] bool is_weak(const Frame& frame, const State& s, const State& with_it,
                           const Eigen::VectorXd& base_e);

// Squares taken of those that were left beyond the encoder's steps.
[[nodiscard]] double share_of(const Frame& frame, double taken, double left, const State& s);

// Whether nothing tells two apart, or the other predicts better: here, and at the bandwidth at
// which no more than rounding is left.
[[nodiscard]] bool are_alike(const Frame& frame, const State& one, const State& other);
[[nodiscard]] bool is_better(const Frame& frame, const State& one, const State& other);

}  // namespace towbench::study::diagnose
