// What repeats with the turn of a shaft, with a tooth, or with time.
#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "study/prediction/effect_steps.h"

namespace towbench::study::diagnose {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;

double motor_per_m(const Context& c) {
  return c.stated.metres_per_motor_rad > 0 ? 1 / (kFullTurn * c.stated.metres_per_motor_rad) : 0;
}
double wheel_per_m(const Context& c) {
  return c.stated.output_radius_m > 0 ? 1 / (kFullTurn * c.stated.output_radius_m) : 0;
}

// Resolved by the encoder, and long enough travelled to be no slope.
void add_visible(std::vector<Scales>& grid, const Context& c, double per_m) {
  if (per_m > 0 && per_m * c.resolution_m < 0.2 && per_m * c.stroke_m > 0.7) {
    grid.push_back({per_m});
  }
}

std::vector<Scales> turns(const Context& c) {
  std::vector<Scales> grid;
  for (const double harmonic : {1.0, 2.0, 3.0, 4.0, 6.0, 12.0}) {
    add_visible(grid, c, harmonic * motor_per_m(c));
  }
  for (const double harmonic : {1.0, 2.0}) {
    add_visible(grid, c, harmonic * wheel_per_m(c));
  }
  for (const double per_m : c.lines_per_m) {
    // Of fewer periods in the stroke it is a shape of the place.
    if (per_m * c.stroke_m > kShapes + 2) add_visible(grid, c, per_m);
  }
  return grid;
}

std::vector<Scales> wheel_turn(const Context& c) {
  std::vector<Scales> grid;
  add_visible(grid, c, wheel_per_m(c));
  return grid;
}

std::vector<Scales> motor_turn(const Context& c) {
  std::vector<Scales> grid;
  add_visible(grid, c, motor_per_m(c));
  return grid;
}

// Teeth of the wheel are not in the model: usual numbers.
std::vector<Scales> teeth(const Context& c) {
  std::vector<Scales> grid;
  for (int count = 10; count <= 40; ++count) {
    add_visible(grid, c, count * wheel_per_m(c));
  }
  return grid;
}

std::vector<Scales> lines_in_time(const Context& c) {
  std::vector<Scales> grid;
  for (const double hertz : c.lines_Hz) grid.push_back({hertz});
  return grid;
}

double reading_step(const Context& c) {
  return 0.3 * std::max(c.resolution_m, 1e-7 * c.stroke_m);
}

}  // namespace

void add_periodic_effects(std::vector<Effect>& library) {
  library.push_back({.name = "torque_ripple",
                     .cause = "a force repeating with a shaft's turn (cogging, commutation)",
                     .needs = "slow motion over several turns",
                     .amplitudes = {Key::kRippleCosine, Key::kRippleSine},
                     .amplitude_names = {"cosine_N", "sine_N"},
                     .scales = {Key::kRipplePerMetre},
                     .scale_names = {"spatial_frequency_per_m"},
                     .own = 0.1,  // of few turns it is a shape of the place
                     .grid = turns,
                     .set = set_scale<Key::kRipplePerMetre>,
                     .step = force_step});
  library.push_back({.name = "sprocket_eccentricity",
                     .cause = "a wheel that runs out of round",
                     .needs = "travel over at least one wheel turn",
                     .amplitudes = {Key::kOutOfRoundCosine, Key::kOutOfRoundSine},
                     .amplitude_names = {"cosine_ratio", "sine_ratio"},
                     .scales = {Key::kOutOfRoundPerMetre},
                     .scale_names = {"spatial_frequency_per_m"},
                     .grid = wheel_turn,
                     .set = set_scale<Key::kOutOfRoundPerMetre>,
                     .step = share_step});
  library.push_back({.name = "sprocket_eccentricity",
                     .cause = "a wheel that runs out of round: the load goes faster and slower",
                     .needs = "travel over at least one wheel turn",
                     .amplitudes = {Key::kWheelCosine, Key::kWheelSine},
                     .amplitude_names = {"cosine_ratio", "sine_ratio"},
                     .scales = {Key::kWheelPerMetre},
                     .scale_names = {"spatial_frequency_per_m"},
                     .grid = wheel_turn,
                     .set = set_scale<Key::kWheelPerMetre>,
                     .step = share_step});
  library.push_back({.name = "chain_polygon",
                     .cause = "links that lie on their wheel as a polygon",
                     .needs = "medium speed, where a tooth passes within the band",
                     .amplitudes = {Key::kReadCosine, Key::kReadSine},
                     .amplitude_names = {"cosine_m", "sine_m"},
                     .scales = {Key::kReadPerMetre},
                     .scale_names = {"spatial_frequency_per_m"},
                     .grid = teeth,
                     .set = set_scale<Key::kReadPerMetre>,
                     .step = reading_step});
  library.push_back({.name = "encoder_eccentricity",
                     .cause = "an encoder disk that runs out of centre",
                     .needs = "a turn of the motor within the band, at two speeds",
                     .amplitudes = {Key::kReadCosine, Key::kReadSine},
                     .amplitude_names = {"cosine_m", "sine_m"},
                     .scales = {Key::kReadPerMetre},
                     .scale_names = {"spatial_frequency_per_m"},
                     .grid = motor_turn,
                     .set = set_scale<Key::kReadPerMetre>,
                     .step = reading_step});
  library.push_back({.name = "periodic_force",
                     .cause = "a force that repeats in time, whatever the motion",
                     .needs = "several periods of it",
                     .amplitudes = {Key::kPeriodicCosine, Key::kPeriodicSine},
                     .amplitude_names = {"cosine_N", "sine_N"},
                     .scales = {Key::kPeriodicHertz},
                     .scale_names = {"frequency_Hz"},
                     .grid = lines_in_time,
                     .set = set_scale<Key::kPeriodicHertz>,
                     .step = force_step});
}

}  // namespace towbench::study::diagnose
