// path: the way-points of the planner; run -path: straight lines from point to point, at rest in
// each, both axes on each line at the same share of it.
#include <array>
#include <cmath>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/shared_options.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {
namespace {

using core::Axis;
using core::ErrorCode;

enum PointOption : std::size_t { kPointY, kPointX };

constexpr OptionSpec coordinate(std::string_view name, CountsOf axis) noexcept {
  return {.name = name,
          .presence = Presence::kRequired,
          .dimension = Dimension::kPosition,
          .bare_unit = "counts",
          .counts_of = axis,
          .meaning = "position"};
}
constexpr std::array kPointOptions{coordinate("Y", CountsOf::kY), coordinate("X", CountsOf::kX)};

ErrorCode add(CommandContext& context, const Arguments& arguments) {
  if (!context.settings.way_points.push_back(
          {{arguments.number(kPointY), arguments.number(kPointX)}})) {
    context.why.text("the path has ").integer(kMaxWayPoints).text(" points, which is all it holds");
    return ErrorCode::kRequestOutOfRange;
  }
  return ErrorCode::kNone;
}

ErrorCode clear(CommandContext& context, const Arguments& /*arguments*/) {
  context.settings.way_points.clear();
  return ErrorCode::kNone;
}

ErrorCode print(CommandContext& context, const Arguments& /*arguments*/) {
  const AxesConfiguration& axes = context.system.configuration().axes;
  for (const PerAxis<double>& point : context.settings.way_points) {
    std::string_view separator;
    for (const Axis axis : kAxes) {
      if (axes[axis].exists) {
        context.out.text(separator).text(core::name_of(axis)).text(" ");
        context.out.fixed(point[axis], 6).text("m");
        separator = ", ";
      }
    }
    context.out.end_line();
  }
  context.out.integer(static_cast<std::int64_t>(context.settings.way_points.size()));
  context.out.text(" points").end_line();
  return ErrorCode::kNone;
}

enum RunOption : std::size_t { kSpeed, kAcceleration, kDwell, kSmooth, kCount };
constexpr std::array<OptionSpec, kCount> kRunOptions{{
    {.name = "--speed",
     .dimension = Dimension::kSpeed,
     .bare_unit = "m/s",
     .range = core::between(1e-4, 0.70),
     .default_value = 0.1,
     .meaning = "along each line"},
    {.name = "--acceleration",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(1e-3, 5),
     .default_value = 0.3,
     .meaning = "time from rest to speed and back"},
    {.name = "--dwell",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0, 60),
     .default_value = 0.5,
     .meaning = "rest before each line"},
    {.name = "--smooth",
     .dimension = Dimension::kTime,
     .bare_unit = "s",
     .range = core::between(0, 2),
     .default_value = 0.112,
     .meaning = "S-curve: averaged over this time; 0 for trapezoids"},
}};

// One axis of one line of `length_m`: the same law of time on both axes, scaled by its share.
core::Result<Segment> leg(double from_m, double to_m, double length_m, const Arguments& arguments) {
  const double dwell_s = arguments.number(kDwell);
  const double smooth_s = arguments.number(kSmooth);
  const double share = std::fabs(to_m - from_m) / length_m;
  // A share this small is rounding, and a speed of next to nothing would make no profile.
  const bool stands = share < 1e-9;
  const TrapezoidParameters wanted{.start_m = from_m,
                                   .distance_m = stands ? length_m : to_m - from_m,
                                   .speed_m_per_s = arguments.number(kSpeed) * (stands ? 1 : share),
                                   .acceleration_time_s = arguments.number(kAcceleration),
                                   .deceleration_time_s = arguments.number(kAcceleration),
                                   .wait_s = dwell_s};
  const auto line = Trapezoid::make(wanted);
  if (!line) {
    return core::failure(line.error());
  }
  if (stands) {
    return Segment(Hold(from_m, line->duration_s() + smooth_s));
  }
  if (smooth_s == 0) {
    return Segment(*line);
  }
  const auto curve = SCurve::make(wanted, smooth_s);
  return curve ? core::Result<Segment>(*curve) : core::failure(curve.error());
}

ErrorCode run_path(CommandContext& context, const Arguments& arguments) {
  const WayPoints& points = context.settings.way_points;
  if (points.empty()) {
    context.why.text("`path add Y X` first");
    return ErrorCode::kRequestWrongState;
  }
  PerAxis<std::array<Segment, kMaxSegments>> segments;
  std::size_t count = 0;
  const AxesConfiguration& axes = context.system.configuration().axes;
  PerAxis<double> at_m{{position_m(context, Axis::kY), position_m(context, Axis::kX)}};
  for (PerAxis<double> point : points) {
    for (const Axis axis : kAxes) {
      point[axis] = axes[axis].exists ? point[axis] : at_m[axis];
    }
    const double dy_m = point[Axis::kY] - at_m[Axis::kY];
    const double dx_m = point[Axis::kX] - at_m[Axis::kX];
    const double length_m = std::sqrt(dy_m * dy_m + dx_m * dx_m);
    if (length_m == 0) {
      continue;
    }
    for (const Axis axis : kAxes) {
      const auto segment = leg(at_m[axis], point[axis], length_m, arguments);
      if (!segment) {
        return segment.error();
      }
      segments[axis][count] = *segment;
      // A share that counts as standing does not move, so the next line starts from there.
      at_m[axis] = std::holds_alternative<Hold>(*segment) ? at_m[axis] : point[axis];
    }
    ++count;
  }
  MotionRequest request;
  request.driven = {{axes[Axis::kY].exists, axes[Axis::kX].exists}};
  double duration_s = 0;
  for (const Axis axis : kAxes) {
    const auto chain = Chain::make(std::span<const Segment>(segments[axis]).first(count));
    if (!chain) {
      context.why.text("the path leads nowhere");
      return chain.error();
    }
    request.trajectory[axis] = *chain;
    duration_s = chain->duration_s();
  }
  if (const core::Status status = context.system.request_motion(request); !status) {
    return explained(context, status.error());
  }
  announce_motion(context, duration_s);
  return ErrorCode::kNone;
}

}  // namespace

std::span<const CommandSpec> path_commands() noexcept {
  static constexpr std::array<CommandSpec, 4> kCommands{{
      {.word = "run",
       .sub = "-path",
       .options = kRunOptions,
       .handler = run_path,
       .meaning = "straight lines through the path's points"},
      {.word = "path",
       .sub = "add",
       .options = kPointOptions,
       .handler = add,
       .meaning = "appends a way-point"},
      {.word = "path", .sub = "clear", .handler = clear, .meaning = "forgets all way-points"},
      {.word = "path", .sub = "print", .handler = print, .meaning = "lists the way-points"},
  }};
  return kCommands;
}

}  // namespace towbench::bbmc
