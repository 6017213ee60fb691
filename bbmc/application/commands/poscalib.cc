// poscalib: finds out where the axes stand, by their hall switches (homing).
#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {
namespace poscalib {

using core::ErrorCode;

enum Option : std::size_t { kDof, kEnd, kOptionCount };
constexpr std::array<OptionSpec, kOptionCount> kOptions{{
    {.name = "DOF",
     .kind = OptionKind::kAxis,
     .presence = Presence::kOptional,
     .meaning = "axis; both if not given"},
    {.name = "--end",
     .kind = OptionKind::kChoice,
     .default_value = 0,
     .choices = "min|max",
     .meaning = "whose switch is looked for"},
}};

void report(const SystemManager& system, core::Axis /*axis*/, TextWriter& out) {
  for (const core::Axis axis : kAxes) {
    if (!system.configuration().axes[axis].exists) {
      continue;
    }
    const AxisStatus& state = system.status().axes[axis];
    out.text(core::name_of(axis)).text(": ");
    if (state.position_calibrated) {
      out.text("stands at ").integer(state.count).text(" counts = ").fixed(state.position_m, 6);
      out.text("m");
    } else {
      out.text("not calibrated");
    }
    out.end_line();
  }
}

ErrorCode run(CommandContext& context, const Arguments& arguments) {
  HomingRequest request;
  for (const core::Axis axis : kAxes) {
    request.wanted[axis] = arguments.given(kDof) ? axis == arguments.axis(kDof)
                                                 : context.system.configuration().axes[axis].exists;
    request.end[axis] = arguments.choice(kEnd) == 0 ? End::kMin : End::kMax;
  }
  const core::Status status = context.system.request_homing(request);
  if (!status) {
    if (status.error() == ErrorCode::kRequestBeyondSoftLimit) {
      context.why.text("both end-stops of an axis are active: there is no way off");
      return status.error();
    }
    return explained(context, status.error());
  }
  context.out.text("looking for the ").text(arguments.choice(kEnd) == 0 ? "min" : "max");
  context.out.text(" switch").end_line();
  context.motion_started = true;
  context.epilogue = report;
  return ErrorCode::kNone;
}

}  // namespace poscalib
}  // namespace

const CommandSpec& poscalib_command() noexcept {
  static constexpr CommandSpec kCommand{
      .word = "poscalib",
      .options = poscalib::kOptions,
      .handler = poscalib::run,
      .meaning = "finds out where the axes stand, by the switches"};
  return kCommand;
}

}  // namespace towbench::bbmc
