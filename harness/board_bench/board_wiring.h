// Which pin of the virtual board meets which signal of the machine.
//
// Two controllers' wirings live side by side on different pins, so that neither has to be chosen:
// the bench's own BBMC (bbmc/baremetal/board_pins.h) has a pin for every line; BBMC 0.5 has one
// hall input an axis, a direction output an axis beside the PWM, and no amplifier lines. It makes
// its direction pins outputs in any case and leaves them alone while it drives by the difference of
// the channels, so that a direction pin counts only once the image has chosen its level.
#pragma once

#include "bbmc/baremetal/board_pins.h"
#include "core/axis.h"

namespace towbench::harness {

struct AxisWiring {
  unsigned subsystem = 1;      // PWMSS: its eQEP reads the encoder, its eHRPWM drives
  unsigned hall_pin = 6;       // of GPIO1: either end's switch
  unsigned direction_pin = 7;  // of GPIO1: once its level was chosen it gives the sign
};

struct BoardWiring {
  unsigned bank = 1;  // every line of the machine is on GPIO1
  core::PerAxis<AxisWiring> axes{{{{1, 6, 7}, {2, 2, 3}}}};
  // With a direction pin: its level towards the maximum.
  bool direction_high_is_max = true;
};

}  // namespace towbench::harness
