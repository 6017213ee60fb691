// run -circle, run -ellipse: both axes at once, from where the carriage stands. The path is exactly
// that shape at every instant: it is the speed along it that rises and falls (phase_ramp.h).
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/machine_axes.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

// What both have, behind their radii.
enum Common : std::size_t {
  kFrequency,
  kPeriod,
  kTurns,
  kEntry,
  kWait,
  kCentre,
  kDirection,
  kGainsY,
  kGainsX = kGainsY + 3,
  kCommonCount = kGainsX + 5,
};

constexpr std::array<OptionSpec, kCommonCount> kCommon{{
    {.name = "--frequency",
     .dimension = Dimension::kFrequency,
     .bare_unit = "Hz",
     .range = core::between(0.01, 2),
     .default_value = 0.15,
     .asked_by = AskedBy::kTraject,
     .meaning = "turns a second"},
    {.name = "--period",
     .presence = Presence::kOptional,
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0.5, 100),
     .meaning = "time of one turn, instead of --frequency"},
    {.name = "--turns",
     .dimension = Dimension::kNone,
     .range = core::between(0.01, 1000),
     .default_value = 2,
     .meaning = "how many, not necessarily whole"},
    {.name = "--entry",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0, 30),
     .default_value = 1,
     .meaning = "time from rest to full speed along the path, and back; 0 jumps as BBMC 0.5"},
    kWaitOption,
    {.name = "--centre",
     .kind = OptionKind::kChoice,
     .default_value = 0,
     .choices = "+|-",
     .meaning = "side of y on which the centre lies"},
    {.name = "--direction",
     .short_name = "-d",
     .kind = OptionKind::kChoice,
     .default_value = 0,
     .choices = "+|-",
     .meaning = "side of x towards which it starts"},
    gain_option("--kp-y", Dimension::kProportionalGain, "proportional gain of y"),
    gain_option("--ki-y", Dimension::kIntegralGain, "integral gain of y"),
    gain_option("--kd-y", Dimension::kDerivativeGain, "derivative gain of y"),
    gain_option("--kp-x", Dimension::kProportionalGain, "proportional gain of x"),
    gain_option("--ki-x", Dimension::kIntegralGain, "integral gain of x"),
    gain_option("--kd-x", Dimension::kDerivativeGain, "derivative gain of x"),
    kTrajectFlag,
    kContrlFlag,
}};

constexpr OptionSpec radius(std::string_view name, CountsOf counts_of, double default_m,
                            std::string_view meaning) noexcept {
  return {.name = name,
          .dimension = Dimension::kLength,
          .bare_unit = "m",
          .range = core::between(1e-3, 0.3),
          .default_value = default_m,
          .counts_of = counts_of,
          .asked_by = AskedBy::kTraject,
          .meaning = meaning};
}

template <std::size_t Count>
constexpr auto with_common(const std::array<OptionSpec, Count>& radii) noexcept {
  std::array<OptionSpec, Count + kCommonCount> all{};
  for (std::size_t i = 0; i < Count; ++i) {
    all[i] = radii[i];
  }
  for (std::size_t i = 0; i < kCommonCount; ++i) {
    all[Count + i] = kCommon[i];
  }
  return all;
}

constexpr auto kCircleOptions =
    with_common(std::array{radius("--radius", CountsOf::kY, 0.20, "of the circle")});
constexpr auto kEllipseOptions =
    with_common(std::array{radius("--radius-y", CountsOf::kY, 0.20, "half the extent on y"),
                           radius("--radius-x", CountsOf::kX, 0.10, "half the extent on x")});

// The common options begin at `first`.
ErrorCode run_loop(CommandContext& context, const Arguments& arguments, std::size_t first,
                   const PerAxis<double>& radius_m) {
  if (const ErrorCode code = must_have_both(context.system.configuration(), context.why);
      code != ErrorCode::kNone) {
    return code;
  }
  PhaseRampParameters phase{.turns = arguments.number(first + kTurns),
                            .ramp_s = arguments.number(first + kEntry),
                            .wait_s = arguments.number(first + kWait)};
  const ErrorCode frequency = chosen_frequency(arguments, first + kFrequency, first + kPeriod,
                                               phase.frequency_hz, context.why);
  if (frequency != ErrorCode::kNone) {
    return frequency;
  }
  const double centre = arguments.choice(first + kCentre) == 0 ? 1.0 : -1.0;
  const double direction = arguments.choice(first + kDirection) == 0 ? 1.0 : -1.0;
  // y = y_0 + r (1 - cos), x = x_0 + r sin: BBMC 0.5's, whose centre lay towards y max.
  const auto y = Harmonic::make({.start_m = position_m(context, core::Axis::kY),
                                 .amplitude_m = centre * radius_m[core::Axis::kY],
                                 .phase = phase});
  const auto x = Harmonic::make({.start_m = position_m(context, core::Axis::kX),
                                 .amplitude_m = direction * radius_m[core::Axis::kX],
                                 .starting_phase_turns = 0.25,
                                 .phase = phase});
  if (!y || !x) {
    return ErrorCode::kRequestBadArgument;
  }
  MotionRequest request;
  request.driven = {{true, true}};
  request.trajectory[core::Axis::kY] = *y;
  request.trajectory[core::Axis::kX] = *x;
  if (const core::Status status = context.system.request_motion(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, y->duration_s());
  const ErrorCode gains = apply_gains(context, arguments, first + kGainsY, core::Axis::kY);
  return gains != ErrorCode::kNone
             ? gains
             : apply_gains(context, arguments, first + kGainsX, core::Axis::kX);
}

ErrorCode run_circle(CommandContext& context, const Arguments& arguments) {
  return run_loop(context, arguments, 1, {{arguments.number(0), arguments.number(0)}});
}

ErrorCode run_ellipse(CommandContext& context, const Arguments& arguments) {
  return run_loop(context, arguments, 2, {{arguments.number(0), arguments.number(1)}});
}

}  // namespace

const CommandSpec& run_circle_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "run",
                                        .sub = "-circle",
                                        .options = kCircleOptions,
                                        .handler = run_circle,
                                        .meaning = "circle with both axes"};
  return kCommand;
}

const CommandSpec& run_ellipse_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "run",
                                        .sub = "-ellipse",
                                        .options = kEllipseOptions,
                                        .handler = run_ellipse,
                                        .meaning = "ellipse with both axes"};
  return kCommand;
}

}  // namespace towbench::bbmc
