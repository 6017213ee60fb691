#include "harness/commands/linux_session.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "bbmc/host/linux/linux_node.h"
#include "harness/checks/check.h"
#include "harness/commands/stop_signal.h"
#include "harness/commands/typist.h"
#include "harness/fixtures/linux_devices_fixture.h"
#include "harness/realtime/realtime_rights.h"
#include "harness/realtime/tick_clock.h"
#include "harness/realtime/tick_summary.h"
#include "harness/record/controller_recorder.h"

namespace towbench::harness {
namespace {

constexpr std::string_view kScheme = "linux:";
constexpr int kPriority = 80;
constexpr char kStopKey = 3;  // Ctrl-C: the console brakes whatever moves
constexpr core::Nanoseconds kTimeToStop_ns = 3 * core::kNanosecondsPerSecond;

class LinuxSession {
 public:
  LinuxSession(const bbmc::Configuration& configuration, ControllerRecorder* recorder)
      : origin_ns_(clock_.now_ns()), node_(configuration, origin_ns_), recorder_(recorder) {}

  int run(const LinuxDevicesFixture& fixture) {
    const auto rights = take_realtime_rights(kPriority, 0);
    for (const auto& warning : rights.warnings) {
      std::fprintf(stderr, "%s\n", warning.c_str());
    }
    if (const auto started = node_.start(fixture.devices, clock_.now_ns() - origin_ns_,
                                         core::nanoseconds(fixture.guard_patience_s));
        !started) {
      return fail("the devices cannot be used", started.error());
    }
    const TickPolicy policy{.period_ns = node_.exchange_ns()};
    serve_until_over(policy.period_ns);
    node_.finish();
    record_rows();
    if (recorder_ != nullptr) {
      recorder_->flush();
    }
    std::fputs(text_of(summarise("controller", rights.text(), policy, timing_)).c_str(), stderr);
    return device_failed_ ? kExitRuntime : kExitPass;
  }

 private:
  void serve_until_over(core::Nanoseconds period_ns) {
    Typist typist;
    core::Nanoseconds due_ns = clock_.now_ns();
    while (!over(typist)) {
      due_ns += period_ns;
      clock_.sleep_until(due_ns);
      const auto woke_ns = clock_.now_ns();
      tell_trouble(node_.serve(woke_ns - origin_ns_));
      print_console();
      record_rows();
      timing_.lateness.add(woke_ns - due_ns);
      const auto done_ns = clock_.now_ns();
      timing_.execution.add(done_ns - woke_ns);
      // What is missed is missed: two exchanges at the same time would only measure noise.
      while (due_ns + period_ns <= done_ns) {
        due_ns += period_ns;
        ++timing_.overruns;
      }
    }
  }

  bool over(Typist& typist) {
    if (stopping_since_ns_ == 0) {
      typist.feed(node_);
    }
    if (stop_requested() && stopping_since_ns_ == 0) {
      stopping_since_ns_ = clock_.now_ns();
      static_cast<void>(node_.type(std::string_view(&kStopKey, 1)));
      return false;
    }
    if (stopping_since_ns_ != 0) {
      return node_.idle() || clock_.now_ns() - stopping_since_ns_ > kTimeToStop_ns;
    }
    return node_.quit_requested() || (typist.ended() && node_.idle());
  }

  // Once each time that a device begins to fail.
  void tell_trouble(bool good) {
    if (!good && !failing_) {
      std::fprintf(stderr, "\r\ncontroller: %s; drive removed\r\n", node_.trouble().c_str());
    }
    failing_ = !good;
    device_failed_ = device_failed_ || failing_;
  }

  void print_console() {
    std::array<char, 512> bytes{};
    while (const std::size_t count = node_.read_console(bytes)) {
      std::fwrite(bytes.data(), 1, count, stdout);
      if (recorder_ != nullptr) {
        recorder_->console({bytes.data(), count});
      }
    }
    std::fflush(stdout);
  }

  void record_rows() {
    if (recorder_ != nullptr) {
      recorder_->drain(node_);
      return;
    }
    bbmc::TelemetryRow row;
    while (node_.next_row(row)) {
    }
    bbmc::SystemEvent event;
    while (node_.next_event(event)) {
    }
  }

  int fail(const char* what, core::ErrorCode code) {
    std::fprintf(stderr, "controller: %s: error %u, %s\n", what, core::number_of(code),
                 node_.trouble().c_str());
    return kExitRuntime;
  }

  HostTickClock clock_;
  core::Nanoseconds origin_ns_;
  bbmc::LinuxNode node_;
  ControllerRecorder* recorder_;
  TickRecord timing_;
  core::Nanoseconds stopping_since_ns_ = 0;
  bool failing_ = false;
  bool device_failed_ = false;
};

}  // namespace

int run_on_devices(const std::string& address, const ControllerFixture& controller,
                   const std::string& out) {
  if (!address.starts_with(kScheme) || address.size() == kScheme.size()) {
    throw FixtureError({.key = "--devices"}, address, "linux:FILE.toml");
  }
  const std::string path = address.substr(kScheme.size());
  const auto fixture = load_linux_devices(path);
  if (const char* sentence = bbmc::inconsistency(fixture.devices, controller.configuration)) {
    throw FixtureError({.file = path}, "devices that do not fit the controller", sentence);
  }
  std::unique_ptr<ControllerRecorder> recorder;
  if (!out.empty()) {
    std::filesystem::create_directories(out);
    recorder = std::make_unique<ControllerRecorder>(out);
  }
  return LinuxSession(controller.configuration, recorder.get()).run(fixture);
}

}  // namespace towbench::harness
