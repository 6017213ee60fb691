// goto: pick-and-place service (thesis 6.2.2).
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

// Where BBMC 0.5 began its runs (RUN_POSINIT_Y, RUN_POSINIT_X): far from the ends on both axes.
constexpr PerAxis<std::int64_t> kHome_count{{200'000, 250'000}};

constexpr OptionSpec kFast{.name = "--fast",
                           .short_name = "-f",
                           .kind = OptionKind::kFlag,
                           .presence = Presence::kOptional,
                           .meaning = "twice the speed of the long leg"};

constexpr OptionSpec target(std::string_view name, CountsOf axis) noexcept {
  return {.name = name,
          .presence = Presence::kRequired,
          .dimension = Dimension::kPosition,
          .bare_unit = "counts",
          .counts_of = axis,
          .meaning = "position"};
}

enum GotoOption : std::size_t { kY, kX, kGotoFast };
constexpr std::array kGotoOptions{target("Y", CountsOf::kY), target("X", CountsOf::kX), kFast};

enum HomeOption : std::size_t { kHomeFast };
constexpr std::array kHomeOptions{kFast};

ErrorCode go(CommandContext& context, const PerAxis<double>& target_m, bool fast) {
  const core::Status status = context.system.request_goto({.target_m = target_m, .fast = fast});
  if (!status) {
    return explained(context, status.error());
  }
  context.motion_started = true;
  return ErrorCode::kNone;
}

ErrorCode go_to(CommandContext& context, const Arguments& arguments) {
  return go(context, {{arguments.number(kY), arguments.number(kX)}}, arguments.given(kGotoFast));
}

ErrorCode go_home(CommandContext& context, const Arguments& arguments) {
  PerAxis<double> target_m;
  for (const core::Axis axis : kAxes) {
    target_m[axis] = context.system.configuration().axes[axis].position_m(kHome_count[axis]);
  }
  return go(context, target_m, arguments.given(kHomeFast));
}

}  // namespace

const CommandSpec& goto_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "goto",
                                        .options = kGotoOptions,
                                        .handler = go_to,
                                        .meaning = "goes to a place with every axis"};
  return kCommand;
}

const CommandSpec& goto_home_command() noexcept {
  static constexpr CommandSpec kCommand{.word = "goto",
                                        .sub = "home",
                                        .options = kHomeOptions,
                                        .handler = go_home,
                                        .meaning = "goes to 200000 and 250000 counts"};
  return kCommand;
}

}  // namespace towbench::bbmc
