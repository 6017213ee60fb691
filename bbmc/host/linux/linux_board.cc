#include "bbmc/host/linux/linux_board.h"

#include <algorithm>

namespace towbench::bbmc {

using core::Status;

LinuxBoard::LinuxBoard(core::Nanoseconds origin_ns) noexcept : origin_ns_(origin_ns) {
  for (std::size_t i = 0; i < kLineCount; ++i) {
    line_ports_[i].attach(bank_, static_cast<Line>(i));
  }
}

BoardPorts LinuxBoard::ports() noexcept {
  BoardPorts ports;
  for (core::Axis axis : kAxes) {
    ports.pwm[axis] = &pwm_[axis];
    ports.encoder[axis] = &counters_[axis];
  }
  for (std::size_t i = 0; i < kLineCount; ++i) {
    ports.lines[i] = &line_ports_[i];
  }
  ports.control_timer = &timer_;
  ports.console = &console_;
  ports.interrupts = &interrupts_;
  return ports;
}

Status LinuxBoard::open_line(Line line, const std::string& place, const std::string& root) {
  if (place.empty()) {
    return {};
  }
  const auto direction = is_input(line) ? LinuxLine::Direction::kIn : LinuxLine::Direction::kOut;
  auto opened = LinuxLine::open(place, root, direction, trouble_);
  if (!opened) {
    return core::failure(opened.error());
  }
  lines_[index_of(line)] = std::move(*opened);
  return {};
}

Status LinuxBoard::open(const LinuxDevices& devices) {
  // Outputs first: the machine is without power before anything is read.
  for (core::Axis which : kAxes) {
    const LinuxAxis& axis = devices.axes[which];
    if (axis.encoder.counter.empty()) {
      continue;
    }
    if (const auto done =
            open_line(amplifier_enable_of(which), axis.amplifier_enable, devices.root);
        !done) {
      return done;
    }
    if (const auto done = pwm_[which].open(axis.pwm, devices.root, trouble_); !done) {
      return done;
    }
    if (const auto done = counters_[which].open(axis.encoder, devices.root, trouble_); !done) {
      return done;
    }
    for (const auto& [line, place] : {std::pair{hall_min_of(which), &axis.hall_min},
                                      {hall_max_of(which), &axis.hall_max},
                                      {amplifier_ready_of(which), &axis.amplifier_ready}}) {
      if (const auto done = open_line(line, *place, devices.root); !done) {
        return done;
      }
    }
  }
  return open_line(Line::kKillSwitch, devices.kill_switch, devices.root);
}

Status LinuxBoard::sample(core::Nanoseconds now_ns) noexcept {
  clock_.now_ns = now_ns;
  for (std::size_t i = 0; i < kInputLines; ++i) {
    if (lines_[i] == nullptr) {
      continue;
    }
    if (const auto done = sample_line(i, now_ns); !done) {
      return done;
    }
  }
  for (LinuxCounter& counter : counters_) {
    if (const auto done = counter.sample(now_ns); !done) {
      return done;
    }
  }
  return {};
}

Status LinuxBoard::sample_line(std::size_t i, core::Nanoseconds now_ns) noexcept {
  LineEdge edge;
  for (;;) {
    const auto more = lines_[i]->next_edge(edge);
    if (!more) {
      return core::failure(more.error());
    }
    if (!*more) {
      break;
    }
    take_edge(i, edge.active, std::clamp<core::Nanoseconds>(edge.time_ns - origin_ns_, 0, now_ns));
  }
  const auto level = lines_[i]->level();
  if (!level) {
    return core::failure(level.error());
  }
  const auto mask = static_cast<std::uint16_t>(1U << i);
  if (*level != ((bank_.levels & mask) != 0)) {
    take_edge(i, *level, now_ns);  // the kernel's queue was full, or it has none
  }
  return {};
}

void LinuxBoard::take_edge(std::size_t i, bool active, core::Nanoseconds time_ns) noexcept {
  const auto mask = static_cast<std::uint16_t>(1U << i);
  bank_.levels = static_cast<std::uint16_t>(active ? bank_.levels | mask : bank_.levels & ~mask);
  if ((bank_.interrupts_enabled & mask) != 0) {
    bank_.insert({.time_ns = time_ns, .line = static_cast<Line>(i), .active = active});
  }
}

Status LinuxBoard::write_outputs() noexcept {
  for (std::size_t i = kInputLines; i < kLineCount; ++i) {
    if (lines_[i] == nullptr) {
      continue;
    }
    if (const auto done = lines_[i]->drive((bank_.levels & (1U << i)) != 0); !done) {
      return done;
    }
  }
  bank_.outputs_written = false;
  return {};
}

Status LinuxBoard::flush() noexcept {
  for (LinuxPwm& pwm : pwm_) {
    if (const auto done = pwm.flush(); !done) {
      return done;
    }
  }
  return bank_.outputs_written ? write_outputs() : Status();
}

void LinuxBoard::make_safe() noexcept {
  for (LinuxPwm& pwm : pwm_) {
    pwm.make_safe();
  }
  for (std::size_t i = kInputLines; i < kLineCount; ++i) {
    const auto mask = static_cast<std::uint16_t>(1U << i);
    bank_.levels = static_cast<std::uint16_t>(bank_.levels & ~mask);
    if (lines_[i] != nullptr) {
      static_cast<void>(lines_[i]->drive(false));
    }
  }
}

}  // namespace towbench::bbmc
