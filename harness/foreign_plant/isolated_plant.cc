#include "harness/foreign_plant/isolated_plant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <mutex>
#include <utility>

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>
#include <sys/wait.h>

#include "harness/foreign_plant/plant_host.h"

namespace towbench::harness {
namespace {

constexpr double kMakingLimit_s = 10;
// Nothing that the bench emulates is larger: what is, has diverged.
constexpr double kLargest = 1e9;
constexpr double kTimeTolerance_s = 1e-9;
constexpr double kSamePlace = 1e-6;

// Those of this process, for its forks.
std::vector<IsolatedPlant*>& plants() {
  static std::vector<IsolatedPlant*> all;
  return all;
}
std::mutex& plants_mutex() {
  static std::mutex mutex;
  return mutex;
}

// A fork for a plant's own process is no fork of the run.
thread_local bool is_starting_host = false;

void before_fork() {
  if (!is_starting_host) {
    plants_mutex().lock();
    for (auto* plant : plants()) {
      plant->before_fork();
    }
  }
}
void after_fork() {
  if (!is_starting_host) {
    plants_mutex().unlock();
  }
}
void in_forked_process() {
  if (!is_starting_host) {
    for (auto* plant : plants()) {
      plant->in_forked_process();
    }
    plants_mutex().unlock();
  }
}

void watch_forks() {
  static std::once_flag once;
  std::call_once(once, [] { (void)pthread_atfork(before_fork, after_fork, in_forked_process); });
}

struct Named {
  const char* name;
  double towbench_plant_output::*value;
};
constexpr std::array kChecked{
    Named{"position_m", &towbench_plant_output::position_m},
    Named{"velocity_m_per_s", &towbench_plant_output::velocity_m_per_s},
    Named{"motor_angle_rad", &towbench_plant_output::motor_angle_rad},
    Named{"motor_speed_rad_per_s", &towbench_plant_output::motor_speed_rad_per_s},
    Named{"force_N", &towbench_plant_output::force_N},
    Named{"current_A", &towbench_plant_output::current_A}};

std::string sentence_about(int status) {
  return WIFSIGNALED(status) ? fmt::format("its process was ended by signal {} ({})",
                                           WTERMSIG(status), strsignal(WTERMSIG(status)))
                             : fmt::format("its process ended with code {}", WEXITSTATUS(status));
}

class Source final : public emulator::ForeignPlantSource {
 public:
  explicit Source(PlantFile file) : file_(std::move(file)) {}
  [[nodiscard]] std::unique_ptr<emulator::ForeignPlant> make(
      const core::PerAxis<std::optional<double>>& starts_m) const override {
    return std::make_unique<IsolatedPlant>(file_, starts_m);
  }

 private:
  PlantFile file_;
};

}  // namespace

IsolatedPlant::IsolatedPlant(PlantFile file, const core::PerAxis<std::optional<double>>& starts_m)
    : file_(std::move(file)) {
  for (const auto which : core::kAllAxes) {
    if (starts_m[which]) {
      order_.push_back(which);
      axes_.push_back({std::string(core::name_of(which)), *starts_m[which]});
    }
  }
  start();
  watch_forks();
  const std::lock_guard lock(plants_mutex());
  plants().push_back(this);
}

IsolatedPlant::~IsolatedPlant() {
  {
    const std::lock_guard lock(plants_mutex());
    std::erase(plants(), this);
  }
  end_host(failure_.empty());
}

void IsolatedPlant::start() {
  try {
    mailbox_ = make_mailbox();
    turn_ = 0;
    is_starting_host = true;
    host_ = start_plant_host(*file_.binary, axes_, *mailbox_);
    is_starting_host = false;
  } catch (const std::exception& error) {
    is_starting_host = false;
    fail(error.what());
    return;
  }
  const double limit_s = std::exchange(file_.answer_limit_s, kMakingLimit_s);
  const bool loaded = answer_comes();
  file_.answer_limit_s = limit_s;
  if (loaded && !mailbox_->succeeded) {
    fail(mailbox_->message.data());
  }
}

// The host's answer to the last request. False: it will never come.
bool IsolatedPlant::answer_comes() {
  constexpr double kLook_s = 0.02;
  for (double waited_s = 0; waited_s < file_.answer_limit_s; waited_s += kLook_s) {
    if (mailbox_->answers.changes_from(turn_, static_cast<std::int64_t>(kLook_s * 1e9))) {
      ++turn_;
      return true;
    }
    int status = 0;
    if (waitpid(host_, &status, WNOHANG) == host_) {
      host_ = -1;
      fail(sentence_about(status));
      return false;
    }
  }
  fail(fmt::format("it has not answered for {} s", file_.answer_limit_s));
  return false;
}

bool IsolatedPlant::order(PlantOrder what) {
  mailbox_->order = what;
  mailbox_->requests.post(turn_);
  return answer_comes();
}

bool IsolatedPlant::step(double until_s, const core::PerAxis<emulator::ForeignInput>& inputs,
                         core::PerAxis<emulator::ForeignOutput>& outputs) noexcept {
  if (is_copy_) {
    go_on_in_forked_process();
  }
  if (!failure_.empty()) {
    return false;
  }
  if (time_s_ == 0) {
    share_priority();
  }
  put(inputs);
  mailbox_->until_s = until_s;
  mailbox_->reached_s = -1;
  if (!order(PlantOrder::kStep) || !is_sound(until_s)) {
    return false;
  }
  time_s_ = until_s;
  take(outputs);
  return true;
}

// By the wall clock the run has a real-time priority and a processor, and waits for this process in
// every tick: it gets a priority below the loops' own (70 and 80), on the other processors.
void IsolatedPlant::share_priority() const noexcept {
  sched_param priority{};
  const int policy = sched_getscheduler(0);
  if (policy == SCHED_FIFO && sched_getparam(0, &priority) == 0) {
    constexpr int kBelowLoops = 20;
    priority.sched_priority = std::max(1, priority.sched_priority - kBelowLoops);
    (void)sched_setscheduler(host_, policy, &priority);
    cpu_set_t processors;
    if (const int own = sched_getcpu();
        own >= 0 && sched_getaffinity(host_, sizeof processors, &processors) == 0 &&
        CPU_COUNT(&processors) > 1) {
      CPU_CLR(static_cast<std::size_t>(own), &processors);
      (void)sched_setaffinity(host_, sizeof processors, &processors);
    }
  }
}

void IsolatedPlant::put(const core::PerAxis<emulator::ForeignInput>& inputs) {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const auto& from = inputs[order_[i]];
    mailbox_->inputs[i] = {.command_V = from.command_V,
                           .voltage_V = from.voltage_V,
                           .current_A = from.current_A,
                           .drive_force_N = from.drive_force_N,
                           .external_force_N = from.external_force_N,
                           .supply_V = from.supply_V,
                           .enabled = from.enabled ? 1 : 0,
                           .reserved = 0};
  }
}

void IsolatedPlant::take(core::PerAxis<emulator::ForeignOutput>& outputs) const {
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const auto& from = mailbox_->outputs[i];
    outputs[order_[i]] = {.position_m = from.position_m,
                          .velocity_m_per_s = from.velocity_m_per_s,
                          .motor_angle_rad = from.motor_angle_rad,
                          .motor_speed_rad_per_s = from.motor_speed_rad_per_s,
                          .force_N = from.force_N,
                          .current_A = from.current_A};
  }
}

bool IsolatedPlant::is_sound(double until_s) {
  if (!mailbox_->succeeded) {
    const std::string why = mailbox_->message.data();
    fail(why.empty() ? "its step failed, and it does not say why" : why);
    return false;
  }
  if (!(std::fabs(mailbox_->reached_s - until_s) <= kTimeTolerance_s)) {
    fail(fmt::format("it went to {} s instead of {} s", mailbox_->reached_s, until_s));
    return false;
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    for (const auto& output : kChecked) {
      const double value = mailbox_->outputs[i].*output.value;
      if (!(std::fabs(value) <= kLargest)) {
        fail(fmt::format("axis {}: {} is {}", axes_[i].name, output.name, value));
        return false;
      }
    }
    const double start_m = mailbox_->outputs[i].position_m;
    if (until_s == 0 && std::fabs(start_m - axes_[i].start_m) > kSamePlace) {
      fail(fmt::format("axis {} starts at {}, and start_m is {}", axes_[i].name, start_m,
                       axes_[i].start_m));
      return false;
    }
  }
  return true;
}

void IsolatedPlant::fail(const std::string& why) {
  failure_ = fmt::format("plant {} at {:.4f} s: {}", file_.name, time_s_, why);
  std::replace_if(
      failure_.begin(), failure_.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; },
      ' ');
  end_host(false);
}

void IsolatedPlant::end_host(bool politely) noexcept {
  if (host_ < 0) {
    return;
  }
  constexpr std::int64_t kPatience_ns = 200'000'000;
  if (politely) {
    mailbox_->order = PlantOrder::kEnd;
    mailbox_->requests.post(turn_);
    (void)mailbox_->answers.changes_from(turn_, kPatience_ns);
  }
  (void)kill(host_, SIGKILL);
  (void)waitpid(host_, nullptr, 0);
  host_ = -1;
}

void IsolatedPlant::before_fork() noexcept {
  if (!failure_.empty() || is_copy_) {
    return;
  }
  saved_.clear();
  if (order(PlantOrder::kSave) && mailbox_->succeeded) {
    saved_.assign(mailbox_->state.begin(), mailbox_->state.begin() + mailbox_->state_size);
  }
}

void IsolatedPlant::in_forked_process() noexcept {
  is_copy_ = true;
  host_ = -1;
}

void IsolatedPlant::go_on_in_forked_process() {
  is_copy_ = false;
  if (!failure_.empty()) {
    return;
  }
  if (saved_.empty()) {
    fail("it offers no saved state, so that the run cannot go on from a snapshot");
    return;
  }
  start();
  if (failure_.empty()) {
    mailbox_->state_size = saved_.size();
    std::copy(saved_.begin(), saved_.end(), mailbox_->state.begin());
    if (order(PlantOrder::kRestore) && !mailbox_->succeeded) {
      fail("it cannot take up its saved state");
    }
  }
}

std::shared_ptr<const emulator::ForeignPlantSource> make_plant_source(PlantFile file) {
  return std::make_shared<Source>(std::move(file));
}

}  // namespace towbench::harness
