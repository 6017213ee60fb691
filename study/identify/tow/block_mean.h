// The mean of a coloured sequence and how sure it is.
//
// Neighbouring samples of a filtered sensor or of a swinging carriage are not independent, so the
// standard error is taken from means of blocks that are long against every memory in the signal
// (batch means: the scatter of b block means over the square root of b, with b - 1 degrees of
// freedom).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace towbench::study::identify {

struct UncertainMean {
  double value = 0;
  double standard_error = 0;      // of `value`
  double degrees_of_freedom = 0;  // behind `standard_error`
};

// Blocks of at least `block_rows`, between 4 and 40 of them: fewer rows than four blocks give
// shorter ones. Needs at least 8 samples; fewer give a standard error of infinity.
[[nodiscard]] UncertainMean block_mean(std::span<const double> samples, std::size_t block_rows);

// One period of a carriage that swings on its transmission against a held motor (4.12 Hz). It dies
// out over 1.4 s, so a steady part always has some of it left.
inline constexpr double kSwing_s = 0.243;

// Running mean over `rows`, twice: a triangle, which takes out a swing of that period and most of
// one that is a fifth slower or faster. Sample k of what is left belongs to sample k + rows - 1.
[[nodiscard]] std::vector<double> without_swing(std::span<const double> samples, std::size_t rows);

// Mean of steady motion without the swing. Its standard error is the scatter of blocks of two
// swings or more, each without its swing, about their own straight line (friction rises along the
// track: that is no noise). A plain mean of a block also has what the motion gained in it, which
// the next block gives back. What is too short for four such blocks: plain means of one swing each.
[[nodiscard]] UncertainMean steady_mean(std::span<const double> samples, double period_s);

// Mean of repeats that are independent of one another.
[[nodiscard]] UncertainMean mean_of_repeats(std::span<const double> repeats);

// share_a a + share_b b of independent means; degrees of freedom by Welch and Satterthwaite.
[[nodiscard]] UncertainMean combine(double share_a, const UncertainMean& a, double share_b,
                                    const UncertainMean& b);

// With a further, independent error of `share` of its value. `degrees_of_freedom`: of that error's
// standard error.
[[nodiscard]] UncertainMean doubted(const UncertainMean& mean, double share,
                                    double degrees_of_freedom);

// Half width of the two-sided 95 % interval over the standard error: Student's t.
[[nodiscard]] double student_factor(double degrees_of_freedom);

}  // namespace towbench::study::identify
