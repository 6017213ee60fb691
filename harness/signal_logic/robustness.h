// By how much a formula holds on a trace, sample by sample: positive while it holds, negative while
// it is broken, the distance of its signals from where that changes.
//
// Donze and Maler, Robust satisfaction of temporal logic over real-valued signals, FORMATS 2010,
// definition 3, read at the samples: always, eventually and until range over the samples within
// their bounds, as far as the record goes. Where a signal has no value, or no sample lies within
// the bounds, there is none (NaN), and whoever ranges over others passes it by. Between samples a
// signal keeps the value of the last one; that is what `after` reads at a deadline between two.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "harness/signal_logic/formula.h"
#include "harness/signal_logic/trace.h"

namespace towbench::harness {

enum class Reading : std::uint8_t {
  kMargin,  // in units of the comparison; of an event without bound
  kTruth,   // +1 and -1, with strict and other comparisons told apart
};

// One value a sample; linear in the samples for each part of the formula.
[[nodiscard]] std::vector<double> evaluate(const Formula& formula, const Trace& trace,
                                           Reading reading);

struct Robustness {
  // At the first sample. None: no signal, no sample, or no occasion to judge by.
  std::optional<double> margin{};
  bool holds = false;
  // Of what the outermost always, eventually and after range over: one value a sample, NaN where
  // they do not.
  std::vector<double> over_time{};
  std::optional<double> worst_s{};  // the first sample at which that is the margin
};
[[nodiscard]] Robustness robustness_of(const Formula& formula, const Trace& trace);

}  // namespace towbench::harness
