#include "study/identify/tow/spectral_line.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace towbench::study::identify {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;

double mean_of(std::span<const double> samples) {
  double sum = 0;
  for (const double each : samples) {
    sum += each;
  }
  return sum / static_cast<double>(samples.size());
}

// 2/N sum x e^{-i w t}: amplitude and phase of a cosine at that frequency. Time from the start.
std::complex<double> projection(std::span<const double> samples, double mean, double period_s,
                                double frequency_Hz, double start_s = 0) {
  const auto turn = std::polar(1.0, -kTurn_rad * frequency_Hz * period_s);
  auto phasor = std::polar(1.0, -kTurn_rad * frequency_Hz * start_s);
  std::complex<double> sum = 0;
  for (const double each : samples) {
    sum += (each - mean) * phasor;
    phasor *= turn;
  }
  return sum * 2.0 / static_cast<double>(samples.size());
}

// Averages of `share` samples: the search needs no more than ten a period of its highest frequency.
std::vector<double> thinned(std::span<const double> samples, std::size_t share) {
  std::vector<double> fewer;
  for (std::size_t i = 0; i + share <= samples.size(); i += share) {
    fewer.push_back(mean_of(samples.subspan(i, share)));
  }
  return fewer;
}

double coarse_frequency(std::span<const double> samples, double period_s, double from_Hz,
                        double to_Hz) {
  constexpr double kSamplesAPeriod = 10;
  const auto share = std::max<std::size_t>(
      1, static_cast<std::size_t>(1.0 / (kSamplesAPeriod * to_Hz * period_s)));
  const auto fewer = thinned(samples, share);
  const double step_s = period_s * static_cast<double>(share);
  const double mean = mean_of(fewer);
  const double step_Hz = 0.25 / (step_s * static_cast<double>(fewer.size()));
  double best_Hz = from_Hz;
  double most = -1;
  for (double f = from_Hz; f <= to_Hz; f += step_Hz) {
    const double power = std::norm(projection(fewer, mean, step_s, f));
    if (power > most) {
      most = power;
      best_Hz = f;
    }
  }
  return best_Hz;
}

struct Piece {
  double middle_s = 0;
  double phase_turns = 0;
  double amplitude = 0;
};

// Pieces of whole periods of the coarse frequency.
std::vector<Piece> pieces_of(std::span<const double> samples, double period_s, double frequency_Hz,
                             std::size_t pieces) {
  const double periods = std::floor(static_cast<double>(samples.size()) * period_s * frequency_Hz /
                                    static_cast<double>(pieces));
  const auto rows = static_cast<std::size_t>(std::lround(periods / (frequency_Hz * period_s)));
  std::vector<Piece> found;
  double last = 0;
  for (std::size_t k = 0; k < pieces && (k + 1) * rows <= samples.size(); ++k) {
    const auto part = samples.subspan(k * rows, rows);
    const double start_s = static_cast<double>(k * rows) * period_s;
    const auto value = projection(part, mean_of(part), period_s, frequency_Hz, start_s);
    // Continued from the piece before, so that the phase does not wrap.
    const double turns = std::arg(value) / kTurn_rad;
    last += std::remainder(turns - last, 1.0);
    found.push_back({start_s + 0.5 * static_cast<double>(rows) * period_s, last, std::abs(value)});
  }
  return found;
}

// Phase of the pieces over time.
struct PhaseLine {
  double slope = 0;  // turns a second
  double slope_standard_error = 0;
  double start = 0;  // turns at the record's start
};

PhaseLine line_through(const std::vector<Piece>& pieces) {
  const auto count = static_cast<double>(pieces.size());
  double middle = 0;
  double phase = 0;
  for (const auto& piece : pieces) {
    middle += piece.middle_s / count;
    phase += piece.phase_turns / count;
  }
  double cross = 0;
  double square = 0;
  for (const auto& piece : pieces) {
    cross += (piece.middle_s - middle) * (piece.phase_turns - phase);
    square += (piece.middle_s - middle) * (piece.middle_s - middle);
  }
  PhaseLine line{.slope = cross / square};
  double residual = 0;
  for (const auto& piece : pieces) {
    residual += std::pow(piece.phase_turns - phase - line.slope * (piece.middle_s - middle), 2);
  }
  line.slope_standard_error = std::sqrt(residual / (count - 2) / square);
  line.start = phase - line.slope * middle;
  return line;
}

}  // namespace

std::optional<SpectralLine> strongest_line(std::span<const double> samples, double period_s,
                                           double from_Hz, double to_Hz) {
  constexpr std::size_t kPieces = 8;
  constexpr double kFewestPeriods = 16;
  if (samples.size() < kPieces) {
    return std::nullopt;
  }
  const double coarse = coarse_frequency(samples, period_s, from_Hz, to_Hz);
  if (static_cast<double>(samples.size()) * period_s * coarse < kFewestPeriods) {
    return std::nullopt;
  }
  // Once to correct the frequency, once more at the corrected one: beside the line, a piece has
  // some of the line's own image in it.
  const double near = coarse + line_through(pieces_of(samples, period_s, coarse, kPieces)).slope;
  const auto pieces = pieces_of(samples, period_s, near, kPieces);
  const auto found = line_through(pieces);
  std::vector<double> amplitudes;
  for (const auto& piece : pieces) {
    amplitudes.push_back(piece.amplitude);
  }
  SpectralLine line;
  const double degrees_of_freedom = static_cast<double>(pieces.size()) - 2;
  line.frequency_Hz = {near + found.slope, found.slope_standard_error, degrees_of_freedom};
  line.amplitude = mean_of_repeats(amplitudes);
  constexpr double kSineAfterCosine = 0.25;
  const double start = found.start + kSineAfterCosine;
  line.phase_turns = start - std::floor(start);
  const double mean = mean_of(samples);
  double variance = 0;
  for (const double each : samples) {
    variance += (each - mean) * (each - mean) / static_cast<double>(samples.size());
  }
  line.share_of_power =
      variance > 0 ? 0.5 * line.amplitude.value * line.amplitude.value / variance : 0.0;
  return line;
}

std::optional<UncertainMean> mean_over_periods(std::span<const double> samples, double period_s,
                                               double frequency_Hz) {
  constexpr double kFewest = 4;
  const double rows_a_period = 1.0 / (frequency_Hz * period_s);
  const double periods = std::floor(static_cast<double>(samples.size()) / rows_a_period);
  if (periods < kFewest) {
    return std::nullopt;
  }
  // Few and long: what the carriage gains in one period it gives back in the next.
  constexpr double kMostBlocks = 8;
  const double a_block = std::ceil(periods / kMostBlocks);
  std::vector<double> means;
  for (double at = 0; at + a_block <= periods; at += a_block) {
    const auto first = static_cast<std::size_t>(std::lround(at * rows_a_period));
    const auto last = static_cast<std::size_t>(std::lround((at + a_block) * rows_a_period));
    means.push_back(mean_of(samples.subspan(first, std::min(last, samples.size()) - first)));
  }
  return mean_of_repeats(means);
}

}  // namespace towbench::study::identify
