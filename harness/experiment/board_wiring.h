// Which pin of the virtual board meets which signal of the machine.
//
// By default two controllers' wirings live side by side on different pins, so that neither has to
// be chosen: the bench's own BBMC (bbmc/baremetal/board_pins.h) has a pin for every line; BBMC 0.5
// has one hall input an axis, a direction output an axis beside the PWM, and no amplifier lines. It
// makes its direction pins outputs in any case and leaves them alone while it drives by the
// difference of the channels, so that a direction pin counts only once the image has chosen its
// level.
#pragma once

#include <optional>

#include "core/axis.h"

namespace towbench::harness {

struct BoardPin {
  unsigned bank = 1;  // GPIO 0 .. 3
  unsigned pin = 0;   // 0 .. 31
  bool active_low = false;

  [[nodiscard]] bool same_place(const BoardPin& other) const noexcept {
    return bank == other.bank && pin == other.pin;
  }
};

// A signal without a pin is not wired.
struct AxisWiring {
  unsigned encoder = 1;           // eQEP 0 .. 2
  unsigned pwm = 1;               // eHRPWM 0 .. 2
  bool channels_swapped = false;  // B drives towards max, A towards min
  // Once its level was chosen it gives the sign: active is towards max.
  std::optional<BoardPin> direction{};
  std::optional<BoardPin> hall{};  // either end's switch
  std::optional<BoardPin> hall_min{};
  std::optional<BoardPin> hall_max{};
  std::optional<BoardPin> ready{};   // of the amplifier
  std::optional<BoardPin> enable{};  // an enable that is no output is pulled up
};

struct BoardWiring {
  core::PerPlanarAxis<AxisWiring> axes{{{{.encoder = 1,
                                          .pwm = 1,
                                          .direction = BoardPin{1, 7},
                                          .hall = BoardPin{1, 6},
                                          .hall_min = BoardPin{1, 16},
                                          .hall_max = BoardPin{1, 17},
                                          .ready = BoardPin{1, 20},
                                          .enable = BoardPin{1, 12}},
                                         {.encoder = 2,
                                          .pwm = 2,
                                          .direction = BoardPin{1, 3},
                                          .hall = BoardPin{1, 2},
                                          .hall_min = BoardPin{1, 18},
                                          .hall_max = BoardPin{1, 19},
                                          .ready = BoardPin{1, 21},
                                          .enable = BoardPin{1, 13}}}}};
  std::optional<BoardPin> kill_switch = BoardPin{1, 14};
};

}  // namespace towbench::harness
