// Five cars on a road, the benchmark "chasing cars" of the ARCH competition's falsification
// category: car 1 is driven by throttle and brake, each other one keeps, chases or brakes by its
// distance to the one before it.
//
// Hu, Lygeros, Sastry, Towards a theory of stochastic hybrid systems, HSCC 2000. Modes, guards and
// flows are those of the competition's model cars.mdl (ERATOMMSD/falstar); here with Euler steps of
// 10 ms, there with Simulink's variable step.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace towbench::tests {

struct CarsRun {
  std::vector<double> time_s;
  std::array<std::vector<double>, 5> y_m;
};

class ChasingCars {
 public:
  static constexpr double kEnd_s = 100;
  static constexpr double kStep_s = 0.01;
  static constexpr std::size_t kStepsASample = 10;

  // Inputs 0 .. 1, constant over equal stretches of the whole time.
  static CarsRun run(const std::vector<double>& throttle, const std::vector<double>& brake) {
    ChasingCars cars;
    CarsRun run;
    const auto steps = static_cast<std::size_t>(kEnd_s / kStep_s);
    for (std::size_t i = 0; i <= steps; ++i) {
      if (i % kStepsASample == 0) {
        run.time_s.push_back(static_cast<double>(i) * kStep_s);
        for (std::size_t car = 0; car < 5; ++car) {
          run.y_m[car].push_back(cars.y_m_[car]);
        }
      }
      const auto part = [&](const std::vector<double>& input) {
        return input[std::min(input.size() - 1, i * input.size() / steps)];
      };
      cars.step(part(throttle), part(brake));
    }
    return run;
  }

 private:
  enum class Mode { kKeeping, kChasing, kBraking };

  void step(double throttle, double brake) {
    for (std::size_t car = 1; car < 5; ++car) {
      change_mode(mode_[car], y_m_[car] - y_m_[car - 1]);
    }
    auto y_rate = v_;
    std::array<double, 5> v_rate{-throttle - brake * v_[0]};
    for (std::size_t car = 1; car < 5; ++car) {
      const auto mode = mode_[car];
      v_rate[car] = mode == Mode::kChasing ? 1 : mode == Mode::kBraking ? -v_[car] : 0;
      y_rate[car] = mode == Mode::kKeeping ? v_[car] : -v_[car];
    }
    for (std::size_t car = 0; car < 5; ++car) {
      v_[car] += v_rate[car] * kStep_s;
      y_m_[car] += y_rate[car] * kStep_s;
    }
  }

  static void change_mode(Mode& mode, double distance) {
    if (mode == Mode::kKeeping) {
      mode = distance >= 15 ? Mode::kChasing : distance <= 5 ? Mode::kBraking : mode;
    } else if (mode == Mode::kChasing) {
      mode = distance <= 10 ? Mode::kKeeping : mode;
    } else {
      mode = distance >= 20 ? Mode::kChasing : mode;
    }
  }

  std::array<double, 5> y_m_{0, 10, 20, 30, 40};
  std::array<double, 5> v_{};
  std::array<Mode, 5> mode_{};
};

}  // namespace towbench::tests
