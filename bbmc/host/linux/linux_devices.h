// Which kernel devices the machine is wired to. Nothing here has a default place: what is not named
// is not touched.
#pragma once

#include <cstdint>
#include <string>

#include "bbmc/device/axes.h"

namespace towbench::bbmc {

struct LinuxEncoderPlace {
  std::string counter;                   // folder: /sys/bus/counter/devices/counter0
  unsigned count = 0;                    // countN in it
  std::uint64_t ceiling = 0xFFFF'FFFFU;  // wraps after it; written to the device
  bool inverted = false;                 // counts down towards max
  std::string index_events;  // /dev/counter0 where the device reports the index; may be empty
};

struct LinuxPwmChannel {
  std::string chip;  // folder: /sys/class/pwm/pwmchip0
  unsigned channel = 0;
};

struct LinuxPwmPlace {
  LinuxPwmChannel towards_max;  // A
  LinuxPwmChannel towards_min;  // B
  double tick_s = 10e-9;        // of the period's ticks: 1000 of 10 ns are 100 kHz
};

// A line is written CHIP:OFFSET (gpiochip1:6), or as the path of a file that holds 0 or 1
// (/sys/class/gpio/gpio38/value, direction already set). `!` before it: active when low.
struct LinuxAxis {
  LinuxEncoderPlace encoder;
  LinuxPwmPlace pwm;
  std::string hall_min;
  std::string hall_max;
  std::string amplifier_ready;  // may be empty where none is fitted
  std::string amplifier_enable;
};

struct LinuxDevices {
  PerAxis<LinuxAxis> axes;
  std::string kill_switch;
  std::string root;  // stands before every path: a folder that imitates a board, else empty
};

}  // namespace towbench::bbmc
