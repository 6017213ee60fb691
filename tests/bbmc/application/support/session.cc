#include "tests/bbmc/application/support/session.h"

#include <stdexcept>

namespace towbench::bbmc::testing {
namespace {

Configuration tabletop_configuration(const core::PerPlanarAxis<bool>& axes) {
  Configuration configuration;
  for (const core::Axis which : core::kPlanarAxes) {
    configuration.axes[which].exists = axes[which];
  }
  for (AxisConfiguration& axis : configuration.axes) {
    // This machine has a count, not an encoder with phases and an index that could be doubted.
    axis.plausibility.enabled = false;
  }
  return configuration;
}

constexpr double kLongest_s = 120;

}  // namespace

Session::Session(std::size_t log_rows, core::PerPlanarAxis<bool> axes) : log_(log_rows) {
  const Configuration configuration = tabletop_configuration(axes);
  machine_ = std::make_unique<Tabletop>(configuration);
  devices_ = std::make_unique<DeviceManager>(machine_->ports());
  system_ = std::make_unique<SystemManager>(configuration, *devices_, log_);
  application_ = std::make_unique<Application>(*system_, *devices_);
  if (!system_->start()) {
    throw std::runtime_error("the tabletop machine does not start");
  }
  type("config console --echo off\r", 0.01);
  heard();
}

void Session::exchange() {
  machine_->advance(kExchange_ns);
  system_->service(machine_->now_ns());
  application_->poll(machine_->now_ns());
}

void Session::run(double for_s) {
  for (const core::Nanoseconds end_ns = machine_->now_ns() + core::nanoseconds(for_s);
       machine_->now_ns() < end_ns;) {
    exchange();
  }
}

std::string Session::heard() {
  return std::exchange(machine_->from_controller, {});
}

std::string Session::type(std::string_view bytes, double for_s) {
  machine_->to_controller += bytes;
  run(for_s);
  return heard();
}

std::string Session::enter(std::string_view line) {
  machine_->to_controller += line;
  machine_->to_controller += '\r';
  const core::Nanoseconds end_ns = machine_->now_ns() + core::nanoseconds(kLongest_s);
  do {
    exchange();
    if (machine_->now_ns() > end_ns) {
      throw std::runtime_error("the console never came back");
    }
  } while (!application_->idle() || !machine_->to_controller.empty());
  std::string text = heard();
  constexpr std::string_view kPrompt = "bbmc> ";
  if (text.ends_with(kPrompt)) {
    text.resize(text.size() - kPrompt.size());
  }
  return text;
}

void Session::calibrate() {
  for (const std::string_view line : {"reset poscalib y 600000", "reset poscalib x 250000"}) {
    enter(line);  // refused for an axis that is not there
  }
}

}  // namespace towbench::bbmc::testing
