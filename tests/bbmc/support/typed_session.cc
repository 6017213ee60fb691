#include "tests/bbmc/support/typed_session.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "bbmc/host/controller_node.h"
#include "core/check.h"
#include "emulator/plant_node.h"

namespace towbench::tests {
namespace {

constexpr double kKillPressed_s = 180.0;
constexpr double kKillReleased_s = 182.0;

class Quiet final : public emulator::PlantObserver {
 public:
  void on_truth(const emulator::TruthRow& /*row*/) noexcept override {}
  void on_event(const emulator::PlantEvent& /*event*/) noexcept override {}
};

std::vector<emulator::ScheduledEvent> a_hand_on_the_kill_switch() {
  return {{.time_ns = core::nanoseconds(kKillPressed_s),
           .kind = emulator::ScheduledEventKind::kPressKillSwitch},
          {.time_ns = core::nanoseconds(kKillReleased_s),
           .kind = emulator::ScheduledEventKind::kReleaseKillSwitch}};
}

class Person {
 public:
  Person()
      : controller_(bbmc::Configuration()), plant_(rig(), 1, a_hand_on_the_kill_switch(), quiet_) {
    controller_.connect(plant_);
    plant_.connect(controller_);
    controller_.greet();
    core::check(controller_.handshake().has_value());
    controller_.serve(0);
  }

  void enter(std::string_view line) {
    const std::string typed = std::string(line) + "\r";
    core::check(controller_.type(typed) == typed.size());
    do {
      exchange();
    } while (!controller_.idle());
    for (int i = 0; i < 20; ++i) {
      exchange();
    }
  }
  void wait_until(double time_s) {
    while (now_ns_ < core::nanoseconds(time_s)) {
      exchange();
    }
  }
  [[nodiscard]] std::string heard() const {
    std::string text = heard_;
    std::erase(text, '\r');
    constexpr std::string_view kPrompt = "bbmc> ";
    if (text.ends_with(kPrompt)) {
      text.resize(text.size() - kPrompt.size());
    }
    return text;
  }

 private:
  static emulator::RigParameters rig() {
    emulator::RigParameters nominal;
    nominal.axes[core::Axis::kY].start_m = 0.449092;
    nominal.axes[core::Axis::kX].start_m = 0.336819;
    return nominal;
  }

  void exchange() {
    now_ns_ += controller_.exchange_ns();
    plant_.on(protocol::Advance{now_ns_});
    controller_.serve(now_ns_);
    std::array<char, 512> bytes{};
    for (std::size_t n = 0; (n = controller_.read_console(bytes)) > 0;) {
      heard_.append(bytes.data(), n);
    }
    bbmc::TelemetryRow row;
    while (controller_.next_row(row)) {
    }
    bbmc::ControllerEvent event;
    while (controller_.next_event(event)) {
    }
  }

  Quiet quiet_;
  bbmc::ControllerNode controller_;
  emulator::PlantNode plant_;
  core::Nanoseconds now_ns_ = 0;
  std::string heard_;
};

}  // namespace

std::string typed_session() {
  Person person;
  for (const std::string_view line :
       {"goto home", "poscalib", "goto home -f", "run -trapez y --distance 0.5m --speed 0.2m/s",
        "run -circle --radius 0.1m --period 5s --turns 1", "rmpi break y -d +", "datalog reset",
        "rmpi si y -a 10% -p 5 5 --pulses 1 --wait 0 --rest 0.01", "datalog print y",
        "run --speed 2m/s"}) {
    person.enter(line);
  }
  person.wait_until(kKillPressed_s - 1.2);
  person.enter("run -trapez y --distance 1m --speed 0.3m/s");
  person.enter("reset");
  person.wait_until(kKillReleased_s + 0.1);
  for (const std::string_view line : {"run", "reset", "status", "quit"}) {
    person.enter(line);
  }
  return person.heard();
}

}  // namespace towbench::tests
