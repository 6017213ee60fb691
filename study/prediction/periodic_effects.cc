// What repeats with the turn of a shaft, with a tooth, or with time.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "study/prediction/effect_steps.h"

namespace towbench::study::diagnose {
namespace {

constexpr double kFullTurn = 2 * std::numbers::pi;
constexpr double kUsualDry = 0.8;  // of dry friction behind the wheel, per that of what moves

double motor_per_m(const Context& c) {
  return c.stated.metres_per_motor_rad > 0 ? 1 / (kFullTurn * c.stated.metres_per_motor_rad) : 0;
}
double output_per_m(const Context& c) {
  return c.stated.output_radius_m > 0 ? 1 / (kFullTurn * c.stated.output_radius_m) : 0;
}
double wheel_per_m(const Context& c) {
  return c.stated.has_wheel ? output_per_m(c) : 0;
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
    add_visible(grid, c, harmonic * output_per_m(c));
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

// Rigid, the load's part of what moves and of what rubs are not known.
template <std::vector<Scales> (*waves)(const Context&)>
std::vector<Scales> and_dry(const Context& c) {
  std::vector<Scales> grid = waves(c);
  for (Scales& scales : grid) {
    scales.push_back(c.stated.elastic() ? c.stated.transmission.load_share : kUsualDry);
  }
  return grid;
}

void set_wheel(Parameters& p, const Context& /*c*/, std::span<const double> scales) {
  p[Key::kWheelPerMetre] = scales[0];
  p[Key::kWheelDry] = scales[1];
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

constexpr double kDegrees = 180 / std::numbers::pi;

// The fit has the force against the ripple, the file the ripple: -(a cos + b sin) = A sin(k theta +
// phi).
PlantValues ripple_values(const Parameters& p, const StatedPlant& stated) {
  const double cosine = -p[Key::kRippleCosine];
  const double sine = -p[Key::kRippleSine];
  const double r = stated.metres_per_motor_rad;
  return {std::hypot(cosine, sine) * r, p[Key::kRipplePerMetre] * kFullTurn * r,
          std::atan2(cosine, sine) * kDegrees};
}

// w = (e / R) cos(phi + phi_0), phi the angle of the wheel
PlantValues eccentric_wheel_values(const Parameters& p, const StatedPlant& stated) {
  const double cosine = p[Key::kWheelCosine];
  const double sine = p[Key::kWheelSine];
  return {std::hypot(cosine, sine) * stated.output_radius_m, std::atan2(-sine, cosine) * kDegrees};
}

// Of N teeth: the first harmonic of what chords pay out is 2 R / N^3 sin(N phi), and the encoder
// stays behind by it. Where it begins is the plant's own, so it must be that of the fit by half.
PlantValues polygon_values(const Parameters& p, const StatedPlant& stated) {
  const double radius_m = stated.output_radius_m;
  const double teeth = std::round(p[Key::kReadPerMetre] * kFullTurn * radius_m);
  const double cosine = p[Key::kReadCosine];
  const double sine = p[Key::kReadSine];
  const double off_m = std::hypot(cosine, sine + 2 * radius_m / (teeth * teeth * teeth));
  return off_m < 0.5 * std::hypot(cosine, sine) ? PlantValues{teeth} : PlantValues{};
}

// The slope of the same: 2 / N^2 cos(N phi).
PlantValues polygon_wheel_values(const Parameters& p, const StatedPlant& stated) {
  const double teeth = std::round(p[Key::kWheelPerMetre] * kFullTurn * stated.output_radius_m);
  const double cosine = p[Key::kWheelCosine];
  const double sine = p[Key::kWheelSine];
  const double off = std::hypot(cosine - 2 / (teeth * teeth), sine);
  return off < 0.5 * std::hypot(cosine, sine) ? PlantValues{teeth} : PlantValues{};
}

// A cos(alpha) + B sin(alpha) = e sin(alpha - phase)
PlantValues eccentric_disk_values(const Parameters& p, const StatedPlant& stated) {
  if (stated.model.metres_per_count <= 0) return {};
  const double cosine = p[Key::kReadCosine];
  const double sine = p[Key::kReadSine];
  return {std::hypot(cosine, sine) / stated.model.metres_per_count,
          std::atan2(-cosine, sine) * kDegrees};
}

}  // namespace

void add_periodic_effects(std::vector<Effect>& library) {
  library.push_back({.name = "torque_ripple",
                     .cause = "a force repeating with a shaft's turn (cogging, commutation)",
                     .needs = "slow motion over several turns",
                     .law = "a cos(2 pi f x) + b sin(2 pi f x)",
                     .source = "harmonic of a shaft",
                     .amplitudes = {Key::kRippleCosine, Key::kRippleSine},
                     .amplitude_names = {"cosine_N", "sine_N"},
                     .scales = {Key::kRipplePerMetre},
                     .scale_names = {"spatial_frequency_per_m"},
                     .own = 0.1,  // of few turns it is a shape of the place
                     .grid = turns,
                     .set = set_scale<Key::kRipplePerMetre>,
                     .step = force_step,
                     .plant_keys = {"disturbances.torque_ripple.amplitude_Nm",
                                    "disturbances.torque_ripple.periods_per_turn",
                                    "disturbances.torque_ripple.phase_deg"},
                     .plant_values = ripple_values});
  library.push_back({.name = "sprocket_eccentricity",
                     .cause = "a wheel that runs out of round",
                     .needs = "travel over at least one wheel turn",
                     .law = "(1 - a cos(2 pi f x) - b sin(2 pi f x)) u",
                     .source = "assumed: the lever alone",
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
                     .law = "load goes (1 + w) times as far, w = a cos(2 pi f x) + b sin(2 pi f x)",
                     .source = "virtual work on an eccentric wheel",
                     .amplitudes = {Key::kWheelCosine, Key::kWheelSine},
                     .amplitude_names = {"cosine_ratio", "sine_ratio"},
                     .scales = {Key::kWheelPerMetre, Key::kWheelDry},
                     .scale_names = {"spatial_frequency_per_m", "friction_share_of_load"},
                     .grid = and_dry<wheel_turn>,
                     .set = set_wheel,
                     .step = share_step,
                     .plant_keys = {"disturbances.wheel.eccentricity_m",
                                    "disturbances.wheel.eccentricity_phase_deg"},
                     .plant_values = eccentric_wheel_values});
  library.push_back({.name = "chain_polygon",
                     .cause = "links that lie on their wheel as a polygon",
                     .needs = "medium speed, where a tooth passes within the band",
                     .law = "reads x + a cos(2 pi f x) + b sin(2 pi f x), f of a tooth",
                     .source = "chords on a pitch circle",
                     .amplitudes = {Key::kReadCosine, Key::kReadSine},
                     .amplitude_names = {"cosine_m", "sine_m"},
                     .scales = {Key::kReadPerMetre},
                     .scale_names = {"spatial_frequency_per_m"},
                     .grid = teeth,
                     .set = set_scale<Key::kReadPerMetre>,
                     .step = reading_step,
                     .plant_keys = {"disturbances.wheel.teeth"},
                     .plant_values = polygon_values});
  library.push_back({.name = "chain_polygon",
                     .cause = "links that lie on their wheel as a polygon: the load goes faster "
                              "and slower",
                     .needs = "medium speed, where a tooth passes within the band",
                     .law = "load goes (1 + w) times as far, w = a cos(2 pi f x) + b sin(2 pi f "
                            "x), f of a tooth",
                     .source = "chords on a pitch circle, virtual work",
                     .amplitudes = {Key::kWheelCosine, Key::kWheelSine},
                     .amplitude_names = {"cosine_ratio", "sine_ratio"},
                     .scales = {Key::kWheelPerMetre, Key::kWheelDry},
                     .scale_names = {"spatial_frequency_per_m", "friction_share_of_load"},
                     .grid = and_dry<teeth>,
                     .set = set_wheel,
                     .step = share_step,
                     .plant_keys = {"disturbances.wheel.teeth"},
                     .plant_values = polygon_wheel_values});
  library.push_back(
      {.name = "encoder_eccentricity",
       .cause = "an encoder disk that runs out of centre",
       .needs = "a turn of the motor within the band, at two speeds",
       .law = "reads x + a cos(2 pi f x) + b sin(2 pi f x), f of the motor",
       .source = "eccentric disk",
       .amplitudes = {Key::kReadCosine, Key::kReadSine},
       .amplitude_names = {"cosine_m", "sine_m"},
       .scales = {Key::kReadPerMetre},
       .scale_names = {"spatial_frequency_per_m"},
       .grid = motor_turn,
       .set = set_scale<Key::kReadPerMetre>,
       .step = reading_step,
       .plant_keys = {"encoder.eccentricity_counts", "encoder.eccentricity_phase_deg"},
       .plant_values = eccentric_disk_values});
  library.push_back({.name = "periodic_force",
                     .cause = "a force that repeats in time, whatever the motion",
                     .needs = "several periods of it",
                     .law = "a cos(2 pi f t) + b sin(2 pi f t)",
                     .source = "a source of its own",
                     .amplitudes = {Key::kPeriodicCosine, Key::kPeriodicSine},
                     .amplitude_names = {"cosine_N", "sine_N"},
                     .scales = {Key::kPeriodicHertz},
                     .scale_names = {"frequency_Hz"},
                     .grid = lines_in_time,
                     .set = set_scale<Key::kPeriodicHertz>,
                     .step = force_step});
}

}  // namespace towbench::study::diagnose
