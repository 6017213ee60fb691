#include "bbmc/host/linux/linux_pwm.h"

#include <cmath>

namespace towbench::bbmc {

core::Status LinuxPwm::open(const LinuxPwmPlace& place, const std::string& root,
                            DeviceTrouble& trouble) {
  tick_ns_ = place.tick_s * 1e9;
  if (const auto opened = towards_max_.open(place.towards_max, root, trouble); !opened) {
    return opened;
  }
  return towards_min_.open(place.towards_min, root, trouble);
}

std::uint64_t LinuxPwm::ns_of(std::uint16_t ticks) const noexcept {
  return static_cast<std::uint64_t>(std::llround(static_cast<double>(ticks) * tick_ns_));
}

core::Status LinuxPwm::apply(const Ehrpwm::Settings& settings) noexcept {
  wanted_ = {};
  if (!is_open()) {
    return {};
  }
  const std::uint64_t period_ns = ns_of(settings.period_ticks);
  if (const auto started = towards_max_.start(period_ns); !started) {
    return started;
  }
  return towards_min_.start(period_ns);
}

core::Status LinuxPwm::read(Ehrpwm::Reading& reading) noexcept {
  reading = wanted_;
  return {};
}

core::Status LinuxPwm::write(const Ehrpwm::Command& command) noexcept {
  wanted_ = command;
  return {};
}

core::Status LinuxPwm::flush() noexcept {
  if (!is_open()) {
    return {};
  }
  const bool max_rises = wanted_.enable && wanted_.channel_a_ticks > 0;
  PwmChannel& falling = max_rises ? towards_min_ : towards_max_;
  PwmChannel& rising = max_rises ? towards_max_ : towards_min_;
  const std::uint16_t ticks = max_rises ? wanted_.channel_a_ticks : wanted_.channel_b_ticks;
  if (const auto done = falling.set_duty(0); !done) {
    return done;
  }
  if (const auto done = rising.set_duty(wanted_.enable ? ns_of(ticks) : 0); !done) {
    return done;
  }
  if (const auto done = towards_max_.set_enabled(wanted_.enable); !done) {
    return done;
  }
  return towards_min_.set_enabled(wanted_.enable);
}

void LinuxPwm::make_safe() noexcept {
  wanted_ = {};
  towards_max_.make_safe();
  towards_min_.make_safe();
}

}  // namespace towbench::bbmc
