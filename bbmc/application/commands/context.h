// What a command's handler works with.
#pragma once

#include "bbmc/application/console/text_writer.h"
#include "bbmc/application/reports/report.h"
#include "bbmc/device/axes.h"
#include "bbmc/system/trajectory/chain.h"
#include "core/bounded_vector.h"

namespace towbench::bbmc {

class DeviceManager;
class SystemManager;
struct CommandContext;

inline constexpr std::size_t kMaxWayPoints = kMaxSegments;
using WayPoints = core::BoundedVector<PerAxis<double>, kMaxWayPoints>;

// What the console itself remembers between commands.
struct ConsoleSettings {
  bool echo = true;
  bool quit = false;
  bool debug = false;    // what the law did, after each motion
  WayPoints way_points;  // m
};

// Writes what a motion has found, once it has ended by itself.
using MotionEpilogue = void (*)(const SystemManager&, core::Axis, TextWriter&);

struct CommandContext {
  SystemManager& system;
  DeviceManager& devices;
  ConsoleSettings& settings;
  TextWriter& out;  // the reply's lines; short, so that they fit
  TextWriter& why;  // of a refusal: the argument, what was given, what is allowed
  Report& report;   // a reply of any length, produced as the UART takes it

  // A handler whose request was accepted sets it: the prompt then waits for the motion's end.
  bool motion_started = false;
  MotionEpilogue epilogue = nullptr;
  core::Axis epilogue_axis = core::Axis::kY;
};

}  // namespace towbench::bbmc
