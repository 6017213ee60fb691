// The strongest sinusoid of a signal: frequency, amplitude, and how sure they are.
//
// Coarse by the periodogram, fine by the phase: the record is cut into pieces, each piece's phase
// against the coarse frequency is found by least squares, and the slope of phase over time corrects
// the frequency. The phases' scatter about that line is the interval, so noise of any colour around
// the line counts as it is.
#pragma once

#include <optional>
#include <span>

#include "study/identify/tow/block_mean.h"

namespace towbench::study::identify {

struct SpectralLine {
  UncertainMean frequency_Hz;
  UncertainMean amplitude;
  double phase_turns = 0;     // of the sine at the record's start
  double share_of_power = 0;  // of the signal's variance, 0 .. 1
};

// Looks between the two frequencies. Empty when the record has fewer than sixteen periods of what
// it found.
[[nodiscard]] std::optional<SpectralLine> strongest_line(std::span<const double> samples,
                                                         double period_s, double from_Hz,
                                                         double to_Hz);

// Mean over a whole number of periods from the start of the record; its blocks are groups of
// periods. Empty with fewer than four periods.
[[nodiscard]] std::optional<UncertainMean> mean_over_periods(std::span<const double> samples,
                                                             double period_s, double frequency_Hz);

}  // namespace towbench::study::identify
